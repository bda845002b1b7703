//! The episode: one task, from the first observation to an account.
//!
//! After a failed step, once its retries are used up, the ground action is banned, and the entities of the action
//! that are neither actor nor in the goal are excluded: from every action if the world is set back (the paper's way),
//! only from actions of the same name if the episode goes on from where it is. Then it imagines and plans again.

use std::collections::BTreeMap;
use std::sync::Arc;

use typelift_model::{ActionModel, Budget, Goal, GroundAction, GroundAtom, Plan, State, Stop, Symbol, Task};
use typelift_plan::{Ban, Exclusion, Outcome};
use typelift_world::Verdict;

use crate::account::{Account, Ending, Failure};
use crate::event::{Event, Observer, PlanSummary};
use crate::experience::Experience;
use crate::monitor::{StepResult, compare};
use crate::options::Options;
use crate::propose::{Proposal, ProposeError, propose};
use crate::turn::{Command, Input};

#[derive(Debug)]
enum Phase {
    New,
    /// The first state, or the initial state again.
    AwaitingReset,
    AwaitingApproval,
    AwaitingResult,
    /// The result of a step that timed out is about to be observed.
    AwaitingLateState,
    Over,
}

/// One task being solved.
#[derive(Debug)]
pub struct Episode {
    model: Arc<ActionModel>,
    goal: Goal,
    /// The values of the functions that costs mention.
    values: BTreeMap<GroundAtom, u32>,
    options: Options,
    budget: Budget,
    experience: Experience,
    inherited: Experience,
    phase: Phase,
    state: State,
    /// The model of the current proposal, with what was imagined for it.
    planned_with: ActionModel,
    plan: Plan,
    next_step: usize,
    /// How many of the plan's steps were executed.
    taken: usize,
    attempts: u32,
    /// The state that the plan was made for.
    planned_in: State,
    /// Plans that went as expected to their end and did not lead to the goal, with the states they were made for.
    in_vain: Vec<(State, Plan)>,
    /// The current plan was made without strictness, although the options ask for it.
    relaxed: bool,
    /// Only bans count any more, not exclusions: nothing else was left.
    bans_only: bool,
    account: Account,
}

impl Episode {
    /// An episode for this goal, with what earlier tasks of the run taught.
    pub fn new(
        model: Arc<ActionModel>,
        goal: impl Into<Goal>,
        options: Options,
        experience: Experience,
        budget: Budget,
    ) -> Self {
        Self {
            planned_with: ActionModel::default(),
            model,
            goal: goal.into(),
            values: BTreeMap::new(),
            options,
            budget,
            inherited: experience.clone(),
            experience,
            phase: Phase::New,
            state: State::default(),
            plan: Plan::default(),
            next_step: 0,
            taken: 0,
            attempts: 0,
            planned_in: State::default(),
            in_vain: Vec::new(),
            relaxed: false,
            bans_only: false,
            account: Account {
                ending: Ending::Stopped(Stop::Cancelled),
                proposals: 0,
                actions: 0,
                plan: None,
                failures: Vec::new(),
                expansions: 0,
                ground_actions: 0,
                lifted: false,
                relaxed: false,
            },
        }
    }

    /// The same with the values of the functions that the model's [costs](typelift_model::Cost) mention.
    #[must_use]
    pub fn with_values(self, values: BTreeMap<GroundAtom, u32>) -> Self {
        Self { values, ..self }
    }

    /// What failed so far, in this task and the ones before it.
    pub fn experience(&self) -> &Experience {
        &self.experience
    }

    /// The model of the current proposal: imagined actions added, strict if asked for.
    pub fn planned_with(&self) -> &ActionModel {
        &self.planned_with
    }

