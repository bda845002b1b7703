//! The bar that tells how far an experiment is, what is running, and how long it will take.

use std::collections::BTreeSet;
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use typelift::words::count;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use typelift_lab::Progress;

use crate::style::HINT;

/// A bar on standard error; nothing if that is no terminal.
#[derive(Debug)]
pub(super) struct Bar {
    quiet: bool,
    bar: ProgressBar,
    running: Mutex<BTreeSet<String>>,
}

impl Bar {
    pub(super) fn new(quiet: bool) -> Self {
        let shown = !quiet && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        Self { quiet, bar: ProgressBar::with_draw_target(None, target), running: Mutex::default() }
    }

    /// Takes the bar away.
    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn show(&self, change: impl FnOnce(&mut BTreeSet<String>)) {
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut running);
        let names: Vec<&str> = running.iter().map(String::as_str).collect();
        self.bar.set_message(names.join("; "));
    }
}

impl Progress for Bar {
    fn begun(&self, runs: usize, weight: u64, finished: usize) {
        if !self.quiet {
            let before = if finished == 0 { String::new() } else { format!(", {finished} were finished before") };
            anstream::eprintln!("{}{before}", count(runs as u64, "run"));
        }
        // The template is right: a test draws it.
        if let Ok(style) = ProgressStyle::with_template("{bar:24} {percent:>3}%  {eta} left  {wide_msg}") {
            self.bar.set_style(style);
        }
        self.bar.set_length(weight);
        self.bar.enable_steady_tick(Duration::from_millis(250));
    }

    fn started(&self, run: &str) {
        self.show(|running| {
            running.insert(run.to_owned());
        });
    }

    fn ended(&self, run: &str, weight: u64) {
        self.bar.inc(weight);
        self.show(|running| {
            running.remove(run);
        });
    }

    fn note(&self, text: &str) {
        if !self.quiet {
            self.bar.suspend(|| anstream::eprintln!("{HINT}note{HINT:#}: {text}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use indicatif::InMemoryTerm;

    use super::*;

    #[test]
    fn the_bar_tells_what_is_running() {
        let terminal = InMemoryTerm::new(4, 80);
        let target = ProgressDrawTarget::term_like(Box::new(terminal.clone()));
        let bar = Bar { quiet: true, bar: ProgressBar::with_draw_target(None, target), running: Mutex::default() };
        bar.begun(4, 4, 0);
        bar.started("T1.1 individual 0");
        bar.started("T4.3 generalized 1");
        bar.ended("T1.1 individual 0", 1);
        bar.bar.tick();
        let text = terminal.contents();
        assert!(text.contains(" 25%") && text.contains("left  T4.3 generalized 1"), "{text}");
        bar.finish();
        assert_eq!(terminal.contents(), "");
    }
}
