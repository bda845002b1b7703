//! The episode: one task, from the first observation to an account.
//!
//! What is proposed is in `planning.rs`, how a plan is carried out in `acting.rs`.
//!
//! A plan that went as expected and did not lead to the goal is not begun again from the same state. If there is no other, the
//! episode ends and says that something happens besides what the model says.

use std::collections::BTreeMap;
use std::sync::Arc;

use thiserror::Error;
use typelift_model::{ActionModel, Budget, Goal, GoalError, GroundAtom, Observations, Plan, State, Stop, Symbol};
use typelift_world::Verdict;

use crate::account::{Account, Ending, StoppedAt};
use crate::blame::{Blame, BlameRule};
use crate::event::{Event, Observer};
use crate::execution::{Execution, Steps};
use crate::experience::Experience;
use crate::options::Options;
use crate::outlook::{Outlook, Outlooks};
use crate::propose::{Proposal, ProposeError};
use crate::turn::{Command, CommandId, Input};

/// What the episode waits for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum Phase {
    /// The start.
    New,
    /// The first state, or the initial state again.
    AwaitingReset,
    /// Of the plan that is proposed.
    AwaitingApproval,
    /// Of the step that was commanded.
    AwaitingResult,
    /// The result of a step that timed out is about to be observed.
    AwaitingLateState,
    /// What is observed now, to plan from: planning erred after something was judged or rejected.
    AwaitingState,
    /// Nothing.
    Over,
}