    /// Takes one input. One that does not fit the last command changes nothing and is answered by that command again; but
    /// while the result of an action is awaited, by [`Command::Observe`], whose answer then is the result.
    ///
    /// # Errors
    /// [`ProposeError::Invalid`] if the planner errs.
    pub fn step(&mut self, input: Input, observer: &mut dyn Observer) -> Result<Command, ProposeError> {
        match (&self.phase, self.completed(input)) {
            (Phase::Over, _) => Ok(Command::Done(Box::new(self.account.clone()))),
            (_, Input::Stop) => Ok(self.end(Ending::Stopped(Stop::Cancelled), observer)),
            (Phase::New, _) => {
                self.phase = Phase::AwaitingReset;
                Ok(Command::Reset)
            }
            (Phase::AwaitingReset, Input::Observation(state)) => {
                self.state = state;
                self.propose(observer)
            }
            (Phase::AwaitingReset, _) => Ok(Command::Reset),
            (Phase::AwaitingApproval, Input::Approve) => self.advance(observer),
            (Phase::AwaitingApproval, Input::Reject { step, reason }) => {
                self.next_step = step.clamp(1, self.plan.len()) - 1;
                self.fail(StepResult::Rejected, Some(reason), None, observer)
            }
            (Phase::AwaitingApproval, _) => Ok(Command::Propose(self.plan.clone())),
            (Phase::AwaitingResult, Input::Observation(state)) => self.judge(state, None, None, observer),
            (Phase::AwaitingResult, Input::Refused { reason, state }) => {
                self.judge(state, Some(Verdict::Refused), Some(reason), observer)
            }
            (Phase::AwaitingResult, Input::TimedOut) => {
                self.phase = Phase::AwaitingLateState;
                Ok(Command::Observe)
            }
            // Not the action again: it may be under way.
            (Phase::AwaitingResult, _) => Ok(Command::Observe),
            (Phase::AwaitingLateState, Input::Observation(state) | Input::Refused { state, .. }) => {
                self.judge(state, Some(Verdict::TimedOut), None, observer)
            }
            (Phase::AwaitingLateState, _) => Ok(Command::Observe),
        }
    }

    /// An input whose state holds what follows from it.
    fn completed(&self, input: Input) -> Input {
        let completed = |state: State| {
            if self.model.axioms.is_empty() { state } else { self.model.with_derived(&state) }
        };
        match input {
            Input::Observation(state) => Input::Observation(completed(state)),
            Input::Refused { reason, state } => Input::Refused { reason, state: completed(state) },
            other => other,
        }
    }

    fn end(&mut self, ending: Ending, observer: &mut dyn Observer) -> Command {
        self.phase = Phase::Over;
        self.account.ending = ending;
        observer.event(&Event::Ended { solved: self.account.solved() });
        Command::Done(Box::new(self.account.clone()))
    }

    /// Plans from the current state.
    fn propose(&mut self, observer: &mut dyn Observer) -> Result<Command, ProposeError> {
        if self.goal.holds_in(&self.state) {
            // It held from the start, or came about by a step that otherwise failed.
            self.account.plan = Some(Plan { steps: self.plan.steps[..self.taken].to_vec() });
            return Ok(self.end(Ending::Solved, observer));
        }
        if self.account.proposals >= self.options.max_proposals {
            return Ok(self.end(Ending::ProposalLimit(self.options.max_proposals), observer));
        }
        let mut proposal = match self.plan_with_last_resorts(observer) {
            Ok(proposal) => proposal,
            Err(ProposeError::Stopped(stop)) => return Ok(self.end(Ending::Stopped(stop), observer)),
            Err(error) => return Err(error),
        };
        // A plan that did not lead to the goal from this very state, though no step of it failed, is not begun again.
        let is_known = |outcome: &Outcome| {
            let Outcome::Solved(plan) = outcome else { return false };
            self.in_vain.iter().any(|(state, tried)| tried == plan && *state == self.state)
        };
        let circular = is_known(&proposal.outcome);
        while is_known(&proposal.outcome) {
            proposal.outcome = proposal.next_plan(&self.budget)?;
        }
        let ending = match &proposal.outcome {
            Outcome::Unsolvable | Outcome::NoMorePlans | Outcome::Stopped(Stop::Expansions) if circular => {
                Ending::Circular
            }
            Outcome::Solved(plan) => {
                self.planned_in = self.state.clone();
                self.plan = plan.clone();
                self.planned_with = proposal.model;
                self.next_step = 0;
                self.taken = 0;
                self.attempts = 0;
                self.account.proposals += 1;
                self.phase = Phase::AwaitingApproval;
                let summary = PlanSummary::of(&self.plan, &self.model.hierarchy);
                observer.event(&Event::Proposed { proposal: self.account.proposals, plan: summary });
                return Ok(Command::Propose(self.plan.clone()));
            }
            Outcome::Unsolvable | Outcome::NoMorePlans => Ending::NoPlan(proposal.explain()),
            Outcome::Stopped(stop) => Ending::Stopped(*stop),
        };
        Ok(self.end(ending, observer))
    }

