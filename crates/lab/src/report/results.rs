//! What a report is made of: the files that the other experiments wrote, as far as a report needs them.
//!
//! Each is looked for in the report's folder, and in the folder of the experiment's name below it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde::de::DeserializeOwned;
use typelift::world::{FileError, read_text};

use crate::growth::GrowthResult;
use crate::hierarchy::TypeHierarchy;
use crate::lifelong::Goal;
use crate::variant::Variant;

/// All results that are there.
#[derive(Debug, Default)]
pub struct Results {
    /// Table I.
    pub table: Option<Table>,
    /// The number of demonstrations.
    pub demonstrations: Option<Demonstrations>,
    /// Broken tools and exceptions.
    pub faults: Option<Faults>,
    /// The hierarchy.
    pub hierarchy: Option<TypeHierarchy>,
    /// Growth.
    pub growth: Option<GrowthResult>,
    /// Learning along a life.
    pub lifelong: Option<Lifelong>,
}

/// `table.json`.
#[derive(Debug, Deserialize)]
pub struct Table {
    /// Runs of each cell.
    pub runs: u64,
    /// The seed of the first.
    pub seed: u64,
    /// Transitions learned from.
    pub transitions: u64,
    /// Actions by variant.
    pub actions: Vec<Actions>,
    /// A cell for each task and variant.
    pub cells: Vec<Cell>,
}

/// How many actions a variant has.
#[derive(Debug, Deserialize)]
pub struct Actions {
    /// The variant.
    pub variant: Variant,
    /// Learned.
    pub learned: u64,
}

/// The runs of a task and a variant.
#[derive(Debug, Clone, Deserialize)]
pub struct Cell {
    /// The task.
    pub task: String,
    /// The variant.
    pub variant: Variant,
    /// Runs.
    pub runs: u64,
    /// Runs that were solved.
    pub solved: u64,
    /// Proposals, the median.
    pub proposals: Option<f64>,
    /// Steps of the plan, the median.
    pub plan_length: Option<f64>,
    /// Planning time.
    pub seconds_mean: Option<f64>,
    /// Its standard deviation.
    pub seconds_sd: Option<f64>,
    /// Ground actions, the median.
    pub ground_actions: f64,
    /// The published cell; nothing where no plan succeeded.
    pub paper: Option<PaperCell>,
}

/// A published cell.
#[derive(Debug, Clone, Deserialize)]
pub struct PaperCell {
    /// Proposals.
    pub proposals: f64,
    /// Steps of the plan.
    pub plan_length: f64,
    /// Planning time.
    pub seconds_mean: f64,
}

impl Cell {
    /// Whether every run was solved.
    pub fn is_solved(&self) -> bool {
        self.solved == self.runs
    }

    /// Whether it is solved in every run, or in none, as published.
    pub fn is_solved_as_published(&self) -> bool {
        if self.paper.is_some() { self.is_solved() } else { self.solved == 0 }
    }

    /// Whether all numbers but the times are the published ones.
    pub fn is_as_published(&self) -> bool {
        let ours = self.proposals.zip(self.plan_length);
        self.is_solved_as_published() && ours == self.paper.as_ref().map(|paper| (paper.proposals, paper.plan_length))
    }
}

/// `demonstrations.json`.
#[derive(Debug, Deserialize)]
pub struct Demonstrations {
    /// The seed of the rooms.
    pub seed: u64,
    /// Tasks.
    pub tasks: u64,
    /// What is demonstrated.
    pub demonstrations: Vec<String>,
    /// By variant.
    pub variants: Vec<OfVariant>,
}

/// The subsets of a variant.
#[derive(Debug, Deserialize)]
pub struct OfVariant {
    /// The variant.
    pub variant: Variant,
    /// By number of demonstrations.
    pub sizes: Vec<Size>,
}

/// The subsets of one size.
#[derive(Debug, Clone, Deserialize)]
pub struct Size {
    /// The number of demonstrations.
    pub demonstrations: u64,
    /// For each subset the number of tasks solved, sorted.
    pub solved: Vec<u64>,
    /// The fewest.
    pub solved_min: u64,
    /// The median.
    pub solved_median: f64,
    /// The most.
    pub solved_max: u64,
    /// Subsets that solve all.
    pub complete: u64,
}