/// Why an input could not be answered.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum EpisodeError {
    /// The goal is none in the world that was observed.
    #[error(transparent)]
    Goal(#[from] GoalError),
    /// The planner erred.
    #[error(transparent)]
    Propose(#[from] ProposeError),
}

/// One task being solved.
///
/// It has no thread, clock or world of its own: its driver does what a [`Command`] says and reports with an
/// [`Input`], which names the command that it answers.
///
/// ```
/// use typelift_agent::{Command, Episode, Experience, Input, Options};
/// use typelift_model::{ActionModel, Budget, Goal};
///
/// let (model, goal) = (ActionModel::default().into(), Goal::default());
/// let mut episode = Episode::new(model, goal, Options::default(), Experience::new(), Budget::unlimited());
/// let Command::Reset { id } = episode.step(Input::Started, &mut ())? else { panic!("it begins with a reset") };
/// // Nothing is asked for, so nothing is to be done.
/// let done = episode.step(Input::Reset { id, state: Default::default(), instance: None }, &mut ())?;
/// assert!(matches!(done, Command::Done(account) if account.solved()));
/// # Ok::<(), typelift_agent::EpisodeError>(())
/// ```
#[derive(Debug)]
pub struct Episode {
    pub(crate) model: Arc<ActionModel>,
    pub(crate) goal: Goal,
    /// The values of the functions that costs mention.
    pub(crate) values: BTreeMap<GroundAtom, u32>,
    /// What the model was learned from, as far as it is known.
    pub(crate) evidence: Arc<Observations>,
    pub(crate) options: Options,
    pub(crate) budget: Budget,
    pub(crate) experience: Experience,
    /// What is believed of the actions, when it was planned last.
    pub(crate) outlooks: Outlooks,
    /// The number of this task in the experience.
    pub(crate) task: u64,
    /// The instance of the world that names belong to; unnamed if it was not said.
    pub(crate) instance: Symbol,
    pub(crate) phase: Phase,
    /// The command that stands.
    pub(crate) standing: CommandId,
    pub(crate) state: State,
    pub(crate) execution: Option<Execution>,
    /// What planned it, for another plan; not there after restoring.
    pub(crate) proposal: Option<Proposal>,
    /// Plans that went as expected to their end and did not lead to the goal, with the states they were made for.
    pub(crate) in_vain: Vec<(State, Steps)>,
    pub(crate) account: Account,
}

impl Episode {
    /// An episode for this goal, with what earlier tasks of the run taught.
    pub fn new(
        model: Arc<ActionModel>,
        goal: impl Into<Goal>,
        options: Options,
        mut experience: Experience,
        budget: Budget,
    ) -> Self {
        let goal = goal.into().named_as_in(&model.predicates);
        Self {
            model,
            goal,
            values: BTreeMap::new(),
            evidence: Arc::default(),
            instance: options.instance.clone().unwrap_or_else(|| Symbol::new("")),
            options,
            budget,
            task: experience.begin_task(),
            experience,
            outlooks: Outlooks::default(),
            phase: Phase::New,
            standing: CommandId::default(),
            state: State::default(),
            execution: None,
            proposal: None,
            in_vain: Vec::new(),
            account: Account::begun(),
        }
    }

    /// The same with the values of the functions that the model's [costs](typelift_model::Cost) mention.
    #[must_use]
    pub fn with_values(self, values: BTreeMap<GroundAtom, u32>) -> Self {
        Self { values, ..self }
    }

    /// The same with what the model was learned from: what failed then speaks against what is planned, and it says more of
    /// what worked than the model does.
    #[must_use]
    pub fn with_evidence(self, evidence: Arc<Observations>) -> Self {
        Self { evidence, ..self }
    }

    /// Weighs anew what is to blame for what failed.
    pub(crate) fn reconsider(&mut self) {
        let blame = Blame { rule: self.options.blame, model: &self.model, evidence: &self.evidence };
        self.experience.reconsider(&blame);
    }

    /// What is believed of the actions by now, in the current state; nothing by the paper's rule.
    pub(crate) fn look_ahead(&mut self) {
        let Self { model, evidence, experience, .. } = &*self;
        let outlook = Outlook { model, evidence, experience, task: self.task };
        self.outlooks = match self.options.blame {
            BlameRule::Belief => outlook.of(&self.state, &self.instance, self.options.risk),
            BlameRule::Paper => Outlooks::default(),
        };
    }

    /// What was tried so far, in this task and the ones before it.
    pub fn experience(&self) -> &Experience {
        &self.experience
    }

    /// The instance of the world in which the episode acts; unnamed if it was not said.
    pub fn instance(&self) -> &Symbol {
        &self.instance
    }

    /// What is to be achieved.
    pub fn goal(&self) -> &Goal {
        &self.goal
    }

    /// What was observed last; no objects before the first observation.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The model of the current proposal: imagined actions added, strict if asked for. None before the first.
    pub fn planned_with(&self) -> Option<&ActionModel> {
        self.execution.as_ref().map(|execution| &*execution.model)
    }

    /// Takes one input. One that answers another command than the one that stands, or that does not fit it, changes
    /// nothing and is answered by the command that stands; where that is an action, by [`Command::Await`].
    ///
    /// # Errors
    /// [`EpisodeError`] if the goal does not fit what is observed first; then nothing has changed. Or if the planner errs:
    /// what the input said has been taken in, and [`Command::Observe`] stands. Whoever answers that has it plan again.
    pub fn step(&mut self, input: Input, observer: &mut dyn Observer) -> Result<Command, EpisodeError> {
        if self.phase == Phase::Over {
            return Ok(self.standing());
        }
        match (self.phase, &input) {
            (_, Input::Stop) => {
                let begun = matches!(self.phase, Phase::AwaitingResult | Phase::AwaitingLateState);
                return Ok(match self.phase {
                    Phase::AwaitingApproval => self.stop(Stop::Cancelled, false, observer),
                    _ if begun => self.stop(Stop::Cancelled, true, observer),
                    _ => self.end(Ending::Stopped(Stop::Cancelled), observer),
                });
            }
            (Phase::New, Input::Started) => return Ok(self.command(Phase::AwaitingReset)),
            // Nothing is believed before the start.
            (Phase::New, _) => return Ok(self.command(Phase::AwaitingReset)),
            _ if input.id() != Some(self.standing) => return Ok(self.standing()),
            _ => {}
        }
        let answered = self.answer(input, observer);
        if let Err(EpisodeError::Propose(_)) = answered {
            // What was judged or rejected is not to be so again, and what was planned before is not to be carried out.
            self.command(Phase::AwaitingState);
        }
        answered
    }

    /// What follows from an input that answers the command that stands.
    fn answer(&mut self, input: Input, observer: &mut dyn Observer) -> Result<Command, EpisodeError> {
        if let (Phase::AwaitingReset, Input::Reset { state, .. }) = (self.phase, &input) {
            self.name_objects_as_in(state);
        }
        match (self.phase, self.completed(input)) {
            (Phase::AwaitingReset, Input::Reset { state, instance, .. }) => self.begin(state, instance, observer),
            (Phase::AwaitingApproval, Input::Approve { .. }) => self.advance(observer),
            (Phase::AwaitingApproval, Input::AnotherPlan { .. }) => self.another_plan(observer),
            (Phase::AwaitingApproval, Input::Reject { step, objection, reason, .. }) => {
                self.reject(step, objection, reason, observer)
            }
            (Phase::AwaitingResult, Input::Observation { state, .. }) => self.judge(state, None, None, observer),
            (Phase::AwaitingResult, Input::Refused { reason, state, .. }) => {
                self.judge(state, Some(Verdict::Refused), Some(reason), observer)
            }
            (Phase::AwaitingResult, Input::TimedOut { .. }) => Ok(self.command(Phase::AwaitingLateState)),
            (Phase::AwaitingLateState, Input::Observation { state, .. } | Input::Refused { state, .. }) => {
                self.judge(state, Some(Verdict::TimedOut), None, observer)
            }
            // What was proposed was for another state.
            (Phase::AwaitingApproval, Input::Shown { state, .. })
            | (Phase::AwaitingState, Input::Observation { state, .. }) => {
                self.state = state;
                self.propose(observer)
            }
            _ => Ok(self.standing()),
        }
    }

    /// A new command, for which the episode waits from now on.
    pub(crate) fn command(&mut self, phase: Phase) -> Command {
        self.phase = phase;
        self.standing = self.standing.next();
        match self.standing() {
            Command::Await { id, call } => Command::Act { id, call },
            other => other,
        }
    }

    /// The command that stands.
    pub(crate) fn standing(&self) -> Command {
        let id = self.standing;
        let step = self.execution.as_ref().and_then(Execution::step);
        match (self.phase, &self.execution, step) {
            (Phase::AwaitingApproval, Some(execution), _) => Command::Propose { id, plan: execution.plan.clone() },
            (Phase::AwaitingResult, _, Some(step)) => Command::Await { id, call: step.call.clone() },
            (Phase::AwaitingLateState | Phase::AwaitingState, ..) => Command::Observe { id },
            (Phase::Over, ..) => Command::Done(Box::new(self.account.clone())),
            _ => Command::Reset { id },
        }
    }

    /// An input whose state holds what follows from it.
    fn completed(&self, input: Input) -> Input {
        if self.model.axioms.is_empty() {
            return input;
        }
        let completed = |state: State| Ok::<_, std::convert::Infallible>(self.model.with_derived(&state));
        match input.try_map(completed) {
            Ok(input) => input,
            Err(never) => match never {},
        }
    }

    /// The world is in its initial state.
    fn begin(
        &mut self,
        state: State,
        instance: Option<Symbol>,
        observer: &mut dyn Observer,
    ) -> Result<Command, EpisodeError> {
        if self.account.proposals == 0 {
            self.goal.check(&state, &self.model.predicates, &self.model.hierarchy)?;
        }
        if let (None, Some(instance)) = (&self.options.instance, instance) {
            self.instance = instance;
        }
        self.state = state;
        self.propose(observer)
    }

    /// The steps of the current plan that were taken.
    pub(crate) fn plan_taken(&self) -> Plan {
        let taken = |execution: &Execution| Plan { steps: execution.plan.steps[..execution.taken].to_vec() };
        self.execution.as_ref().map(taken).unwrap_or_default()
    }

    /// Ends at the next step of the plan, whether or not it was begun.
    pub(crate) fn stop(&mut self, stop: Stop, begun: bool, observer: &mut dyn Observer) -> Command {
        self.account.stopped_at = self.execution.as_ref().and_then(|execution| {
            let (step, steps, call) = (execution.next_step + 1, execution.plan.len(), execution.step()?.call.clone());
            Some(StoppedAt { proposal: self.account.proposals, step, steps, call, begun })
        });
        self.end(Ending::Stopped(stop), observer)
    }

    pub(crate) fn end(&mut self, ending: Ending, observer: &mut dyn Observer) -> Command {
        self.phase = Phase::Over;
        self.reconsider();
        if ending == Ending::Solved {
            self.account.plan = Some(self.plan_taken());
        }
        self.account.ending = ending;
        observer.event(&Event::Ended { solved: self.account.solved(), ending: self.account.ending.word() });
        self.standing()
    }
}
