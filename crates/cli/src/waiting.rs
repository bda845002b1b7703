//! The line that says on a terminal what takes more than a second, and for how long: `planning … 3 s`.

use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// What is done in less is not spoken of.
const DELAY: Duration = Duration::from_secs(1);

/// How often the line is drawn anew.
const INTERVAL: Duration = Duration::from_millis(250);

/// A line on standard error while something goes on; nothing if that is no terminal. Whoever prints meanwhile ends it first,
/// or prints [aside](Self::aside). A copy stands for the same line.
#[derive(Clone, Debug, Default)]
pub(crate) struct Waiting {
    is_shown: bool,
    /// When all that goes on began, if it is waited for as one thing.
    since: Option<Instant>,
    line: Arc<Mutex<Option<Line>>>,
}

/// A line that a thread draws.
#[derive(Debug)]
struct Line {
    stage: Arc<Mutex<String>>,
    begun: Instant,
    delay: Duration,
    /// The thread ends when this is dropped.
    over: Sender<()>,
    thread: JoinHandle<()>,
}

impl Waiting {
    /// Shows lines unless it is to be quiet, or nobody looks.
    pub(crate) fn new(quiet: bool) -> Self {
        Self { is_shown: !quiet && std::io::stderr().is_terminal(), ..Self::default() }
    }

    /// What follows is one thing for whoever waits: once it takes its time, each stage of it is spoken of at once.
    pub(crate) fn for_one_thing(self) -> Self {
        Self { since: Some(Instant::now()), ..self }
    }

    /// Does some work, which is spoken of if it takes its time.
    pub(crate) fn during<T>(&self, stage: &str, work: impl FnOnce() -> T) -> T {
        self.begin(stage);
        let done = work();
        self.end();
        done
    }

    /// Something begins, and what went on before is over.
    pub(crate) fn begin(&self, stage: &str) {
        self.end();
        if self.is_shown {
            let delay = self.since.map_or(DELAY, |since| DELAY.saturating_sub(since.elapsed()));
            let line = Line::drawn_on(ProgressDrawTarget::stderr, stage, Instant::now(), delay);
            *self.line.lock().unwrap_or_else(PoisonError::into_inner) = Some(line);
        }
    }

    /// What goes on is still the same for whoever waits, and is now at this stage.
    pub(crate) fn is_at(&self, stage: &str) {
        if let Some(line) = &*self.line.lock().unwrap_or_else(PoisonError::into_inner) {
            stage.clone_into(&mut line.stage.lock().unwrap_or_else(PoisonError::into_inner));
        }
    }

    /// It is over, and the line is erased when this returns.
    pub(crate) fn end(&self) {
        let line = self.line.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(line) = line {
            line.erase();
        }
    }

    /// Prints something while something goes on: the line stands below it afterwards.
    pub(crate) fn aside(&self, print: impl FnOnce()) {
        // Held meanwhile, so that what goes on does not end in between.
        let mut line = self.line.lock().unwrap_or_else(PoisonError::into_inner);
        let interrupted = line.take().map(Line::erase);
        print();
        *line = interrupted.map(|(stage, begun, delay)| {
            let left = delay.saturating_sub(begun.elapsed());
            Line::drawn_on(ProgressDrawTarget::stderr, &stage, begun, left)
        });
    }
}

impl Line {
    fn drawn_on(
        target: impl FnOnce() -> ProgressDrawTarget + Send + 'static,
        stage: &str,
        begun: Instant,
        delay: Duration,
    ) -> Self {
        let (over, is_over) = channel::<()>();
        let stage = Arc::new(Mutex::new(stage.to_owned()));
        let drawn = Arc::clone(&stage);
        let thread = thread::spawn(move || {
            let waits = |time| is_over.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
            if !waits(delay) {
                return;
            }
            let bar = ProgressBar::with_draw_target(None, target());
            // The template is right: a test draws it.
            if let Ok(style) = ProgressStyle::with_template("{msg}") {
                bar.set_style(style);
            }
            loop {
                let stage = drawn.lock().unwrap_or_else(PoisonError::into_inner).clone();
                bar.set_message(format!("{stage} … {} s", begun.elapsed().as_secs()));
                bar.tick();
                if !waits(INTERVAL) {
                    break;
                }
            }
            bar.finish_and_clear();
        });
        Self { stage, begun, delay, over, thread }
    }

    /// Erases it, and gives what it is about, since when, and after how long it is spoken of.
    fn erase(self) -> (String, Instant, Duration) {
        drop(self.over);
        // A thread that could not draw is no matter.
        let _ = self.thread.join();
        let stage = self.stage.lock().unwrap_or_else(PoisonError::into_inner).clone();
        (stage, self.begun, self.delay)
    }
}

#[cfg(test)]
mod tests {
    use indicatif::InMemoryTerm;

    use super::*;

    fn waiting_on(terminal: &InMemoryTerm, delay: Duration) -> Waiting {
        let terminal = terminal.clone();
        let target = move || ProgressDrawTarget::term_like(Box::new(terminal));
        let line = Line::drawn_on(target, "planning", Instant::now(), delay);
        Waiting { is_shown: true, line: Arc::new(Mutex::new(Some(line))), ..Waiting::default() }
    }

    /// Looks until something stands there.
    fn first_seen(terminal: &InMemoryTerm) -> String {
        let begun = Instant::now();
        while terminal.contents().is_empty() && begun.elapsed() < Duration::from_secs(20) {
            thread::sleep(Duration::from_millis(5));
        }
        terminal.contents()
    }

    #[test]
    fn what_takes_its_time_is_spoken_of_until_it_is_over() {
        let terminal = InMemoryTerm::new(4, 40);
        let begun = Instant::now();
        let waiting = waiting_on(&terminal, DELAY);
        let seen = first_seen(&terminal);
        assert!(seen.starts_with("planning … ") && seen.ends_with(" s"), "{seen:?}");
        assert!(begun.elapsed() >= DELAY, "only then");
        let ended_elsewhere = waiting.clone();
        thread::spawn(move || ended_elsewhere.end()).join().expect("it ends");
        assert_eq!(terminal.contents(), "");
        waiting.end();
    }

    #[test]
    fn what_is_done_at_once_leaves_no_trace() {
        let terminal = InMemoryTerm::new(4, 40);
        let waiting = waiting_on(&terminal, Duration::from_secs(600));
        waiting.end();
        assert_eq!(terminal.moves_since_last_check(), "", "not even a movement of the cursor");
    }

    #[test]
    fn without_a_terminal_nothing_is_begun() {
        let waiting = Waiting::new(true);
        waiting.begin("planning");
        assert!(waiting.line.lock().expect("whole").is_none());
    }
}
