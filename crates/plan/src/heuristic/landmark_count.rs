//! The landmark-count heuristic of Richter and Westphal (*The LAMA planner*, JAIR 39, 2010), with what is known of landmarks
//! kept as by Büchner, Keller, Eriksson and Helmert (*Landmark progression in heuristic search*, ICAPS 2023): how many
//! landmarks of the graph have to become true in the future.
//!
//! A landmark is past when an action has made it true. It is in the future until an action makes it true; and again
//! while it does not hold although it is a goal, or has to hold immediately before one that is not past; and while one that is
//! reasonably made true before it is not past. Path dependent: of several paths to a state the first counts. Not
//! admissible; it never says that a state is a dead end. Conditional effects and derived predicates count as far as the
//! graph knows them.

use std::sync::Arc;

use super::{Heuristic, Reached};
use crate::fdr::{Assignment, Fdr, Values};
use crate::landmark::LandmarkGraph;
use crate::relaxation::Relaxation;

/// Counts landmarks.
#[derive(Debug)]
pub(crate) struct LandmarkCount {
    graph: Arc<LandmarkGraph>,
    /// The literals of each landmark, one of which makes it true: facts, and whether they must hold.
    literals: Vec<Vec<(Assignment, bool)>>,
}

impl LandmarkCount {
    pub(crate) fn new(graph: Arc<LandmarkGraph>, task: &Fdr, relaxation: &Relaxation) -> Self {
        let literals = graph
            .landmarks
            .iter()
            .map(|landmark| landmark.props.iter().filter_map(|&prop| relaxation.literal(task, prop)).collect());
        Self { literals: literals.collect(), graph }
    }

    fn holds(&self, values: &Values, landmark: usize) -> bool {
        self.literals[landmark].iter().any(|&(fact, wanted)| fact.holds(values) == wanted)
    }

    /// How many landmarks' bits stand in so many words.
    fn words(&self) -> usize {
        self.literals.len().div_ceil(32)
    }
}

fn is_set(bits: &[u32], index: usize) -> bool {
    bits[index / 32] >> (index % 32) & 1 == 1
}

fn set(bits: &mut [u32], index: usize) {
    bits[index / 32] |= 1 << (index % 32);
}

impl Heuristic for LandmarkCount {
    fn memory_len(&self) -> usize {
        2 * self.words()
    }

    fn estimate(&mut self, _task: &Fdr, reached: Reached<'_>, memory: &mut [u32]) -> Option<u32> {
        let values = reached.values;
        let (past, future) = memory.split_at_mut(self.words());
        past.fill(0);
        future.fill(0);
        for index in 0..self.literals.len() {
            let in_future = match reached.by {
                None => !self.holds(values, index),
                Some(by) => {
                    let (was_past, was_future) = by.memory.split_at(self.words());
                    let in_future =
                        is_set(was_future, index) && (!self.holds(values, index) || self.holds(by.values, index));
                    if is_set(was_past, index) {
                        set(past, index);
                    }
                    in_future
                }
            };
            set(if in_future { &mut *future } else { &mut *past }, index);
        }
        for (index, landmark) in self.graph.landmarks.iter().enumerate() {
            let is_needed = landmark.is_goal || landmark.needed_for.iter().any(|&next| !is_set(past, next as usize));
            if is_needed && !self.holds(values, index)
                || landmark.better_after.iter().any(|&before| !is_set(past, before as usize))
            {
                set(future, index);
            }
        }
        Some(future.iter().map(|word| word.count_ones()).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::poll::Poll;
    use crate::worked::Worked;
    use typelift_model::Budget;

    /// The counts along a path, the initial state's first.
    fn counts(worked: &Worked, path: &[&str]) -> Vec<Option<u32>> {
        let no_limit = Budget::unlimited();
        let mut poll = Poll::new(&no_limit);
        let graph = LandmarkGraph::new(&worked.ground, &worked.fdr, &worked.relaxation, &mut poll).expect("no limits");
        let mut count = LandmarkCount::new(Arc::new(graph), &worked.fdr, &worked.relaxation);
        worked.estimates(&mut count, path)
    }

    #[test]
    fn what_is_past_may_be_needed_again() {
        // Landmarks: at(shop), bread, and at(home), which holds.
        let worked = Worked::new(
            "init: at(home)
             goal: at(home) bread
             go: at(home) -> at(shop) !at(home)
             back: at(shop) -> at(home) !at(shop)
             buy: at(shop) -> bread",
        );
        // At the shop at(home) takes the place of at(shop): it is a goal, and does not hold.
        assert_eq!(counts(&worked, &["go", "buy", "back"]), [2, 2, 1, 0].map(Some));
        // Home without bread, at(shop) is past, but has to hold again immediately before bread.
        assert_eq!(counts(&worked, &["go", "back"]), [2, 2, 2].map(Some));
    }

    #[test]
    fn what_is_better_made_true_later_is_in_the_future() {
        // Cooking undoes tidiness, and both are asked: tidiness is reasonably made true after the meal.
        let worked = Worked::new(
            "init: hungry
             goal: tidy meal
             tidy-up: -> tidy
             cook: hungry -> meal !tidy",
        );
        assert_eq!(counts(&worked, &["cook", "tidy-up"]), [2, 1, 0].map(Some));
        // Tidying up first gains nothing.
        assert_eq!(counts(&worked, &["tidy-up", "cook", "tidy-up"]), [2, 2, 1, 0].map(Some));
    }
}
