//! Planning tasks.

use std::collections::BTreeMap;

use crate::{Goal, GroundAtom, State};

/// A planning task (paper: 𝒯): where one is, and what must hold in the end.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Task {
    /// The initial state (𝒯_init).
    pub init: State,
    /// What must hold in the end.
    pub goal: Goal,
    /// The values of the functions that [costs](crate::Cost) mention. They never change.
    pub values: BTreeMap<GroundAtom, u32>,
}

impl Task {
    /// A task in which no cost mentions a function.
    pub fn new(init: State, goal: impl Into<Goal>) -> Self {
        Self { init, goal: goal.into(), values: BTreeMap::new() }
    }
}
