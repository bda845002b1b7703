//! Living a life: its tasks, one after the other, by one agent.

use std::sync::Arc;

use typelift::agent::{Account, Command, Episode, Event, Experience, Explanation, Input, Observer};
use typelift::model::{Budget, LearnedModel, Observations, Plan, State, Symbol};
use typelift::world::{Acted, Parser, Record, Reset, Scene, Verdict, World};
use typelift_kitchen::{Fault, Kitchen, Life, LifeTask};

use super::agent::Agent;
use super::informed::{No, objection};
use super::mistake::{Foresight, foresee};
use super::record::{FailedStep, LifeRecord, OtherEffect, TaskRecord, TrueCause};
use super::remembering::Learner;
use super::truth::{LOOKED_AT, Walks};
use crate::attempt::ending_word;
use crate::limits::{Limits, Stopper};

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

    /// Lives a life, and looks at so many states of walks from time to time; nothing if it was stopped.
    ///
    /// # Errors
    /// In words, if the simulator or the planner errs.
    pub(super) fn live(mut self, life: &Life, states: usize) -> Result<Option<LifeRecord>, String> {
        let mut tasks = Vec::with_capacity(life.tasks.len());
        let mut truth = Vec::new();
        let states = if self.agent == Agent::Memory { states } else { 0 };
        let walks = Walks::new(life, states, &self.learner.learned)?;
        for (number, task) in life.tasks.iter().enumerate() {
            if states > 0 && LOOKED_AT.contains(&number) {
                truth.push(walks.truth(&self.learner.learned, number));
            }
            let done = self.carry_out(task)?;
            if (self.stopper)() {
                return Ok(None);
            }
            tasks.push(done);
        }
        if states > 0 {
            truth.push(walks.truth(&self.learner.learned, life.tasks.len()));
        }
        let (exceptions, interlock) = (life.exceptions.clone(), life.interlock.clone());
        Ok(Some(LifeRecord { exceptions, interlock, tasks, truth }))
    }

    fn carry_out(&mut self, LifeTask { task, seed, newly_broken, .. }: &LifeTask) -> Result<TaskRecord, String> {
        if self.agent != Agent::Memory {
            self.experience = Experience::new();
        }
        let Learner { learned, model } = &self.learner;
        let options = self.agent.options(self.limits);
        let budget = self.limits.budget(self.stopper);
        let episode =
            Episode::new(Arc::clone(model), task.goal.clone(), options, self.experience.clone(), budget.clone())
                .with_evidence(Arc::clone(&self.evidence));
        let mut trying = Trying {
            agent: self.agent,
            episode,
            budget,
            kitchen: Kitchen::new(),
            parser: Parser::new(model.hierarchy.clone(), learned.parse.clone()).knowing(&model.predicates),
            unknown: newly_broken.clone(),
            foresight: Foresight::default(),
            taken: Vec::new(),
        };
        let mut seen = Seen::default();
        let account = trying.drive(&Reset { seed: *seed, scenario: Some(task.scenario.clone()) }, &mut seen)?;
        let failed = trying.failed(&seen);
        if self.agent == Agent::Memory {
            self.experience = trying.episode.experience().clone();
            self.learner.learn(&task.name, seen.records)?;
        }
        Ok(TaskRecord {
            task: task.name.clone(),
            ending: ending_word(&account.ending),
            proposals: account.proposals - rejected(&account),
            actions: account.actions,
            newly_broken: newly_broken.clone(),
            failed,
        })
    }
}

/// Plans that were not carried out, since somebody said no.
fn rejected(account: &Account) -> u64 {
    account.failures.iter().filter(|failure| failure.record.is_none()).count() as u64
}

/// An agent that tries a task.
struct Trying {
    agent: Agent,
    episode: Episode,
    budget: Budget,
    kitchen: Kitchen,
    parser: Parser,
    /// A tool that broke just now, as long as that is not known.
    unknown: Option<Symbol>,
    /// What is believed of the plan that is carried out.
    foresight: Foresight,
    /// What was done, in order.
    taken: Vec<Taken>,
}

/// A step that was taken.
struct Taken {
    /// Why it changed nothing, if it did not.
    fault: Option<Fault>,
    /// How likely it was thought to work, and how likely another plan, if there was a better one.
    p: Option<f64>,
    better: Option<f64>,
    explanations: Vec<Explanation>,
}

