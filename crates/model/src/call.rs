//! Actions as the environment knows them.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{Symbol, Term};

/// What the environment is told when a lifted action is executed: its name, and its arguments as terms.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct LiftedCall {
    /// The action's name in the environment.
    pub name: Symbol,
    /// The arguments in the demonstrated order.
    pub args: Vec<Term>,
}

/// An action as the environment knows it (paper: the action description a_d): `PICK(agent_1, counter_3, lettuce_1)`.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GroundCall {
    /// The action's name.
    pub name: Symbol,
    /// The entities it is applied to.
    pub args: Vec<Symbol>,
}

impl fmt::Display for GroundCall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}(", self.name)?;
        for (i, arg) in self.args.iter().enumerate() {
            write!(f, "{}{arg}", if i > 0 { ", " } else { "" })?;
        }
        f.write_str(")")
    }
}

impl fmt::Debug for GroundCall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
