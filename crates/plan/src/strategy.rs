//! Every way to search, by name: which search, with which heuristics.

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use typelift_model::Budget;

use crate::ground::GroundTask;
use crate::heuristic::{Blind, CostMeasure, Ff, Heuristic, LandmarkCount, LmCut, OrderedLandmarks, Undominated};
use crate::landmark::{LandmarkGraph, sequences};
use crate::poll::Poll;
use crate::reach::Cut;
use crate::relaxation::{Negatives, Relaxation};
use crate::search::{AStar, Attempts, Interleaved, Lazy, Preference, Priority, Search, Space};
use crate::shuffle::Shuffler;

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

/// With more goals than this ordered landmarks are left out.
const MOST_GOALS_IN_ORDER: usize = 50;

/// The weights with which cheaper plans are looked for, in turn.
const WEIGHTS: [u32; 4] = [5, 3, 2, 1];

impl Stage {
    /// The stage after this one has found a plan; the last goes on.
    pub(crate) fn next(self) -> Self {
        match self {
            Self::First => Self::Weighted(WEIGHTS[0]),
            Self::Weighted(weight) => Self::Weighted(WEIGHTS.into_iter().find(|&next| next < weight).unwrap_or(weight)),
        }
    }
}

impl Strategy {
    /// Every strategy.
    pub const ALL: [Self; 6] =
        [Self::OrderedLandmarks, Self::Lama, Self::LazyFf, Self::LazyLandmarks, Self::AStarLmCut, Self::AStarBlind];

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
        Ok(match self {
            Self::OrderedLandmarks => {
                let heuristic = OrderedLandmarks::new(sequences(ground, task, budget)?);
                Box::new(AStar::new(space, Box::new(heuristic), false, plans))
            }
            Self::Lama => {
                let parts = Parts::new(stage, ground, space, budget)?;
                match stage {
                    Stage::First => {
                        // What lists many goals is not what ordered landmarks are for.
                        let few = (task.goal.len() <= MOST_GOALS_IN_ORDER)
                            .then(|| Self::OrderedLandmarks.search(stage, ground, space, 1, budget));
                        let lasting = [Preference::Helpful, Preference::Preferred]
                            .map(|preference| Box::new(parts.lama(space, preference)) as Box<dyn Search>);
                        let lasting = few.transpose()?.into_iter().chain(lasting).collect();
                        Box::new(Interleaved::new(lasting, Box::new(parts)))
                    }
                    Stage::Weighted(_) => Box::new(parts.lama(space, Preference::Helpful)),
                }
            }
            Self::LazyFf => {
                let parts = Parts::new(stage, ground, space, budget)?;
                Box::new(parts.lazy(space, vec![Box::new(parts.ff())], Preference::Preferred))
            }
            Self::LazyLandmarks => {
                let parts = Parts::new(stage, ground, space, budget)?;
                Box::new(parts.lazy(space, vec![Box::new(parts.landmark_count(space))], Preference::None))
            }
            Self::AStarLmCut => Box::new(AStar::new(space, Box::new(LmCut::new(task, relaxation())), true, plans)),
            Self::AStarBlind => Box::new(AStar::new(space, Box::new(Blind::new(task)), true, plans)),
        })
    }
}

/// What lazy searches of one stage share.
#[derive(Debug)]
struct Parts {
    priority: Priority,
    measure: CostMeasure,
    relaxation: Arc<Relaxation>,
    undominated: Arc<Undominated>,
    costs: Vec<u32>,
    landmarks: Arc<LandmarkGraph>,
}

impl Parts {
    fn new(stage: Stage, ground: &GroundTask, space: &Space, budget: &Budget) -> Result<Self, Cut> {
        let (priority, measure) = match stage {
            Stage::First => (Priority::Greedy, CostMeasure::Steps),
            Stage::Weighted(weight) => (Priority::Weighted(weight), CostMeasure::PlusOne),
        };
        let relaxation = Arc::new(Relaxation::new(&space.task, Negatives::Propositions));
        let costs = measure.of(&space.task);
        let undominated = Arc::new(Undominated::of(&relaxation, &costs));
        let landmarks = LandmarkGraph::new(ground, &space.task, &relaxation, &mut Poll::new(budget))?;
        Ok(Self { priority, measure, relaxation, undominated, costs, landmarks: Arc::new(landmarks) })
    }

    fn ff(&self) -> Ff {
        Ff::new(Arc::clone(&self.relaxation), Arc::clone(&self.undominated), self.costs.clone())
    }

    fn landmark_count(&self, space: &Space) -> LandmarkCount {
        LandmarkCount::new(Arc::clone(&self.landmarks), &space.task, &self.relaxation)
    }

    fn lazy(&self, space: &Space, heuristics: Vec<Box<dyn Heuristic>>, preference: Preference) -> Lazy {
        Lazy::new(space, self.priority, self.measure, heuristics, preference)
    }

    fn lama(&self, space: &Space, preference: Preference) -> Lazy {
        self.lazy(space, vec![Box::new(self.ff()), Box::new(self.landmark_count(space))], preference)
    }
}

impl Attempts for Parts {
    fn begin(&self, space: &Space, number: u64) -> Box<dyn Search> {
        let mut shuffler = Shuffler::new(number);
        let ff = Box::new(self.ff().shuffled(&mut shuffler));
        let preference = if number.is_multiple_of(2) { Preference::Helpful } else { Preference::Preferred };
        // Every third without landmarks.
        let heuristics: Vec<Box<dyn Heuristic>> =
            if number.is_multiple_of(3) { vec![ff] } else { vec![ff, Box::new(self.landmark_count(space))] };
        Box::new(self.lazy(space, heuristics, preference).shuffled(shuffler))
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
