//! A blocking driver: an episode over a world.

use thiserror::Error;
use typelift_model::Plan;
use typelift_world::{ParseError, Parser, Reset, Scene, World, WorldError, instance_of};

use crate::account::Account;
use crate::episode::{Episode, EpisodeError};
use crate::event::Observer;
use crate::objection::Objection;
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
        /// What speaks against it.
        objection: Option<Objection>,
        /// Why, in words.
        reason: String,
    },
    /// Propose another one.
    AnotherPlan,
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
    /// The goal is none in this world, or the planner erred.
    #[error(transparent)]
    Episode(#[from] EpisodeError),
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
            Command::Reset { id } => {
                // What cannot be set back is taken as it is.
                let scene = if world.can_reset() { world.reset(reset)? } else { world.observe()? };
                Input::Reset { id, state: parse(&scene)?, instance: Some(instance_of(world, reset)) }
            }
            // Actions are answered at once, so none is ever under way.
            Command::Observe { id } | Command::Await { id, .. } => {
                Input::Observation { id, state: parse(&world.observe()?)? }
            }
            Command::Propose { id, plan } => match confirm(&plan) {
                Confirmation::Approve => Input::Approve { id },
                Confirmation::Reject { step, objection, reason } => Input::Reject { id, step, objection, reason },
                Confirmation::AnotherPlan => Input::AnotherPlan { id },
                Confirmation::Stop => Input::Stop,
            },
            Command::Act { id, call } => {
                let acted = world.act(&call)?;
                let state = parse(&acted.scene)?;
                match acted.reason.filter(|_| !acted.executed) {
                    Some(reason) => Input::Refused { id, reason, state },
                    None if !acted.executed => Input::Refused { id, reason: "not executed".to_owned(), state },
                    None => Input::Observation { id, state },
                }
            }
            Command::Done(account) => return Ok(*account),
        };
    }
}
