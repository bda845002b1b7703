//! Learning along a life: 200 tasks one after the other, in a kitchen in which tools break and are mended, six foods do not go
//! with a tool, and one rule is hidden. What each of several agents does wrong, and whether it does it again.

mod agent;
mod blame;
mod informed;
mod living;
mod mistake;
mod record;
mod remembering;
mod render;
mod summary;
mod truth;

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use typelift::model::LearnedModel;
use typelift_kitchen::{demonstrations, life};

use crate::error::LabError;
use crate::learned::learned_from;
use crate::limits::{Limits, Stopper};
use crate::runner::{Experiment, RunnerOptions, carry_out};

pub use agent::Agent;
pub use blame::Blame;
pub use record::{FailedStep, LifeRecord, OtherEffect, TaskRecord, TrueCause};
pub use summary::{AgentSummary, Goal};
pub use truth::Truth;

use living::Living;

/// What is lived.
#[derive(Debug, Clone, PartialEq)]
pub struct LifelongOptions {
    /// The agents.
    pub agents: Vec<Agent>,
    /// Lives of each agent, each of a seed of its own.
    pub runs: u64,
    /// The seed of the first life; the others follow.
    pub seed: u64,
    /// Tasks of a life.
    pub tasks: usize,
    /// States in which it is looked at what is thought to work.
    pub states: usize,
    /// What a task may take.
    pub limits: Limits,
}

impl LifelongOptions {
    /// Tasks of a short life.
    pub const QUICK: usize = 12;
}

impl Default for LifelongOptions {
    fn default() -> Self {
        let limits = Limits { max_expansions: 200_000, max_proposals: 12, seconds: 120.0 };
        Self { agents: Agent::ALL.to_vec(), runs: 10, seed: 0, tasks: 200, states: 200, limits }
    }
}

/// A life, and who lives it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct LifeRun {
    /// The seed of the life.
    pub seed: u64,
    /// Who lives it.
    pub agent: Agent,
}

impl fmt::Display for LifeRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "life {}, {}", self.seed, self.agent)
    }
}

struct LifelongExperiment {
    options: LifelongOptions,
    learned: LearnedModel,
}

impl Experiment for LifelongExperiment {
    const NAME: &'static str = "lifelong";
    type Run = LifeRun;
    type Record = LifeRecord;

    fn settings(&self) -> Value {
        json!({ "tasks": self.options.tasks, "states": self.options.states, "limits": self.options.limits })
    }

    fn runs(&self) -> Vec<LifeRun> {
        let LifelongOptions { runs, seed, agents, .. } = &self.options;
        let lives = (0..*runs).map(|number| seed.saturating_add(number));
        lives.flat_map(|seed| agents.iter().map(move |agent| LifeRun { seed, agent: *agent })).collect()
    }

    fn weight(&self, run: &LifeRun) -> u64 {
        match run.agent {
            Agent::Memory => 4,
            Agent::Forgetful | Agent::Paper => 2,
            Agent::Informed => 1,
        }
    }

    fn run(&self, run: &LifeRun, stopper: &Stopper) -> Result<Option<LifeRecord>, LabError> {
        let life = life(run.seed, self.options.tasks);
        let living = Living::new(run.agent, &self.learned, self.options.limits, stopper);
        living.live(&life, self.options.states).map_err(|message| LabError::Run { run: run.to_string(), message })
    }
}

/// What came of the lives.
#[derive(Debug, Clone, PartialEq)]
pub struct LifelongResult {
    /// What was lived.
    pub options: LifelongOptions,
    /// What came of each life.
    pub records: BTreeMap<LifeRun, LifeRecord>,
}

/// Has the lives lived, and writes `lifelong.csv`, `failed.csv`, `lifelong.json` and `lifelong.md`.
///
/// # Errors
/// [`LabError`]; see [`carry_out`].
pub fn lifelong_experiment(options: &LifelongOptions, runner: &RunnerOptions<'_>) -> Result<LifelongResult, LabError> {
    let experiment =
        LifelongExperiment { options: options.clone(), learned: learned_from(&demonstrations(0), false).0 };
    let records = carry_out(&experiment, runner)?;
    let result = LifelongResult { options: options.clone(), records };
    result.write(runner.folder)?;
    Ok(result)
}
