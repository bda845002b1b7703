//! What was not imagined, and why.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::Symbol;

/// A proposal that the guard gave up: a learned action with a parameter of which the type would have risen too far.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GivenUp {
    /// The learned action.
    pub action: Symbol,
    /// The parameter's name, without the question mark.
    pub parameter: Symbol,
    /// The type that it has.
    pub from: Symbol,
    /// The type that it would have had.
    pub to: Symbol,
    /// Why that is too far.
    pub because: Because,
}

/// Why a type would have risen too far.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Because {
    /// It would cover this type as well, which another parameter has.
    Covers(Symbol),
    /// It would cover everything, or be as wide as a type can be that does not.
    Topmost,
    /// Something of this type would act, which never was seen to.
    ActsInstead(Symbol),
}

impl fmt::Display for GivenUp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { action, parameter, from, to, because } = self;
        write!(f, "raising ?{parameter} of {action} from {from} to {to} would ")?;
        match because {
            Because::Covers(other) => write!(f, "cover {other} too"),
            Because::Topmost => f.write_str("cover almost everything"),
            Because::ActsInstead(instead) => write!(f, "let {instead} act, which was never seen to"),
        }
    }
}
