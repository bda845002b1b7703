//! The paper's search, and, where it does not find a plan soon, the portfolio around LAMA's in turn with it.
//!
//! On what was demonstrated the paper's search finds short plans in a few expansions. But it follows one order of
//! landmarks, and where several goals want the same place that order misleads it: the expansions grow tenfold with each.
//! The relaxation and the landmarks of the portfolio are made when its turn comes, so that nothing is paid for before.

use std::sync::Arc;

use typelift_model::{Budget, GroundAtom, Stop};

use crate::lama::LamaPortfolio;
use crate::poll::Poll;
use crate::report::Report;
use crate::search::{AStar, EAGER, Found, Member, Portfolio, Ranking, Search, Space};

/// The expansions that the paper's search has to itself.
const ALONE: u64 = 200;

/// The paper's search, alone and then in turn with others.
#[derive(Debug)]
pub(crate) struct OrderedFirst {
    space: Arc<Space>,
    ranking: Ranking,
    portfolio: Portfolio,
    /// The expansions that the paper's search still has to itself; `None` once the others are there.
    alone: Option<u64>,
}

impl OrderedFirst {
    /// This search of the paper's, and the portfolio of its space; `ranking` is for the portfolio's lazy searches.
    pub(crate) fn new(space: Arc<Space>, ranking: Ranking, in_order: AStar) -> Self {
        let portfolio = Portfolio::new(vec![Member { search: Box::new(in_order), weight: EAGER }]);
        Self { space, ranking, portfolio, alone: Some(ALONE) }
    }

    /// Lets the others take part.
    fn join(&mut self, budget: &Budget) -> Result<(), Stop> {
        let lama = LamaPortfolio::new(Arc::clone(&self.space), self.ranking, &mut Poll::new(budget))?;
        self.portfolio.join(lama.lazy_members());
        self.alone = None;
        Ok(())
    }
}

impl Search for OrderedFirst {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let Some(left) = self.alone else { return self.portfolio.next(cost_bound, budget) };
        let before = self.report().expansions;
        let allowed = budget.expansions.map_or(left, |allowed| allowed.min(left));
        let found = self.portfolio.next(cost_bound, &Budget { expansions: Some(allowed), ..budget.clone() });
        let spent = self.report().expansions - before;
        self.alone = Some(left.saturating_sub(spent));
        let rest = budget.expansions.map(|allowed| allowed.saturating_sub(spent));
        match found {
            Found::Stopped(Stop::Expansions) if rest != Some(0) => match self.join(budget) {
                Ok(()) => self.portfolio.next(cost_bound, &Budget { expansions: rest, ..budget.clone() }),
                Err(stop) => Found::Stopped(stop),
            },
            found => found,
        }
    }

    fn report(&self) -> Report {
        self.portfolio.report()
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        self.portfolio.missing()
    }
}
