//! The last resort of limits of time and memory: ends the program while it does what cannot be asked to stop, such as
//! reading a very long file.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use typelift::model::{MemoryLimit, Stop};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::{Clock, Interrupt, Limits};
use crate::waiting::Waiting;

/// What a time limit is overstepped by at most: this, and a twentieth; a limit of memory by a twentieth.
const GRACE: Duration = Duration::from_millis(50);

/// How often it is asked how much memory is held.
const INTERVAL: Duration = Duration::from_millis(5);

/// Does some work. If that takes more than is allowed, `last_words` says so and the program ends.
pub(crate) fn watched<T>(
    clock: Clock,
    limits: Limits,
    last_words: impl FnOnce(Stop) -> Exit + Send + 'static,
    work: impl FnOnce() -> T,
) -> T {
    let watchdog = Watchdog::start(clock, limits, last_words);
    let done = work();
    watchdog.call_off();
    done
}

/// Does some work, all of which is in vain if it takes more than is allowed.
pub(crate) fn within<T>(clock: Clock, limits: Limits, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    within_shown(clock, limits, &Waiting::default(), work)
}

/// The same where a line may tell of the work, which is erased before anything is said.
pub(crate) fn within_shown<T>(
    clock: Clock,
    limits: Limits,
    shown: &Waiting,
    work: impl FnOnce() -> Result<T, Failure>,
) -> Result<T, Failure> {
    let stopped = |stop: Stop| Failure::new(stop.into(), stop);
    let budget = limits.budget(clock, &Interrupt::default());
    let line = shown.clone();
    let last_words = move |stop| {
        line.end();
        stopped(stop).report()
    };
    let done = watched(clock, limits, last_words, work)?;
    // The watchdog leaves some grace.
    match budget.stopped() {
        Some(stop) => Err(stopped(stop)),
        None => Ok(done),
    }
}

/// Watches until it is called off.
#[derive(Debug, Default)]
struct Watchdog {
    /// Whether one of the two has gone ahead: the watchdog or whom it watches.
    decided: Arc<AtomicBool>,
}

impl Watchdog {
    /// Ends the program soon after a limit is reached; before, `last_words` says why.
    fn start(clock: Clock, limits: Limits, last_words: impl FnOnce(Stop) -> Exit + Send + 'static) -> Self {
        let watchdog = Self::default();
        let (time, memory) = (limits.time(), limits.memory_from_now());
        if time.is_none() && memory.is_none() {
            return watchdog;
        }
        let decided = watchdog.decided.clone();
        thread::spawn(move || {
            let Some(stop) = wait(clock, time, memory, &decided) else { return };
            if !decided.swap(true, Ordering::SeqCst) {
                std::process::exit(last_words(stop) as i32);
            }
        });
        watchdog
    }

    /// From now on the program ends by itself. Does not return if it is being ended.
    fn call_off(&self) {
        if self.decided.swap(true, Ordering::SeqCst) {
            loop {
                thread::park();
            }
        }
    }
}

/// Waits until a limit is reached; none if it is called off before.
fn wait(clock: Clock, time: Option<Duration>, memory: Option<MemoryLimit>, decided: &AtomicBool) -> Option<Stop> {
    let latest = time.map(|limit| limit.saturating_add(limit / 20).saturating_add(GRACE));
    let most =
        memory.map(|MemoryLimit { bytes, probe }| MemoryLimit { bytes: bytes.saturating_add(bytes / 20), probe });
    loop {
        let left = latest.map(|latest| latest.saturating_sub(clock.elapsed()));
        if decided.load(Ordering::SeqCst) {
            return None;
        }
        if left == Some(Duration::ZERO) {
            return Some(Stop::Time);
        }
        if most.as_ref().is_some_and(MemoryLimit::is_reached) {
            return Some(Stop::Memory);
        }
        let interval = most.as_ref().map(|_| INTERVAL);
        thread::sleep(left.into_iter().chain(interval).min().unwrap_or(INTERVAL));
    }
}
