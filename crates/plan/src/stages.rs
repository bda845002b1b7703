//! The searches of a strategy, one after another: for the first plan, for cheaper plans, for different plans.
//!
//! A* goes on to all of its plans. A lazy search closes each state after its first way there; so cheaper plans are looked
//! for by another search, which ranks by the costs so far too, with a smaller and smaller weight on the estimate (Richter,
//! Thayer and Ruml 2010), and different ones by the paper's, which keeps several ways to each state.

use std::sync::Arc;

use typelift_model::{Budget, GroundAtom, Stop};

use crate::heuristic::{Blind, CostMeasure, LandmarkCount, LmCut, OrderedLandmarks};
use crate::lama::{LamaPortfolio, RelaxedPlans};
use crate::landmark::{LandmarkGraph, sequences};
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
    /// How many ways to each state a search keeps, if it can keep several.
    plans: usize,
    strategy: Strategy,
    stage: Stage,
    search: Box<dyn Search>,
    has_found: bool,
    /// What finished searches have counted.
    past: Report,
}

impl Stages {
    /// The first stage of a strategy; `plans` is how many ways to each state it keeps, if it can keep several.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends the work on landmarks and relaxation.
    pub(crate) fn new(space: Arc<Space>, strategy: Strategy, plans: usize, budget: &Budget) -> Result<Self, Stop> {
        let search = begin(strategy, Stage::First, &space, plans, budget)?;
        let past = Report::default();
        Ok(Self { space, plans, strategy, stage: Stage::First, search, has_found: false, past })
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
            None => self.turn_to(Strategy::OrderedLandmarks, Stage::First, budget),
            Some(_) if self.stage == Stage::First => self.turn_to(self.strategy, self.stage.next(), budget),
            Some(_) => Ok(()),
        }
    }

    fn turn_to(&mut self, strategy: Strategy, stage: Stage, budget: &Budget) -> Result<(), Stop> {
        if (strategy, stage) == (self.strategy, self.stage) {
            return Ok(());
        }
        let search = begin(strategy, stage, &self.space, self.plans, budget)?;
        self.past += self.search.report();
        (self.strategy, self.stage, self.search) = (strategy, stage, search);
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
                let _ = self.turn_to(self.strategy, self.stage.next(), budget);
            }
        }
        found
    }

    fn report(&self) -> Report {
        self.past + self.search.report()
    }

    fn improvements(&self) -> u64 {
        self.search.improvements()
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        self.search.missing()
    }
}

/// The search of a strategy for a stage.
fn begin(
    strategy: Strategy,
    stage: Stage,
    space: &Arc<Space>,
    plans: usize,
    budget: &Budget,
) -> Result<Box<dyn Search>, Stop> {
    let mut poll = Poll::new(budget);
    let (task, ranking) = (&space.task, stage.ranking());
    Ok(match strategy {
        Strategy::OrderedLandmarks => Box::new(in_order(space, plans, budget)?),
        Strategy::AStarLmCut => {
            let relaxation = Relaxation::new(task, Negatives::Propositions, &mut poll)?;
            let lm_cut = LmCut::new(task, Arc::new(relaxation));
            Box::new(AStar::new(Arc::clone(space), Box::new(lm_cut), true, plans))
        }
        Strategy::AStarBlind => Box::new(AStar::new(Arc::clone(space), Box::new(Blind::new(task)), true, plans)),
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
        Strategy::LamaPortfolio => {
            let lama = LamaPortfolio::new(Arc::clone(space), ranking, &mut poll)?;
            match stage {
                Stage::First => {
                    let in_order = lama.takes_in_order().then(|| in_order(space, 1, budget)).transpose()?;
                    Box::new(lama.in_turn(in_order))
                }
                Stage::Weighted(_) => Box::new(lama.search(Preference::Helpful)),
            }
        }
    })
}

/// The paper's search.
fn in_order(space: &Arc<Space>, plans: usize, budget: &Budget) -> Result<AStar, Stop> {
    let heuristic = OrderedLandmarks::new(sequences(&space.ground, &space.task, budget)?);
    Ok(AStar::new(Arc::clone(space), Box::new(heuristic), false, plans))
}
