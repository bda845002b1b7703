//! Why a text is not a model.

use thiserror::Error;

use crate::{Hierarchy, HierarchyError, NameCollision, Symbol, TypeId};

/// The format that this version writes.
pub const MODEL_FORMAT: &str = "model/2";
/// The format before, which is still read.
pub(crate) const MODEL_FORMAT_1: &str = "model/1";

/// Why a text is not a model.
#[derive(Debug, Error)]
pub enum ModelFileError {
    /// It is not JSON, or not of the right shape.
    #[error("line {line}, column {column}: {message}")]
    Json {
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// It is of another version.
    #[error(
        "this is a file of format `{found}`; this version of typelift reads `{MODEL_FORMAT_1}` and `{MODEL_FORMAT}`"
    )]
    Version {
        /// The format it names.
        found: String,
    },
    /// It is of another kind.
    #[error("this is a file of format `{found}`, not a model")]
    NotAModel {
        /// The format it names.
        found: String,
    },
    /// It does not say what it is.
    #[error("there is no \"format\":\"{MODEL_FORMAT}\": this is not a model file")]
    NoFormat,
    /// Its types are not a tree.
    #[error("\"types\": {0}")]
    Hierarchy(#[from] HierarchyError),
    /// It names a type that it does not have.
    #[error("{place}: unknown type `{name}`")]
    UnknownType {
        /// Where.
        place: String,
        /// The type's name.
        name: Symbol,
    },
    /// An action refers to a parameter, cluster or name that it does not have, or twice to one.
    #[error("{place}: {message}")]
    Inconsistent {
        /// Where.
        place: String,
        /// What is wrong.
        message: String,
    },
    /// Its names collide in PDDL.
    #[error(transparent)]
    Collision(#[from] NameCollision),
}

pub(crate) fn at_most(n: usize, most: usize, what: &str, place: impl Fn() -> String) -> Result<(), ModelFileError> {
    if n <= most { Ok(()) } else { Err(inconsistent(place(), &format!("{n} {what} are more than {most}"))) }
}

pub(crate) fn inconsistent(place: String, message: &str) -> ModelFileError {
    ModelFileError::Inconsistent { place, message: message.to_owned() }
}

pub(crate) fn type_id(
    hierarchy: &Hierarchy,
    name: &Symbol,
    place: impl Fn() -> String,
) -> Result<TypeId, ModelFileError> {
    hierarchy.id(name.as_str()).ok_or_else(|| ModelFileError::UnknownType { place: place(), name: name.clone() })
}
