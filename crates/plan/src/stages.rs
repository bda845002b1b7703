//! The searches of a strategy, one after the other: for a first plan, and for cheaper ones.
//!
//! A* goes on to all of its plans. A lazy search closes each state after its first way there; so cheaper plans are looked
//! for by another search, which ranks by the costs so far too, with a smaller and smaller weight on the estimate (Richter,
//! Thayer and Ruml 2010).

use std::sync::Arc;

use typelift_model::{Budget, GroundAtom, Stop};

use crate::heuristic::{Blind, CostMeasure, LandmarkCount, LmCut, OrderedLandmarks};
use crate::lama::{LamaPortfolio, RelaxedPlans};
use crate::landmark::{LandmarkGraph, sequences};
use crate::ordered_first::OrderedFirst;
use crate::poll::Poll;
use crate::relaxation::{Negatives, Relaxation};
use crate::report::Report;
use crate::search::{AStar, Found, Lazy, Preference, Priority, Ranking, Search, Space};
use crate::strategy::Strategy;

/// Which of a strategy's searches: the first plan's, or one that looks for cheaper plans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    First,
    Weighted(u32),
}

/// The weights with which cheaper plans are looked for, in turn.
const WEIGHTS: [u32; 4] = [5, 3, 2, 1];

impl Stage {
    /// The stage after this one has found a plan; the last goes on.
    fn next(self) -> Self {
        match self {
            Self::First => Self::Weighted(WEIGHTS[0]),
            Self::Weighted(weight) => Self::Weighted(WEIGHTS.into_iter().find(|&next| next < weight).unwrap_or(weight)),
        }
    }

    /// How lazy searches rank states in this stage, and measure costs.
    fn ranking(self) -> Ranking {
        let (priority, measure) = match self {
            Self::First => (Priority::Greedy, CostMeasure::Steps),
            Self::Weighted(weight) => (Priority::Weighted(weight), CostMeasure::PlusOne),
        };
        Ranking { priority, measure }
    }
}

/// A strategy's search, and what came before it.
#[derive(Debug)]
pub(crate) struct Stages {
    space: Arc<Space>,
    strategy: Strategy,
    stage: Stage,
    search: Box<dyn Search>,
    has_found: bool,
    /// What finished searches have counted.
    past: Report,
}

impl Stages {
    /// The first stage of a strategy.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends the work on landmarks and relaxation.
    pub(crate) fn new(space: Arc<Space>, strategy: Strategy, budget: &Budget) -> Result<Self, Stop> {
        let search = begin(strategy, Stage::First, &space, budget)?;
        let past = Report::default();
        Ok(Self { space, strategy, stage: Stage::First, search, has_found: false, past })
    }

    /// What is searched.
    pub(crate) fn space(&self) -> &Space {
        &self.space
    }

    /// Whether this search finds all plans, however many and however cheap.
    fn is_one_for_all(&self) -> bool {
        matches!(self.strategy, Strategy::OrderedLandmarks | Strategy::AStarLmCut | Strategy::AStarBlind)
    }

    /// Turns to the search that is to find another plan.
    fn prepare(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Result<(), Stop> {
        if self.is_one_for_all() || !self.has_found {
            return Ok(());
        }
        match cost_bound {
            Some(_) if self.stage == Stage::First => self.turn_to(self.stage.next(), budget),
            _ => Ok(()),
        }
    }

    fn turn_to(&mut self, stage: Stage, budget: &Budget) -> Result<(), Stop> {
        if stage == self.stage {
            return Ok(());
        }
        let search = begin(self.strategy, stage, &self.space, budget)?;
        self.past += self.search.report();
        (self.stage, self.search) = (stage, search);
        Ok(())
    }
}

impl Search for Stages {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        if let Err(stop) = self.prepare(cost_bound, budget) {
            return Found::Stopped(stop);
        }
        let found = self.search.next(cost_bound, budget);
        if matches!(found, Found::Plan(_)) {
            self.has_found = true;
            if cost_bound.is_some() && !self.is_one_for_all() {
                // If there is no time to prepare the next stage, this one goes on.
                let _ = self.turn_to(self.stage.next(), budget);
            }
        }
        found
    }

    fn report(&self) -> Report {
        self.past + self.search.report()
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        self.search.missing()
    }
}

/// The search of a strategy for a stage.
fn begin(strategy: Strategy, stage: Stage, space: &Arc<Space>, budget: &Budget) -> Result<Box<dyn Search>, Stop> {
    let mut poll = Poll::new(budget);
    let (task, ranking) = (&space.task, stage.ranking());
    Ok(match strategy {
        Strategy::OrderedLandmarks => Box::new(in_order(space, budget)?),
        Strategy::OrderedFirst if stage == Stage::First => {
            Box::new(OrderedFirst::new(Arc::clone(space), ranking, in_order(space, budget)?))
        }
        Strategy::AStarLmCut => {
            let relaxation = Relaxation::new(task, Negatives::Propositions, &mut poll)?;
            let lm_cut = LmCut::new(task, Arc::new(relaxation));
            Box::new(AStar::new(Arc::clone(space), Box::new(lm_cut), true))
        }
        Strategy::AStarBlind => Box::new(AStar::new(Arc::clone(space), Box::new(Blind::new(task)), true)),
        Strategy::LazyFf => {
            let relaxed = RelaxedPlans::new(task, ranking.measure, &mut poll)?;
            Box::new(Lazy::new(Arc::clone(space), ranking, vec![Box::new(relaxed.ff())], Preference::Preferred))
        }
        Strategy::LazyLandmarks => {
            let relaxation = Relaxation::new(task, Negatives::Propositions, &mut poll)?;
            let graph = Arc::new(LandmarkGraph::new(&space.ground, task, &relaxation, &mut poll)?);
            let count = LandmarkCount::new(graph, task, &relaxation);
            Box::new(Lazy::new(Arc::clone(space), ranking, vec![Box::new(count)], Preference::None))
        }
        Strategy::OrderedFirst | Strategy::LamaPortfolio | Strategy::Bfws => {
            let lama = LamaPortfolio::new(Arc::clone(space), ranking, &mut poll)?;
            match stage {
                Stage::First if strategy == Strategy::Bfws => Box::new(lama.width_first()),
                Stage::First => {
                    let in_order = lama.takes_in_order().then(|| in_order(space, budget)).transpose()?;
                    Box::new(lama.in_turn(in_order))
                }
                Stage::Weighted(_) => Box::new(lama.search(Preference::Helpful)),
            }
        }
    })
}

/// The paper's search.
fn in_order(space: &Arc<Space>, budget: &Budget) -> Result<AStar, Stop> {
    let heuristic = OrderedLandmarks::new(sequences(&space.ground, &space.task, budget)?);
    Ok(AStar::new(Arc::clone(space), Box::new(heuristic), false))
}
