//! What was recorded, as it was observed.

use std::io::{self, Write};

use typelift_model::Symbol;

use crate::trace_writer::TraceWriter;
use crate::{ParseError, Parser, Scene, Trace, TraceAction, TraceHeader};

/// A trace as it was observed: its states are scenes, which are not parsed yet.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// What it is about.
    pub header: TraceHeader,
    /// What was observed before the first action.
    pub first: Scene,
    /// The actions, each with what was observed after it.
    pub steps: Vec<(TraceAction, Scene)>,
}

impl Recording {
    /// What was observed, before the first action and after each.
    pub fn scenes(&self) -> impl Iterator<Item = &Scene> {
        std::iter::once(&self.first).chain(self.steps.iter().map(|(_, after)| after))
    }

    /// Writes it as a trace file.
    ///
    /// # Errors
    /// Those of the output.
    pub fn write(&self, out: impl Write) -> io::Result<()> {
        let mut writer = TraceWriter::new(out, &self.header, &self.first)?;
        self.steps.iter().try_for_each(|(action, after)| writer.step(action, after))
    }

    /// The trace that it is for this parser; `file` is what it is called.
    ///
    /// # Errors
    /// [`ParseError`] if one of the scenes is not a state.
    pub fn trace(&self, file: impl Into<Symbol>, parser: &mut Parser) -> Result<Trace, ParseError> {
        Ok(Trace {
            file: Some(file.into()),
            task: self.header.task.clone(),
            goal: self.header.goal.clone(),
            states: self.scenes().map(|scene| parser.parse(scene)).collect::<Result<_, _>>()?,
            actions: self.steps.iter().map(|(action, _)| action.clone()).collect(),
            ..Trace::default()
        })
    }
}
