//! Writing a trace as it happens.

use std::io::{self, Write};

use crate::trace_line::TraceLine;
use crate::{Scene, TraceAction, TraceHeader};

/// Appends to a trace. What was written is a whole trace at any time: an action is written together with the state after
/// it, in one go, and the output is flushed.
#[derive(Debug)]
pub struct TraceWriter<W> {
    out: W,
}

impl<W: Write> TraceWriter<W> {
    /// Begins a trace with what is observed before the first action.
    ///
    /// # Errors
    /// Those of the output.
    pub fn new(out: W, header: &TraceHeader, first: &Scene) -> io::Result<Self> {
        let mut writer = Self { out };
        writer.append([header.into(), first.into()])?;
        Ok(writer)
    }

    /// Goes on with a trace that ends with a state.
    pub(crate) fn going_on(out: W) -> Self {
        Self { out }
    }

    /// Appends an action and what is observed after it.
    ///
    /// # Errors
    /// Those of the output.
    pub fn step(&mut self, action: &TraceAction, after: &Scene) -> io::Result<()> {
        self.append([action.into(), after.into()])
    }

    fn append(&mut self, lines: [TraceLine<'_>; 2]) -> io::Result<()> {
        let mut bytes = Vec::new();
        for line in lines {
            serde_json::to_writer(&mut bytes, &line)?;
            bytes.push(b'\n');
        }
        self.out.write_all(&bytes)?;
        self.out.flush()
    }
}
