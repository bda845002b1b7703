//! The portfolio around LAMA's search (Richter and Westphal, *The LAMA planner*, JAIR 39, 2010).

use std::sync::Arc;

use typelift_model::Stop;

use crate::fdr::Fdr;
use crate::heuristic::{CostMeasure, Ff, Heuristic, LandmarkCount, Undominated};
use crate::landmark::LandmarkGraph;
use crate::poll::Poll;
use crate::relaxation::{Negatives, Relaxation};
use crate::search::{
    AStar, EAGER, Lazy, Member, Portfolio, Preference, Ranking, Restartable, Restarts, Search, Space, WidthFirst,
};
use crate::shuffle::Shuffler;

/// With more goals than this ordered landmarks are left out.
const MOST_GOALS_IN_ORDER: usize = 50;

/// What several FF heuristics share.
#[derive(Debug)]
pub(crate) struct RelaxedPlans {
    relaxation: Arc<Relaxation>,
    undominated: Arc<Undominated>,
    costs: Vec<u32>,
}

impl RelaxedPlans {
    pub(crate) fn new(task: &Fdr, measure: CostMeasure, poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let relaxation = Arc::new(Relaxation::new(task, Negatives::Propositions, poll)?);
        let costs = measure.of(task);
        let undominated = Arc::new(Undominated::of(&relaxation, &costs, poll)?);
        Ok(Self { relaxation, undominated, costs })
    }

    pub(crate) fn ff(&self) -> Ff {
        Ff::new(Arc::clone(&self.relaxation), Arc::clone(&self.undominated), self.costs.clone())
    }
}

/// What the portfolio's searches of one stage share.
#[derive(Debug)]
pub(crate) struct LamaPortfolio {
    space: Arc<Space>,
    ranking: Ranking,
    relaxed: RelaxedPlans,
    landmarks: Arc<LandmarkGraph>,
}

impl LamaPortfolio {
    pub(crate) fn new(space: Arc<Space>, ranking: Ranking, poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let relaxed = RelaxedPlans::new(&space.task, ranking.measure, poll)?;
        let landmarks = Arc::new(LandmarkGraph::new(&space.ground, &space.task, &relaxed.relaxation, poll)?);
        Ok(Self { space, ranking, relaxed, landmarks })
    }

    fn landmark_count(&self) -> LandmarkCount {
        LandmarkCount::new(Arc::clone(&self.landmarks), &self.space.task, &self.relaxed.relaxation)
    }

    /// LAMA's search.
    pub(crate) fn search(&self, preference: Preference) -> Lazy {
        let heuristics: Vec<Box<dyn Heuristic>> = vec![Box::new(self.relaxed.ff()), Box::new(self.landmark_count())];
        Lazy::new(Arc::clone(&self.space), self.ranking, heuristics, preference)
    }

    /// Best-first width search.
    pub(crate) fn width_first(&self) -> WidthFirst {
        WidthFirst::new(Arc::clone(&self.space), self.relaxed.ff(), self.landmark_count())
    }

    /// Whether the search with ordered landmarks has a part in it.
    pub(crate) fn takes_in_order(&self) -> bool {
        self.space.task.goal.len() <= MOST_GOALS_IN_ORDER
    }

    /// For a first plan: the search with ordered landmarks, if it has a part, and the lazy ones.
    pub(crate) fn in_turn(self, in_order: Option<AStar>) -> Portfolio {
        let in_order = in_order.map(|search| Member { search: Box::new(search), weight: EAGER });
        Portfolio::new(in_order.into_iter().chain(self.lazy_members()).collect())
    }

    /// LAMA's search with two kinds of preferred actions, a restarting LAMA, and best-first width search.
    pub(crate) fn lazy_members(self) -> Vec<Member> {
        let (helpful, preferred) = (self.search(Preference::Helpful), self.search(Preference::Preferred));
        let width = self.width_first();
        let restarts = Restarts::new(Box::new(self));
        let searches: [Box<dyn Search>; 4] =
            [Box::new(helpful), Box::new(preferred), Box::new(restarts), Box::new(width)];
        searches.into_iter().map(|search| Member { search, weight: 1 }).collect()
    }
}

impl Restartable for LamaPortfolio {
    fn attempt(&self, number: u64) -> Box<dyn Search> {
        let mut shuffler = Shuffler::new(number);
        let ff = Box::new(self.relaxed.ff().shuffled(&mut shuffler));
        let preference = if number.is_multiple_of(2) { Preference::Helpful } else { Preference::Preferred };
        // Every third without landmarks.
        let heuristics: Vec<Box<dyn Heuristic>> =
            if number.is_multiple_of(3) { vec![ff] } else { vec![ff, Box::new(self.landmark_count())] };
        Box::new(Lazy::new(Arc::clone(&self.space), self.ranking, heuristics, preference).shuffled(shuffler))
    }
}
