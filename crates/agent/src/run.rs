//! A blocking driver: an episode over a world.

use thiserror::Error;
use typelift_model::{GroundCall, Plan, State, Symbol};
use typelift_world::{
    Acted, Beginning, FileError, ParseError, Parser, Record, RecordSink, Reply, Reset, Said, Scene, TraceAction, World,
    WorldError, instance_of,
};

use crate::account::Account;
use crate::episode::{Episode, EpisodeError};
use crate::event::{Event, Observer};
use crate::person::{Confirmation, Person, Shown};
use crate::turn::{Command, CommandId, Input};

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

/// Drives an episode over a world; `person` is asked before each plan is executed. An action that is not finished in time
/// is followed by an observation, as long as the world gives one.
///
/// Each of the sinks is given each step before the observer is told of it and before the next action is sent: with a
/// [`Recorder`](typelift_world::Recorder), it is on the disk by then. Of an episode that was restored, a step that had been commanded before is not recorded: what was observed before it is not
/// known in the world's own words. The trace begins with what is observed after it, or before the next step.
///
/// # Errors
/// [`RunError`] if the environment fails, the planner errs, or what happens cannot be recorded.
pub fn run(
    episode: &mut Episode,
    world: &mut dyn World,
    reset: &Reset,
    parser: &mut Parser,
    person: &mut dyn Person,
    observer: &mut dyn Observer,
    sinks: &mut [&mut dyn RecordSink],
) -> Result<Account, RunError> {
    let mut recording = RecordingObserver::new(observer, sinks);
    let mut input = Input::Started;
    // An action that was not finished in time, until something is observed.
    let mut late: Option<GroundCall> = None;
    let mut spoken: Option<Said> = None;
    loop {
        let told = episode.account.failures.len();
        let command = episode.step(input, &mut recording);
        let heard = spoken.take().and_then(|said| episode.understood(said, told));
        recording.spoken(heard.as_ref());
        if let Some(error) = recording.error {
            return Err(error.into());
        }
        input = match command? {
            Command::Reset { id } => {
                // What cannot be set back is taken as it is.
                let scene = if world.can_reset() { world.reset(reset)? } else { world.observe()? };
                let state = parser.parse(&scene)?;
                recording.first = Some(scene);
                recording.observer.first_state(&state);
                Input::Reset { id, state, instance: Some(instance_of(world, reset)) }
            }
            Command::Observe { id } | Command::Await { id, .. } => {
                let scene = world.observe().map_err(|error| match &late {
                    None => error,
                    Some(call) => error.after(&format!("{call} was not finished in time")),
                })?;
                late = None;
                let state = parser.parse(&scene)?;
                recording.observed(scene);
                Input::Observation { id, state }
            }
            Command::Propose { id, plan } => {
                let confirmation = person.confirm(&plan, episode.state());
                spoken = said(&confirmation, episode.instance());
                match confirmation {
                    Confirmation::Approve | Confirmation::Agree => Input::Approve { id },
                    Confirmation::Reject { step, objection, reason } => Input::Reject { id, step, objection, reason },
                    Confirmation::AnotherPlan => Input::AnotherPlan { id },
                    Confirmation::Show => {
                        recording.spoken(spoken.take().as_ref());
                        let state = demonstrate(episode, world, parser, person, &mut recording)?;
                        Input::Shown { id, state }
                    }
                    Confirmation::Stop => Input::Stop,
                }
            }
            Command::Act { id, call } => {
                recording.begin(world, episode.instance())?;
                match world.act(&call) {
                    Err(WorldError::TimedOut { .. }) => {
                        recording.is_late = true;
                        late = Some(call);
                        Input::TimedOut { id }
                    }
                    acted => {
                        let acted = acted?;
                        let state = parser.parse(&acted.scene)?;
                        result_input(id, recording.acted(acted), state)
                    }
                }
            }
            Command::Done(account) => return Ok(*account),
        };
    }
}

/// Has a person do what they want to show, and keeps it as what it is: a demonstration. Gives the state that it leads to.
fn demonstrate(
    episode: &Episode,
    world: &mut dyn World,
    parser: &mut Parser,
    person: &mut dyn Person,
    recording: &mut RecordingObserver<'_, '_>,
) -> Result<State, RunError> {
    let mut state = episode.state().clone();
    let mut last: Option<Shown> = None;
    while let Some(call) = person.show(&state, last.as_ref()) {
        recording.begin(world, episode.instance())?;
        let (scene, executed, reason) = match world.act(&call) {
            Err(WorldError::TimedOut { .. }) => (world.observe()?, None, None),
            acted => acted.map(|Acted { scene, executed, reason }| (scene, Some(executed), reason))?,
        };
        let after = parser.parse(&scene)?;
        recording.shown(&TraceAction { executed, reason: reason.clone(), ..call.clone().into() }, &scene)?;
        let (added, deleted) = (state.added(&after).cloned().collect(), state.deleted(&after).cloned().collect());
        last = Some(Shown { call, executed, reason, added, deleted });
        state = after;
    }
    Ok(state)
}

