//! Who is given what happens in an environment, to keep it.

use typelift_model::{Plan, Symbol};

use crate::{FileError, Recorder, Said, Scene, TraceAction};

/// Where the environment is, when something is about to be done in it for the first time after it was set up.
#[derive(Debug, Clone, PartialEq)]
pub struct Beginning<'a> {
    /// What was observed.
    pub first: &'a Scene,
    /// What the environment calls itself.
    pub environment: String,
    /// The instance of the world, in which an object's name means one thing; empty if it has no name.
    pub instance: Symbol,
}

/// Keeps what happens: an agent's driver tells each step once it is judged, and sends the next action only when
/// [`step`](Self::step) has returned. So a sink that has written the step by then loses at most the action that is under way.
pub trait RecordSink {
    /// Something is about to be done for the first time after the environment was set up.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be kept.
    fn begin(&mut self, beginning: &Beginning<'_>) -> Result<(), FileError>;

    /// An action, and what was observed after it.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be kept, or if nothing was begun.
    fn step(&mut self, action: &TraceAction, after: &Scene) -> Result<(), FileError>;

    /// A plan is proposed. Whoever keeps what happened only need not keep that.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be kept.
    fn proposed(&mut self, _plan: &Plan) -> Result<(), FileError> {
        Ok(())
    }

    /// A person said something of the plan that was proposed last, and it was understood.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be kept.
    fn said(&mut self, _said: &Said) -> Result<(), FileError> {
        Ok(())
    }
}

/// A trace says what is observed, and not where.
impl RecordSink for Recorder {
    fn begin(&mut self, beginning: &Beginning<'_>) -> Result<(), FileError> {
        Self::begin(self, beginning.first)
    }

    fn step(&mut self, action: &TraceAction, after: &Scene) -> Result<(), FileError> {
        Self::step(self, action, after)
    }
}
