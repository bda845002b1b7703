//! What an algorithm may spend. Algorithms never look at a clock: whoever knows the time hands in a closure.

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use thiserror::Error;

/// Why an algorithm ended before it was done. It is displayed for people; [`Stop::word`] is for programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Error)]
pub enum Stop {
    /// The time allowed is used up.
    #[error("out of time")]
    Time,
    /// The memory allowed is used up.
    #[error("out of memory")]
    Memory,
    /// It was asked to stop.
    #[error("stopped")]
    Cancelled,
    /// The expansions allowed to one search are used up.
    #[error("gave up at the limit of expansions")]
    Expansions,
}

impl Stop {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Time, Self::Memory, Self::Cancelled, Self::Expansions];

    /// The word for it wherever a program reads it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Time => "out_of_time",
            Self::Memory => "out_of_memory",
            Self::Cancelled => "stopped",
            Self::Expansions => "gave_up",
        }
    }
}

impl Serialize for Stop {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}

impl<'de> Deserialize<'de> for Stop {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        let stop = Self::ALL.into_iter().find(|stop| stop.word() == word);
        stop.ok_or_else(|| de::Error::custom(format_args!("`{word}` is no reason to stop")))
    }
}

/// Limits that an algorithm polls. The default has none.
#[derive(Clone, Default)]
pub struct Budget {
    /// Nodes that one search may expand.
    pub expansions: Option<u64>,
    /// Bytes that grounding and search may hold together, by their own count of what grows without bound: ground actions
    /// and nodes. What a whole process may hold is for `stop` to tell.
    pub bytes: Option<u64>,
    /// Asked now and then; an answer ends the work.
    pub stop: Option<Arc<dyn Fn() -> Option<Stop> + Send + Sync>>,
}

impl Budget {
    /// No limits.
    pub fn unlimited() -> Self {
        Self::default()
    }

    /// At most this many expansions a search.
    pub fn with_expansions(expansions: u64) -> Self {
        Self { expansions: Some(expansions), ..Self::default() }
    }

    /// Asks whether to stop.
    pub fn stopped(&self) -> Option<Stop> {
        self.stop.as_ref().and_then(|stop| stop())
    }
}

impl fmt::Debug for Budget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Budget")
            .field("expansions", &self.expansions)
            .field("bytes", &self.bytes)
            .field("stop", &self.stop.is_some())
            .finish()
    }
}
