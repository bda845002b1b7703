//! What is wrong with a memory.

use std::path::{Path, PathBuf};

use rusqlite::ErrorCode;
use thiserror::Error;
use typelift_learn::LearnError;
use typelift_model::{MergeError, ModelFileError, SourceId, Symbol};
use typelift_world::FileError;

use crate::version::VERSION;

/// Why a memory cannot be used, or not as it was asked. Shown as `robot.memory: …`.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}: {kind}", .file.display())]
pub struct MemoryError {
    /// The file, as it was named.
    pub file: PathBuf,
    /// What is wrong with it.
    pub kind: MemoryErrorKind,
}

/// What is wrong with a memory; what can be done about it depends on this.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum MemoryErrorKind {
    /// There is no file, or one in which nothing was ever written.
    #[error("there is no memory here yet")]
    Missing,
    /// There is something else already.
    #[error("there is something of this name already")]
    Exists,
    /// The system does not let it be opened.
    #[error("{0}")]
    CannotOpen(String),
    /// It is something else.
    #[error("this is not a memory")]
    NotAMemory,
    /// Another version wrote it.
    #[error("this is a memory of version {found}; this typelift reads version {VERSION}")]
    Version {
        /// Its version.
        found: i64,
    },
    /// Another program has been writing to it all the time that was waited.
    #[error("another program is writing to it")]
    Busy,
    /// It may be read, but not written.
    #[error("it cannot be written to")]
    ReadOnly,
    /// There is no room left.
    #[error("the disk is full")]
    DiskFull,
    /// The system does not read or write it, though it is open.
    #[error("it cannot be read or written: {0}")]
    Failing(String),
    /// Something in it is not as it was written.
    #[error("it is damaged: {0}")]
    Damaged(String),
    /// A model was learned from scenes that were read in another way, with the first difference.
    #[error("{model} is of another kind: {difference}")]
    Disagrees {
        /// What the model is called.
        model: String,
        /// The first difference.
        difference: String,
    },
    /// A model keeps totals only, so that nothing of it could be taken back.
    #[error("{model} keeps totals only, and not what each trace contributed")]
    Compact {
        /// What the model is called.
        model: String,
    },
    /// The same trace is known, and was read in another way.
    #[error("{model}: {error}")]
    Merge {
        /// What the model is called.
        model: String,
        /// Which trace.
        error: MergeError,
    },
    /// Nothing was learned from this source, or it was taken back already.
    #[error("nothing is known from {}", .0.short())]
    NotKnown(SourceId),
    /// Nothing was done with an object of this name, or said of it.
    #[error("nothing was done with {0} that is known, and nothing was said of it")]
    NoSuchObject(Symbol),
    /// This entry is nothing that a person said, or it was taken back already.
    #[error("entry {0} is nothing that a person said, or is taken back already")]
    NotSaid(i64),
    /// Something was said to have happened before anything was observed.
    #[error("nothing was observed before the first action")]
    NotBegun,
}

impl MemoryErrorKind {
    /// What to do about it, where the system stands in the way.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Busy => Some("Try again when it has ended."),
            Self::ReadOnly => Some("Let it be written, or copy it to where it can be; what only reads it can go on."),
            Self::DiskFull => Some("Make room and go on: what was kept until then is there."),
            Self::Failing(_) => {
                Some("Is there room on the disk, and may the file grow? What was kept until then is there.")
            }
            _ => None,
        }
    }

    pub(crate) fn of(self, file: &Path) -> MemoryError {
        MemoryError { file: file.to_owned(), kind: self }
    }
}

impl From<rusqlite::Error> for MemoryErrorKind {
    fn from(error: rusqlite::Error) -> Self {
        // A page that ends before its end.
        const SHORT_READ: i32 = 522;
        match error.sqlite_error_code() {
            Some(ErrorCode::SystemIoFailure) if error.sqlite_error().is_some_and(|e| e.extended_code == SHORT_READ) => {
                Self::Damaged(error.to_string())
            }
            Some(ErrorCode::NotADatabase) => Self::NotAMemory,
            Some(ErrorCode::DatabaseBusy | ErrorCode::DatabaseLocked) => Self::Busy,
            Some(ErrorCode::ReadOnly) => Self::ReadOnly,
            Some(ErrorCode::DiskFull) => Self::DiskFull,
            Some(ErrorCode::CannotOpen | ErrorCode::PermissionDenied) => Self::CannotOpen(error.to_string()),
            Some(ErrorCode::SystemIoFailure) => Self::Failing(error.to_string()),
            _ => Self::Damaged(error.to_string()),
        }
    }
}

/// What was written by a memory and cannot be read by it is damaged.
impl From<serde_json::Error> for MemoryErrorKind {
    fn from(error: serde_json::Error) -> Self {
        Self::Damaged(error.to_string())
    }
}

impl From<ModelFileError> for MemoryErrorKind {
    fn from(error: ModelFileError) -> Self {
        Self::Damaged(error.to_string())
    }
}

impl From<LearnError> for MemoryErrorKind {
    fn from(error: LearnError) -> Self {
        Self::Damaged(error.to_string())
    }
}

impl From<MemoryError> for FileError {
    fn from(error: MemoryError) -> Self {
        let told = Self::new(&error.file, error.kind.to_string());
        error.kind.hint().into_iter().fold(told, |told, hint| told.with_hint(hint.to_owned()))
    }
}
