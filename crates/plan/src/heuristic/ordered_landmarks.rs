//! The paper's heuristic: landmarks in the order of their sequences, one pointer a sequence.
//!
//! A pointer moves on while the landmark it points to holds; what it passed stays passed. h is the number of
//! landmarks from the pointers on, plus 1 if the action that led here touches no object of the goal (but
//! for the actor), plus 1 if it passed no landmark. Landmark counting is after Richter and Westphal (2010), the
//! strict order within a sequence and the penalties are the paper's. Path dependent, not admissible, not safe as a
//! dead-end detector: it never says that a state is hopeless. Conditional effects and derived predicates count as far as
//! landmarks do.

use super::{Heuristic, Reached, Step};
use crate::fact::FactId;
use crate::fdr::{Fdr, Values};
use crate::landmark::LandmarkSequence;

/// Counts landmarks not yet passed.
#[derive(Debug)]
pub(crate) struct OrderedLandmarks {
    sequences: Vec<Vec<FactId>>,
}

impl OrderedLandmarks {
    /// The heuristic over these sequences.
    pub(crate) fn new(sequences: Vec<LandmarkSequence>) -> Self {
        Self { sequences: sequences.into_iter().map(|sequence| sequence.facts).collect() }
    }

    fn advance(&self, task: &Fdr, values: &Values, pointers: &mut [u32]) -> (u32, bool) {
        let (mut left, mut passed) = (0, false);
        for (facts, pointer) in self.sequences.iter().zip(pointers) {
            let start = *pointer;
            while facts.get(*pointer as usize).is_some_and(|&fact| task.holds(values, fact)) {
                *pointer += 1;
            }
            passed |= *pointer > start;
            left += facts.len() as u32 - *pointer;
        }
        (left, passed)
    }
}

impl Heuristic for OrderedLandmarks {
    fn memory_len(&self) -> usize {
        self.sequences.len()
    }

    fn estimate(&mut self, task: &Fdr, reached: Reached<'_>, memory: &mut [u32]) -> Option<u32> {
        let Some(Step { action, memory: before, .. }) = reached.by else {
            memory.fill(0);
            return Some(self.advance(task, reached.values, memory).0);
        };
        memory.copy_from_slice(before);
        let (left, passed) = self.advance(task, reached.values, memory);
        Some(left + u32::from(!task.actions.touches_goal[action as usize]) + u32::from(!passed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landmark::sequences;
    use crate::worked::Worked;
    use typelift_model::Budget;

    #[test]
    fn landmarks_left_and_penalties() {
        // The egg's landmarks are held(egg), then boiled(egg): two are left at first. An action that passes no landmark is
        // charged 1, and so is one that has nothing to do with the egg.
        let worked = Worked::new(
            "init: in(egg) cold
             goal: boiled(egg)
             take(?0): in(?0) -> held(?0) !in(?0)
             drop(?0): held(?0) -> in(?0) !held(?0)
             boil(?0): held(?0) hot -> boiled(?0)
             heat: cold -> hot !cold",
        );
        let landmarks = sequences(&worked.ground, &worked.fdr, &Budget::unlimited()).expect("no limits");
        let mut ordered = OrderedLandmarks::new(landmarks);
        let mut along = |path: &[&str]| worked.estimates(&mut ordered, path).into_iter().flatten().collect::<Vec<_>>();
        // heat: 2 left, none passed, not about the egg. take: 1 left. boil: nothing.
        assert_eq!(along(&["heat", "take(egg)", "boil(egg)"]), [2, 4, 1, 0]);
        // What is passed stays passed: after dropping the egg 1 is left, and none was passed; the same after taking it again.
        assert_eq!(along(&["take(egg)", "drop(egg)", "take(egg)"]), [2, 1, 2, 2]);
    }
}
