//! Snapshots: what a simulator or a perception system reports (paper: the low-level state x).

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use typelift_model::{GroundAtom, Pattern, Symbol};

use crate::json::distinct_map;

/// An attribute's value.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum Value {
    /// True or false; true gives the atom `attribute(entity)`.
    Bool(bool),
    /// A number; gives no atom.
    Number(f64),
    /// One of several words; `V` gives the atom `attribute_V(entity)`.
    Text(Symbol),
    /// A vector of numbers; gives no atom.
    Vector(Vec<f64>),
}

/// A relation of one entity to others.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum Relation {
    /// To at most one entity; to none (null) gives the atom `relation_None(entity)`.
    One(Option<Symbol>),
    /// To any number; an empty list gives no atom.
    Many(Vec<Symbol>),
}

impl Relation {
    /// The entities related to, in the order given.
    pub fn targets(&self) -> &[Symbol] {
        match self {
            Self::One(target) => target.as_slice(),
            Self::Many(targets) => targets,
        }
    }
}

/// One entity with what was observed of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Entity {
    /// Its name, unique in the snapshot.
    pub id: Symbol,
    /// Its type's name.
    #[serde(rename = "type")]
    pub ty: Symbol,
    /// Scalar properties.
    #[serde(default, deserialize_with = "distinct_map")]
    pub attributes: BTreeMap<Symbol, Value>,
    /// Relations to other entities.
    #[serde(default, deserialize_with = "distinct_map")]
    pub relations: BTreeMap<Symbol, Relation>,
}

/// Everything observed at one moment.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Snapshot {
    /// The entities.
    pub entities: Vec<Entity>,
}

/// A state as files and environments give it: a snapshot, or already symbolic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum Scene {
    /// Entities with attributes and relations, to be parsed.
    Snapshot(Snapshot),
    /// Objects and atoms.
    Symbolic {
        /// Every object, with its type's name.
        #[serde(deserialize_with = "distinct_map")]
        objects: BTreeMap<Symbol, Symbol>,
        /// The atoms that hold.
        #[serde(default)]
        atoms: BTreeSet<GroundAtom>,
        /// Atoms of which it is not known whether they hold; `*` stands for any entity: `holding_holds(agent_1,*)`.
        /// What is listed in `atoms` is known.
        #[serde(default)]
        unknown: BTreeSet<Pattern<Symbol>>,
    },
}

impl Scene {
    /// Every entity with its type's name, in the order of the scene.
    pub fn entities_and_types(&self) -> Vec<(&Symbol, &Symbol)> {
        match self {
            Self::Snapshot(snapshot) => snapshot.entities.iter().map(|entity| (&entity.id, &entity.ty)).collect(),
            Self::Symbolic { objects, .. } => objects.iter().collect(),
        }
    }
}
