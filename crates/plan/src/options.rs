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
}

impl Default for Options {
    fn default() -> Self {
        Self { strategy: Strategy::default(), tie_order: TieOrder::SpecificFirst }
    }
}
