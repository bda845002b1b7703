//! Why a snapshot is not one of a kitchen.

use thiserror::Error;
use typelift_model::Symbol;

/// Why a snapshot is not one of a kitchen.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SnapshotError {
    /// Two entities of one name.
    #[error("there are two entities `{entity}`")]
    Duplicate {
        /// The name.
        entity: Symbol,
    },
    /// A type that nothing in a kitchen has.
    #[error("entity {entity}: nothing in a kitchen is of type `{ty}`")]
    Type {
        /// The entity.
        entity: Symbol,
        /// Its type.
        ty: Symbol,
    },
    /// There is no agent.
    #[error("there is no agent")]
    NoAgent,
    /// There is more than one agent.
    #[error("there are two agents, {first} and {second}; a kitchen has one")]
    TwoAgents {
        /// The first.
        first: Symbol,
        /// The other.
        second: Symbol,
    },
    /// An attribute with a value that it cannot have, or on an entity that cannot have it.
    #[error("entity {entity}: `{attribute}` is {found}, but it can only be {expected}")]
    Attribute {
        /// The entity.
        entity: Symbol,
        /// The attribute.
        attribute: &'static str,
        /// Its value, as JSON.
        found: String,
        /// The values that it can have.
        expected: String,
    },
    /// A relation to something that cannot be there.
    #[error("entity {entity}: `{relation}` names `{target}`, which is not {expected}")]
    Target {
        /// The entity.
        entity: Symbol,
        /// The relation.
        relation: &'static str,
        /// What it names.
        target: Symbol,
        /// What it has to name, with its article.
        expected: &'static str,
    },
    /// More items than the entity has room for.
    #[error("entity {entity}: `{relation}` names too many items: {count}, where there is room for {most}")]
    TooMany {
        /// The entity.
        entity: Symbol,
        /// The relation.
        relation: &'static str,
        /// How many it names.
        count: usize,
        /// How many it could.
        most: usize,
    },
    /// An item in two places.
    #[error("entity {entity}: it is in {first} and in {second}")]
    TwoPlaces {
        /// The item.
        entity: Symbol,
        /// Where it is.
        first: Symbol,
        /// Where it is as well.
        second: Symbol,
    },
    /// A location where the entity cannot be.
    #[error("entity {entity}: the location {location} is {problem}")]
    Location {
        /// The entity.
        entity: Symbol,
        /// The location, as JSON.
        location: String,
        /// What is wrong with it.
        problem: String,
    },
    /// Nowhere to put an entity that has no location.
    #[error("entity {entity}: it has no location, and there is no free place for it")]
    NoPlace {
        /// The entity.
        entity: Symbol,
    },
    /// An attribute that follows from the rest, and does not.
    #[error("entity {entity}: `{attribute}` is {found}, which contradicts what lies where")]
    Contradiction {
        /// The entity.
        entity: Symbol,
        /// The attribute.
        attribute: &'static str,
        /// Its value.
        found: bool,
    },
}
