//! Another planner in the place of ours.

use std::fmt::Debug;
use std::process::ExitStatus;

use thiserror::Error;
use typelift_model::{ActionModel, Budget, Symbol, Task};

use crate::outcome::Outcome;

/// A planner that is asked instead of [`Planner`](crate::Planner).
pub trait ExternalPlanner: Debug + Send + Sync {
    /// Plans a task. The caller must check the plan.
    ///
    /// # Errors
    /// [`ExternalFailure`] if there is no answer, or none that can be read.
    fn plan(&self, model: &ActionModel, task: &Task, budget: &Budget) -> Result<Outcome, ExternalFailure>;
}

/// Why another planner gave no usable answer.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ExternalFailure {
    /// The task could not be put to it.
    #[error("{reason}")]
    NotAsked {
        /// Why not: its language cannot say the task, or a file cannot be written.
        reason: String,
    },
    /// It could not be started.
    #[error("cannot start {program}: {reason}")]
    NotStarted {
        /// The program.
        program: String,
        /// The system's reason.
        reason: String,
        /// What to do about it, if that is known.
        hint: Option<String>,
    },
    /// It ended and left neither a plan nor a word about why there is none.
    #[error("{program} {}{}", ended(*.status), indented(.last_words))]
    NoAnswer {
        /// The program.
        program: String,
        /// Its exit status, or the signal that ended it, if that is known.
        status: Option<ExitStatus>,
        /// The last lines that it printed.
        last_words: Vec<String>,
    },
    /// Its plan is not made of the model's actions.
    #[error("the plan of {program} cannot be used: {defect}")]
    UnusablePlan {
        /// The program.
        program: String,
        /// What is wrong with it.
        defect: PlanDefect,
    },
}

/// Why the plan of another planner cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PlanDefect {
    /// It cannot be read.
    #[error("{reason}")]
    Unreadable {
        /// Why not.
        reason: String,
    },
    /// A step is not an action of the model.
    #[error("step {step}: {defect}")]
    Step {
        /// Which, from 1.
        step: usize,
        /// What is wrong with it.
        defect: StepDefect,
    },
}

/// Why a step that another planner wrote cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum StepDefect {
    /// It has a name that the planner was not told.
    #[error("there is no {kind} `{name}`")]
    UnknownName {
        /// What has the name.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// Its action has another number of parameters.
    #[error("{action} takes {expected} objects, not {found}")]
    Arguments {
        /// The action.
        action: Symbol,
        /// How many objects it takes.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// What its action costs with these objects is stated nowhere.
    #[error("what {action} costs there is not stated")]
    NoCost {
        /// The action.
        action: Symbol,
    },
}

/// How a program ended that left no plan.
fn ended(status: Option<ExitStatus>) -> String {
    match status {
        Some(status) if status.success() => "ended without a plan".to_owned(),
        Some(status) => format!("failed ({status})"),
        None => "failed".to_owned(),
    }
}

fn indented(lines: &[String]) -> String {
    lines.iter().map(|line| format!("\n  {line}")).collect()
}
