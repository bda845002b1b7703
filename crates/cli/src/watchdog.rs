//! The last resort of a time limit: ends the program while it does what cannot be asked to stop, such as reading a very
//! long file.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use crate::exit::Exit;
use crate::limits::Clock;

/// What a time limit is overstepped by at most: this, and a twentieth.
const GRACE: Duration = Duration::from_millis(50);

/// Watches until it is called off.
#[derive(Debug, Default, Clone)]
pub(crate) struct Watchdog {
    /// Whether one of the two has gone ahead: the watchdog or whom it watches.
    decided: Arc<AtomicBool>,
}

impl Watchdog {
    /// Ends the program soon after the limit; before, `last_words` says why.
    pub(crate) fn start(
        clock: Clock,
        limit: Option<Duration>,
        last_words: impl FnOnce() -> Exit + Send + 'static,
    ) -> Self {
        let watchdog = Self::default();
        let Some(limit) = limit else { return watchdog };
        let latest = limit.saturating_add(limit / 20).saturating_add(GRACE);
        let decided = watchdog.decided.clone();
        thread::spawn(move || {
            thread::sleep(latest.saturating_sub(clock.elapsed()));
            if !decided.swap(true, Ordering::SeqCst) {
                std::process::exit(last_words() as i32);
            }
        });
        watchdog
    }

    /// From now on the program ends by itself. Does not return if it is being ended.
    pub(crate) fn call_off(&self) {
        if self.decided.swap(true, Ordering::SeqCst) {
            loop {
                thread::park();
            }
        }
    }
}
