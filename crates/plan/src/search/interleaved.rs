//! Several searches of one task in turn: what one of them gets lost in, another may find at once.
//!
//! Greedy searches have heavy tails: the same search with ties broken otherwise may take a hundredth or a hundred times
//! the expansions. So the lasting searches take turns with one that begins anew again and again, each time with ties broken
//! in another way, and each time for longer. A turn goes on while it brings progress, and turns grow with what was done so
//! far, so that few of them are enough.
//!
//! Turns are counted in expansions, not in time, so that the same plan is found on any machine.

use typelift_model::{Budget, Stop};

use super::{Found, Report, Search, Space};

/// The expansions of the first turn.
const FIRST_TURN: u64 = 600;

/// Of a search that estimates every successor, an expansion counts as so many of one that estimates what it expands.
pub(crate) const EAGER: u64 = 8;

/// The expansions after which a search that begins anew does so for the first time.
const FIRST_ATTEMPT: u64 = 500;

/// Makes the search of an attempt, by its number.
pub(crate) trait Attempts: std::fmt::Debug + Send {
    /// A search that breaks ties in a way of its own.
    fn begin(&self, space: &Space, number: u64) -> Box<dyn Search>;
}

/// One that begins anew.
#[derive(Debug)]
struct Restarting {
    attempts: Box<dyn Attempts>,
    number: u64,
    current: Option<Box<dyn Search>>,
    /// The expansions left to this attempt.
    left: u64,
    past: Report,
}

/// Searches in turn.
#[derive(Debug)]
pub(crate) struct Interleaved {
    lasting: Vec<Box<dyn Search>>,
    /// What an expansion of each counts.
    weights: Vec<u64>,
    restarting: Restarting,
    /// Whose turn it is, and how many expansions of it are left.
    turn: usize,
    left: u64,
    length: u64,
    /// The improvements of the search whose turn it is when the turn began.
    improvements: u64,
}

impl Interleaved {
    /// Lasting searches, each with what an expansion of it counts, and the attempts of one that begins anew.
    pub(crate) fn new(lasting: Vec<(Box<dyn Search>, u64)>, attempts: Box<dyn Attempts>) -> Self {
        let (lasting, weights): (Vec<_>, Vec<_>) = lasting.into_iter().unzip();
        let left = FIRST_TURN / weights.first().unwrap_or(&1);
        let restarting = Restarting { attempts, number: 0, current: None, left: 0, past: Report::default() };
        Self { lasting, weights, restarting, turn: 0, left, length: FIRST_TURN, improvements: 0 }
    }

    fn end_turn(&mut self) {
        let improvements = |turn: usize| self.lasting.get(turn).map_or(0, |search| search.improvements());
        if improvements(self.turn) == self.improvements {
            self.turn += 1;
            if self.turn > self.lasting.len() {
                self.turn = 0;
                self.length += self.length / 4;
            }
        }
        self.improvements = improvements(self.turn);
        self.left = self.length / self.weights.get(self.turn).unwrap_or(&1);
    }
}

impl Restarting {
    fn next(&mut self, space: &Space, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let search = match &mut self.current {
            Some(search) if self.left > 0 => search,
            current => {
                if let Some(past) = current.take() {
                    self.past = added(self.past, past.report());
                }
                self.number += 1;
                self.left = FIRST_ATTEMPT * luby(self.number);
                current.insert(self.attempts.begin(space, self.number))
            }
        };
        let before = search.report().expansions;
        let expansions = budget.expansions.map_or(self.left, |allowed| allowed.min(self.left));
        let found = search.next(space, cost_bound, &Budget { expansions: Some(expansions), ..budget.clone() });
        self.left = self.left.saturating_sub(search.report().expansions - before);
        found
    }

    fn report(&self) -> Report {
        self.current.as_ref().map_or(self.past, |search| added(self.past, search.report()))
    }
}

impl Search for Interleaved {
    fn next(&mut self, space: &Space, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let begun = self.report().expansions;
        loop {
            let spent = self.report().expansions;
            let allowed = budget.expansions.map(|allowed| (begun + allowed).saturating_sub(spent));
            if allowed == Some(0) {
                return Found::Stopped(Stop::Expansions);
            }
            let expansions = allowed.map_or(self.left, |allowed| allowed.min(self.left));
            let turn = Budget { expansions: Some(expansions), ..budget.clone() };
            let (found, own) = match self.lasting.get_mut(self.turn) {
                Some(search) => {
                    let before = search.report().expansions;
                    (search.next(space, cost_bound, &turn), search.report().expansions - before)
                }
                None => {
                    let before = self.restarting.report().expansions;
                    let found = self.restarting.next(space, cost_bound, &turn);
                    (found, self.restarting.report().expansions - before)
                }
            };
            self.left = self.left.saturating_sub(own);
            match found {
                Found::Stopped(Stop::Expansions) => {
                    if self.left == 0 {
                        self.end_turn();
                    }
                }
                found => return found,
            }
        }
    }

    fn report(&self) -> Report {
        self.lasting.iter().map(|search| search.report()).fold(self.restarting.report(), added)
    }

    fn closest(&self) -> Option<Vec<u32>> {
        self.lasting.first()?.closest()
    }
}

fn added(a: Report, b: Report) -> Report {
    Report {
        expansions: a.expansions + b.expansions,
        evaluations: a.evaluations + b.evaluations,
        reopened: a.reopened + b.reopened,
        ..a
    }
}

/// The sequence 1, 1, 2, 1, 1, 2, 4, … of Luby, Sinclair and Zuckerman (1993), by number from 1 on: no other sequence of
/// lengths is much better, whatever the search.
fn luby(number: u64) -> u64 {
    let bits = 64 - number.leading_zeros();
    if number == (1 << bits) - 1 { 1 << (bits - 1) } else { luby(number - (1 << (bits - 1)) + 1) }
}

#[cfg(test)]
mod tests {
    #[test]
    fn lengths_of_attempts() {
        let lengths: Vec<u64> = (1..=15).map(super::luby).collect();
        assert_eq!(lengths, [1, 1, 2, 1, 1, 2, 4, 1, 1, 2, 1, 1, 2, 4, 8]);
    }
}
