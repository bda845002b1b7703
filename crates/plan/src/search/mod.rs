//! Searches. Everything that can be asked for one plan after another is a [`Search`]: a search with one open list, several
//! searches that take turns, searches for cheaper and cheaper plans, and searches with more and more objects.

mod astar;
#[cfg(test)]
mod endless;
mod lazy;
mod novelty;
mod open_list;
mod portfolio;
mod restarts;
mod space;
mod width;

use std::fmt::Debug;

pub(crate) use astar::AStar;
pub(crate) use lazy::{Lazy, Preference, Priority, Ranking};
pub(crate) use portfolio::{EAGER, Member, Portfolio};
pub(crate) use restarts::{Restartable, Restarts};
pub(crate) use space::Space;
pub(crate) use width::WidthFirst;

use typelift_model::{Budget, GroundAtom, Plan, Stop};

use crate::report::Report;

/// How a search ended.
#[derive(Debug)]
pub(crate) enum Found {
    /// A plan, perhaps one that was found before: the caller tells them apart.
    Plan(Plan),
    /// Everything below the cost bound was searched.
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

    /// Of the expanded states, take the one in which most goal atoms held: the goal atoms that did not, and whether each must
    /// hold.
    fn missing(&self) -> Vec<(GroundAtom, bool)>;
}
