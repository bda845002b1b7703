//! Why an experiment could not be finished.

use thiserror::Error;
use typelift::world::FileError;

/// Why an experiment could not be finished. What was finished of it is in its run log.
#[derive(Debug, Error)]
pub enum LabError {
    /// A file is wrong, or cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Somebody stopped it.
    #[error("stopped: {finished} of {total} runs are finished")]
    Stopped {
        /// Runs that are finished.
        finished: usize,
        /// Runs asked for.
        total: usize,
    },
    /// A run could not be carried out: a defect, since everything that it needs is built in.
    #[error("{run}: {message}")]
    Run {
        /// The run.
        run: String,
        /// What happened.
        message: String,
    },
    /// The operating system gives no threads.
    #[error("the threads could not be started: {0}")]
    Threads(String),
}
