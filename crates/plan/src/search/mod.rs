//! Searches. Each can be continued.

mod astar;
mod interleaved;
mod lazy;
mod open_list;

use std::fmt::Debug;

pub(crate) use astar::AStar;
pub(crate) use interleaved::{Attempts, EAGER, Interleaved};
pub(crate) use lazy::{Lazy, Preference, Priority};

use typelift_model::{Budget, Stop};

use crate::fdr::{ActionIndex, Fdr, SuccessorGenerator};
use crate::symmetry::Symmetry;

/// What grounding and search counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Report {
    /// How often what can be reached was worked out, for planning and, before it, for imagination.
    pub groundings: u64,
    /// Ground actions.
    pub ground_actions: u64,
    /// Facts.
    pub facts: u64,
    /// Nodes expanded.
    pub expansions: u64,
    /// Nodes evaluated by heuristics.
    pub evaluations: u64,
    /// Nodes opened again, having been reached on a smaller g.
    pub reopened: u64,
}

/// What is searched.
#[derive(Debug)]
pub(crate) struct Space {
    pub(crate) task: Fdr,
    pub(crate) successors: SuccessorGenerator,
    pub(crate) symmetry: Symmetry,
}

impl Space {
    /// What is searched is this task.
    pub(crate) fn new(task: Fdr, symmetry: Symmetry) -> Self {
        let successors = SuccessorGenerator::new(&task);
        Self { task, successors, symmetry }
    }
}

/// What a search came to.
#[derive(Debug)]
pub(crate) enum Found {
    /// A plan that was not found before, as the search tells plans apart.
    Plan(Vec<ActionIndex>),
    /// Everything that is not too dear was searched.
    Nothing,
    /// The budget ended it.
    Stopped(Stop),
}

/// A search that can be continued.
pub(crate) trait Search: Debug + Send {
    /// Searches on for a plan cheaper than the bound, if there is one; everything dearer is pruned from now on.
    fn next(&mut self, space: &Space, cost_bound: Option<u64>, budget: &Budget) -> Found;

    /// What was counted.
    fn report(&self) -> Report;

    /// How often it came nearer to the goal than ever before, by an estimate.
    fn improvements(&self) -> u64 {
        0
    }

    /// The state expanded so far in which most goal facts held.
    fn closest(&self) -> Option<Vec<u32>>;
}
