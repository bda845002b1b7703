//! How an episode carries out a plan: a step at a time, each held against what was expected.
//!
//! After a failed step, once its retries are used up, it is noted with what is to blame, and the very same action is not
//! tried again. Then it imagines and plans again: from the initial state if the world is set back (the paper's way),
//! else from where it is.

use std::collections::BTreeSet;

use typelift_belief::Deed;
use typelift_model::{GroundCall, State, Symbol};
use typelift_plan::Ban;
use typelift_world::{Expected, Record, TraceAction, Verdict};

use crate::account::{Ending, Failure, SeenDone};
use crate::blame::BlameRule;
use crate::deed::{Failed, surroundings};
use crate::episode::{Episode, EpisodeError, Phase};
use crate::event::{Event, Observer};
use crate::execution::Execution;
use crate::instead;
use crate::monitor::{Comparison, StepResult, compare};
use crate::objection::Objection;
use crate::turn::Command;

impl Episode {
    /// Goes on to the next step of the plan, or ends it.
    pub(crate) fn advance(&mut self, observer: &mut dyn Observer) -> Result<Command, EpisodeError> {
        let Some(execution) = &self.execution else { return self.propose(observer) };
        if execution.step().is_none() {
            if !self.goal.holds_in(&self.state) {
                self.in_vain.push((execution.made_for.clone(), execution.steps()));
                return self.again(observer);
            }
            return Ok(self.end(Ending::Solved, observer));
        }
        // The paper does not look at preconditions before a step; but what vanished cannot be acted on, nor be recorded.
        let looks = !self.options.restart || execution.expected(&self.state).is_none();
        if looks && let Some(missing) = execution.missing_precondition(&self.state) {
            observer.event(&Event::Drifted { step: execution.next_step + 1, missing });
            return self.again(observer);
        }
        if let Some(stop) = self.budget.stopped() {
            return Ok(self.stop(stop, false, observer));
        }
        Ok(self.command(Phase::AwaitingResult))
    }

    /// Compares what happened with what was expected. `excuse` is what the driver reported instead of success.
    pub(crate) fn judge(
        &mut self,
        after: State,
        excuse: Option<Verdict>,
        reason: Option<String>,
        observer: &mut dyn Observer,
    ) -> Result<Command, EpisodeError> {
        let Some(execution) = &mut self.execution else { return self.propose(observer) };
        self.account.actions += 1;
        execution.taken = execution.next_step + 1;
        let compared = |expected| compare(&expected, &self.state, &after, execution.expects_changes(), &self.model);
        let unexpected = Comparison { verdict: Verdict::Otherwise, missed: Vec::new() };
        let Comparison { verdict: seen, missed } = execution.expected(&self.state).map_or(unexpected, compared);
        let verdict = match excuse {
            Some(excuse) if seen == Verdict::Nothing || excuse == Verdict::TimedOut => match seen {
                Verdict::AsExpected => seen,
                _ => excuse,
            },
            _ => seen,
        };
        let (deed, result) = (self.deed(&self.state), StepResult::Tried(verdict));
        let before = std::mem::replace(&mut self.state, after);
        let executed = match excuse {
            Some(Verdict::Refused) => Some(false),
            Some(_) => None,
            None => Some(true),
        };
        if let Some(record) = self.record_of(&before, executed, reason.clone(), verdict) {
            observer.record(&record);
        }
        let reported = excuse.filter(|excuse| *excuse != verdict);
        self.report_step(result, reason.clone(), reported, missed.clone(), &before, observer);
        if verdict != Verdict::AsExpected {
            return self.fail(result, reason, missed, &before, observer);
        }
        self.note_seen_done(reported, reason);
        if let Some(deed) = deed {
            let around = surroundings(&deed, &self.model, &before);
            self.experience.succeeded(deed, around);
        }
        if let Some(execution) = &mut self.execution {
            if execution.retries > 0 {
                self.experience.retries.note(true);
            }
            execution.next_step += 1;
            execution.retries = 0;
        }
        self.advance(observer)
    }

    /// Notes that the next step was done, if the environment reported something else.
    fn note_seen_done(&mut self, reported: Option<Verdict>, reason: Option<String>) {
        if let (Some(reported), Some(execution)) = (reported, &self.execution)
            && let Some(step) = execution.step()
        {
            let (proposal, step, call) = (self.account.proposals, execution.next_step + 1, step.call.clone());
            self.account.seen_done.push(SeenDone { proposal, step, call, reported, reason });
        }
    }

