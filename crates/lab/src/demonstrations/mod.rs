//! The number of demonstrations: a model from every subset of 2 to 8 of them, tested on the 24 tasks.

mod effect;
mod render;
mod subset;

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use typelift::agent::Ending;
use typelift::model::Stop;
use typelift_kitchen::{Demonstration, KitchenTask, demonstrations, tasks};

use crate::attempt::{Setting, attempt};
use crate::error::LabError;
use crate::learned::learned_from;
use crate::limits::{Limits, Stopper};
use crate::runner::{Experiment, RunnerOptions, carry_out};
use crate::statistics::median;
use crate::variant::{Variant, paper_options};

pub use effect::Gain;
pub use subset::Subset;

/// What is run.
#[derive(Debug, Clone, PartialEq)]
pub struct DemonstrationsOptions {
    /// The variants.
    pub variants: Vec<Variant>,
    /// The seed of the rooms.
    pub seed: u64,
    /// What a task may take.
    pub limits: Limits,
    /// Only all demonstrations, and all but one.
    pub quick: bool,
}

impl Default for DemonstrationsOptions {
    fn default() -> Self {
        let limits = Limits { max_expansions: 4_000, max_proposals: 4, seconds: 120.0 };
        Self { variants: Variant::ALL.to_vec(), seed: 0, limits, quick: false }
    }
}

/// A variant learned from some of the demonstrations.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct SubsetRun {
    /// The variant.
    pub variant: Variant,
    /// What is shown.
    pub shown: Subset,
}

impl fmt::Display for SubsetRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} from {}", self.variant, self.shown)
    }
}

/// What came of testing a model on all tasks.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SubsetRecord {
    /// Actions learned.
    pub actions: usize,
    /// Nodes expanded for all tasks.
    pub expansions: u64,
    /// Tasks that the clock ended, and so depend on the machine.
    pub out_of_time: usize,
    /// The tasks that were solved, with the proposals made for each.
    pub solved: BTreeMap<String, u64>,
}

struct SubsetExperiment<'a> {
    options: &'a DemonstrationsOptions,
    demonstrations: Vec<Demonstration>,
    tasks: Vec<KitchenTask>,
}

impl Experiment for SubsetExperiment<'_> {
    const NAME: &'static str = "demonstrations";
    type Run = SubsetRun;
    type Record = SubsetRecord;

    fn settings(&self) -> Value {
        let mut settings = json!(self.options.limits);
        settings["seed"] = self.options.seed.into();
        settings
    }

    fn runs(&self) -> Vec<SubsetRun> {
        let sizes = if self.options.quick { 7..=8 } else { 2..=8 };
        let subsets: Vec<Subset> = sizes.flat_map(Subset::of_size).collect();
        let of = |variant: &Variant| {
            let variant = *variant;
            subsets.iter().map(move |shown| SubsetRun { variant, shown: shown.clone() })
        };
        self.options.variants.iter().flat_map(of).collect()
    }

    fn weight(&self, run: &SubsetRun) -> u64 {
        if run.variant.imagines() { 10 } else { 1 }
    }

    fn run(&self, run: &SubsetRun, stopper: &Stopper) -> Result<Option<SubsetRecord>, LabError> {
        let shown: Vec<Demonstration> = run.shown.choose(&self.demonstrations);
        let model = Arc::new(learned_from(&shown, run.variant.individual()).0.model);
        let options = typelift::agent::Options {
            max_proposals: self.options.limits.max_proposals,
            ..paper_options(run.variant.imagines())
        };
        let mut record =
            SubsetRecord { actions: model.actions.len(), expansions: 0, out_of_time: 0, solved: BTreeMap::new() };
        for task in &self.tasks {
            let setting = Setting::new(task, self.options.seed);
            let done = attempt(&model, setting, &options, self.options.limits.budget(stopper))
                .map_err(|error| LabError::Run { run: format!("{run}, {}", task.name), message: error.to_string() })?;
            if stopper() {
                return Ok(None);
            }
            record.expansions += done.account.expansions;
            record.out_of_time += usize::from(done.account.ending == Ending::Stopped(Stop::Time));
            if done.account.solved() {
                record.solved.insert(task.name.clone(), done.account.proposals);
            }
        }
        Ok(Some(record))
    }
}

/// How many tasks the models solve, by the number of demonstrations they are learned from.
#[derive(Debug, Clone, PartialEq)]
pub struct DemonstrationsResult {
    /// What was run.
    pub options: DemonstrationsOptions,
    /// The tasks.
    pub tasks: usize,
    /// What the demonstrations show, in order.
    pub titles: Vec<String>,
    /// What came of each subset.
    pub records: BTreeMap<SubsetRun, SubsetRecord>,
}

/// The subsets of one size and variant.
#[derive(Debug, Clone, PartialEq)]
pub struct Size {
    /// The number of demonstrations.
    pub size: usize,
    /// For each subset the number of tasks solved, sorted.
    pub solved: Vec<usize>,
}

impl Size {
    /// The median number of tasks solved.
    pub fn median(&self) -> f64 {
        median(self.solved.iter().map(|n| *n as f64)).unwrap_or_default()
    }
}

impl DemonstrationsResult {
    /// A variant's subsets by size.
    pub fn sizes(&self, variant: Variant) -> Vec<Size> {
        let mut sizes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (run, record) in self.records.iter().filter(|(run, _)| run.variant == variant) {
            sizes.entry(run.shown.len()).or_default().push(record.solved.len());
        }
        let sorted = |(size, mut solved): (usize, Vec<usize>)| {
            solved.sort_unstable();
            Size { size, solved }
        };
        sizes.into_iter().map(sorted).collect()
    }

    /// The smallest subsets from which a variant solves every task.
    pub fn smallest_complete(&self, variant: Variant) -> Vec<&Subset> {
        let complete =
            self.records.iter().filter(|(run, record)| run.variant == variant && record.solved.len() == self.tasks);
        let complete: Vec<&Subset> = complete.map(|(run, _)| &run.shown).collect();
        let smallest = complete.iter().map(|shown| shown.len()).min();
        complete.into_iter().filter(|shown| Some(shown.len()) == smallest).collect()
    }

    /// How many tasks were ended by the clock, and so depend on the machine.
    pub fn out_of_time(&self) -> usize {
        self.records.values().map(|record| record.out_of_time).sum()
    }
}

/// Learns from every subset, tests on every task, and writes `demonstrations.csv`, `sizes.csv`, `gains.csv`,
/// `violins.svg`, `demonstrations.json` and `demonstrations.md`.
///
/// # Errors
/// [`LabError`]; see [`carry_out`].
pub fn demonstrations_experiment(
    options: &DemonstrationsOptions,
    runner: &RunnerOptions<'_>,
) -> Result<DemonstrationsResult, LabError> {
    let experiment = SubsetExperiment { options, demonstrations: demonstrations(0), tasks: tasks() };
    let records = carry_out(&experiment, runner)?;
    let result = DemonstrationsResult {
        options: options.clone(),
        tasks: experiment.tasks.len(),
        titles: experiment.demonstrations.iter().map(|shown| shown.recording.header.task.clone()).collect(),
        records,
    };
    result.write(runner.folder)?;
    Ok(result)
}
