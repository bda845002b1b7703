//! What may not be used although the model would allow it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::{ActionSchema, GroundAction, GroundAtom, GroundCall, Hierarchy, Symbol, Term, TypeId};

/// An object that may not take part in actions.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Exclusion {
    /// The object.
    pub object: Symbol,
    /// In which actions: those of this call name, or all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub call: Option<Symbol>,
}

impl fmt::Display for Exclusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.call {
            None => write!(f, "{}", self.object),
            Some(call) => write!(f, "{} from {call}", self.object),
        }
    }
}

/// Types of which no object may be an argument of a call: one type at one place, or several that may not meet.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TypeExclusion {
    /// In actions of this call name,
    pub call: Symbol,
    /// of those the ones that add atoms of all these predicates; of all if there are none.
    pub adds: BTreeSet<Symbol>,
    /// The types' names, by their places among the call's arguments, from 0.
    #[serde(deserialize_with = "typelift_model::numbered_keys")]
    pub types: BTreeMap<usize, Symbol>,
}

impl TypeExclusion {
    /// Whether it is about this action at all.
    pub fn concerns(&self, schema: &ActionSchema) -> bool {
        let adds = |predicate: &Symbol| schema.adds().any(|atom| atom.predicate == *predicate);
        self.call == schema.call.name && self.adds.iter().all(adds)
    }

    /// The parameter of the action at each place, with the type that may not stand there; `None` if it has no such
    /// place or a constant there, or the hierarchy no such type.
    pub(crate) fn parameters(&self, schema: &ActionSchema, hierarchy: &Hierarchy) -> Option<Vec<(usize, TypeId)>> {
        let place = |(place, name): (&usize, &Symbol)| match schema.call.args.get(*place)? {
            Term::Param(index) => Some((*index as usize, hierarchy.id(name.as_str())?)),
            Term::Const(_) => None,
        };
        self.types.iter().map(place).collect()
    }
}

impl fmt::Display for TypeExclusion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let types: Vec<String> = self.types.values().map(|name| format!("any {name}")).collect();
        write!(f, "{} from {}", types.join(" with "), self.call)?;
        let adds: Vec<&str> = self.adds.iter().map(Symbol::as_str).collect();
        if adds.is_empty() { Ok(()) } else { write!(f, " for {}", adds.join(" and ")) }
    }
}

/// A ground action that may not be used: this call, expected to have this effect. Another action with the same call
/// and another effect may.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

/// Objects, types at places, ground actions and calls that grounding leaves out.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Restrictions {
    /// Excluded objects.
    pub excluded: BTreeSet<Exclusion>,
    /// Excluded types, and combinations of types.
    pub types: BTreeSet<TypeExclusion>,
    /// Banned ground actions.
    pub banned: BTreeSet<Ban>,
    /// Calls that are not made, whatever they are expected to do.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub calls: BTreeSet<GroundCall>,
}

impl Restrictions {
    /// Whether the object may take part in actions of this call name.
    pub fn allows(&self, object: &Symbol, call: &Symbol) -> bool {
        self.excluded.is_empty()
            || !self.excluded.iter().any(|e| e.object == *object && e.call.as_ref().is_none_or(|name| name == call))
    }

    /// Whether the types of these objects may stand in place of the action's parameters. What is not decided yet
    /// (`None`) excludes nothing.
    pub fn allows_types(&self, schema: &ActionSchema, types: &[Option<TypeId>], hierarchy: &Hierarchy) -> bool {
        let is_excluded = |exclusion: &&TypeExclusion| {
            let matches =
                |&(index, excluded): &(usize, TypeId)| types[index].is_some_and(|ty| hierarchy.is_a(ty, excluded));
            exclusion.parameters(schema, hierarchy).is_some_and(|parameters| parameters.iter().all(matches))
        };
        !self.types.iter().filter(|exclusion| exclusion.concerns(schema)).any(|exclusion| is_excluded(&exclusion))
    }

    /// Whether something speaks against an object of this type beside objects of those: it is excluded from actions of
    /// some call name or from all, or so is its type, alone or together with one of those.
    pub fn distrusts(&self, object: &Symbol, ty: TypeId, beside: &[TypeId], hierarchy: &Hierarchy) -> bool {
        let is = |ty: TypeId, name: &Symbol| {
            hierarchy.id(name.as_str()).is_some_and(|excluded| hierarchy.is_a(ty, excluded))
        };
        let meets = |exclusion: &TypeExclusion| {
            exclusion.types.iter().any(|(place, name)| {
                let mut others = exclusion.types.iter().filter(|(other, _)| *other != place);
                is(ty, name) && others.all(|(_, other)| beside.iter().any(|&ty| is(ty, other)))
            })
        };
        self.excluded.iter().any(|exclusion| exclusion.object == *object) || self.types.iter().any(meets)
    }
}