    /// The next step as experience keeps it.
    fn deed(&self, state: &State) -> Option<Deed> {
        let execution = self.execution.as_ref()?;
        let (step, schema) = (execution.step()?, execution.schema()?);
        Some(Deed::of(step, schema, state, &self.instance, &self.model.hierarchy))
    }

    /// What happened: the next step was done in the state `before`, and the current state came of it.
    fn record_of(
        &self,
        before: &State,
        executed: Option<bool>,
        reason: Option<String>,
        verdict: Verdict,
    ) -> Option<Record> {
        let execution = self.execution.as_ref()?;
        let step = execution.step()?;
        let effect = execution.expected(before);
        let (adds, deletes) = effect.map(|action| (action.adds, action.deletes)).unwrap_or_default();
        let expected = Some(Expected { action: step.action.clone(), args: step.objects.clone(), adds, deletes });
        let action = TraceAction { executed, reason, expected, verdict: Some(verdict), ..step.call.clone().into() };
        let (before, after) = (before.clone(), self.state.clone());
        Some(Record { source: None, step: self.account.actions, before, action, after })
    }

    /// Tells of the next step, which led from the state `before` to the current one.
    fn report_step(
        &self,
        result: StepResult,
        reason: Option<String>,
        reported: Option<Verdict>,
        missed: Vec<String>,
        before: &State,
        observer: &mut dyn Observer,
    ) {
        let Some(execution) = &self.execution else { return };
        let Some(step) = execution.step() else { return };
        observer.event(&Event::Stepped {
            proposal: self.account.proposals,
            step: execution.next_step + 1,
            call: step.call.clone(),
            imagined: step.imagined.is_some(),
            result,
            reason,
            reported,
            added: before.added(&self.state).cloned().collect(),
            deleted: before.deleted(&self.state).cloned().collect(),
            missed,
        });
    }

    /// A step failed: tries it again, or learns from it and plans anew.
    fn fail(
        &mut self,
        result: StepResult,
        reason: Option<String>,
        missed: Vec<String>,
        before: &State,
        observer: &mut dyn Observer,
    ) -> Result<Command, EpisodeError> {
        let most = match (self.options.retries, self.options.blame) {
            (None, BlameRule::Belief) if !self.experience.retries.may_help() => 0,
            _ => self.options.retries(),
        };
        if let Some(execution) = &mut self.execution
            && execution.retries < most
            && execution.missing_precondition(&self.state).is_none()
        {
            if let Some(stop) = self.budget.stopped() {
                return Ok(self.stop(stop, false, observer));
            }
            execution.retries += 1;
            if let Some(step) = execution.step() {
                observer.event(&Event::Retried { call: step.call.clone() });
            }
            return Ok(self.command(Phase::AwaitingResult));
        }
        self.note_failure(result, reason, missed, None, before, observer);
        self.again(observer)
    }

    /// A person said no to a step. An objection that is not about the step is none, and the proposal stands.
    pub(crate) fn reject(
        &mut self,
        step: usize,
        objection: Option<Objection>,
        reason: String,
        observer: &mut dyn Observer,
    ) -> Result<Command, EpisodeError> {
        let Some(execution) = &mut self.execution else { return Ok(self.standing()) };
        let at = step.clamp(1, execution.plan.len()) - 1;
        let in_goal = |object: &Symbol| self.goal.mentions(object);
        let objection =
            objection.map(|said| instead::named(said, &execution.plan.steps[at], &self.state, &self.model, in_goal));
        let fits = match &objection {
            Some(Objection::Broken { objects } | Objection::WrongKind { objects }) => {
                objects.iter().all(|object| execution.plan.steps[at].objects.contains(object))
            }
            Some(Objection::While { atom }) => {
                self.model.predicates.get(&atom.predicate).map(Vec::len) == Some(atom.arity())
            }
            Some(Objection::Instead { object, .. }) => object.is_some(),
            Some(Objection::NotNow) | None => true,
        };
        if !fits {
            return Ok(self.standing());
        }
        execution.next_step = at;
        let objection = objection_to(execution, objection, &self.state);
        let reason = Some(reason).filter(|reason| !reason.is_empty());
        self.report_step(StepResult::Rejected, reason.clone(), None, Vec::new(), &self.state, observer);
        let state = self.state.clone();
        self.overrule(objection.as_ref(), observer);
        self.note_failure(StepResult::Rejected, reason, Vec::new(), objection, &state, observer);
        self.again(observer)
    }

