//! What an algorithm may spend. Algorithms never look at a clock: whoever knows the time hands in a closure.

use std::fmt;
use std::sync::Arc;

/// Why an algorithm was told to stop from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The time allowed is used up.
    Time,
    /// Somebody asked it to stop.
    Cancelled,
}

/// Limits that an algorithm polls. The default has none.
#[derive(Clone, Default)]
pub struct Budget {
    /// Nodes that one search may expand.
    pub expansions: Option<u64>,
    /// Bytes that grounding and search may hold together, by their own count of what grows without bound: ground actions
    /// and nodes.
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
