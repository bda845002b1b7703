//! A blocking driver: an episode over a world.

use thiserror::Error;
use typelift_model::Plan;
use typelift_world::{
    Acted, FileError, ParseError, Parser, Record, Recorder, Reset, Scene, TraceAction, World, WorldError, instance_of,
};

use crate::account::Account;
use crate::episode::{Episode, EpisodeError};
use crate::event::{Event, Observer};
use crate::objection::Objection;
use crate::turn::{Command, Input};

/// The answer of the person who is asked about a plan.
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
    /// What happened cannot be recorded.
    #[error(transparent)]
    Record(#[from] FileError),
}

/// Drives an episode over a world; `confirm` is asked before each plan is executed. With a recorder, each step is on the
/// disk before the observer is told of it and before the next action is sent.
///
/// # Errors
/// [`RunError`] if the environment fails, the planner errs, or what happens cannot be recorded.
pub fn run(
    episode: &mut Episode,
    world: &mut dyn World,
    reset: &Reset,
    parser: &mut Parser,
    confirm: &mut dyn FnMut(&Plan) -> Confirmation,
    observer: &mut dyn Observer,
    recorder: Option<&mut Recorder>,
) -> Result<Account, RunError> {
    let mut recording = RecordingObserver { observer, recorder, first: None, acted: None, error: None };
    let mut parse = |scene: &Scene| parser.parse(scene);
    let mut input = Input::Started;
    loop {
        let command = episode.step(input, &mut recording);
        if let Some(error) = recording.error {
            return Err(error.into());
        }
        input = match command? {
            Command::Reset { id } => {
                // What cannot be set back is taken as it is.
                let scene = if world.can_reset() { world.reset(reset)? } else { world.observe()? };
                let state = parse(&scene)?;
                recording.first = Some(scene);
                Input::Reset { id, state, instance: Some(instance_of(world, reset)) }
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
                recording.begin()?;
                let acted = world.act(&call)?;
                let state = parse(&acted.scene)?;
                let acted = recording.acted.insert(acted);
                match &acted.reason {
                    _ if acted.executed => Input::Observation { id, state },
                    Some(reason) => Input::Refused { id, reason: reason.clone(), state },
                    None => Input::Refused { id, reason: "not executed".to_owned(), state },
                }
            }
            Command::Done(account) => return Ok(*account),
        };
    }
}

/// Records each step as the environment told it, and only then tells the observer.
struct RecordingObserver<'a> {
    observer: &'a mut dyn Observer,
    recorder: Option<&'a mut Recorder>,
    /// What was observed after a reset, as long as nothing was done.
    first: Option<Scene>,
    /// What came of the action that is about to be judged.
    acted: Option<Acted>,
    /// Why a step could not be recorded; from then on nothing is told.
    error: Option<FileError>,
}

impl RecordingObserver<'_> {
    /// Something is about to be done: begins a trace if it is the first action after a reset.
    fn begin(&mut self) -> Result<(), FileError> {
        match (self.first.take(), &mut self.recorder) {
            (Some(first), Some(recorder)) => recorder.begin(&first),
            _ => Ok(()),
        }
    }
}

impl Observer for RecordingObserver<'_> {
    fn record(&mut self, record: &Record) {
        if let (Some(recorder), Some(Acted { scene, executed, reason })) = (&mut self.recorder, self.acted.take()) {
            let action = TraceAction { executed: Some(executed), reason, ..record.action.clone() };
            self.error = recorder.step(&action, &scene).err();
        }
        if self.error.is_none() {
            self.observer.record(record);
        }
    }

    fn event(&mut self, event: &Event) {
        if self.error.is_none() {
            self.observer.event(event);
        }
    }
}
