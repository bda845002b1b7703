//! A search that is restarted again and again, each time with ties broken in another way, and from time to time for longer.
//!
//! Greedy searches have heavy tails: the same search with ties broken otherwise may take a hundredth or a hundred times the
//! expansions (Gomes, Selman, Crato and Kautz 2000).

use std::fmt::Debug;

use typelift_model::{Budget, GroundAtom, Stop};

use super::{Found, Search};
use crate::report::Report;

/// The expansions after which the first attempt ends.
const FIRST_ATTEMPT: u64 = 500;

/// Makes the searches.
pub(crate) trait Restartable: Debug + Send {
    /// The search of an attempt, by its number: it breaks ties in a way of its own.
    fn attempt(&self, number: u64) -> Box<dyn Search>;
}

/// Attempts, one after the other.
#[derive(Debug)]
pub(crate) struct Restarts {
    restartable: Box<dyn Restartable>,
    number: u64,
    current: Option<Box<dyn Search>>,
    /// The expansions left to this attempt.
    left: u64,
    /// What earlier attempts counted.
    past: Report,
}

impl Restarts {
    pub(crate) fn new(restartable: Box<dyn Restartable>) -> Self {
        Self { restartable, number: 0, current: None, left: 0, past: Report::default() }
    }

    /// The attempt that goes on, or the next one, with the expansions left to it.
    fn attempt(&mut self) -> (&mut dyn Search, &mut u64) {
        let search = match self.current.take() {
            Some(search) if self.left > 0 => search,
            ended => {
                self.past += ended.map(|search| search.report()).unwrap_or_default();
                self.number += 1;
                self.left = FIRST_ATTEMPT * luby(self.number);
                self.restartable.attempt(self.number)
            }
        };
        (self.current.insert(search).as_mut(), &mut self.left)
    }
}

impl Search for Restarts {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let mut budget = budget.clone();
        loop {
            if budget.expansions == Some(0) {
                return Found::Stopped(Stop::Expansions);
            }
            let (search, left) = self.attempt();
            let expansions = budget.expansions.map_or(*left, |allowed| allowed.min(*left));
            let before = search.report().expansions;
            let found = search.next(cost_bound, &Budget { expansions: Some(expansions), ..budget.clone() });
            let spent = search.report().expansions - before;
            *left = left.saturating_sub(spent);
            budget.expansions = budget.expansions.map(|allowed| allowed.saturating_sub(spent));
            if !matches!(found, Found::Stopped(Stop::Expansions)) {
                return found;
            }
        }
    }

    fn report(&self) -> Report {
        self.past + self.current.as_ref().map(|search| search.report()).unwrap_or_default()
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        self.current.as_ref().map(|search| search.missing()).unwrap_or_default()
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
    use std::sync::{Arc, Mutex};

    use super::*;
    use crate::search::endless::{Endless, Expanded, expanded};

    #[test]
    fn lengths_of_attempts() {
        let lengths: Vec<u64> = (1..=15).map(luby).collect();
        assert_eq!(lengths, [1, 1, 2, 1, 1, 2, 4, 1, 1, 2, 1, 1, 2, 4, 8]);
    }

    /// Attempts that find nothing.
    #[derive(Debug, Default)]
    struct Hopeless(Arc<Mutex<Vec<Expanded>>>);

    impl Restartable for Hopeless {
        fn attempt(&self, _: u64) -> Box<dyn Search> {
            let (search, expanded) = Endless::new(false);
            self.0.lock().expect("one thread").push(expanded);
            Box::new(search)
        }
    }

    #[test]
    fn every_attempt_has_its_length() {
        let attempts = Arc::default();
        let mut restarts = Restarts::new(Box::new(Hopeless(Arc::clone(&attempts))));
        // However often it is stopped.
        for _ in 0..9 {
            assert!(matches!(restarts.next(None, &Budget::with_expansions(300)), Found::Stopped(Stop::Expansions)));
        }
        let lengths: Vec<u64> = attempts.lock().expect("one thread").iter().map(expanded).collect();
        assert_eq!(lengths, [500, 500, 1_000, 500, 200]);
        assert_eq!(restarts.report().expansions, 2_700);
    }
}
