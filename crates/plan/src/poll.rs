//! Asking a budget whether to stop: often enough in time, seldom enough to cost nothing.

use typelift_model::{Budget, Stop};

/// How much work is done between two questions. A unit is a look at one fact, object or action.
const INTERVAL: usize = 1 << 12;

/// Counts work, and asks now and then.
pub(crate) struct Poll<'a> {
    budget: &'a Budget,
    work: usize,
}

impl<'a> Poll<'a> {
    /// Asks at the first occasion.
    pub(crate) fn new(budget: &'a Budget) -> Self {
        Self { budget, work: INTERVAL }
    }

    /// Counts so much work; a reason to stop, if it was time to ask and there is one.
    pub(crate) fn stopped(&mut self, work: usize) -> Option<Stop> {
        self.work += work;
        if self.work < INTERVAL {
            return None;
        }
        self.work = 0;
        self.budget.stopped()
    }

    /// The same where a stop is an error.
    pub(crate) fn check(&mut self, work: usize) -> Result<(), Stop> {
        self.stopped(work).map_or(Ok(()), Err)
    }
}
