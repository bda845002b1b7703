//! Searches. Whatever can be asked for one plan after another is a [`Search`]: one open list, several in turn, one after the
//! other for cheaper and cheaper plans, with few objects and then with more.

mod astar;
#[cfg(test)]
mod endless;
mod lazy;
mod open_list;
mod portfolio;
mod restarts;
mod space;

use std::fmt::Debug;

pub(crate) use astar::AStar;
pub(crate) use lazy::{Lazy, Preference, Priority, Ranking};
pub(crate) use portfolio::{EAGER, Member, Portfolio};
pub(crate) use restarts::{Restartable, Restarts};
pub(crate) use space::Space;

use typelift_model::{Budget, GroundAtom, Plan, Stop};

use crate::report::Report;

/// What a search came to.
#[derive(Debug)]
pub(crate) enum Found {
    /// A plan, perhaps one that was found before: who asks tells them apart.
    Plan(Plan),
    /// Everything that is not too dear was searched.
    Nothing,
    /// The budget ended it.
    Stopped(Stop),
}

/// A search that can be continued.
pub(crate) trait Search: Debug + Send {
    /// Searches on for a plan cheaper than the bound, if there is one; everything dearer is pruned from now on. The budget's
    /// expansions are for this call.
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found;

    /// What was counted since it began.
    fn report(&self) -> Report;

    /// How often it came nearer to the goal than ever before, by an estimate.
    fn improvements(&self) -> u64 {
        0
    }

    /// What of the goal was missing in the state expanded so far in which most of it held, and whether each must hold.
    fn missing(&self) -> Vec<(GroundAtom, bool)>;
}