    /// Plans. Where there is no plan, it tries without the exclusions of earlier tasks; and an episode that goes on
    /// from where it is then tries without strictness, and at last without any exclusion. Ground actions that failed
    /// stay banned throughout.
    fn plan_with_last_resorts(&mut self, observer: &mut dyn Observer) -> Result<Proposal, ProposeError> {
        let none =
            |proposal: &Proposal| matches!(proposal.outcome, Outcome::Unsolvable | Outcome::Stopped(Stop::Expansions));
        self.relaxed = false;
        let options = self.options.clone();
        let mut proposal = self.plan_once(&options, observer)?;
        if none(&proposal) && self.inherited.exclusions().next().is_some() {
            let before = self.experience.clone();
            self.experience.lift_exclusions_of(&self.inherited);
            let lifted = self.plan_once(&options, observer)?;
            if none(&lifted) {
                self.experience = before;
            } else {
                // What is excluded again from now on was learned in this task.
                self.inherited = Experience::new();
                self.account.lifted = true;
                observer.event(&Event::Lifted);
                proposal = lifted;
            }
        }
        if !none(&proposal) || options.restart || self.account.failures.is_empty() {
            return Ok(proposal);
        }
        if options.strict {
            let plain = self.plan_once(&Options { strict: false, ..options.clone() }, observer)?;
            if !none(&plain) {
                self.relaxed = true;
                self.account.relaxed = true;
                observer.event(&Event::Relaxed);
                return Ok(plain);
            }
        }
        if !self.bans_only && self.experience.exclusions().next().is_some() {
            self.bans_only = true;
            let without = self.plan_once(&options, observer)?;
            if !none(&without) {
                self.account.lifted = true;
                observer.event(&Event::Lifted);
                return Ok(without);
            }
            self.bans_only = false;
        }
        Ok(proposal)
    }

    fn plan_once(&mut self, options: &Options, observer: &mut dyn Observer) -> Result<Proposal, ProposeError> {
        observer.event(&Event::PlanningStarted { proposal: self.account.proposals + 1 });
        let task = Task { init: self.state.clone(), goal: self.goal.clone(), values: self.values.clone() };
        let mut restrictions = self.experience.restrictions();
        if self.bans_only {
            restrictions.excluded.clear();
        }
        let planned = propose(&self.model, &task, &restrictions, options, &self.budget);
        let report = planned.as_ref().map(Proposal::report).unwrap_or_default();
        self.account.expansions += report.expansions;
        self.account.ground_actions = self.account.ground_actions.max(report.ground_actions);
        let imagined = planned.as_ref().map(|p| p.imagination.actions.iter().map(|a| a.name.clone()).collect());
        observer.event(&Event::PlanningEnded {
            expansions: report.expansions,
            ground_actions: report.ground_actions,
            imagined: imagined.unwrap_or_default(),
            found: planned.as_ref().is_ok_and(|p| matches!(p.outcome, Outcome::Solved(_))),
        });
        planned
    }

    /// Goes on to the next step of the plan, or ends it.
    fn advance(&mut self, observer: &mut dyn Observer) -> Result<Command, ProposeError> {
        if self.next_step == self.plan.len() {
            if self.goal.holds_in(&self.state) {
                self.account.plan = Some(self.plan.clone());
                return Ok(self.end(Ending::Solved, observer));
            }
            self.in_vain.push((self.planned_in.clone(), self.plan.clone()));
            return self.again(observer);
        }
        if !self.options.restart
            && let Some(missing) = self.missing_precondition()
        {
            observer.event(&Event::Drifted { step: self.next_step + 1, missing });
            return self.propose(observer);
        }
        if let Some(stop) = self.budget.stopped() {
            return Ok(self.end(Ending::Stopped(stop), observer));
        }
        self.phase = Phase::AwaitingResult;
        Ok(Command::Act(self.plan.steps[self.next_step].call.clone()))
    }

    fn missing_precondition(&self) -> Option<String> {
        let Some(action) = self.expected() else { return Some("an object of it".to_owned()) };
        let (atom, positive) = action.unmet(&self.state).next()?;
        Some(format!("{}{atom}", if *positive { "" } else { "not " }))
    }

    /// The next step as it is expected in the current state.
    fn expected(&self) -> Option<GroundAction> {
        let step = self.plan.steps.get(self.next_step)?;
        let schema = self.planned_with.action(step.action.as_str())?;
        schema.instantiate(&step.objects, &self.state, &self.model.hierarchy).ok()
    }

