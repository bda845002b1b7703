//! Limits: the only place where the program looks at the clock for an algorithm, and where Ctrl-C arrives.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use typelift::model::{Budget, Stop};

use crate::exit::Exit;
use crate::failure::Failure;

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

/// Limits that every command spells alike.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
#[command(next_help_heading = "Limits")]
pub(crate) struct Limits {
    /// Stop after this time, reading included: seconds, or 500ms, 30s, 5m
    #[arg(long, value_name = "TIME", value_parser = parse_duration, allow_negative_numbers = true)]
    time_limit: Option<Duration>,
    /// Expand at most this many nodes in one search
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_negative_numbers = true)]
    max_expansions: Option<u64>,
    /// Hold at most this many megabytes, the program itself included
    #[arg(long, value_name = "MB", value_parser = parse_whole, allow_negative_numbers = true)]
    memory_limit: Option<u64>,
}

/// Reads `90`, `500ms`, `30s`, `5m` or `1h`.
pub(crate) fn parse_duration(text: &str) -> Result<Duration, String> {
    let split = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let factor = match unit {
        "" | "s" => 1.0,
        "ms" => 1e-3,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ if number.is_empty() => return Err("write a number of seconds, or 500ms, 30s, 5m or 1h".to_owned()),
        _ => return Err(format!("unknown unit `{unit}`; write 500ms, 30s, 5m or 1h")),
    };
    let number: f64 = number.parse().map_err(|_| "write a number of seconds, or 500ms, 30s, 5m or 1h".to_owned())?;
    Duration::try_from_secs_f64(number * factor).map_err(|e| e.to_string())
}

/// Reads a number as every option takes them.
pub(crate) fn parse_whole(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("write a whole number from 0 to {}", u64::MAX))
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

impl Limits {
    /// The same, with at most so many expansions a search unless the user said otherwise.
    pub(crate) fn with_default_expansions(self, expansions: u64) -> Self {
        Self { max_expansions: self.max_expansions.or(Some(expansions)), ..self }
    }

    /// The time allowed, if it is limited.
    pub(crate) fn time(self) -> Option<Duration> {
        self.time_limit
    }

    /// The bytes of memory allowed, if they are limited.
    pub(crate) fn bytes(self) -> Option<u64> {
        self.memory_limit.map(|megabytes| megabytes.saturating_mul(1 << 20))
    }

    /// The budget that these limits leave, counted from the program's start.
    pub(crate) fn budget(self, clock: Clock, interrupt: &Interrupt) -> Budget {
        let interrupt = interrupt.clone();
        let limit = self.time_limit;
        let bytes = self.bytes();
        let meter = MemoryMeter::default();
        Budget {
            expansions: self.max_expansions,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations() {
        assert_eq!(parse_duration("90"), Ok(Duration::from_secs(90)));
        assert_eq!(parse_duration("500ms"), Ok(Duration::from_millis(500)));
        assert_eq!(parse_duration("1.5m"), Ok(Duration::from_secs(90)));
        assert!(
            parse_duration("5 parsecs").is_err() && parse_duration("").is_err() && parse_duration("1e999").is_err()
        );
    }
}
