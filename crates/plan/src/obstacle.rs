//! What stands between an action and an atom that it could add or delete.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::Symbol;

/// What stands between an action and the atom that it could add or delete.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Obstacle {
    /// An object has a type that the action does not take.
    Type {
        /// The object.
        object: Symbol,
        /// Its type.
        found: Symbol,
        /// The type that the action takes there.
        expected: Symbol,
    },
    /// There is no such object.
    Missing {
        /// The object's name.
        object: Symbol,
    },
    /// An object may not be used.
    Excluded {
        /// The object.
        object: Symbol,
    },
    /// No object of a type may be used.
    NoObject {
        /// The type.
        ty: Symbol,
    },
    /// Every ground action that would do was tried, and may not be tried again.
    Banned,
    /// A precondition cannot be reached; parameters that the atom leaves open are written by their type.
    Precondition(String),
    /// The condition of the effect cannot be reached; written in the same way.
    Condition(String),
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Type { object, found, expected } => write!(f, "{object} is of type {found}, not {expected}"),
            Self::Missing { object } => write!(f, "there is no {object}"),
            Self::Excluded { object } => write!(f, "{object} may not be used any more"),
            Self::NoObject { ty } => write!(f, "there is no {ty} that may be used"),
            Self::Banned => f.write_str("what fits it may not be used any more"),
            Self::Precondition(atom) => write!(f, "it needs {atom}, which cannot be reached"),
            Self::Condition(atom) => write!(f, "it does that only with {atom}, which cannot be reached"),
        }
    }
}

/// The action that comes nearest to adding an atom, or to deleting it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Nearest {
    /// Its name, as plans have it.
    pub action: Symbol,
    /// Whether it has other ways to be used or to change the atom: then the obstacles are those of the nearest way.
    #[serde(default, skip_serializing_if = "is_false")]
    pub one_of_several: bool,
    /// Whether it was imagined: then no list of the model's actions has it.
    #[serde(default, skip_serializing_if = "is_false")]
    pub imagined: bool,
    /// What is missing; empty if only no choice of objects satisfies all that it needs.
    pub obstacles: Vec<Obstacle>,
    /// Where what is missing is missing for want of something else: what that is in the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub root: Option<Root>,
}

/// Something that cannot be reached, and for want of which something else cannot: what the nearest action to that needs, or
/// the nearest to what that needs, and so on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Root {
    /// The action that needs it, as plans have it.
    pub action: Symbol,
    /// The atom; parameters that it leaves open are written by their type.
    pub needs: String,
}

/// An atom that an action needs and that cannot be reached; what is open in it may be anything that fits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Need {
    pub(crate) predicate: Symbol,
    pub(crate) args: Vec<Option<Symbol>>,
    pub(crate) text: String,
}

impl Need {
    /// Whether this is the other, or that with more left open.
    pub(crate) fn covers(&self, other: &Self) -> bool {
        let covers = |(own, other): (&Option<Symbol>, &Option<Symbol>)| own.is_none() || own == other;
        self.predicate == other.predicate
            && self.args.len() == other.args.len()
            && self.args.iter().zip(&other.args).all(covers)
    }
}

fn is_false(value: &bool) -> bool {
    !*value
}

impl Nearest {
    /// What keeps it from adding the atom, or from deleting it.
    pub(crate) fn say(&self, f: &mut fmt::Formatter<'_>, change: &str) -> fmt::Result {
        let Self { action, one_of_several, imagined, obstacles, root } = self;
        let action = if *imagined { format!("{action} (imagined)") } else { action.to_string() };
        if obstacles.is_empty() {
            return write!(f, "no choice of objects lets {action} {change} it");
        }
        let way = if *one_of_several { "in the nearest of its cases " } else { "" };
        let obstacles: Vec<String> = obstacles.iter().map(ToString::to_string).collect();
        write!(f, "the nearest action is {action}, but {way}{}", obstacles.join(", and "))?;
        root.iter().try_for_each(|Root { action, needs }| {
            write!(f, "; in the end {action} needs {needs}, which cannot be reached either")
        })
    }
}
