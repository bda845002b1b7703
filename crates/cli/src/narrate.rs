//! What happens during an episode, told as it happens; and how long planning took.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::time::{Duration, Instant};

use typelift::agent::{Event, Observer};
use typelift::model::Hierarchy;
use typelift::words::{line, wire_event};

use crate::style::painted;

/// Tells events to a person, writes them to a file, and measures planning.
#[derive(Debug, Default)]
pub(crate) struct Narrator {
    /// Tell every step to standard error.
    pub(crate) aloud: bool,
    /// Where events are written, one JSON object a line.
    events: Option<BufWriter<File>>,
    /// The types of the model that is acted with.
    pub(crate) hierarchy: Hierarchy,
    /// Why events could not be written.
    pub(crate) events_error: Option<std::io::Error>,
    /// The time spent planning.
    pub(crate) planning: Duration,
    started: Option<Instant>,
}

impl Narrator {
    pub(crate) fn new(aloud: bool, events: Option<BufWriter<File>>) -> Self {
        Self { aloud, events, ..Self::default() }
    }
}

impl Observer for Narrator {
    fn event(&mut self, event: &Event) {
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
            }
        }
        if self.aloud
            && let Some(line) = line(event)
        {
            anstream::eprintln!("{}", painted(&line));
        }
    }
}
