//! Keys that entities of a type have at times only: what is left out gives no atom, which no action can need.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use typelift_model::Symbol;

use crate::mixed_relation::RelationForms;
use crate::{Entity, MixedRelation, Relation, Value};

/// An attribute or relation that an entity has and another of its type, or the same at another time, does not.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct LeftOut {
    /// The attribute or relation.
    pub key: Symbol,
    /// Whether it is a relation.
    pub is_relation: bool,
    /// The type of both entities.
    pub ty: Symbol,
    /// An entity that has it.
    pub has: Symbol,
    /// One that lacks it; the same if it has it in some states and lacks it in others.
    pub lacks: Symbol,
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, is_relation, ty, has, lacks } = self;
        let kind = if *is_relation { "relation" } else { "attribute" };
        if has == lacks {
            write!(f, "the {kind} `{key}` of {has} is left out in some states, and in others it is there")
        } else {
            write!(f, "the {kind} `{key}` is left out of {lacks}, and {has}, which is of type {ty} too, has it")
        }
    }
}

impl LeftOut {
    /// What to do about it.
    pub fn hint(&self) -> String {
        let key = &self.key;
        if self.is_relation {
            format!(
                "What is left out gives no atom that an action could need or add: where it is to nothing, write null, which \
                 gives `{key}_None`."
            )
        } else {
            "What is left out gives no atom that an action could need or add: write a word for that, too.".to_owned()
        }
    }
}

/// The keys that entities of each type were seen with. It grows with the entities, and not with the scenes.
#[derive(Debug, Clone, Default)]
pub(crate) struct KeySets {
    /// For each type, the sets of keys that its entities had, and which had it.
    seen: BTreeMap<Symbol, BTreeMap<BTreeSet<Symbol>, BTreeSet<Symbol>>>,
    /// For each type, the keys that give an atom whatever their value is, and whether each is a relation. Of the others
    /// (true or false, lists, numbers) nothing is lost if they are left out.
    telling: BTreeMap<Symbol, BTreeMap<Symbol, bool>>,
    forms: RelationForms,
}

impl KeySets {
    /// Notes the keys of an entity that are not ignored, and how its relations are written.
    pub(crate) fn note(&mut self, entity: &Entity, mut is_ignored: impl FnMut(&Symbol) -> bool) {
        let mut keys = BTreeSet::new();
        let words = entity.attributes.iter().map(|(key, value)| (key, matches!(value, Value::Text(_)), false));
        let ids = entity.relations.iter().map(|(key, relation)| (key, matches!(relation, Relation::One(_)), true));
        for (key, is_telling, is_relation) in words.chain(ids).filter(|(key, ..)| !is_ignored(key)) {
            if is_telling {
                self.telling.entry(entity.ty.clone()).or_default().entry(key.clone()).or_insert(is_relation);
            }
            keys.insert(key.clone());
        }
        for (name, relation) in entity.relations.iter().filter(|(name, _)| !is_ignored(name)) {
            self.forms.note(&entity.id, name, relation);
        }
        let with_keys = self.seen.entry(entity.ty.clone()).or_default().entry(keys).or_default();
        if !with_keys.contains(&entity.id) {
            with_keys.insert(entity.id.clone());
        }
    }

    /// The relations that are lists at times only.
    pub(crate) fn mixed(&self) -> impl Iterator<Item = MixedRelation> {
        self.forms.mixed()
    }

    /// The keys that were left out, each once for a type.
    pub(crate) fn left_out(&self) -> Vec<LeftOut> {
        let mut found = Vec::new();
        for (ty, keys) in &self.telling {
            for (key, &is_relation) in keys {
                let entities = |with: bool| -> BTreeSet<&Symbol> {
                    let sets = self.seen[ty].iter().filter(|(keys, _)| keys.contains(key) == with);
                    sets.flat_map(|(_, entities)| entities).collect()
                };
                let (having, lacking) = (entities(true), entities(false));
                let at_times = having.intersection(&lacking).next();
                let pair = at_times.map(|entity| (entity, entity)).or(having.first().zip(lacking.first()));
                found.extend(pair.map(|(has, lacks)| LeftOut {
                    key: key.clone(),
                    is_relation,
                    ty: ty.clone(),
                    has: (*has).clone(),
                    lacks: (*lacks).clone(),
                }));
            }
        }
        found
    }
}
