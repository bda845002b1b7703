//! A portfolio: several searches of one task in turn. What one of them gets lost in, another may find at once.
//!
//! A turn goes on while it brings progress, and turns grow with what was done so far, so that few of them are enough. They
//! are counted in expansions, so that the same plan is found on any machine.

use typelift_model::{Budget, GroundAtom, Stop};

use super::{Found, Search};
use crate::report::Report;

/// The expansions of the first turn.
const FIRST_TURN: u64 = 600;

/// An expansion of a search that estimates every successor counts as this many of a search that estimates only the states it
/// expands.
pub(crate) const EAGER: u64 = 8;

/// One of the searches.
#[derive(Debug)]
pub(crate) struct Member {
    pub(crate) search: Box<dyn Search>,
    /// How much one of its expansions counts.
    pub(crate) weight: u64,
}

/// Searches in turn.
#[derive(Debug)]
pub(crate) struct Portfolio {
    members: Vec<Member>,
    /// Whose turn it is, and how many expansions of it are left.
    turn: usize,
    left: u64,
    length: u64,
    /// The improvements of the search whose turn it is when the turn began.
    improvements: u64,
}

impl Portfolio {
    /// A portfolio of these, of which there must be one at least.
    pub(crate) fn new(members: Vec<Member>) -> Self {
        let left = members.first().map_or(0, |first| FIRST_TURN / first.weight);
        Self { members, turn: 0, left, length: FIRST_TURN, improvements: 0 }
    }

    /// Adds these, whose turn it is now.
    pub(crate) fn join(&mut self, members: Vec<Member>) {
        (self.turn, self.length) = (self.members.len(), FIRST_TURN);
        self.members.extend(members);
        self.begin_turn();
    }

    fn begin_turn(&mut self) {
        let next = &self.members[self.turn];
        self.improvements = next.search.improvements();
        self.left = self.length / next.weight;
    }

    fn end_turn(&mut self) {
        if self.members[self.turn].search.improvements() == self.improvements {
            self.turn += 1;
            if self.turn == self.members.len() {
                self.turn = 0;
                self.length += self.length / 4;
            }
        }
        self.begin_turn();
    }
}

impl Search for Portfolio {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let mut budget = budget.clone();
        loop {
            if budget.expansions == Some(0) {
                return Found::Stopped(Stop::Expansions);
            }
            let expansions = budget.expansions.map_or(self.left, |allowed| allowed.min(self.left));
            let search = &mut self.members[self.turn].search;
            let before = search.report().expansions;
            let found = search.next(cost_bound, &Budget { expansions: Some(expansions), ..budget.clone() });
            let spent = search.report().expansions - before;
            self.left = self.left.saturating_sub(spent);
            budget.expansions = budget.expansions.map(|allowed| allowed.saturating_sub(spent));
            match found {
                Found::Stopped(Stop::Expansions) if self.left == 0 => self.end_turn(),
                Found::Stopped(Stop::Expansions) => {}
                found => return found,
            }
        }
    }

    fn report(&self) -> Report {
        self.members.iter().map(|member| member.search.report()).sum()
    }

    /// The first member's, which does not depend on how many turns the others had.
    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        self.members.first().map(|first| first.search.missing()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::endless::{Endless, expanded};

    /// What each of two searches that find nothing has expanded after so many expansions of both.
    fn after(expansions: u64, improving: bool) -> [u64; 2] {
        let (one, first) = Endless::new(improving);
        let (other, second) = Endless::new(false);
        let member = |search, weight| Member { search: Box::new(search), weight };
        let mut portfolio = Portfolio::new(vec![member(one, EAGER), member(other, 1)]);
        let found = portfolio.next(None, &Budget::with_expansions(expansions));
        assert!(matches!(found, Found::Stopped(Stop::Expansions)));
        [expanded(&first), expanded(&second)]
    }

    #[test]
    fn turns_grow_by_a_quarter() {
        // 600 for each, of which the first, whose expansions count as eight, makes 75; then 750, of which it makes 93.
        assert_eq!(after(50, false), [50, 0]);
        assert_eq!(after(75 + 600, false), [75, 600]);
        assert_eq!(after(75 + 600 + 93 + 750, false), [75 + 93, 600 + 750]);
    }

    #[test]
    fn a_turn_that_brings_progress_goes_on() {
        assert_eq!(after(1_000, true), [1_000, 0]);
    }
}
