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
    /// What each landmark asks for, one of them: facts, and whether they must hold.
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
