//! Limits: the only place where the program looks at the clock for an algorithm, and where Ctrl-C arrives.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use typelift::model::{Budget, MemoryLimit, Stop};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::quantities::{parse_bytes, parse_duration, parse_whole};
use crate::resident::memory_held_from_now;

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
    /// Hold at most so much memory beyond what is held at the start: mebibytes, or 500M, 2G
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
    /// Whether somebody looks at it from time to time. Otherwise it ends the program at once.
    heeded: Arc<AtomicBool>,
    /// What is done at once when it is raised: waiting for a flag would be too late.
    hooks: Arc<Mutex<Vec<Hook>>>,
}

type Hook = Box<dyn Fn() + Send>;

/// A second request to stop counts as one only after this time.
const REPETITION: Duration = Duration::from_millis(500);

/// How much later than a child of this program the program itself may learn of a signal that was sent to both.
const LATENESS: Duration = Duration::from_millis(250);

impl Interrupt {
    /// Catches Ctrl-C from now on. It ends the program at once until it is [heeded](Self::heeded), since nothing that is
    /// read can be asked to stop: it may come through a pipe, and never. A second one always ends it at once.
    pub(crate) fn install() -> Result<Self, Failure> {
        let interrupt = Self::default();
        let Self { raised, heeded, hooks } = interrupt.clone();
        let mut first: Option<Instant> = None;
        ctrlc::set_handler(move || {
            raised.store(true, Ordering::SeqCst);
            // `timeout` and shells signal a program and its group: a repetition at once is the same request.
            let again = first.get_or_insert_with(Instant::now).elapsed() > REPETITION;
            for hook in hooks.lock().iter().flat_map(|hooks| hooks.iter()) {
                hook();
            }
            if again || !heeded.load(Ordering::SeqCst) {
                std::process::exit(Exit::Interrupted as i32);
            }
        })
        .map_err(|e| Failure::new(Exit::Internal, format!("cannot catch Ctrl-C: {e}")))?;
        Ok(interrupt)
    }

    /// From now on it is looked at.
    pub(crate) fn heeded(&self) {
        self.heeded.store(true, Ordering::SeqCst);
    }

    /// Does what may wait for ever and cannot be asked to stop, such as opening a pipe that nobody reads. An interrupt that
    /// comes meanwhile ends the program at once.
    pub(crate) fn unheeded<T>(&self, work: impl FnOnce() -> T) -> T {
        self.heeded.store(false, Ordering::SeqCst);
        let done = work();
        self.heeded();
        done
    }

    /// Has something done as soon as it is raised; at once if it is already.
    pub(crate) fn on_raised(&self, hook: impl Fn() + Send + 'static) {
        let Ok(mut hooks) = self.hooks.lock() else { return };
        // Whoever raises it after this look waits for the lock, and finds the hook.
        if self.is_set() {
            hook();
        }
        hooks.push(Box::new(hook));
    }

    pub(crate) fn is_set(&self) -> bool {
        self.raised.load(Ordering::SeqCst)
    }

    /// Whether it explains that a child has failed: a signal to a whole group may end the child before it arrives here.
    pub(crate) fn explains_failure(&self) -> bool {
        let begun = Instant::now();
        while !self.is_set() && begun.elapsed() < LATENESS {
            std::thread::sleep(LATENESS / 25);
        }
        self.is_set()
    }
}

impl SearchLimits {
    /// The budget that these limits leave; at most `expansions` a search where the user does not say.
    pub(crate) fn budget(self, clock: Clock, interrupt: &Interrupt, expansions: Option<u64>) -> Budget {
        Budget { expansions: self.max_expansions.or(expansions), ..self.limits.budget(clock, interrupt) }
    }
}

/// What to try next where a limit ended a search, if something can be tried.
pub(crate) fn what_to_try(stop: Stop) -> Option<&'static str> {
    match stop {
        Stop::Expansions => Some("--max-expansions allows more of them; another --search may need fewer"),
        Stop::Time => Some("--time-limit allows more of it; another --search may need less"),
        Stop::Memory => Some("--memory-limit allows more of it; another --search may need less"),
        Stop::Cancelled => None,
    }
}

impl Limits {
    /// The time allowed, if it is limited.
    pub(crate) fn time(self) -> Option<Duration> {
        self.time_limit
    }

    /// The memory that a call which begins now may come to hold, if it is limited: what is held already does not count.
    pub(crate) fn memory_from_now(self) -> Option<MemoryLimit> {
        let bytes = self.memory_limit?;
        // Some more is held before it is asked again, and a table that grows is there twice for a while.
        Some(MemoryLimit { bytes: bytes - bytes / 32, probe: memory_held_from_now() })
    }

    /// The budget that these limits leave a call that begins now; its time is counted from the program's start.
    pub(crate) fn budget(self, clock: Clock, interrupt: &Interrupt) -> Budget {
        let interrupt = interrupt.clone();
        let limit = self.time_limit;
        let stop = move || {
            if interrupt.is_set() {
                Some(Stop::Cancelled)
            } else {
                limit.is_some_and(|limit| clock.elapsed() >= limit).then_some(Stop::Time)
            }
        };
        Budget { expansions: None, memory: self.memory_from_now(), stop: Some(Arc::new(stop)) }
    }
}
