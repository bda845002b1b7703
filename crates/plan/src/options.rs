//! The choices a caller has in planning.

use crate::ground::TieOrder;
use crate::strategy::Strategy;

/// How plans are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// How states are searched.
    pub strategy: Strategy,
    /// In which order successors are tried.
    pub tie_order: TieOrder,
    /// How many plans will be asked for: so many different ways to each node are kept. 1 is the plain search.
    pub plans: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { strategy: Strategy::default(), tie_order: TieOrder::SpecificFirst, plans: 1 }
    }
}