/// `faults.json`.
#[derive(Debug, Deserialize)]
pub struct Faults {
    /// Runs of each scenario.
    pub runs: u64,
    /// The seed of the first.
    pub seed: u64,
    /// The scenarios in a sentence.
    pub summary: String,
    /// A scenario a row, with restart and without.
    pub scenarios: Vec<Scenario>,
}

/// A scenario in one mode.
#[derive(Debug, Clone, Deserialize)]
pub struct Scenario {
    /// Its name.
    pub scenario: String,
    /// What is broken; nothing in an exception.
    pub broken: Vec<String>,
    /// Whether there is a way.
    pub possible: bool,
    /// Whether the world is set back after a failure.
    pub restart: bool,
    /// Runs that were solved.
    pub solved: u64,
    /// Proposals, the median.
    pub proposals: f64,
    /// Steps of the plan, the median.
    pub plan_length: Option<f64>,
    /// What was excluded in some run.
    pub excluded: Vec<String>,
    /// Known mistakes made again in a later task.
    pub repeated_mistakes: u64,
}

/// `lifelong.json`.
#[derive(Debug, Deserialize)]
pub struct Lifelong {
    /// Lives of each agent.
    pub runs: u64,
    /// The seed of the first.
    pub seed: u64,
    /// Tasks of a life.
    pub tasks: usize,
    /// Tasks of each part of a life that is looked at apart.
    pub window: usize,
    /// The agents.
    pub agents: Vec<LifeOf>,
    /// What was to be reached.
    pub goals: Vec<Goal>,
}

/// The lives of an agent.
#[derive(Debug, Clone, Deserialize)]
pub struct LifeOf {
    /// The agent.
    pub agent: String,
    /// Tasks.
    pub tasks: u64,
    /// Tasks that were solved.
    pub solved: u64,
    /// Plans a task.
    pub proposals: f64,
    /// Failed steps a task, in successive parts of a life.
    pub failed_over_time: Vec<f64>,
    /// Failed steps by their true cause: in the first part, in the last part, and in all.
    pub causes: BTreeMap<String, [u64; 3]>,
}

/// An experiment that a report shows, with the file that it reads.
pub const EXPERIMENTS: [(&str, &str); 6] = [
    ("table", "table.json"),
    ("demonstrations", "demonstrations.json"),
    ("faults", "faults.json"),
    ("hierarchy", "hierarchy.json"),
    ("growth", "growth.json"),
    ("lifelong", "lifelong.json"),
];

impl Results {
    /// Reads what is there.
    ///
    /// # Errors
    /// [`FileError`] for a file that is there and is not what the experiment writes.
    pub fn read(folder: &Path) -> Result<Self, FileError> {
        let path = |index: usize| find(folder, EXPERIMENTS[index]);
        Ok(Self {
            table: read(path(0))?,
            demonstrations: read(path(1))?,
            faults: read(path(2))?,
            hierarchy: read(path(3))?,
            growth: read(path(4))?,
            lifelong: read(path(5))?,
        })
    }

    /// The experiments whose results are not there.
    pub fn missing(&self) -> Vec<&'static str> {
        let there = [
            self.table.is_some(),
            self.demonstrations.is_some(),
            self.faults.is_some(),
            self.hierarchy.is_some(),
            self.growth.is_some(),
            self.lifelong.is_some(),
        ];
        EXPERIMENTS.iter().zip(there).filter(|(_, there)| !there).map(|((name, _), _)| *name).collect()
    }
}

/// The file of an experiment, if it is there.
fn find(folder: &Path, (experiment, file): (&str, &str)) -> Option<PathBuf> {
    [folder.join(file), folder.join(experiment).join(file)].into_iter().find(|path| path.is_file())
}

fn read<T: DeserializeOwned>(path: Option<PathBuf>) -> Result<Option<T>, FileError> {
    let Some(path) = path else { return Ok(None) };
    let text = read_text(&path)?;
    serde_json::from_str(&text).map(Some).map_err(|error| {
        let hint = "The experiment writes it anew when it is run again with the same -o.";
        FileError::new(&path, format!("this is not what the experiment writes: {error}")).with_hint(hint.to_owned())
    })
}
