//! Relations that are now a list, and now an id or null.

use std::collections::BTreeMap;
use std::fmt;

use typelift_model::Symbol;

use crate::Relation;

/// A relation that is now a list, and now an id or null: of an empty list no atom says that it is empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MixedRelation {
    /// The relation.
    pub relation: Symbol,
    /// An entity of which it is a list.
    pub list: Symbol,
    /// An entity of which it is none.
    pub one: Symbol,
}

impl fmt::Display for MixedRelation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { relation, list, one } = self;
        write!(f, "the relation `{relation}` is now a list, as of {list}, and now an id or null, as of {one}")
    }
}

impl MixedRelation {
    /// What to do about it.
    pub fn hint(&self) -> String {
        "Where there may be several it is a list, even of one or none; where there is at most one it is an id or null."
            .to_owned()
    }
}

/// How relations were written, of the first entity each.
#[derive(Debug, Clone, Default)]
pub(crate) struct RelationForms {
    lists: BTreeMap<Symbol, Symbol>,
    ones: BTreeMap<Symbol, Symbol>,
}

impl RelationForms {
    /// Notes a relation of an entity.
    pub(crate) fn note(&mut self, entity: &Symbol, name: &Symbol, relation: &Relation) {
        let forms = match relation {
            Relation::Many(_) => &mut self.lists,
            Relation::One(_) => &mut self.ones,
        };
        if !forms.contains_key(name) {
            forms.insert(name.clone(), entity.clone());
        }
    }

    /// The relations that were written in both ways.
    pub(crate) fn mixed(&self) -> impl Iterator<Item = MixedRelation> {
        self.lists.iter().filter_map(|(relation, list)| {
            let one = self.ones.get(relation)?.clone();
            Some(MixedRelation { relation: relation.clone(), list: list.clone(), one })
        })
    }
}