    /// What was said before and is contradicted by this objection to the next step no longer counts: what spoke against an
    /// object that is wanted now, and that one was wanted which something speaks against now.
    fn overrule(&mut self, objection: Option<&Objection>, observer: &mut dyn Observer) {
        let Some(step) = self.execution.as_ref().and_then(Execution::step) else { return };
        let overruled = match objection {
            Some(Objection::Instead { with, .. }) => {
                let Some(ty) = self.state.objects.get(with).copied() else { return };
                let call = step.call.name.clone();
                self.experience.overrule(&call, with, ty, &self.instance, &self.model.hierarchy)
            }
            Some(Objection::Broken { objects } | Objection::WrongKind { objects }) => {
                let objects = if objects.is_empty() { step.objects.clone() } else { objects.clone() };
                self.experience.overrule_wanted(&objects, &self.instance)
            }
            _ => return,
        };
        for reason in overruled {
            observer.event(&Event::Overruled { reason });
        }
    }

    /// The type of the object that is wanted.
    fn wanted(&self, objection: Option<&Objection>) -> Option<Symbol> {
        let Some(Objection::Instead { with, .. }) = objection else { return None };
        self.state.objects.get(with).map(|ty| self.model.hierarchy.name(*ty).clone())
    }

    /// The calls that are not made in this task after an objection to the next step.
    fn not_made(&self, objection: Option<&Objection>) -> BTreeSet<GroundCall> {
        let step = self.execution.as_ref().and_then(Execution::step);
        match (objection, step) {
            (Some(Objection::Instead { object: Some(object), with }), Some(step)) => {
                instead::others(&step.call, object, with, &self.state, &self.model)
            }
            _ => BTreeSet::new(),
        }
    }

    /// Notes that the next step failed, or was rejected, in the state `before`, and what is to blame.
    fn note_failure(
        &mut self,
        result: StepResult,
        reason: Option<String>,
        missed: Vec<String>,
        objection: Option<Objection>,
        before: &State,
        observer: &mut dyn Observer,
    ) {
        let (Some(execution), Some(deed)) = (&self.execution, self.deed(before)) else { return };
        let Some(step) = execution.step().cloned() else { return };
        let mut failure = Failure {
            proposal: self.account.proposals,
            step: execution.next_step + 1,
            action: step.action.clone(),
            call: step.call.clone(),
            record: matches!(result, StepResult::Tried(_)).then_some(self.account.actions),
            result,
            reason,
            missed,
            added: before.added(&self.state).cloned().collect(),
            deleted: before.deleted(&self.state).cloned().collect(),
            imagined: step.imagined.is_some(),
            suspects: Vec::new(),
        };
        let why = failure.in_words();
        let failed = Failed {
            count: 1 + u64::from(execution.retries),
            ban: execution.expected(before).map(|action| Ban::of(&action)),
            not_made: self.not_made(objection.as_ref()),
            wanted: self.wanted(objection.as_ref()),
            objection,
            useless: self.options.restart,
            rejected: result == StepResult::Rejected,
            ..Failed::of(deed, &step.call.name, &self.model, before, &self.goal, why.clone())
        };
        self.experience.failed(Failed { task: self.task, ..failed });
        if execution.retries > 0 {
            self.experience.retries.note(false);
        }
        self.reconsider();
        failure.suspects = self.experience.failures().last().into_iter().flat_map(Failed::suspects).cloned().collect();
        for suspect in &failure.suspects {
            observer.event(&Event::Excluded { suspect: suspect.clone(), reason: why.clone() });
        }
        self.account.failures.push(failure);
    }

    /// Plans anew: from the initial state if the world is set back, else from where it is.
    fn again(&mut self, observer: &mut dyn Observer) -> Result<Command, EpisodeError> {
        if self.options.restart && self.account.actions > 0 {
            if let Some(execution) = &mut self.execution {
                execution.taken = 0;
            }
            return Ok(self.command(Phase::AwaitingReset));
        }
        self.propose(observer)
    }
}

/// What is said against the next step, if nothing more is said: that the things which an imagined step puts where none
/// of their kind was ever seen do not go there.
fn objection_to(execution: &Execution, said: Option<Objection>, state: &State) -> Option<Objection> {
    let unspecific = match &said {
        None => true,
        Some(Objection::WrongKind { objects }) => objects.is_empty(),
        Some(_) => false,
    };
    let Some(step) = execution.step().filter(|_| unspecific) else { return said };
    let replaced = step.imagined.iter().flat_map(|imagined| &imagined.replaced);
    let new = replaced.filter_map(|replacement| {
        let object = step.objects.get(replacement.parameter as usize)?;
        let seen = execution.model.hierarchy.is_a(*state.objects.get(object)?, replacement.from);
        (!seen && step.call.args.contains(object)).then(|| object.clone())
    });
    let objects: Vec<Symbol> = new.collect();
    if objects.is_empty() { said } else { Some(Objection::WrongKind { objects }) }
}
