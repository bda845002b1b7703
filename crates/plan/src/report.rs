//! What was counted.

use std::iter::Sum;
use std::ops::{Add, AddAssign};

/// What grounding and search counted. The reports of searches that take turns, or follow each other, can be added.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Report {
    /// How often reachability was computed, for planning and, before it, for imagination.
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

impl Add for Report {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            groundings: self.groundings + other.groundings,
            ground_actions: self.ground_actions + other.ground_actions,
            facts: self.facts + other.facts,
            expansions: self.expansions + other.expansions,
            evaluations: self.evaluations + other.evaluations,
            reopened: self.reopened + other.reopened,
        }
    }
}

impl AddAssign for Report {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sum for Report {
    fn sum<I: Iterator<Item = Self>>(reports: I) -> Self {
        reports.fold(Self::default(), Self::add)
    }
}
