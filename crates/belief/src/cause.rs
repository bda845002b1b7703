//! What can be to blame for a failure.

use serde::{Deserialize, Serialize};
use typelift_model::{LiftedAtom, Symbol, TypeId};

use crate::surroundings::Surrounding;

/// Two parameters and the types there.
pub type Pair = ((usize, TypeId), (usize, TypeId));

/// What may be to blame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Culprit {
    /// An object, in its instance of the world.
    Object,
    /// A type in its place.
    Type,
    /// Two types together.
    Pair,
    /// A literal that does not hold; after `not` one that holds.
    Literal,
    /// Nothing that is known.
    Chance,
}

/// Something that can be to blame for a failure of an action.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// An object, in its instance of the world.
    Object {
        /// The instance, in which alone the name means it.
        instance: Symbol,
        /// Its name.
        object: Symbol,
        /// When it had worked last, in the order in which all was tried; 0 if it never had. Failures between which it worked
        /// have different causes.
        worked: u64,
    },
    /// The type at a parameter.
    Type(usize, TypeId),
    /// Two types together, each at a parameter.
    Together(Pair),
    /// A literal that did not hold.
    Missing(LiftedAtom),
    /// A literal that held, and must not.
    Present(LiftedAtom),
    /// Something around who took part that held, and must not, or that did not hold.
    Around(Surrounding, bool),
    /// Nothing that is known.
    Chance,
}

impl Cause {
    /// Of what kind it is.
    pub fn culprit(&self) -> Culprit {
        match self {
            Self::Object { .. } => Culprit::Object,
            Self::Type(..) => Culprit::Type,
            Self::Together(_) => Culprit::Pair,
            Self::Missing(_) | Self::Present(_) | Self::Around(..) => Culprit::Literal,
            Self::Chance => Culprit::Chance,
        }
    }
}