impl Trying {
    /// Drives the episode to its end.
    fn drive(&mut self, reset: &Reset, seen: &mut Seen) -> Result<Account, String> {
        let mut input = Input::Started;
        loop {
            let failures = self.episode.experience().failures().len();
            let command = self.episode.step(input, seen).map_err(|error| error.to_string())?;
            self.explain(failures);
            input = match command {
                Command::Reset { id } => {
                    let scene = self.kitchen.reset(reset).map_err(|error| error.to_string())?;
                    Input::Reset { id, state: self.parsed(&scene)?, instance: None }
                }
                Command::Observe { id } | Command::Await { id, .. } => {
                    let scene = self.kitchen.observe().map_err(|error| error.to_string())?;
                    Input::Observation { id, state: self.parsed(&scene)? }
                }
                Command::Propose { id, plan } => match self.objection(&plan) {
                    Some(no) => no.to(id),
                    None => {
                        self.consider(&plan);
                        seen.done = 0;
                        Input::Approve { id }
                    }
                },
                Command::Act { id, call } => {
                    let fault = self.kitchen.room().and_then(|room| room.fault(&call));
                    if matches!((&fault, &self.unknown), (Some(Fault::Broken { tool }), Some(unknown)) if tool == unknown)
                    {
                        self.unknown = None;
                    }
                    let p = self.foresight.works.get(seen.done).copied().flatten();
                    let better = self.foresight.better;
                    self.taken.push(Taken { fault, p, better, explanations: Vec::new() });
                    let Acted { scene, executed, reason } =
                        self.kitchen.act(&call).map_err(|error| error.to_string())?;
                    let state = self.parsed(&scene)?;
                    match executed {
                        true => Input::Observation { id, state },
                        false => Input::Refused { id, reason: reason.unwrap_or_default(), state },
                    }
                }
                Command::Done(account) => return Ok(*account),
            };
        }
    }

    fn parsed(&mut self, scene: &Scene) -> Result<State, String> {
        self.parser.parse(scene).map_err(|error| error.to_string())
    }

    fn objection(&self, plan: &Plan) -> Option<No> {
        let room = self.kitchen.room().filter(|_| self.agent == Agent::Informed)?;
        objection(room, plan, self.unknown.as_ref())
    }

    /// Notes what is believed of a plan that is about to be carried out.
    fn consider(&mut self, plan: &Plan) {
        if self.agent == Agent::Memory {
            self.foresight = foresee(&self.episode, plan, &self.budget);
        }
    }

    /// Notes what explains the last step, if it counts as a failure since.
    fn explain(&mut self, failures: usize) {
        if self.agent == Agent::Memory
            && let (Some(failed), Some(taken)) =
                (self.episode.experience().failures().get(failures), self.taken.last_mut())
        {
            taken.explanations = self.episode.explanations(failed);
        }
    }

    /// The steps that failed.
    fn failed(&self, seen: &Seen) -> Vec<FailedStep> {
        let steps = self.taken.iter().zip(&seen.records).zip(&seen.retries);
        let failed = steps.filter(|((_, record), _)| record.action.verdict != Some(Verdict::AsExpected));
        let step = |((taken, record), retry): ((&Taken, &Record), &bool)| FailedStep {
            call: record.action.call.to_string(),
            action: record.action.expected.as_ref().map(|expected| expected.action.to_string()).unwrap_or_default(),
            cause: taken.fault.clone().map_or(TrueCause::Effect(OtherEffect::OtherEffect), TrueCause::Fault),
            retry: *retry,
            p: taken.p,
            better: taken.better,
            explanations: taken.explanations.clone(),
        };
        failed.map(step).collect()
    }
}

/// What is seen of an episode.
#[derive(Default)]
struct Seen {
    /// The steps taken, with the states around them.
    records: Vec<Record>,
    /// Whether each was a retry.
    retries: Vec<bool>,
    is_retry: bool,
    /// Steps of the plan that worked.
    done: usize,
}

impl Observer for Seen {
    fn event(&mut self, event: &Event) {
        if let Event::Retried { .. } = event {
            self.is_retry = true;
        }
    }

    fn record(&mut self, record: &Record) {
        self.done += usize::from(record.action.verdict == Some(Verdict::AsExpected));
        self.retries.push(std::mem::take(&mut self.is_retry));
        self.records.push(record.clone());
    }
}
