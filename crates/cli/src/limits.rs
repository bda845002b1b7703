//! Limits: the only place where the program looks at the clock for an algorithm, and where Ctrl-C arrives.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use typelift::model::{Budget, Stop};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::quantities::{parse_bytes, parse_duration, parse_whole};

/// When the program started: a time limit covers reading and grounding too.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock(Instant);

impl Clock {
    pub(crate) fn start() -> Self {
        Self(Instant::now())
    }

    pub(crate) fn elapsed(self) -> Duration {
        self.0.elapsed()
    }
}

/// The limits of every command that learns, plans or checks.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
#[command(next_help_heading = "Limits")]
pub(crate) struct Limits {
    /// Stop after this time, reading included: seconds, or 500ms, 30s, 5m
    #[arg(long, value_name = "TIME", value_parser = parse_duration, allow_negative_numbers = true)]
    time_limit: Option<Duration>,
    /// Hold at most so much memory, the program itself included: mebibytes, or 500M, 2G
    #[arg(long, value_name = "SIZE", value_parser = parse_bytes, allow_negative_numbers = true)]
    memory_limit: Option<u64>,
}

/// The limits of a command that searches.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
#[command(next_help_heading = "Limits")]
pub(crate) struct SearchLimits {
    #[command(flatten)]
    pub(crate) limits: Limits,
    /// Expand at most this many nodes in one search
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_negative_numbers = true)]
    max_expansions: Option<u64>,
}

/// Set by Ctrl-C and by a request to terminate.
#[derive(Clone, Default)]
pub(crate) struct Interrupt {
    raised: Arc<AtomicBool>,
    /// What is done at once when it is raised: waiting for a flag would be too late.
    hooks: Arc<Mutex<Vec<Hook>>>,
}

type Hook = Box<dyn Fn() + Send>;

/// A second request to stop counts as one only after this time.
const REPETITION: Duration = Duration::from_millis(500);

impl Interrupt {
    /// Catches Ctrl-C from now on; a second one ends the program at once.
    pub(crate) fn install() -> Result<Self, Failure> {
        let interrupt = Self::default();
        let Self { raised, hooks } = interrupt.clone();
        let mut first: Option<Instant> = None;
        ctrlc::set_handler(move || {
            raised.store(true, Ordering::SeqCst);
            // `timeout` and shells signal a program and its group: a repetition at once is the same request.
            let again = first.get_or_insert_with(Instant::now).elapsed() > REPETITION;
            for hook in hooks.lock().iter().flat_map(|hooks| hooks.iter()) {
                hook();
            }
            if again {
                std::process::exit(Exit::Interrupted as i32);
            }
        })
        .map_err(|e| Failure::new(Exit::Internal, format!("cannot catch Ctrl-C: {e}")))?;
        Ok(interrupt)
    }

    /// Has something done as soon as it is raised.
    pub(crate) fn on_raised(&self, hook: impl Fn() + Send + 'static) {
        if let Ok(mut hooks) = self.hooks.lock() {
            hooks.push(Box::new(hook));
        }
    }

    pub(crate) fn is_set(&self) -> bool {
        self.raised.load(Ordering::SeqCst)
    }
}

impl SearchLimits {
    /// The budget that these limits leave; at most `expansions` a search where the user does not say.
    pub(crate) fn budget(self, clock: Clock, interrupt: &Interrupt, expansions: Option<u64>) -> Budget {
        Budget { expansions: self.max_expansions.or(expansions), ..self.limits.budget(clock, interrupt) }
    }
}

impl Limits {
    /// The time allowed, if it is limited.
    pub(crate) fn time(self) -> Option<Duration> {
        self.time_limit
    }

    /// The bytes of memory allowed, if they are limited.
    pub(crate) fn bytes(self) -> Option<u64> {
        self.memory_limit
    }

    /// The limit that is exceeded, if one is.
    pub(crate) fn exceeded(self, clock: Clock) -> Option<Stop> {
        if self.time_limit.is_some_and(|limit| clock.elapsed() >= limit) {
            Some(Stop::Time)
        } else if self.memory_limit.is_some_and(holds_more_than) {
            Some(Stop::Memory)
        } else {
            None
        }
    }

    /// The budget that these limits leave, counted from the program's start.
    pub(crate) fn budget(self, clock: Clock, interrupt: &Interrupt) -> Budget {
        let interrupt = interrupt.clone();
        let limit = self.time_limit;
        let bytes = self.bytes();
        let meter = MemoryMeter::default();
        Budget {
            expansions: None,
            // What the algorithms count for themselves is the second best.
            bytes: bytes.filter(|_| resident().is_none()),
            stop: Some(Arc::new(move || {
                if interrupt.is_set() {
                    Some(Stop::Cancelled)
                } else if limit.is_some_and(|limit| clock.elapsed() >= limit) {
                    Some(Stop::Time)
                } else if bytes.is_some_and(|bytes| meter.exceeds(bytes, clock)) {
                    Some(Stop::Memory)
                } else {
                    None
                }
            })),
        }
    }
}

/// The bytes of memory that the program holds, if the system tells.
fn resident() -> Option<u64> {
    memory_stats::memory_stats().map(|stats| stats.physical_mem as u64)
}

/// Whether the program holds more than so many bytes of memory, as far as the system tells.
pub(crate) fn holds_more_than(bytes: u64) -> bool {
    resident().is_some_and(|resident| resident > bytes)
}

/// Asks the system how much memory the program holds: what an algorithm counts for itself leaves out what was given back
/// and may not be used again.
#[derive(Default)]
struct MemoryMeter {
    /// When it is asked again, in microseconds of the program's clock.
    next: AtomicU64,
}

impl MemoryMeter {
    /// Asking takes a few microseconds.
    const INTERVAL: u64 = 1_000;

    /// Whether the program holds more than so many bytes, as far as the system tells, and it was time to ask.
    fn exceeds(&self, bytes: u64, clock: Clock) -> bool {
        let now = clock.elapsed().as_micros() as u64;
        if now < self.next.load(Ordering::Relaxed) {
            return false;
        }
        self.next.store(now + Self::INTERVAL, Ordering::Relaxed);
        // Some more is held before it is asked again, and a table that grows is there twice for a while.
        holds_more_than(bytes - bytes / 32)
    }
}
