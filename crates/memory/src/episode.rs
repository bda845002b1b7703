//! An episode, kept as it happens.

use std::path::Path;

use rusqlite::Connection;
use serde::Serialize;
use serde_json::value::{RawValue, to_raw_value};
use typelift_model::{Plan, SourceId, Step};
use typelift_world::{Beginning, FileError, RecordSink, Said, Scene, TraceAction, TraceHeader, TraceLine, source_of};

use crate::error::{MemoryError, MemoryErrorKind};
use crate::log::{self, Kind, append, trace_text};
use crate::scene_change::SceneChange;

/// Appends what happens in an episode to a memory. Each beginning, after the environment was set up again, is a source of its
/// own, as it is a trace of its own. A step is on the disk when [`step`](RecordSink::step) returns.
#[derive(Debug)]
pub struct EpisodeLog<'m> {
    file: &'m Path,
    connection: &'m Connection,
    header: TraceHeader,
    /// The entry with which it began, and what was observed last.
    current: Option<(i64, Scene)>,
}

impl<'m> EpisodeLog<'m> {
    pub(crate) fn new(file: &'m Path, connection: &'m Connection, header: TraceHeader) -> Self {
        Self { file, connection, header, current: None }
    }

    /// The episode is over, and how it ended, in a word. Of one in which nothing was done nothing is kept.
    ///
    /// # Errors
    /// [`MemoryError`] if it cannot be written.
    pub fn end(mut self, how: &str) -> Result<(), MemoryError> {
        self.close(how).map_err(|kind| kind.of(self.file))
    }

    fn close(&mut self, how: &str) -> Result<(), MemoryErrorKind> {
        let Some((episode, _)) = self.current.take() else { return Ok(()) };
        let source: SourceId = source_of(trace_text(self.connection, episode)?.as_bytes());
        append(self.connection, Kind::Ended, Some(episode), &log::Ended { how: how.to_owned(), source })?;
        Ok(())
    }

    fn open(&mut self, Beginning { first, environment, instance }: &Beginning<'_>) -> Result<(), MemoryErrorKind> {
        self.close(log::SET_BACK)?;
        let scene = (*first).clone();
        let (environment, instance) = (environment.clone(), instance.clone());
        let header = raw(&TraceLine::from(&self.header))?;
        let begun = log::Begun { environment, instance, header, scene };
        let number = append(self.connection, Kind::Begun, None, &begun)?;
        self.current = Some((number, begun.scene));
        Ok(())
    }

    /// Keeps what was proposed or said: it is of the task, and not of what happened.
    fn note(&self, kind: Kind, content: &impl Serialize) -> Result<(), FileError> {
        let noted = append(self.connection, kind, None, content);
        noted.map(|_| ()).map_err(|kind| kind.of(self.file).into())
    }

    fn add(&mut self, action: &TraceAction, after: &Scene) -> Result<(), MemoryErrorKind> {
        let Some((episode, before)) = &mut self.current else { return Err(MemoryErrorKind::NotBegun) };
        let change = SceneChange::between(before, after);
        let action = raw(&TraceLine::from(action))?;
        append(self.connection, Kind::Stepped, Some(*episode), &log::Stepped { action, change })?;
        before.clone_from(after);
        Ok(())
    }
}

impl RecordSink for EpisodeLog<'_> {
    fn begin(&mut self, beginning: &Beginning<'_>) -> Result<(), FileError> {
        self.open(beginning).map_err(|kind| kind.of(self.file).into())
    }

    fn step(&mut self, action: &TraceAction, after: &Scene) -> Result<(), FileError> {
        self.add(action, after).map_err(|kind| kind.of(self.file).into())
    }

    fn proposed(&mut self, plan: &Plan) -> Result<(), FileError> {
        let step = |step: &Step| log::ProposedStep { call: step.call.clone(), imagined: step.imagined.is_some() };
        let steps = plan.steps.iter().map(step).collect();
        let proposed = log::Proposed { task: self.header.task.clone(), steps };
        self.note(Kind::Proposed, &proposed)
    }

    fn said(&mut self, said: &Said) -> Result<(), FileError> {
        self.note(Kind::Said, &log::Said { task: self.header.task.clone(), said: said.clone() })
    }
}

fn raw(line: &impl Serialize) -> Result<Box<RawValue>, MemoryErrorKind> {
    Ok(to_raw_value(line)?)
}
