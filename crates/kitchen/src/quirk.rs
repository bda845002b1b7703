//! What makes tools do nothing although no state tells, besides being broken.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift_model::Symbol;

use crate::kind::{ItemKind, StationKind};

/// A food that a tool does nothing to, though it does to others like it: `{"food":"lettuce","tool":"cutboard"}`. Both are
/// types. The tool takes and gives the food as any other.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `food` and `tool`")]
pub struct Exception {
    /// The food's type.
    pub food: Symbol,
    /// The tool's type.
    pub tool: Symbol,
}

impl fmt::Display for Exception {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} with {}", self.food, self.tool)
    }
}

/// Tools that do nothing while something lies in another: `{"tools":["cutboard_1"],"loaded":"toaster_1"}`. All are names.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `tools` and `loaded`")]
pub struct Interlock {
    /// The tools that do nothing.
    pub tools: Vec<Symbol>,
    /// The tool in which something lies.
    pub loaded: Symbol,
}

impl fmt::Display for Interlock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tools: Vec<&str> = self.tools.iter().map(Symbol::as_str).collect();
        write!(f, "{} while {} is loaded", tools.join(", "), self.loaded)
    }
}

/// The exceptions and interlocks of a room. No snapshot tells.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Quirks {
    pub(crate) exceptions: Vec<(ItemKind, StationKind)>,
    /// By station: those that do nothing, and the one in which something lies.
    pub(crate) interlocks: Vec<(Vec<usize>, usize)>,
}
