//! What happens during an episode, told as it happens; and how long planning took.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::time::{Duration, Instant};

use typelift::agent::{Event, Observer, StepResult};
use typelift::world::Verdict;

use crate::style::{BAD, DIM, GOOD, IMAGINED, WARNING, count};

/// Tells events to a person, writes them to a file, and measures planning.
#[derive(Debug, Default)]
pub(crate) struct Narrator {
    /// Tell every step to standard error.
    pub(crate) aloud: bool,
    /// Where events are written, one JSON object a line.
    events: Option<BufWriter<File>>,
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
            let written = serde_json::to_writer(&mut *file, event).map_err(Into::into);
            if let Err(error) = written.and_then(|()| writeln!(file)).and_then(|()| file.flush()) {
                self.events_error.get_or_insert(error);
            }
        }
        if self.aloud
            && let Some(line) = told(event)
        {
            anstream::eprintln!("{line}");
        }
    }
}

/// An event in one line.
pub(crate) fn told(event: &Event) -> Option<String> {
    Some(match event {
        Event::PlanningStarted { .. } | Event::PlanningEnded { .. } | Event::Ended { .. } => return None,
        Event::Proposed { proposal, plan } => {
            let imagined = plan.steps.iter().filter(|step| step.imagined.is_some()).count();
            let steps = count(plan.steps.len() as u64, "step");
            let imagined = if imagined > 0 { format!(", {imagined} imagined") } else { String::new() };
            format!("  proposal {proposal}: {steps}{imagined}")
        }
        Event::Stepped { step, call, imagined, result, reason, .. } => {
            let mark = if *imagined { format!("  {IMAGINED}imagined{IMAGINED:#}") } else { String::new() };
            if *result == StepResult::Tried(Verdict::AsExpected) {
                format!("  {step:>3}  {call}{mark}  {GOOD}ok{GOOD:#}")
            } else {
                let reason = reason.as_ref().map(|reason| format!(": {reason}")).unwrap_or_default();
                format!("  {step:>3}  {call}{mark}  {BAD}{}{BAD:#}{reason}", result.phrase())
            }
        }
        Event::Retried { .. } => format!("       {DIM}again{DIM:#}"),
        Event::Excluded { suspect, .. } => format!("       {WARNING}excluded{WARNING:#}: {suspect}"),
        Event::Drifted { missing, .. } => match missing.strip_prefix("not ") {
            Some(atom) => format!("       the world changed by itself: {atom} holds now"),
            None => format!("       the world changed by itself: {missing} no longer holds"),
        },
        Event::LastResort { resort } => format!("       nothing left to try: {}", resort.phrase()),
        Event::NoOtherPlan { .. } => "       there is no other plan".to_owned(),
    })
}
