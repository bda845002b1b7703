//! Living a life: its tasks, one after the other, by one agent.

use std::sync::Arc;

use typelift::agent::{Account, Confirmation, Episode, Event, Experience, Observer, run};
use typelift::model::{LearnedModel, Observations, Plan};
use typelift::world::{Parser, Record, RecordSink, Reset, TraceHeader, Verdict};
use typelift_kitchen::{Life, LifeTask};

use super::agent::Agent;
use super::record::{FailedStep, LifeRecord, OtherEffect, TaskRecord, TrueCause};
use super::remembering::{Kept, Learner};
use super::watched::Watched;
use crate::attempt::ending_word;
use crate::limits::{Limits, Stopper};
use crate::runner::locked;

/// An agent in the course of its life.
pub(super) struct Living<'a> {
    agent: Agent,
    limits: Limits,
    stopper: &'a Stopper,
    learner: Learner,
    /// What the demonstrations show.
    evidence: Arc<Observations>,
    experience: Experience,
}

impl<'a> Living<'a> {
    pub(super) fn new(agent: Agent, learned: &LearnedModel, limits: Limits, stopper: &'a Stopper) -> Self {
        let evidence = Arc::new(learned.evidence.total().into_owned());
        let learner = Learner::new(learned.clone());
        Self { agent, limits, stopper, learner, evidence, experience: Experience::new() }
    }

    /// Lives a life; nothing if it was stopped.
    ///
    /// # Errors
    /// In words, if the simulator or the planner errs.
    pub(super) fn live(mut self, life: &Life) -> Result<Option<LifeRecord>, String> {
        let mut tasks = Vec::with_capacity(life.tasks.len());
        for task in &life.tasks {
            let done = self.carry_out(task)?;
            if (self.stopper)() {
                return Ok(None);
            }
            tasks.push(done);
        }
        Ok(Some(LifeRecord { exceptions: life.exceptions.clone(), interlock: life.interlock.clone(), tasks }))
    }

    fn carry_out(&mut self, LifeTask { task, seed, newly_broken, .. }: &LifeTask) -> Result<TaskRecord, String> {
        if self.agent != Agent::Memory {
            self.experience = Experience::new();
        }
        let model = Arc::clone(&self.learner.model);
        let options = self.agent.options(self.limits);
        let budget = self.limits.budget(self.stopper);
        let mut episode = Episode::new(Arc::clone(&model), task.goal.clone(), options, self.experience.clone(), budget)
            .with_evidence(Arc::clone(&self.evidence));
        let mut parser =
            Parser::new(model.hierarchy.clone(), self.learner.learned.parse.clone()).knowing(&model.predicates);
        let mut world = Watched::default();
        let notes = world.notes();
        let mut confirm = |plan: &Plan| match self.agent {
            Agent::Informed => locked(&notes).answer(plan, newly_broken.as_ref()),
            _ => Confirmation::Approve,
        };
        let mut steps = Steps::default();
        let mut kept = Kept::new(TraceHeader { task: task.name.clone(), goal: task.goal.clone().into() });
        let reset = Reset { seed: *seed, scenario: Some(task.scenario.clone()) };
        let mut sinks: Vec<&mut dyn RecordSink> = vec![&mut kept];
        let account = run(&mut episode, &mut world, &reset, &mut parser, &mut confirm, &mut steps, &mut sinks)
            .map_err(|error| error.to_string())?;
        if self.agent == Agent::Memory {
            self.experience = episode.experience().clone();
            self.learner.learn(&kept)?;
        }
        let faults = std::mem::take(&mut locked(&notes).faults);
        let steps = steps.taken.into_iter().zip(faults);
        let failed = steps.filter(|(step, _)| step.verdict != Verdict::AsExpected).map(|(step, fault)| FailedStep {
            cause: fault.map_or(TrueCause::Effect(OtherEffect::OtherEffect), TrueCause::Fault),
            call: step.call,
            action: step.action,
            retry: step.retry,
        });
        Ok(TaskRecord {
            task: task.name.clone(),
            ending: ending_word(&account.ending),
            proposals: account.proposals - rejected(&account),
            actions: account.actions,
            failed: failed.collect(),
        })
    }
}

/// Plans that were not carried out, since somebody said no.
fn rejected(account: &Account) -> u64 {
    account.failures.iter().filter(|failure| failure.record.is_none()).count() as u64
}

/// A step that was taken.
struct Taken {
    call: String,
    action: String,
    verdict: Verdict,
    retry: bool,
}

/// Notes the steps that are taken.
#[derive(Default)]
struct Steps {
    taken: Vec<Taken>,
    is_retry: bool,
}

impl Observer for Steps {
    fn event(&mut self, event: &Event) {
        if let Event::Retried { .. } = event {
            self.is_retry = true;
        }
    }

    fn record(&mut self, record: &Record) {
        let action = &record.action;
        self.taken.push(Taken {
            call: action.call.to_string(),
            action: action.expected.as_ref().map(|expected| expected.action.to_string()).unwrap_or_default(),
            verdict: action.verdict.unwrap_or(Verdict::AsExpected),
            retry: std::mem::take(&mut self.is_retry),
        });
    }
}
