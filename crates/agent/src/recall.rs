//! What was tried in earlier runs, from the records of it: the same experience as if it had been tried in this run.

use std::collections::BTreeSet;

use typelift_belief::Deed;
use typelift_model::{ActionModel, GroundAtom, State, Symbol};
use typelift_plan::Ban;
use typelift_world::{Expected, Trace, TraceAction, Verdict};

use crate::account::failure_in_words;
use crate::deed::{Failed, surroundings};
use crate::experience::Experience;
use crate::monitor::StepResult;

/// The record of an episode, or of the part of one up to where the world was set back.
#[derive(Debug, Clone, Copy)]
pub struct Recalled<'r> {
    /// What was done and observed.
    pub trace: &'r Trace,
    /// The instance of the world.
    pub instance: &'r Symbol,
    /// Whether it is the same task as in the record before it, after the world was set back.
    pub goes_on: bool,
}

impl Experience {
    /// Notes what was tried in an earlier run. Steps of which the record does not say what was expected teach nothing. In
    /// time of the record.
    pub fn recall(&mut self, recalled: &Recalled<'_>, model: &ActionModel) {
        let task = if recalled.goes_on { self.task() } else { self.begin_task() };
        let mut tries = 0;
        let steps = recalled.trace.states.windows(2).zip(&recalled.trace.actions);
        let mut next = steps.clone().skip(1).map(|(_, action)| action);
        for (states, action) in steps {
            let (before, after, next) = (&states[0], &states[1], next.next());
            let (Some(expected), Some(verdict)) = (&action.expected, action.verdict) else { continue };
            let adds: BTreeSet<Symbol> = expected.adds.iter().map(|atom| atom.predicate.clone()).collect();
            let hierarchy = &model.hierarchy;
            let deed = Deed::recorded(&action.call, &expected.args, adds, before, recalled.instance, hierarchy);
            tries += 1;
            if verdict == Verdict::AsExpected {
                let around = surroundings(&deed, model, before);
                self.succeeded(deed, around);
            } else if next.is_none_or(|next| next.call != action.call || next.expected != action.expected) {
                let reason = in_words(action, expected, verdict, before, after);
                let failed = Failed {
                    count: tries,
                    task,
                    ban: Some(ban(action, expected)),
                    ..Failed::of(deed, &action.call.name, model, before, &recalled.trace.goal, reason)
                };
                self.failed(failed);
            } else {
                continue;
            }
            if tries > 1 {
                self.retries.note(verdict == Verdict::AsExpected);
            }
            tries = 0;
        }
    }
}

fn ban(TraceAction { call, .. }: &TraceAction, expected: &Expected) -> Ban {
    let Expected { action, adds, deletes, .. } = expected.clone();
    Ban { action, call: call.clone(), adds, deletes }
}

/// The step and what came of it, as the run said it then.
fn in_words(action: &TraceAction, expected: &Expected, verdict: Verdict, before: &State, after: &State) -> String {
    let absent = expected.adds.iter().filter(|atom| !after.holds(atom)).map(ToString::to_string);
    let still = expected.deletes.iter().filter(|atom| after.holds(atom)).map(|atom| format!("not {atom}"));
    let missed: Vec<String> = absent.chain(still).collect();
    let added: Vec<GroundAtom> = before.added(after).cloned().collect();
    let deleted: Vec<GroundAtom> = before.deleted(after).cloned().collect();
    failure_in_words(&action.call, StepResult::Tried(verdict), action.reason.as_deref(), &missed, &added, &deleted)
}
