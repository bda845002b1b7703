//! What an algorithm may spend. Algorithms never look at a clock: whoever knows the time hands in a closure.

use std::fmt;
use std::sync::Arc;

use thiserror::Error;

/// Why an algorithm ended before it was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Stop {
    /// The time allowed is used up.
    #[error("out of time")]
    Time,
    /// The memory allowed is used up.
    #[error("out of memory")]
    Memory,
    /// Somebody asked it to stop.
    #[error("stopped")]
    Cancelled,
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
