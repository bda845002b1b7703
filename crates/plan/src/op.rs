//! Ground actions.

use typelift_model::Symbol;

use crate::fact::FactId;

/// A ground action of one [`GroundTask`](crate::GroundTask).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct OpId(u32);

impl OpId {
    pub(crate) fn new(index: usize) -> Self {
        Self(index as u32)
    }

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// An effect that depends on the state.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ConditionalEffect {
    /// Facts that must hold.
    pub positive: Vec<FactId>,
    /// Facts that must not hold.
    pub negative: Vec<FactId>,
    /// The fact concerned.
    pub fact: FactId,
    /// Whether it is added.
    pub adds: bool,
}

/// A ground action. All lists are sorted.
#[derive(Debug, Clone)]
pub struct Op {
    pub(crate) schema: usize,
    pub(crate) objects: Vec<Symbol>,
    /// Facts that must hold.
    pub preconditions: Vec<FactId>,
    /// Facts that must not hold.
    pub negative: Vec<FactId>,
    /// Facts added whatever the state.
    pub adds: Vec<FactId>,
    /// Facts deleted whatever the state, and not added.
    pub deletes: Vec<FactId>,
    /// Effects with conditions.
    pub conditional: Vec<ConditionalEffect>,
    /// The cost.
    pub cost: u32,
    /// Whether an object that is no actor is mentioned in the goal.
    pub touches_goal: bool,
}
