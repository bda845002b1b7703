//! What an algorithm may spend. Algorithms never look at a clock: the caller hands in a closure.

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

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Stop {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Stop".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let words: Vec<&str> = Self::ALL.iter().map(|stop| stop.word()).collect();
        schemars::json_schema!({ "description": "Why something was ended early.", "type": "string", "enum": words })
    }
}

impl<'de> Deserialize<'de> for Stop {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        let stop = Self::ALL.into_iter().find(|stop| stop.word() == word);
        stop.ok_or_else(|| de::Error::custom(format_args!("`{word}` is no reason to stop")))
    }
}

/// Tells how many bytes are held. It is asked as often as the time is: a probe that has to ask the system repeats the last
/// answer for a while.
pub type MemoryProbe = Arc<dyn Fn() -> u64 + Send + Sync>;

/// How much memory may be held, as a probe tells.
#[derive(Clone)]
pub struct MemoryLimit {
    /// The bytes allowed: as soon as so many are held, the work ends.
    pub bytes: u64,
    /// Tells how many are held.
    pub probe: MemoryProbe,
}

/// Limits that an algorithm polls. The default has none.
///
/// No algorithm counts what it holds. A budget without a `memory` limit has none, whatever is planned; a limit is as exact
/// as its probe, and as often as it is asked. A probe usually tells what the whole process holds, above what it held when
/// the work began. Then everything that happens in the process meanwhile counts: searches that run at the same time share
/// one limit, and what ended work has left behind does not count, as it was there before.
///
/// ```
/// use std::sync::Arc;
/// use typelift_model::{Budget, MemoryLimit, Stop};
///
/// # fn bytes_held_by_this_process() -> u64 { 5_000_000 }
/// let before = bytes_held_by_this_process();
/// let probe = Arc::new(move || bytes_held_by_this_process().saturating_sub(before));
/// let budget = Budget { memory: Some(MemoryLimit { bytes: 200 << 20, probe }), ..Budget::unlimited() };
/// assert_eq!(budget.stopped(), None);
///
/// let nothing = MemoryLimit { bytes: 0, probe: Arc::new(|| 0) };
/// assert_eq!(Budget { memory: Some(nothing), ..budget }.stopped(), Some(Stop::Memory));
/// ```
#[derive(Clone, Default)]
pub struct Budget {
    /// Nodes that one search may expand.
    pub expansions: Option<u64>,
    /// Memory that may be held.
    pub memory: Option<MemoryLimit>,
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
        let is_full = |memory: &MemoryLimit| memory.is_reached().then_some(Stop::Memory);
        self.stop.as_ref().and_then(|stop| stop()).or_else(|| self.memory.as_ref().and_then(is_full))
    }
}

impl MemoryLimit {
    /// Whether as much is held as is allowed.
    pub fn is_reached(&self) -> bool {
        (self.probe)() >= self.bytes
    }
}

impl fmt::Debug for MemoryLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MemoryLimit").field("bytes", &self.bytes).finish_non_exhaustive()
    }
}

impl fmt::Debug for Budget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Budget")
            .field("expansions", &self.expansions)
            .field("memory", &self.memory)
            .field("stop", &self.stop.is_some())
            .finish()
    }
}
