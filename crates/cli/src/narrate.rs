//! What happens during an episode, told as it happens; and how long planning took.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use typelift::agent::{Event, Observer};
use typelift::model::{Budget, Familiar, Hierarchy, State, Stop};
use typelift::words::{line, wire_event};

use crate::files::warn_of_doubts;
use crate::style::painted;
use crate::waiting::Waiting;

/// Tells events to a person, writes them to a file, and measures planning.
#[derive(Debug, Default)]
pub(crate) struct Narrator {
    /// Tell every step to standard error.
    pub(crate) aloud: bool,
    /// Where events are written, one JSON object a line.
    events: Option<BufWriter<File>>,
    /// The types of the model that is acted with.
    pub(crate) hierarchy: Hierarchy,
    /// What the model knows of states, until the first of them was looked at.
    pub(crate) familiar: Option<Familiar>,
    /// Why events could not be written.
    pub(crate) events_error: Option<std::io::Error>,
    /// Whether that is so.
    is_lost: Arc<AtomicBool>,
    /// The time spent planning.
    pub(crate) planning: Duration,
    started: Option<Instant>,
    /// Tells that planning, or the environment, takes its time.
    waiting: Waiting,
}

impl Narrator {
    pub(crate) fn new(aloud: bool, events: Option<BufWriter<File>>, waiting: Waiting) -> Self {
        Self { aloud, events, waiting, ..Self::default() }
    }

    /// Does what is planned after an episode, and tells that it takes its time.
    pub(crate) fn while_planning<T>(&self, plan: impl FnOnce() -> T) -> T {
        self.waiting.during("planning", plan)
    }

    /// The same budget, which is used up when an event cannot be written: nothing more is done of which nobody would know.
    pub(crate) fn bounds(&self, budget: Budget) -> Budget {
        let (is_lost, before) = (Arc::clone(&self.is_lost), budget.stop);
        let stop = move || match &before {
            _ if is_lost.load(Ordering::Relaxed) => Some(Stop::Cancelled),
            Some(stop) => stop(),
            None => None,
        };
        Budget { stop: Some(Arc::new(stop)), ..budget }
    }
}

impl Observer for Narrator {
    fn first_state(&mut self, state: &State) {
        let Some(familiar) = self.familiar.take() else { return };
        self.waiting.end();
        warn_of_doubts(Path::new("the environment"), &familiar.doubts(state, &self.hierarchy));
    }

    fn event(&mut self, event: &Event) {
        self.waiting.end();
        match event {
            Event::PlanningStarted { .. } => self.started = Some(Instant::now()),
            Event::PlanningEnded { .. } => {
                self.planning += self.started.take().map_or(Duration::ZERO, |started| started.elapsed());
            }
            _ => {}
        }
        if let Some(file) = &mut self.events {
            let written = serde_json::to_writer(&mut *file, &wire_event(event, &self.hierarchy)).map_err(Into::into);
            if let Err(error) = written.and_then(|()| writeln!(file)).and_then(|()| file.flush()) {
                self.events_error.get_or_insert(error);
                self.is_lost.store(true, Ordering::Relaxed);
            }
        }
        if self.aloud
            && let Some(line) = line(event)
        {
            anstream::eprintln!("{}", painted(&line));
        }
        if self.started.is_some() {
            self.waiting.begin("planning");
        }
    }
}
