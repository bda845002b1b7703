//! What happens during an episode, for its observers.

use serde::Serialize;
use typelift_model::{GroundAtom, GroundCall, Plan, State, Stop, Symbol};
use typelift_world::{Record, Verdict};

use crate::monitor::StepResult;
use crate::resort::Resort;
use crate::suspect::Suspect;

/// Why no other plan is proposed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum WhyNoOther {
    /// There is none.
    NoMorePlans,
    /// No more may be proposed.
    ProposalLimit,
    /// The search was stopped before it found one. Asked again, it goes on.
    Stopped(Stop),
}

/// On what terms a plan is looked for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PlanningTerms {
    /// The usual ones, with the exclusions that count by then.
    #[default]
    Usual,
    /// There is no plan on the usual ones, and this is given up. That it led to a proposal, and whether it is given up from then
    /// on, is told by a [`LastResort`](Event::LastResort).
    WithResort(Resort),
    /// There is none either way, and preconditions are done without.
    Loosened,
    /// Those of the plan before: another one is looked for.
    AsBefore,
}

/// Something that happened. `P` is how plans are told: programs outside are given a view of them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Event<P = Plan> {
    /// Planning begins.
    PlanningStarted {
        /// The number of the proposal it may lead to, from 1.
        proposal: u64,
        /// On what terms.
        #[cfg_attr(feature = "schema", schemars(default))]
        terms: PlanningTerms,
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
        plan: P,
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
        /// What the environment reported, where the states show that the step was done all the same.
        #[serde(skip_serializing_if = "Option::is_none")]
        reported: Option<Verdict>,
        /// What it added.
        added: Vec<GroundAtom>,
        /// What it deleted.
        deleted: Vec<GroundAtom>,
        /// What was expected of it and did not come about: what was to hold, and after `not` what was to hold no longer.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        #[cfg_attr(feature = "schema", schemars(default))]
        missed: Vec<String>,
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
    /// What a person said before no longer counts, since the same person, or another one, said something else.
    Overruled {
        /// What was said, with the step that it was about.
        reason: String,
    },
    /// The world changed by itself: the next step of the plan is no longer applicable.
    Drifted {
        /// The step's number, from 1.
        step: usize,
        /// The precondition that no longer holds, or the name of an entity that is there no more.
        missing: String,
    },
    /// Something is given up since nothing else was left; ground actions that failed stay banned.
    LastResort {
        /// What.
        resort: Resort,
    },
    /// Another plan was asked for, and none is proposed.
    NoOtherPlan {
        /// The number of the proposal that stands.
        proposal: u64,
        /// Why.
        why: WhyNoOther,
    },
    /// It is over.
    Ended {
        /// Whether the goal was seen to hold.
        solved: bool,
        /// The [word](crate::Ending::word) for how it ended, as in the account.
        #[cfg_attr(feature = "schema", schemars(default))]
        ending: &'static str,
    },
}

impl<P: Clone> Event<P> {
    /// The same with its plan told as `tell` does.
    pub fn map_plan<Q>(&self, tell: impl FnOnce(&P) -> Q) -> Event<Q> {
        match self.clone() {
            Self::PlanningStarted { proposal, terms } => Event::PlanningStarted { proposal, terms },
            Self::PlanningEnded { expansions, ground_actions, imagined, found } => {
                Event::PlanningEnded { expansions, ground_actions, imagined, found }
            }
            Self::Proposed { proposal, plan } => Event::Proposed { proposal, plan: tell(&plan) },
            Self::Stepped { proposal, step, call, imagined, result, reason, reported, added, deleted, missed } => {
                Event::Stepped { proposal, step, call, imagined, result, reason, reported, added, deleted, missed }
            }
            Self::Retried { call } => Event::Retried { call },
            Self::Excluded { suspect, reason } => Event::Excluded { suspect, reason },
            Self::Overruled { reason } => Event::Overruled { reason },
            Self::Drifted { step, missing } => Event::Drifted { step, missing },
            Self::LastResort { resort } => Event::LastResort { resort },
            Self::NoOtherPlan { proposal, why } => Event::NoOtherPlan { proposal, why },
            Self::Ended { solved, ending } => Event::Ended { solved, ending },
        }
    }
}

/// Watches an episode.
pub trait Observer {
    /// Something happened.
    fn event(&mut self, event: &Event);

    /// What is there when an episode begins, before anything is planned.
    fn first_state(&mut self, _: &State) {}

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
