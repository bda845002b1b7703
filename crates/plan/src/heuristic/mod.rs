//! Heuristics.
//!
//! A heuristic may keep a fixed number of words per search node, since what it knows can depend on the path by which
//! a state was reached.

mod blind;
mod bucket_queue;
mod ff;
mod landmark_count;
mod lm_cut;
mod ordered_landmarks;
mod undominated;

use std::fmt::Debug;

pub(crate) use blind::Blind;
pub(crate) use ff::Ff;
pub(crate) use landmark_count::LandmarkCount;
pub(crate) use lm_cut::LmCut;
pub(crate) use ordered_landmarks::OrderedLandmarks;
pub(crate) use undominated::Undominated;

use crate::fdr::{ActionIndex, Fdr, Values};

/// A state to be estimated, and how it was reached.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reached<'a> {
    /// The values of the state.
    pub(crate) values: &'a Values,
    /// How it was reached; none for the initial state.
    pub(crate) by: Option<Step<'a>>,
}

/// The step that led to a state.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step<'a> {
    /// The action that led here.
    pub(crate) action: ActionIndex,
    /// The values of the state before.
    pub(crate) values: &'a Values,
    /// The heuristic's memory of the state before.
    pub(crate) memory: &'a [u32],
}

/// An estimate of the cost to the goal.
pub(crate) trait Heuristic: Debug + Send {
    /// The number of words that it keeps per node.
    fn memory_len(&self) -> usize {
        0
    }

    /// Estimates a state, and fills its memory; `None` if no plan leads from it to the goal.
    fn estimate(&mut self, task: &Fdr, reached: Reached<'_>, memory: &mut [u32]) -> Option<u32>;

    /// The actions that the heuristic would begin with in the state estimated last, such as the first ones of a relaxed plan.
    /// Some may not be applicable.
    fn preferred(&self) -> &[ActionIndex] {
        &[]
    }

    /// The actions that achieve something that a [preferred](Self::preferred) action achieves. Some may not be applicable.
    fn helpful(&self) -> &[ActionIndex] {
        &[]
    }
}

/// How a heuristic or a search measures the cost of an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CostMeasure {
    /// Each action 1.
    Steps,
    /// The task's cost.
    Plain,
    /// The task's cost plus 1, so that actions without cost count; the plain cost if all actions cost the same.
    PlusOne,
}

impl CostMeasure {
    /// The cost of each action of a task.
    pub(crate) fn of(self, task: &Fdr) -> Vec<u32> {
        let costs = &task.actions.costs;
        let plus = match self {
            Self::Steps => return vec![1; costs.len()],
            Self::Plain => 0,
            Self::PlusOne => u32::from(costs.windows(2).any(|pair| pair[0] != pair[1])),
        };
        costs.iter().map(|cost| cost.saturating_add(plus)).collect()
    }
}
