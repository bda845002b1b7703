//! Planning tasks.

use std::collections::BTreeMap;

use crate::{GroundAtom, State};

/// A planning task (paper: 𝒯): where one is, and what must hold in the end.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Task {
    /// The initial state (𝒯_init).
    pub init: State,
    /// The atoms that must all hold.
    pub goal: Vec<GroundAtom>,
    /// The atoms of which none may hold. Tasks for learned models have none.
    pub negative_goal: Vec<GroundAtom>,
    /// The values of the functions that [costs](crate::Cost) mention. They never change.
    pub values: BTreeMap<GroundAtom, u32>,
}

impl Task {
    /// A task with nothing but goal atoms to be made true.
    pub fn new(init: State, goal: Vec<GroundAtom>) -> Self {
        Self { init, goal, ..Self::default() }
    }

    /// The same task from another state.
    #[must_use]
    pub fn from_state(&self, init: State) -> Self {
        Self { init, ..self.clone() }
    }

    /// Whether the goal holds in a state, which holds all that follows from it.
    pub fn goal_holds(&self, state: &State) -> bool {
        self.goal_literals().all(|(atom, positive)| state.holds(atom) == positive)
    }

    /// The goal as literals: each atom, and whether it must hold.
    pub fn goal_literals(&self) -> impl Iterator<Item = (&GroundAtom, bool)> {
        self.goal.iter().map(|atom| (atom, true)).chain(self.negative_goal.iter().map(|atom| (atom, false)))
    }
}

impl From<Vec<GroundAtom>> for Task {
    /// A goal alone.
    fn from(goal: Vec<GroundAtom>) -> Self {
        Self::new(State::default(), goal)
    }
}
