//! What a step of a trace is taken for, from what is said of it. Everything else is in its states.
//!
//! | the trace says                                      | the learner takes the step for              |
//! |-----------------------------------------------------|---------------------------------------------|
//! | `as-expected`, whatever the flag                    | what its states show                        |
//! | `"executed": false`, or `refused`                   | a failure, whatever changed meanwhile       |
//! | `timed-out`                                         | neither: it may have been half done         |
//! | anything else: nothing, `nothing`, `partly`, `otherwise` | what its states show                   |
//!
//! What its states show is an observation of an action, if something changed, and a failure, if nothing did. A change
//! that another made, or an accident on the way, is not what an action does: what a step that was not executed
//! left behind is counted, with its places, and nothing is learned from it.

use typelift_world::{TraceAction, Verdict};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The states around it decide.
    AsShown,
    /// It was not carried out.
    NotExecuted,
    /// It may have been carried out in part.
    Undecided,
}

pub(crate) fn outcome(action: &TraceAction) -> Outcome {
    match (action.executed, action.verdict) {
        (_, Some(Verdict::AsExpected)) => Outcome::AsShown,
        (_, Some(Verdict::TimedOut)) => Outcome::Undecided,
        (Some(false), _) | (_, Some(Verdict::Refused)) => Outcome::NotExecuted,
        _ => Outcome::AsShown,
    }
}

#[cfg(test)]
mod tests {
    use typelift_model::GroundCall;

    use super::*;

    #[test]
    fn what_was_seen_to_happen_happened() {
        let read = |executed, verdict| {
            let call = GroundCall { name: "do".into(), args: Vec::new() };
            outcome(&TraceAction { executed, verdict, ..TraceAction::from(call) })
        };
        assert_eq!(read(None, None), Outcome::AsShown);
        assert_eq!(read(Some(true), Some(Verdict::Nothing)), Outcome::AsShown);
        assert_eq!(read(Some(false), Some(Verdict::AsExpected)), Outcome::AsShown);
        assert_eq!(read(Some(false), None), Outcome::NotExecuted);
        assert_eq!(read(Some(false), Some(Verdict::Otherwise)), Outcome::NotExecuted);
        assert_eq!(read(Some(true), Some(Verdict::Refused)), Outcome::NotExecuted);
        assert_eq!(read(Some(true), Some(Verdict::TimedOut)), Outcome::Undecided);
    }
}
