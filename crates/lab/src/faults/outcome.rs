//! What came of a task, and which known mistakes were made again.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use typelift::agent::{Account, Ending, Suspect};
use typelift::model::{GroundCall, Plan};
use typelift::plan::Exclusion;
use typelift::world::{Acted, Reset, Scene, World, WorldError};
use typelift_kitchen::Kitchen;

use crate::attempt::{Attempt, ending_word};

/// What came of a task.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Outcome {
    /// How it ended.
    pub ending: String,
    /// Why there is no plan, if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
    /// Plans proposed.
    pub proposals: u64,
    /// Actions executed, retries included.
    pub actions: u64,
    /// The length of the plan that succeeded.
    pub plan_length: Option<usize>,
    /// What was excluded, and from which actions if not from all.
    pub excluded: Vec<String>,
    /// The imagined actions of the plan that succeeded.
    pub imagined: Vec<String>,
    /// Actions that failed.
    pub failed: Vec<String>,
    /// Whether exclusions were lifted, since nothing else was left.
    pub lifted: bool,
    /// Whether actions were used although some of their effects held already, since nothing else was left.
    pub relaxed: bool,
}

impl Outcome {
    /// Whether the goal was seen to hold.
    pub fn solved(&self) -> bool {
        self.plan_length.is_some()
    }
}

pub(super) fn outcome(account: &Account) -> Outcome {
    let plan = account.plan.as_ref().filter(|_| account.solved());
    let imagined = |plan: &Plan| -> BTreeSet<String> {
        plan.steps.iter().filter(|step| step.imagined.is_some()).map(|step| step.action.to_string()).collect()
    };
    let why = match &account.ending {
        Ending::NoPlan(explanation) => explanation.to_string().lines().next().map(str::to_owned),
        _ => None,
    };
    let excluded: BTreeSet<String> =
        account.failures.iter().flat_map(|f| &f.suspects).map(ToString::to_string).collect();
    Outcome {
        ending: ending_word(&account.ending),
        why,
        proposals: account.proposals,
        actions: account.actions,
        plan_length: plan.map(Plan::len),
        excluded: excluded.into_iter().collect(),
        imagined: plan.map(imagined).unwrap_or_default().into_iter().collect(),
        failed: account.failures.iter().map(|failure| failure.call.to_string()).collect(),
        lifted: account.resorts.lifted(),
        relaxed: account.resorts.relaxed(),
    }
}

/// Known mistakes made again in the later task: a ground action, with the effect expected of it, that failed in the
/// first and fails again, or a thing excluded then that takes part although exclusions were not lifted.
pub(super) fn repeated(first: &Attempt, later: &Attempt, told: &[GroundCall]) -> Vec<String> {
    let bans = |attempt: &Attempt| attempt.experience.bans(&attempt.instance);
    let before: BTreeMap<_, _> = bans(first).into_iter().map(|(ban, why)| (ban, why.count)).collect();
    let after = bans(later).into_iter();
    let again = after.filter(|(ban, why)| before.get(ban).is_some_and(|count| why.count > *count));
    let suspects = first.experience.suspects(&first.instance);
    let excluded = |call: &&GroundCall| {
        suspects.iter().any(|(suspect, _)| match suspect {
            Suspect::Object(Exclusion { object, call: from }) => {
                call.args.contains(object) && from.as_ref().is_none_or(|name| *name == call.name)
            }
            // What is said of types says nothing of names.
            Suspect::Types(_) | Suspect::Condition(_) | Suspect::Around(_) => false,
        })
    };
    let used = told.iter().filter(|call| !later.account.resorts.lifted() && excluded(call));
    again.map(|(ban, _)| ban.call.to_string()).chain(used.map(ToString::to_string)).collect()
}

/// Calls that failed in the first task and again in the later one, where something else was expected of them: nothing
/// else was left, and exclusions were lifted.
pub(super) fn failed_otherwise(first: &Attempt, later: &Attempt, repeated: &[String]) -> Vec<String> {
    let calls = |attempt: &Attempt| -> BTreeSet<String> {
        attempt.account.failures.iter().map(|failure| failure.call.to_string()).collect()
    };
    calls(first).intersection(&calls(later)).filter(|call| !repeated.contains(call)).cloned().collect()
}

/// A kitchen that writes down what it is told.
#[derive(Debug, Default)]
pub(super) struct Listening {
    kitchen: Kitchen,
    pub(super) told: Vec<GroundCall>,
}

impl World for Listening {
    fn name(&self) -> String {
        self.kitchen.name()
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        self.kitchen.reset(reset)
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.kitchen.observe()
    }

    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
        self.told.push(call.clone());
        self.kitchen.act(call)
    }
}
