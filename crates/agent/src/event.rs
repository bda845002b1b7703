//! What happens during an episode, for whoever watches.

use serde::{Deserialize, Serialize};
use typelift_model::{GroundAtom, GroundCall, Hierarchy, Plan, Symbol, describe_replacements};
use typelift_world::Record;

use crate::blame::Suspect;
use crate::monitor::StepResult;
use crate::resort::Resort;

/// One step of a plan, in plain words.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StepSummary {
    /// The action schema.
    pub action: Symbol,
    /// What the environment is told.
    pub call: GroundCall,
    /// What was put in place of what, if the step is imagined.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub imagined: Option<String>,
}

/// A plan, in plain words.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlanSummary {
    /// The steps.
    pub steps: Vec<StepSummary>,
}

impl PlanSummary {
    /// The summary of a plan over a hierarchy.
    pub fn of(plan: &Plan, hierarchy: &Hierarchy) -> Self {
        let steps = plan.steps.iter().map(|step| StepSummary {
            action: step.action.clone(),
            call: step.call.clone(),
            imagined: step.imagined.as_ref().map(|i| describe_replacements(&i.replaced, hierarchy)),
        });
        Self { steps: steps.collect() }
    }
}

/// Something that happened.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event {
    /// Planning begins.
    PlanningStarted {
        /// The number of the proposal it may lead to, from 1.
        proposal: u64,
    },
    /// Planning ended.
    PlanningEnded {
        /// Nodes expanded.
        expansions: u64,
        /// Ground actions.
        ground_actions: u64,
        /// Names of the actions that were imagined.
        imagined: Vec<Symbol>,
        /// Whether there is a plan.
        found: bool,
    },
    /// A plan is proposed.
    Proposed {
        /// Its number, from 1.
        proposal: u64,
        /// The plan.
        plan: PlanSummary,
    },
    /// A step was executed, or rejected.
    Stepped {
        /// The proposal's number.
        proposal: u64,
        /// The step's number, from 1.
        step: usize,
        /// The action.
        call: GroundCall,
        /// Whether it rests on an imagined action.
        imagined: bool,
        /// What came of it.
        result: StepResult,
        /// The environment's or the person's reason, if given.
        #[serde(skip_serializing_if = "Option::is_none")]
        reason: Option<String>,
        /// What it added.
        added: Vec<GroundAtom>,
        /// What it deleted.
        deleted: Vec<GroundAtom>,
    },
    /// A failed step is tried again.
    Retried {
        /// The action.
        call: GroundCall,
    },
    /// Something is to blame, and excluded.
    Excluded {
        /// What.
        #[serde(flatten)]
        suspect: Suspect,
        /// Why.
        reason: String,
    },
    /// The world changed by itself: the next step of the plan is no longer applicable.
    Drifted {
        /// The step's number, from 1.
        step: usize,
        /// The precondition that no longer holds.
        missing: String,
    },
    /// Something is given up since nothing else was left; ground actions that failed stay banned.
    LastResort {
        /// What.
        resort: Resort,
    },
    /// Another plan was asked for, and there is none, or no more may be proposed.
    NoOtherPlan {
        /// The number of the proposal that stands.
        proposal: u64,
    },
    /// It is over.
    Ended {
        /// Whether the goal was seen to hold.
        solved: bool,
    },
}

/// Watches an episode.
pub trait Observer {
    /// Something happened.
    fn event(&mut self, event: &Event);

    /// What happened at a step, whatever came of it; the event [`Stepped`](Event::Stepped) tells of it after that. States
    /// hold what follows from the model's axioms too.
    fn record(&mut self, _: &Record) {}
}

/// Watches nothing.
impl Observer for () {
    fn event(&mut self, _: &Event) {}
}

impl Observer for Vec<Event> {
    fn event(&mut self, event: &Event) {
        self.push(event.clone());
    }
}
