//! A search that never ends, for tests of searches that are made of others.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use typelift_model::{Budget, GroundAtom, Stop};

use super::{Found, Search};
use crate::report::Report;

/// How much a search has expanded.
pub(crate) type Expanded = Arc<AtomicU64>;

pub(crate) fn expanded(by: &Expanded) -> u64 {
    by.load(Ordering::Relaxed)
}

/// Spends what it is given, and finds nothing.
#[derive(Debug)]
pub(crate) struct Endless {
    expanded: Expanded,
    /// Whether it comes nearer to the goal with every expansion.
    is_improving: bool,
}

impl Endless {
    pub(crate) fn new(is_improving: bool) -> (Self, Expanded) {
        let expanded = Expanded::default();
        (Self { expanded: Arc::clone(&expanded), is_improving }, expanded)
    }
}

impl Search for Endless {
    fn next(&mut self, _: Option<u64>, budget: &Budget) -> Found {
        let allowed = budget.expansions.expect("tests limit expansions");
        self.expanded.fetch_add(allowed, Ordering::Relaxed);
        Found::Stopped(Stop::Expansions)
    }

    fn report(&self) -> Report {
        Report { expansions: expanded(&self.expanded), ..Report::default() }
    }

    fn improvements(&self) -> u64 {
        if self.is_improving { expanded(&self.expanded) } else { 0 }
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        Vec::new()
    }
}
