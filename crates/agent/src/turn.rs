//! What passes between an episode and whoever drives it.

use typelift_model::{GroundCall, Plan, State};

use crate::account::Account;

/// What the driver is to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Set the world to its initial state; answer with an observation.
    Reset,
    /// Observe; answer with an observation.
    Observe,
    /// Have this plan approved or rejected, if anyone is to be asked.
    Propose(Plan),
    /// Execute this; answer with an observation, a refusal or a time-out.
    Act(GroundCall),
    /// It is over.
    Done(Box<Account>),
}

/// What the driver reports.
#[derive(Debug, Clone, PartialEq)]
pub enum Input {
    /// The episode may begin.
    Started,
    /// What is observed, after a reset, an observation or an action that was executed.
    Observation(State),
    /// The plan may be executed.
    Approve,
    /// A step of the proposed plan, counted from 1, is not to be taken.
    Reject {
        /// The step.
        step: usize,
        /// Why.
        reason: String,
    },
    /// Whoever executes declined the action; with what is observed now. The observation decides: if what was
    /// expected happened all the same, the step succeeded.
    Refused {
        /// Why.
        reason: String,
        /// What is observed now.
        state: State,
    },
    /// Whoever executes did not finish in time, but can be observed: for a robot's own loop. [`run`](crate::run) treats a
    /// world that does not answer as failed.
    TimedOut,
    /// End the episode.
    Stop,
}
