//! Planning tasks.

use crate::{GroundAtom, State};

/// A planning task (paper: 𝒯): where one is, and what must hold in the end.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Task {
    /// The initial state (𝒯_init).
    pub init: State,
    /// The atoms that must all hold.
    pub goal: Vec<GroundAtom>,
}
