//! What learning could make nothing of.

use typelift_model::Unexplained;

/// Why nothing was learned from a transition.
pub fn why_unexplained(reason: Unexplained) -> &'static str {
    match reason {
        Unexplained::ObjectsChanged => "entities appeared or vanished",
        Unexplained::PartlyObserved => "what they may have changed is unknown in part",
        Unexplained::UnlistedKinds => "their states do not list a kind of atoms that others list",
        Unexplained::TooLarge => "too many entities take part",
        Unexplained::TooSymmetric => "too many entities changed alike to tell them apart",
        Unexplained::NotExecuted => "something changed, though the action was not executed",
        Unexplained::TimedOut => "the action was not finished in time",
    }
}
