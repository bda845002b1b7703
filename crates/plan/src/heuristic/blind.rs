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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worked::Worked;

    #[test]
    fn worked_by_hand() {
        // The cheapest action costs 2; in the goal nothing is left to pay. It is not seen that there is no way on from b.
        let worked = Worked::new(
            "init: a
             goal: c
             on cost 3: a -> c !a
             off cost 2: a -> b !a",
        );
        let mut blind = Blind::new(&worked.fdr);
        assert_eq!(["a", "b", "c"].map(|state| worked.estimate(&mut blind, state)), [Some(2), Some(2), Some(0)]);
    }
}
