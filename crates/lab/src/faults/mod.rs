//! Things that do not behave as shown: broken tools, and exceptions to what was learned. Each scenario is a task and,
//! with what was experienced in it, a later one, which must not repeat a mistake.

mod outcome;
mod render;
mod scenario;

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use typelift::agent::Experience;
use typelift::model::{ActionModel, Symbol};

use crate::attempt::{Setting, attempt_in};
use crate::error::LabError;
use crate::learned::kitchen_model;
use crate::limits::{Limits, Stopper};
use crate::runner::{Experiment, RunnerOptions, carry_out};
use crate::variant::paper_options;

pub use outcome::Outcome;
pub use render::FaultRow;
pub use scenario::{FaultScenario, fault_scenarios};

use outcome::{Listening, failed_otherwise, outcome, repeated};

/// What is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaultsOptions {
    /// Runs of each scenario, each in a room of its own.
    pub runs: u64,
    /// The seed of the first room; the others follow.
    pub seed: u64,
    /// What a task may take.
    pub limits: Limits,
    /// Only four scenarios.
    pub quick: bool,
}

impl Default for FaultsOptions {
    fn default() -> Self {
        let limits = Limits { max_expansions: 200_000, max_proposals: 12, seconds: 120.0 };
        Self { runs: 5, seed: 0, limits, quick: false }
    }
}

/// A scenario, what is done after a failure, and a room.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct FaultRun {
    /// The scenario's name.
    pub scenario: String,
    /// Whether the world is set back after a failure, as in the paper.
    pub restart: bool,
    /// The seed of the room.
    pub seed: u64,
}

impl fmt::Display for FaultRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let how = if self.restart { "with restart" } else { "without restart" };
        write!(f, "{}, {how}, {}", self.scenario, self.seed)
    }
}

/// What came of the two tasks of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FaultRecord {
    /// The task.
    pub first: Outcome,
    /// The later one.
    pub later: Outcome,
    /// Known mistakes made again in the later task; there should be none.
    pub repeated: Vec<String>,
    /// Calls that failed in both tasks, with something else expected of them in the later, when nothing else was left.
    pub failed_otherwise: Vec<String>,
}

struct FaultsExperiment {
    options: FaultsOptions,
    model: Arc<ActionModel>,
    scenarios: Vec<FaultScenario>,
}

impl Experiment for FaultsExperiment {
    const NAME: &'static str = "faults";
    type Run = FaultRun;
    type Record = FaultRecord;

    fn settings(&self) -> Value {
        json!(self.options.limits)
    }

    fn runs(&self) -> Vec<FaultRun> {
        let FaultsOptions { runs, seed, .. } = self.options;
        let mut all = Vec::new();
        for scenario in &self.scenarios {
            for restart in [true, false] {
                let run = |n| FaultRun { scenario: scenario.name.clone(), restart, seed: seed.saturating_add(n) };
                all.extend((0..runs).map(run));
            }
        }
        all
    }

    fn run(&self, run: &FaultRun, stopper: &Stopper) -> Result<Option<FaultRecord>, LabError> {
        let failed = |message: String| LabError::Run { run: run.to_string(), message };
        let scenario = self.scenarios.iter().find(|scenario| scenario.name == run.scenario);
        let scenario = scenario.ok_or_else(|| failed("there is no such scenario".to_owned()))?;
        let tasks = scenario.tasks(run.seed).map_err(|error| failed(error.to_string()))?;
        let options = typelift::agent::Options {
            restart: run.restart,
            max_proposals: self.options.limits.max_proposals,
            // The later task is one in the same kitchen, whatever else lies in it.
            instance: Some(Symbol::new("kitchen")),
            ..paper_options(true)
        };
        let mut experience = Experience::new();
        let mut both = Vec::with_capacity(2);
        for task in &tasks {
            let mut kitchen = Listening::default();
            let setting = Setting { task, seed: run.seed, experience };
            let budget = self.options.limits.budget(stopper);
            let done = attempt_in(&mut kitchen, &self.model, setting, &options, budget)
                .map_err(|error| failed(error.to_string()))?;
            if stopper() {
                return Ok(None);
            }
            experience = done.experience.clone();
            both.push((done, kitchen.told));
        }
        let [(first, _), (later, told)] = both.as_slice() else {
            return Err(failed("there are two tasks".to_owned()));
        };
        let repeated = repeated(first, later, told);
        Ok(Some(FaultRecord {
            first: outcome(&first.account),
            later: outcome(&later.account),
            failed_otherwise: failed_otherwise(first, later, &repeated),
            repeated,
        }))
    }
}

/// What came of the scenarios.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultsResult {
    /// What was run.
    pub options: FaultsOptions,
    /// The scenarios.
    pub scenarios: Vec<FaultScenario>,
    /// What came of each run.
    pub records: BTreeMap<FaultRun, FaultRecord>,
}

/// Runs the scenarios, and writes `faults.csv`, `faults.json` and `faults.md`.
///
/// # Errors
/// [`LabError`]; see [`carry_out`].
pub fn faults_experiment(options: &FaultsOptions, runner: &RunnerOptions<'_>) -> Result<FaultsResult, LabError> {
    let mut scenarios = fault_scenarios();
    scenarios.retain(|scenario| !options.quick || scenario::QUICK.contains(&scenario.name.as_str()));
    let experiment = FaultsExperiment { options: *options, model: Arc::new(kitchen_model(false)), scenarios };
    let records = carry_out(&experiment, runner)?;
    let result = FaultsResult { options: *options, scenarios: experiment.scenarios, records };
    result.write(runner.folder)?;
    Ok(result)
}
