//! The paper's heuristic: ordered landmarks not yet passed, with penalties.
//!
//! Each landmark sequence has a pointer; it moves on while the landmark it points at holds. The estimate is the
//! number of landmarks from the pointers on, plus 1 if the action that led here touches no object of the goal (but
//! for the actor), plus 1 if it passed no landmark. Landmark counting is after Richter and Westphal (2010), the
//! strict order within a sequence and the penalties are the paper's. Path dependent, not admissible, not safe as a
//! dead-end detector: it never says that a state is hopeless.

use crate::ground::Op;
use crate::landmark::LandmarkSequence;
use crate::successor::holds;

use super::Heuristic;

/// Counts landmarks not yet passed.
#[derive(Debug)]
pub struct OrderedLandmarks {
    sequences: Vec<LandmarkSequence>,
}

impl OrderedLandmarks {
    /// The heuristic over these sequences.
    pub fn new(sequences: Vec<LandmarkSequence>) -> Self {
        Self { sequences }
    }

    fn advance(&self, state: &[u64], pointers: &mut [u32]) -> (u32, bool) {
        let (mut left, mut passed) = (0, false);
        for (sequence, pointer) in self.sequences.iter().zip(pointers) {
            let start = *pointer;
            while sequence.facts.get(*pointer as usize).is_some_and(|&fact| holds(state, fact)) {
                *pointer += 1;
            }
            passed |= *pointer > start;
            left += sequence.facts.len() as u32 - *pointer;
        }
        (left, passed)
    }
}

impl Heuristic for OrderedLandmarks {
    fn memory_len(&self) -> usize {
        self.sequences.len()
    }

    fn initial(&self, state: &[u64], memory: &mut [u32]) -> u32 {
        memory.fill(0);
        self.advance(state, memory).0
    }

    fn successor(&self, predecessor: &[u32], op: &Op, state: &[u64], memory: &mut [u32]) -> u32 {
        memory.copy_from_slice(predecessor);
        let (left, passed) = self.advance(state, memory);
        left + u32::from(!op.touches_goal) + u32::from(!passed)
    }
}
