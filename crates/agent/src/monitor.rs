//! The effect check: what an action changed against what it was expected to change.

use serde::Serialize;
use typelift_model::{GroundAction, GroundAtom, State};

/// What came of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StepResult {
    /// Every expected change was observed; more may have changed besides.
    AsExpected,
    /// Nothing changed.
    NothingChanged,
    /// Some of the expected changes were observed.
    Partly,
    /// Something changed, but nothing that was expected.
    Otherwise,
    /// Whoever executes declined, and nothing changed.
    Refused,
    /// Whoever executes did not finish in time.
    TimedOut,
    /// A person rejected the step before it was executed.
    Rejected,
}

impl StepResult {
    /// A short phrase for it.
    pub fn phrase(self) -> &'static str {
        match self {
            Self::AsExpected => "as expected",
            Self::NothingChanged => "nothing changed",
            Self::Partly => "only part of the expected effect happened",
            Self::Otherwise => "something else happened",
            Self::Refused => "refused",
            Self::TimedOut => "timed out",
            Self::Rejected => "rejected",
        }
    }
}

/// Compares an executed action with the states around it.
///
/// Every atom of the expected effect must be in the observed change; additional changes are tolerated. Every effect
/// of a learned action was a change when it was observed, so `strict_effects` expects each to be a change now; for
/// given actions only what would change is expected. An atom that is unknown before or after counts neither way.
pub fn compare(action: &GroundAction, before: &State, after: &State, strict_effects: bool) -> StepResult {
    let wanted = |atom: &&GroundAtom, adds: bool| {
        let known = !before.is_unknown(atom) && !after.is_unknown(atom);
        known && (strict_effects || before.holds(atom) != adds)
    };
    let added = |atom: &GroundAtom| !before.holds(atom) && after.holds(atom);
    let deleted = |atom: &GroundAtom| before.holds(atom) && !after.holds(atom);
    let adds: Vec<bool> = action.adds.iter().filter(|a| wanted(a, true)).map(added).collect();
    let deletes: Vec<bool> = action.deletes.iter().filter(|a| wanted(a, false)).map(deleted).collect();
    let observed: Vec<bool> = adds.into_iter().chain(deletes).collect();
    if observed.iter().all(|&seen| seen) {
        StepResult::AsExpected
    } else if before.objects == after.objects && before.added(after).chain(before.deleted(after)).next().is_none() {
        StepResult::NothingChanged
    } else if observed.iter().any(|&seen| seen) {
        StepResult::Partly
    } else {
        StepResult::Otherwise
    }
}
