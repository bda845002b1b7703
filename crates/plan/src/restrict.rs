//! What may not be used although the model would allow it.

use std::collections::BTreeSet;

use typelift_model::{GroundAction, GroundAtom, GroundCall, Symbol};

/// An object that may not take part in actions.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Exclusion {
    /// The object.
    pub object: Symbol,
    /// In which actions: those of this call name, or all.
    pub call: Option<Symbol>,
}

/// A ground action that may not be used: this call, expected to have this effect. Another action with the same call
/// and another effect may.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Ban {
    /// The action schema. Where its effects have conditions they depend on the state, and schema and call decide.
    pub action: Symbol,
    /// The call.
    pub call: GroundCall,
    /// What it was expected to add, sorted.
    pub adds: Vec<GroundAtom>,
    /// What it was expected to delete and not to add, sorted.
    pub deletes: Vec<GroundAtom>,
}

impl Ban {
    /// The ban of a ground action.
    pub fn of(action: &GroundAction) -> Self {
        Self {
            action: action.schema.clone(),
            call: action.call.clone(),
            adds: action.adds.clone(),
            deletes: action.deletes.clone(),
        }
    }
}

/// Objects and ground actions that grounding leaves out.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Restrictions {
    /// Excluded objects.
    pub excluded: BTreeSet<Exclusion>,
    /// Banned ground actions.
    pub banned: BTreeSet<Ban>,
}

impl Restrictions {
    /// Whether the object may take part in actions of this call name.
    pub fn allows(&self, object: &Symbol, call: &Symbol) -> bool {
        self.excluded.is_empty()
            || !self.excluded.iter().any(|e| e.object == *object && e.call.as_ref().is_none_or(|name| name == call))
    }

    /// Whether the object is excluded from actions of some call name, or from all.
    pub fn distrusts(&self, object: &Symbol) -> bool {
        self.excluded.iter().any(|exclusion| exclusion.object == *object)
    }
}
