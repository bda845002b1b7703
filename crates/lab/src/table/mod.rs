//! Table I: 24 tasks, four variants, several rooms, each cell beside the published one.

mod cell;
mod render;

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use typelift::model::{ActionModel, Plan};
use typelift_kitchen::{KitchenTask, demonstrations, tasks};

use crate::attempt::{Setting, attempt, ending_word};
use crate::error::LabError;
use crate::learned::learned_from;
use crate::limits::{Limits, Stopper};
use crate::runner::{Experiment, RunnerOptions, carry_out};
use crate::variant::{Variant, paper_options};

pub use cell::{Cell, Comparison};

/// What is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableOptions {
    /// Runs of each cell, each in a room of its own.
    pub runs: u64,
    /// The seed of the first room; the others follow.
    pub seed: u64,
    /// What a run may spend.
    pub limits: Limits,
    /// Whether to measure seconds, which differ from run to run.
    pub times: bool,
    /// Only the tasks in [`QUICK`].
    pub quick: bool,
}

impl Default for TableOptions {
    fn default() -> Self {
        let limits = Limits { max_expansions: 200_000, max_proposals: 12, seconds: 120.0 };
        Self { runs: 5, seed: 0, limits, times: true, quick: false }
    }
}

/// The tasks of a quick table: shown, longer for individual actions, beyond these, imagined, and with several proposals.
pub const QUICK: [&str; 5] = ["T1.1", "T2.1", "T2.2", "T4.1", "T5.2"];

/// A task, a variant and a room.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TableRun {
    /// The task.
    pub task: String,
    /// The variant.
    pub variant: Variant,
    /// The seed of the room.
    pub seed: u64,
}

impl fmt::Display for TableRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.task, self.variant, self.seed)
    }
}

/// What came of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TableRecord {
    /// How it ended.
    pub ending: String,
    /// Plans proposed, the one that succeeded included.
    pub proposals: u64,
    /// The length of the plan that succeeded.
    pub plan_length: Option<usize>,
    /// How many of its steps are imagined.
    pub imagined_steps: Option<usize>,
    /// Nodes expanded by all searches.
    pub expansions: u64,
    /// Ground actions of the largest search.
    pub ground_actions: u64,
    /// Planning time in seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

/// The models of a table, and the tasks.
struct TableExperiment {
    options: TableOptions,
    models: BTreeMap<Variant, Arc<ActionModel>>,
    tasks: Vec<KitchenTask>,
}

impl Experiment for TableExperiment {
    const NAME: &'static str = "table";
    type Run = TableRun;
    type Record = TableRecord;

    fn settings(&self) -> Value {
        let mut settings = json!(self.options.limits);
        settings["times"] = self.options.times.into();
        settings
    }

    fn runs(&self) -> Vec<TableRun> {
        let TableOptions { runs, seed, .. } = self.options;
        let mut all = Vec::new();
        for task in &self.tasks {
            for variant in Variant::ALL {
                let run = |n| TableRun { task: task.name.clone(), variant, seed: seed.saturating_add(n) };
                all.extend((0..runs).map(run));
            }
        }
        all
    }

    fn weight(&self, run: &TableRun) -> u64 {
        // Searches that end only at the limit take nearly all of the time.
        let to_the_limit = matches!(run.task.as_str(), "T4.3" | "T4.4" | "T5.4") || run.task.starts_with("T6");
        if run.variant == Variant::IndividualImagined && to_the_limit { 500 } else { 1 }
    }

    fn run(&self, run: &TableRun, stopper: &Stopper) -> Result<Option<TableRecord>, LabError> {
        let failed = |message: String| LabError::Run { run: run.to_string(), message };
        let task = self.tasks.iter().find(|task| task.name == run.task);
        let task = task.ok_or_else(|| failed("there is no such task".to_owned()))?;
        let options = typelift::agent::Options {
            max_proposals: self.options.limits.max_proposals,
            ..paper_options(run.variant.imagines())
        };
        let budget = self.options.limits.budget(stopper);
        let model = &self.models[&run.variant];
        let done = attempt(model, Setting::new(task, run.seed), &options, budget).map_err(|e| failed(e.to_string()))?;
        if stopper() {
            return Ok(None);
        }
        let account = &done.account;
        let plan = account.plan.as_ref().filter(|_| account.solved());
        let imagined = |plan: &Plan| plan.steps.iter().filter(|step| step.imagined.is_some()).count();
        Ok(Some(TableRecord {
            ending: ending_word(&account.ending),
            proposals: account.proposals,
            plan_length: plan.map(Plan::len),
            imagined_steps: plan.map(imagined),
            expansions: account.expansions,
            ground_actions: account.ground_actions,
            seconds: self.options.times.then_some(done.planning.as_secs_f64()),
        }))
    }
}

/// Table I, ours beside the paper's.
#[derive(Debug, Clone, PartialEq)]
pub struct TableResult {
    /// What was run.
    pub options: TableOptions,
    /// Transitions in the demonstrations.
    pub transitions: u64,
    /// Actions learned, by variant.
    pub actions: BTreeMap<Variant, usize>,
    /// The cells: by task, then by variant.
    pub cells: Vec<Cell>,
    /// What came of each run.
    pub records: BTreeMap<TableRun, TableRecord>,
}

/// Runs Table I, and writes `table.csv`, `table.json` and `table.md`.
///
/// # Errors
/// [`LabError`]; see [`carry_out`].
pub fn table(options: &TableOptions, runner: &RunnerOptions<'_>) -> Result<TableResult, LabError> {
    let shown = demonstrations(0);
    let learned = [false, true].map(|individual| learned_from(&shown, individual));
    let transitions = learned[0].1.transitions;
    let models: BTreeMap<Variant, Arc<ActionModel>> =
        Variant::ALL.map(|v| (v, Arc::new(learned[usize::from(v.individual())].0.model.clone()))).into();
    let mut tasks = tasks();
    tasks.retain(|task| !options.quick || QUICK.contains(&task.name.as_str()));
    let actions = models.iter().map(|(variant, model)| (*variant, model.actions.len())).collect();
    let experiment = TableExperiment { options: *options, models, tasks };
    let records = carry_out(&experiment, runner)?;
    let cells = cell::cells(&experiment.tasks, &records);
    let result = TableResult { options: *options, transitions, actions, cells, records };
    result.write(runner.folder)?;
    Ok(result)
}
