//! Somebody else's planner in the place of ours.

use std::fmt::Debug;

use thiserror::Error;
use typelift_model::{ActionModel, Budget, Task};

use crate::outcome::Outcome;

/// A planner that is asked instead of [`Planner`](crate::Planner).
pub trait ExternalPlanner: Debug + Send + Sync {
    /// Plans a task. Whoever asks has the plan checked.
    ///
    /// # Errors
    /// [`ExternalFailure`] if there is no answer, or none that can be read.
    fn plan(&self, model: &ActionModel, task: &Task, budget: &Budget) -> Result<Outcome, ExternalFailure>;
}

/// Why somebody else's planner gave no usable answer.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ExternalFailure {
    /// It could not be asked, or failed.
    #[error("{0}")]
    Failed(String),
    /// Its plan cannot be read, or is none for this task.
    #[error("{0}")]
    InvalidPlan(String),
}
