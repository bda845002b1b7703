//! What the parser of snapshots was told, kept with the model so that new states are read the same way.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::Symbol;

/// How snapshots become states.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ParseConfig {
    /// Attributes and relations that give no atoms: `name`, or `type.name` for one type and those below it.
    #[serde(default)]
    pub ignore: BTreeSet<Symbol>,
    /// Names that were met with several numbers of arguments: the model tells these predicates apart by it, as `name/2`.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub by_arity: BTreeSet<Symbol>,
}
