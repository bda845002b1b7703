//! What a person may say against a step of a plan.

use serde::{Deserialize, Serialize};
use typelift_model::{GroundAtom, Symbol};

/// What a person says against a step. An agent takes it as certain: neither what failed nor what worked outweighs it, and of
/// two words that contradict each other the later counts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "because", rename_all = "snake_case")]
pub enum Objection {
    /// These things are out of order, in this instance of the world; those that a failure would be blamed on if none is
    /// named.
    Broken {
        /// Objects of the step.
        #[serde(default)]
        objects: Vec<Symbol>,
    },
    /// Things of the kinds of these, together, do not go there; if none is named, what is imagined.
    WrongKind {
        /// Objects of the step.
        #[serde(default)]
        objects: Vec<Symbol>,
    },
    /// Not while this holds.
    While {
        /// The atom.
        atom: GroundAtom,
    },
    /// Not in this task.
    NotNow,
    /// In this task another object in place of one of the step.
    Instead {
        /// An object of the step; if none is named, the one that is most of the other's kind.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        object: Option<Symbol>,
        /// The object that is wanted.
        with: Symbol,
    },
}
