//! Every way to search, by name: which search, with which heuristics.
//!
//! Learned models are planned for with the paper's search by default: on the kitchen's 24 tasks it expands 5 to 66 nodes
//! (`typelift plan MODEL TASK --imagine`), and no other does better there.

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use thiserror::Error;
use typelift_model::{Budget, Stop};

use crate::ground::GroundTask;
use crate::heuristic::{Blind, CostMeasure, Ff, Heuristic, LandmarkCount, LmCut, OrderedLandmarks, Undominated};
use crate::landmark::{LandmarkGraph, sequences};
use crate::poll::Poll;
use crate::relaxation::{Negatives, Relaxation};
use crate::search::{AStar, Attempts, EAGER, Interleaved, Lazy, Preference, Priority, Search, Space};
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
    ) -> Result<Box<dyn Search>, Stop> {
        let mut poll = Poll::new(budget);
        Ok(match self {
            Self::OrderedLandmarks => Box::new(ordered(ground, space, plans, budget)?),
            Self::AStarLmCut => {
                let relaxation = Relaxation::new(&space.task, Negatives::Propositions, &mut poll)?;
                Box::new(AStar::new(space, Box::new(LmCut::new(&space.task, Arc::new(relaxation))), true, plans))
            }
            Self::AStarBlind => Box::new(AStar::new(space, Box::new(Blind::new(&space.task)), true, plans)),
            Self::LazyFf => {
                let way = Way::of(stage);
                let relaxed = RelaxedPlans::new(way, space, &mut poll)?;
                Box::new(way.lazy(space, vec![Box::new(relaxed.ff())], Preference::Preferred))
            }
            Self::LazyLandmarks => {
                let relaxation = Relaxation::new(&space.task, Negatives::Propositions, &mut poll)?;
                let graph = Arc::new(LandmarkGraph::new(ground, &space.task, &relaxation, &mut poll)?);
                let count = LandmarkCount::new(graph, &space.task, &relaxation);
                Box::new(Way::of(stage).lazy(space, vec![Box::new(count)], Preference::None))
            }
            Self::Lama => {
                let lama = Lama::new(Way::of(stage), ground, space, &mut poll)?;
                match stage {
                    Stage::First => Box::new(lama.first(ground, space, budget)?),
                    Stage::Weighted(_) => Box::new(lama.search(space, Preference::Helpful)),
                }
            }
        })
    }
}

/// The paper's search.
fn ordered(ground: &GroundTask, space: &Space, plans: usize, budget: &Budget) -> Result<AStar, Stop> {
    let heuristic = OrderedLandmarks::new(sequences(ground, &space.task, budget)?);
    Ok(AStar::new(space, Box::new(heuristic), false, plans))
}

/// How lazy searches of one stage rank states, and measure costs.
#[derive(Debug, Clone, Copy)]
struct Way {
    priority: Priority,
    measure: CostMeasure,
}

impl Way {
    fn of(stage: Stage) -> Self {
        let (priority, measure) = match stage {
            Stage::First => (Priority::Greedy, CostMeasure::Steps),
            Stage::Weighted(weight) => (Priority::Weighted(weight), CostMeasure::PlusOne),
        };
        Self { priority, measure }
    }

    fn lazy(self, space: &Space, heuristics: Vec<Box<dyn Heuristic>>, preference: Preference) -> Lazy {
        Lazy::new(space, self.priority, self.measure, heuristics, preference)
    }
}

/// What several FF heuristics share.
#[derive(Debug)]
struct RelaxedPlans {
    relaxation: Arc<Relaxation>,
    undominated: Arc<Undominated>,
    costs: Vec<u32>,
}

impl RelaxedPlans {
    fn new(way: Way, space: &Space, poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let relaxation = Arc::new(Relaxation::new(&space.task, Negatives::Propositions, poll)?);
        let costs = way.measure.of(&space.task);
        let undominated = Arc::new(Undominated::of(&relaxation, &costs, poll)?);
        Ok(Self { relaxation, undominated, costs })
    }

    fn ff(&self) -> Ff {
        Ff::new(Arc::clone(&self.relaxation), Arc::clone(&self.undominated), self.costs.clone())
    }
}

/// What LAMA's searches of one stage share.
#[derive(Debug)]
struct Lama {
    way: Way,
    relaxed: RelaxedPlans,
    landmarks: Arc<LandmarkGraph>,
}

impl Lama {
    fn new(way: Way, ground: &GroundTask, space: &Space, poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let relaxed = RelaxedPlans::new(way, space, poll)?;
        let landmarks = Arc::new(LandmarkGraph::new(ground, &space.task, &relaxed.relaxation, poll)?);
        Ok(Self { way, relaxed, landmarks })
    }

    fn landmark_count(&self, space: &Space) -> LandmarkCount {
        LandmarkCount::new(Arc::clone(&self.landmarks), &space.task, &self.relaxed.relaxation)
    }

    fn search(&self, space: &Space, preference: Preference) -> Lazy {
        let heuristics: Vec<Box<dyn Heuristic>> =
            vec![Box::new(self.relaxed.ff()), Box::new(self.landmark_count(space))];
        self.way.lazy(space, heuristics, preference)
    }

    /// The searches for a first plan.
    fn first(self, ground: &GroundTask, space: &Space, budget: &Budget) -> Result<Interleaved, Stop> {
        let mut lasting: Vec<(Box<dyn Search>, u64)> = Vec::new();
        if space.task.goal.len() <= MOST_GOALS_IN_ORDER {
            lasting.push((Box::new(ordered(ground, space, 1, budget)?), EAGER));
        }
        for preference in [Preference::Helpful, Preference::Preferred] {
            lasting.push((Box::new(self.search(space, preference)), 1));
        }
        Ok(Interleaved::new(lasting, Box::new(self)))
    }
}

impl Attempts for Lama {
    fn begin(&self, space: &Space, number: u64) -> Box<dyn Search> {
        let mut shuffler = Shuffler::new(number);
        let ff = Box::new(self.relaxed.ff().shuffled(&mut shuffler));
        let preference = if number.is_multiple_of(2) { Preference::Helpful } else { Preference::Preferred };
        // Every third without landmarks.
        let heuristics: Vec<Box<dyn Heuristic>> =
            if number.is_multiple_of(3) { vec![ff] } else { vec![ff, Box::new(self.landmark_count(space))] };
        Box::new(self.way.lazy(space, heuristics, preference).shuffled(shuffler))
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name that no strategy has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there are {}", Strategy::ALL.map(Strategy::name).join(", "))]
pub struct UnknownStrategy {
    /// The name.
    pub name: String,
}

impl FromStr for Strategy {
    type Err = UnknownStrategy;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|strategy| strategy.name() == text);
        known.ok_or_else(|| UnknownStrategy { name: text.to_owned() })
    }
}