/// What a person said of a plan, if anything; of which step, and what follows, is seen once it was understood.
fn said(confirmation: &Confirmation, instance: &Symbol) -> Option<Said> {
    let (reply, because) = match confirmation {
        Confirmation::Approve | Confirmation::Stop => return None,
        Confirmation::Agree => (Reply::Yes, String::new()),
        Confirmation::Reject { reason, .. } => (Reply::No, reason.clone()),
        Confirmation::AnotherPlan => (Reply::Another, String::new()),
        Confirmation::Show => (Reply::Shown, String::new()),
    };
    Some(Said { reply, instance: instance.clone(), call: None, because, experience: None })
}

/// The input that tells the result of an action.
fn result_input(id: CommandId, result: &StepRecord, state: State) -> Input {
    match &result.reason {
        _ if result.executed == Some(true) => Input::Observation { id, state },
        Some(reason) => Input::Refused { id, reason: reason.clone(), state },
        None => Input::Refused { id, reason: "not executed".to_owned(), state },
    }
}

/// What a trace says of the step that is about to be judged, besides what the judgement does.
struct StepRecord {
    after: Scene,
    /// Whether the environment says that it did it, if it said anything in time.
    executed: Option<bool>,
    reason: Option<String>,
}

/// Records each step as the environment told it, and only then tells the observer.
struct RecordingObserver<'a, 's> {
    observer: &'a mut dyn Observer,
    sinks: &'a mut [&'s mut dyn RecordSink],
    /// What was observed where a trace is to begin, as long as nothing was done.
    first: Option<Scene>,
    /// Whether a trace was begun.
    has_begun: bool,
    /// Whether an action was not finished in time, and nothing was observed since.
    is_late: bool,
    /// What came of the action that is about to be judged.
    result: Option<StepRecord>,
    /// The plan that was proposed last, until it is recorded.
    proposed: Option<Plan>,
    /// Why a step could not be recorded; from then on nothing is told.
    error: Option<FileError>,
}

impl<'a, 's> RecordingObserver<'a, 's> {
    fn new(observer: &'a mut dyn Observer, sinks: &'a mut [&'s mut dyn RecordSink]) -> Self {
        Self {
            observer,
            sinks,
            first: None,
            has_begun: false,
            is_late: false,
            result: None,
            proposed: None,
            error: None,
        }
    }

    /// Something is about to be done: a trace begins if it is the first action after a reset, or the first of all.
    fn begin(&mut self, world: &mut dyn World, instance: &Symbol) -> Result<(), RunError> {
        if self.sinks.is_empty() {
            return Ok(());
        }
        let first = match self.first.take() {
            None if !self.has_begun => Some(world.observe()?),
            first => first,
        };
        if let Some(first) = first {
            let beginning = Beginning { first: &first, environment: world.name(), instance: instance.clone() };
            self.sinks.iter_mut().try_for_each(|sink| sink.begin(&beginning))?;
            self.has_begun = true;
        }
        Ok(())
    }

    /// A person did something.
    fn shown(&mut self, action: &TraceAction, after: &Scene) -> Result<(), FileError> {
        self.sinks.iter_mut().try_for_each(|sink| sink.step(action, after))
    }

    /// A person said something, or nothing; and after that a plan may have been proposed.
    fn spoken(&mut self, said: Option<&Said>) {
        let proposed = self.proposed.take();
        if self.error.is_none() {
            let keep = |sink: &mut &mut dyn RecordSink| {
                said.into_iter().try_for_each(|said| sink.said(said))?;
                proposed.iter().try_for_each(|plan| sink.proposed(plan))
            };
            self.error = self.sinks.iter_mut().try_for_each(keep).err();
        }
    }

    /// An action was answered.
    fn acted(&mut self, acted: Acted) -> &StepRecord {
        let Acted { scene, executed, reason } = acted;
        self.result.insert(StepRecord { after: scene, executed: Some(executed), reason })
    }

    /// Something was observed without being acted on: after an action that was not finished in time, else where a trace
    /// can begin.
    fn observed(&mut self, scene: Scene) {
        if std::mem::take(&mut self.is_late) {
            self.result = Some(StepRecord { after: scene, executed: None, reason: None });
        } else {
            self.first = Some(scene);
        }
    }
}

impl Observer for RecordingObserver<'_, '_> {
    fn record(&mut self, record: &Record) {
        if let Some(StepRecord { after, executed, reason }) = self.result.take()
            && !self.sinks.is_empty()
        {
            let action = TraceAction { executed, reason, ..record.action.clone() };
            self.error = self.sinks.iter_mut().try_for_each(|sink| sink.step(&action, &after)).err();
        }
        if self.error.is_none() {
            self.observer.record(record);
        }
    }

    fn event(&mut self, event: &Event) {
        if let Event::Proposed { plan, .. } = event {
            self.proposed = Some(plan.clone());
        }
        if self.error.is_none() {
            self.observer.event(event);
        }
    }
}
