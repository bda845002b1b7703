//! Every way to search, by name: which search, with which heuristics.

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use typelift_model::Budget;

use crate::ground::GroundTask;
use crate::heuristic::{Blind, CostMeasure, Ff, Heuristic, LandmarkCount, LmCut, OrderedLandmarks};
use crate::landmark::{LandmarkGraph, sequences};
use crate::poll::Poll;
use crate::reach::Cut;
use crate::relaxation::{Negatives, Relaxation};
use crate::search::{AStar, Lazy, Priority, Search, Space};

/// A way to search for plans.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Strategy {
    /// The paper's: A* with landmarks in one sequence per goal object. For learned models.
    #[default]
    OrderedLandmarks,
    /// LAMA's: lazy greedy search that alternates between FF's relaxed plans and landmark counting, with preferred
    /// actions; then weighted A* with decreasing weights (Richter and Westphal 2010).
    Lama,
    /// Lazy greedy search with FF's relaxed plans and preferred actions alone.
    LazyFf,
    /// Lazy greedy search with landmark counting alone.
    LazyLandmarks,
    /// A* with LM-cut: an optimal plan.
    AStarLmCut,
    /// A* without an estimate, which is uniform-cost search: an optimal plan.
    AStarBlind,
}

/// Which of a strategy's searches: the first plan's, or one that looks for cheaper plans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stage {
    First,
    Weighted(u32),
}

/// The weights with which cheaper plans are looked for, in turn.
const WEIGHTS: [u32; 4] = [5, 3, 2, 1];

impl Stage {
    /// The stage after this one has found a plan; the last goes on.
    pub(crate) fn next(self) -> Self {
        match self {
            Self::First => Self::Weighted(WEIGHTS[0]),
            Self::Weighted(weight) => {
                Self::Weighted(WEIGHTS.into_iter().find(|&next| next < weight).unwrap_or(weight))
            }
        }
    }
}

impl Strategy {
    /// Every strategy.
    pub const ALL: [Self; 6] = [
        Self::OrderedLandmarks,
        Self::Lama,
        Self::LazyFf,
        Self::LazyLandmarks,
        Self::AStarLmCut,
        Self::AStarBlind,
    ];

    /// Its name on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::OrderedLandmarks => "ordered-landmarks",
            Self::Lama => "lama",
            Self::LazyFf => "lazy-ff",
            Self::LazyLandmarks => "lazy-landmarks",
            Self::AStarLmCut => "astar-lmcut",
            Self::AStarBlind => "astar-blind",
        }
    }

    /// Whether its first plan is a cheapest one.
    pub fn is_optimal(self) -> bool {
        matches!(self, Self::AStarLmCut | Self::AStarBlind)
    }

    /// Whether one search finds all of its plans, however many and however cheap.
    pub(crate) fn has_one_search(self) -> bool {
        matches!(self, Self::OrderedLandmarks | Self::AStarLmCut | Self::AStarBlind)
    }

    /// Its search for a stage; `plans` different ways to each state are kept where that is possible.
    pub(crate) fn search(
        self,
        stage: Stage,
        ground: &GroundTask,
        space: &Space,
        plans: usize,
        budget: &Budget,
    ) -> Result<Box<dyn Search>, Cut> {
        let task = &space.task;
        let relaxation = || Arc::new(Relaxation::new(task, Negatives::Propositions));
        let (priority, measure) = match stage {
            Stage::First => (Priority::Greedy, CostMeasure::Steps),
            Stage::Weighted(weight) => (Priority::Weighted(weight), CostMeasure::PlusOne),
        };
        let lazy = |heuristics: Vec<Box<dyn Heuristic>>, prefers: bool| -> Box<dyn Search> {
            Box::new(Lazy::new(space, priority, measure, heuristics, prefers))
        };
        let landmarks = |relaxation: &Relaxation| -> Result<Box<dyn Heuristic>, Cut> {
            let graph = LandmarkGraph::new(ground, task, relaxation, &mut Poll::new(budget))?;
            Ok(Box::new(LandmarkCount::new(graph, task, relaxation)))
        };
        Ok(match self {
            Self::OrderedLandmarks => {
                let heuristic = OrderedLandmarks::new(sequences(ground, task, budget)?);
                Box::new(AStar::new(space, Box::new(heuristic), false, plans))
            }
            Self::Lama => {
                let relaxation = relaxation();
                let landmarks = landmarks(&relaxation)?;
                lazy(vec![Box::new(Ff::new(task, relaxation, measure)), landmarks], true)
            }
            Self::LazyFf => lazy(vec![Box::new(Ff::new(task, relaxation(), measure))], true),
            Self::LazyLandmarks => lazy(vec![landmarks(&relaxation())?], false),
            Self::AStarLmCut => Box::new(AStar::new(space, Box::new(LmCut::new(task, relaxation())), true, plans)),
            Self::AStarBlind => Box::new(AStar::new(space, Box::new(Blind::new(task)), true, plans)),
        })
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Strategy {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|strategy| strategy.name() == text);
        known.ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|strategy| strategy.name()).collect();
            format!("there are {}", names.join(", "))
        })
    }
}
