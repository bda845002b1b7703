//! A blocking driver: an episode over a world.

use thiserror::Error;
use typelift_model::Plan;
use typelift_world::{ParseError, Parser, Reset, Scene, World, WorldError};

use crate::account::Account;
use crate::episode::Episode;
use crate::event::Observer;
use crate::propose::ProposeError;
use crate::turn::{Command, Input};

/// What whoever is asked says of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Confirmation {
    /// Execute it.
    Approve,
    /// Do not take this step, counted from 1; the plan is dropped.
    Reject {
        /// The step.
        step: usize,
        /// Why.
        reason: String,
    },
    /// End the episode.
    Stop,
}

/// Why an episode could not be driven to its end.
#[derive(Debug, Error)]
pub enum RunError {
    /// The environment failed.
    #[error(transparent)]
    World(#[from] WorldError),
    /// The environment's state is not one.
    #[error("the environment's state cannot be read: {0}")]
    State(#[from] ParseError),
    /// The planner erred.
    #[error(transparent)]
    Propose(#[from] ProposeError),
}

/// Drives an episode over a world; `confirm` is asked before each plan is executed.
///
/// # Errors
/// [`RunError`] if the environment fails, or the planner errs.
pub fn run(
    episode: &mut Episode,
    world: &mut dyn World,
    reset: &Reset,
    parser: &mut Parser,
    confirm: &mut dyn FnMut(&Plan) -> Confirmation,
    observer: &mut dyn Observer,
) -> Result<Account, RunError> {
    let mut parse = |scene: &Scene| parser.parse(scene);
    let mut input = Input::Started;
    loop {
        input = match episode.step(input, observer)? {
            Command::Reset if world.can_reset() => Input::Observation(parse(&world.reset(reset)?)?),
            // What cannot be set back is taken as it is.
            Command::Reset | Command::Observe => Input::Observation(parse(&world.observe()?)?),
            Command::Propose(plan) => match confirm(&plan) {
                Confirmation::Approve => Input::Approve,
                Confirmation::Reject { step, reason } => Input::Reject { step, reason },
                Confirmation::Stop => Input::Stop,
            },
            Command::Act(call) => {
                let acted = world.act(&call)?;
                let state = parse(&acted.scene)?;
                match acted.reason.filter(|_| !acted.executed) {
                    Some(reason) => Input::Refused { reason, state },
                    None if !acted.executed => Input::Refused { reason: "not executed".to_owned(), state },
                    None => Input::Observation(state),
                }
            }
            Command::Done(account) => return Ok(*account),
        };
    }
}
