//! Heuristics.
//!
//! A heuristic may keep a fixed number of words per search node, since what it knows can depend on the path by which
//! a state was reached.

mod ordered_landmarks;

use std::fmt::Debug;

pub use ordered_landmarks::OrderedLandmarks;

use crate::ground::Op;

/// An estimate of the cost to the goal.
pub trait Heuristic: Debug + Send {
    /// The number of words that it keeps per node. Nodes of one state whose words differ are different nodes.
    fn memory_len(&self) -> usize;

    /// Fills the memory of the initial node and estimates it.
    fn initial(&self, state: &[u64], memory: &mut [u32]) -> u32;

    /// Fills the memory of the node that `op` leads to, from its predecessor's, and estimates it.
    fn successor(&self, predecessor: &[u32], op: &Op, state: &[u64], memory: &mut [u32]) -> u32;
}
