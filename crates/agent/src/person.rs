//! The person who is asked about plans, and who may show what to do.

use typelift_model::{GroundAtom, GroundCall, Plan, State};

use crate::objection::Objection;

/// The answer of the person who is asked about a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Confirmation {
    /// Execute it: nobody need be asked.
    Approve,
    /// Execute it: a person said so.
    Agree,
    /// Do not take this step, counted from 1; the plan is dropped.
    Reject {
        /// The step.
        step: usize,
        /// What speaks against it.
        objection: Option<Objection>,
        /// Why, in words.
        reason: String,
    },
    /// Propose another one.
    AnotherPlan,
    /// The person shows what to do instead, from where the world stands; then it is planned anew.
    Show,
    /// End the episode.
    Stop,
}

/// Who is asked. A function from plans to answers is somebody who shows nothing.
pub trait Person {
    /// What they say of a plan that is proposed in this state.
    fn confirm(&mut self, plan: &Plan, state: &State) -> Confirmation;

    /// What they do next where they [show](Confirmation::Show) something; `last` is what they did before and what came of it.
    /// Nothing ends the demonstration.
    fn show(&mut self, _state: &State, _last: Option<&Shown>) -> Option<GroundCall> {
        None
    }
}

impl<F: FnMut(&Plan) -> Confirmation> Person for F {
    fn confirm(&mut self, plan: &Plan, _: &State) -> Confirmation {
        self(plan)
    }
}

/// A step of a demonstration, and what came of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shown {
    /// What the environment was told.
    pub call: GroundCall,
    /// Whether it did it, if it said anything in time.
    pub executed: Option<bool>,
    /// Why not, if it says so.
    pub reason: Option<String>,
    /// What it added.
    pub added: Vec<GroundAtom>,
    /// What it deleted.
    pub deleted: Vec<GroundAtom>,
}