    /// Compares what happened with what was expected. `excuse` is what the driver reported instead of success.
    fn judge(
        &mut self,
        after: State,
        excuse: Option<Verdict>,
        reason: Option<String>,
        observer: &mut dyn Observer,
    ) -> Result<Command, ProposeError> {
        self.account.actions += 1;
        self.taken = self.next_step + 1;
        let step = &self.plan.steps[self.next_step];
        let strict = self.planned_with.action(step.action.as_str()).is_some_and(|action| action.strict);
        // A relaxed plan knows that not every effect will be a change.
        let strict_effects = strict && !self.relaxed;
        let seen = self.expected().map_or(Verdict::Otherwise, |e| compare(&e, &self.state, &after, strict_effects));
        let verdict = match excuse {
            Some(excuse) if seen == Verdict::Nothing || excuse == Verdict::TimedOut => match seen {
                Verdict::AsExpected => seen,
                _ => excuse,
            },
            _ => seen,
        };
        if verdict == Verdict::AsExpected {
            self.report_step(StepResult::Tried(verdict), reason, &after, observer);
            self.state = after;
            self.next_step += 1;
            self.attempts = 0;
            return self.advance(observer);
        }
        self.fail(StepResult::Tried(verdict), reason, Some(after), observer)
    }

    fn report_step(&self, result: StepResult, reason: Option<String>, after: &State, observer: &mut dyn Observer) {
        let step = &self.plan.steps[self.next_step];
        observer.event(&Event::Stepped {
            proposal: self.account.proposals,
            step: self.next_step + 1,
            call: step.call.clone(),
            imagined: step.imagined.is_some(),
            result,
            reason,
            added: self.state.added(after).cloned().collect(),
            deleted: self.state.deleted(after).cloned().collect(),
        });
    }

    /// A step failed, or was rejected: tries it again, or learns from it and plans anew.
    fn fail(
        &mut self,
        result: StepResult,
        reason: Option<String>,
        after: Option<State>,
        observer: &mut dyn Observer,
    ) -> Result<Command, ProposeError> {
        let expected = self.expected();
        if let Some(after) = after {
            self.report_step(result, reason.clone(), &after, observer);
            self.state = after;
            if self.attempts < self.options.retries() && self.missing_precondition().is_none() {
                self.attempts += 1;
                let call = self.plan.steps[self.next_step].call.clone();
                observer.event(&Event::Retried { call: call.clone() });
                self.phase = Phase::AwaitingResult;
                return Ok(Command::Act(call));
            }
        } else {
            self.report_step(result, reason.clone(), &self.state, observer);
        }
        let step = self.plan.steps[self.next_step].clone();
        let why = format!("{} {}", step.call, reason.as_deref().unwrap_or(result.phrase()));
        let excluded = self.blamed(&step.objects);
        for exclusion in &excluded {
            let (object, call) = (exclusion.object.clone(), exclusion.call.clone());
            self.experience.exclude(exclusion.clone(), &why);
            observer.event(&Event::Excluded { object, call, reason: why.clone() });
        }
        if let Some(action) = expected {
            self.experience.ban(Ban::of(&action), &why);
        }
        self.account.failures.push(Failure {
            proposal: self.account.proposals,
            step: self.next_step + 1,
            action: step.action,
            call: step.call,
            result,
            reason,
            imagined: step.imagined.is_some(),
            excluded,
        });
        self.again(observer)
    }

    /// The entities of a failed step that are neither actor nor in the goal.
    fn blamed(&self, objects: &[Symbol]) -> Vec<Exclusion> {
        let call = (!self.options.restart).then(|| self.plan.steps[self.next_step].call.name.clone());
        let is_actor = |object: &Symbol| self.state.objects.get(object).is_some_and(|ty| self.model.is_actor(*ty));
        let in_goal = |object: &Symbol| self.goal.mentions(object);
        let mut objects: Vec<&Symbol> = objects.iter().filter(|o| !is_actor(o) && !in_goal(o)).collect();
        objects.sort_unstable();
        objects.dedup();
        objects.into_iter().map(|object| Exclusion { object: object.clone(), call: call.clone() }).collect()
    }

    /// Plans anew: from the initial state if the world is set back, else from where it is.
    fn again(&mut self, observer: &mut dyn Observer) -> Result<Command, ProposeError> {
        if self.options.restart && self.account.actions > 0 {
            self.phase = Phase::AwaitingReset;
            self.taken = 0;
            return Ok(Command::Reset);
        }
        self.propose(observer)
    }
}
