//! What was expected of an action, and what the states around it say came of it.

use serde::{Deserialize, Serialize};
use typelift_model::{GroundAtom, Symbol};

/// The action of a model that an agent meant to carry out: a call alone does not say which of several actions with that
/// call it was, nor which entities it concerns besides the call's arguments.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Expected {
    /// The name of the action schema.
    pub action: Symbol,
    /// The entities in place of all its parameters, in order.
    pub args: Vec<Symbol>,
    /// What was to hold then, sorted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub adds: Vec<GroundAtom>,
    /// What was to hold no longer, sorted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub deletes: Vec<GroundAtom>,
}

/// What came of an action, judged by comparing the states around it with what was expected. Files, events and accounts
/// have it in [words](Self::word) joined by hyphens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Every expected change was observed; more may have changed besides.
    AsExpected,
    /// Nothing changed, though the environment says that it did it.
    Nothing,
    /// Some of the expected changes were observed.
    Partly,
    /// Something changed, but nothing that was expected.
    Otherwise,
    /// The environment declined, and nothing changed.
    Refused,
    /// The environment did not finish in time.
    TimedOut,
}

impl Verdict {
    /// Every verdict.
    pub const ALL: [Self; 6] =
        [Self::AsExpected, Self::Nothing, Self::Partly, Self::Otherwise, Self::Refused, Self::TimedOut];

    /// The word for it wherever a program reads it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::AsExpected => "as-expected",
            Self::Nothing => "nothing",
            Self::Partly => "partly",
            Self::Otherwise => "otherwise",
            Self::Refused => "refused",
            Self::TimedOut => "timed-out",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_have_the_words() {
        for verdict in Verdict::ALL {
            assert_eq!(serde_json::to_value(verdict).expect("JSON"), verdict.word());
        }
    }
}
