//! What is to be noted where there is no plan: of the goal, and of what was not imagined.

use typelift_agent::GivenUp;
use typelift_model::GoalTypeMismatch;

/// How much of what was given up is told: more nobody reads.
const TOLD: usize = 3;

/// What the guard of imagination refused, a line each; of many, the first few and how many more there were.
pub fn given_up_notes(given_up: &[GivenUp]) -> Vec<String> {
    let mut notes: Vec<String> =
        given_up.iter().take(TOLD).map(|given_up| format!("refused by the guard: {given_up}")).collect();
    let more = given_up.len().saturating_sub(TOLD);
    if let Some(last) = notes.last_mut().filter(|_| more > 0) {
        *last += &format!(" (and {more} more)");
    }
    notes
}

/// All that is to be noted where there is no plan, a line each.
pub(crate) fn notes(mismatches: &[GoalTypeMismatch], given_up: &[GivenUp]) -> Vec<String> {
    mismatches.iter().map(ToString::to_string).chain(given_up_notes(given_up)).collect()
}
