//! One task attempted in a kitchen, and the time that planning took.

use std::sync::Arc;
use std::time::{Duration, Instant};

use typelift::agent::{Account, Confirmation, Ending, Episode, Event, Experience, Observer, Options, RunError, run};
use typelift::model::{ActionModel, Budget, GroundAtom, ParseConfig, Plan, Stop, Symbol};
use typelift::world::{Parser, Reset, World};
use typelift_kitchen::{Kitchen, KitchenTask};

/// What came of a task.
#[derive(Debug, Clone)]
pub struct Attempt {
    /// The agent's account.
    pub account: Account,
    /// What was experienced, in this task and before.
    pub experience: Experience,
    /// The instance of the kitchen.
    pub instance: Symbol,
    /// The time spent on planning, imagination included.
    pub planning: Duration,
}

/// A task, with the room and with what was experienced before it.
#[derive(Debug, Clone)]
pub struct Setting<'a> {
    /// The task.
    pub task: &'a KitchenTask,
    /// The seed of the room.
    pub seed: u64,
    /// What earlier tasks taught.
    pub experience: Experience,
}

impl<'a> Setting<'a> {
    /// A task without experience from others.
    pub fn new(task: &'a KitchenTask, seed: u64) -> Self {
        Self { task, seed, experience: Experience::new() }
    }
}

/// Attempts a task in the simulator; every plan is approved.
///
/// # Errors
/// [`RunError`] if the simulator or the planner errs.
pub fn attempt(
    model: &Arc<ActionModel>,
    setting: Setting<'_>,
    options: &Options,
    budget: Budget,
) -> Result<Attempt, RunError> {
    attempt_in(&mut Kitchen::new(), model, setting, options, budget)
}

/// The same in a kitchen of somebody's own.
///
/// # Errors
/// [`RunError`] if the simulator or the planner errs.
pub fn attempt_in(
    world: &mut dyn World,
    model: &Arc<ActionModel>,
    setting: Setting<'_>,
    options: &Options,
    budget: Budget,
) -> Result<Attempt, RunError> {
    let Setting { task, seed, experience } = setting;
    let mut parser = Parser::new(model.hierarchy.clone(), ParseConfig::default());
    let model = knowing(model, &task.goal);
    let mut episode = Episode::new(Arc::clone(&model), task.goal.clone(), options.clone(), experience, budget);
    let reset = Reset { seed, scenario: Some(task.scenario.clone()) };
    let mut stopwatch = Stopwatch::default();
    let mut approve = |_: &Plan| Confirmation::Approve;
    let account = run(&mut episode, world, &reset, &mut parser, &mut approve, &mut stopwatch, &mut [])?;
    let (experience, instance) = (episode.experience().clone(), episode.instance().clone());
    Ok(Attempt { account, experience, instance, planning: stopwatch.total })
}

/// The model with the predicates of the goal: from few demonstrations it may not know them, and that there is no plan
/// then is what is measured.
fn knowing(model: &Arc<ActionModel>, goal: &[GroundAtom]) -> Arc<ActionModel> {
    if goal.iter().all(|atom| model.predicates.contains_key(&atom.predicate)) {
        return Arc::clone(model);
    }
    let mut knowing = ActionModel::clone(model);
    let root = knowing.hierarchy.root();
    for atom in goal {
        knowing.predicates.entry(atom.predicate.clone()).or_insert_with(|| vec![root; atom.arity()]);
    }
    Arc::new(knowing)
}

/// Adds up the time between the beginning and the end of planning.
#[derive(Debug, Default)]
struct Stopwatch {
    begun: Option<Instant>,
    total: Duration,
}

impl Observer for Stopwatch {
    fn event(&mut self, event: &Event) {
        match event {
            Event::PlanningStarted { .. } => self.begun = Some(Instant::now()),
            Event::PlanningEnded { .. } | Event::Ended { .. } => {
                self.total += self.begun.take().map(|begun| begun.elapsed()).unwrap_or_default();
            }
            _ => {}
        }
    }
}

/// How an episode ended, as it is written into tables.
pub fn ending_word(ending: &Ending) -> String {
    ending.word().replace('_', " ")
}

/// Whether a record with this ending was cut off by the clock: on another machine it may be another.
pub fn is_out_of_time(ending: &str) -> bool {
    ending == ending_word(&Ending::Stopped(Stop::Time))
}
