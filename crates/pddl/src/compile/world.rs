//! What every block of a domain or problem is compiled against.

use std::collections::BTreeMap;

use typelift_model::{ArgumentTypes, Hierarchy, Symbol, TypeId};

use super::limits::Limits;

/// What is known outside of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct World<'w> {
    /// The types.
    pub(super) hierarchy: &'w Hierarchy,
    /// The objects that may be mentioned.
    pub(super) objects: &'w BTreeMap<Symbol, TypeId>,
    /// The predicates with the types of their arguments.
    pub(super) predicates: &'w ArgumentTypes,
    /// How large the model may become.
    pub(super) limits: Limits,
}
