//! The blind heuristic: the cheapest action's cost until the goal holds. Admissible and consistent, with conditional effects
//! and derived predicates too; it sees no dead ends.

use super::{Heuristic, Reached};
use crate::fdr::Fdr;

/// Estimates nothing.
#[derive(Debug)]
pub(crate) struct Blind {
    cheapest: u32,
}

impl Blind {
    pub(crate) fn new(task: &Fdr) -> Self {
        Self { cheapest: task.actions.costs.iter().copied().min().unwrap_or(0) }
    }
}

impl Heuristic for Blind {
    fn estimate(&mut self, task: &Fdr, reached: Reached<'_>, _memory: &mut [u32]) -> Option<u32> {
        Some(if task.is_goal(reached.values) { 0 } else { self.cheapest })
    }
}
