//! Recording what happens in an environment: each step is on the disk before the next action is sent.

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::text_file::write_new_file;
use crate::trace_writer::TraceWriter;
use crate::{FileError, Scene, TraceAction, TraceHeader};

/// Records what happens during a task as traces in a folder: NAME.jsonl, and then, since no file is ever written over,
/// NAME-2.jsonl, NAME-3.jsonl and so on. Each begins where the environment was set to an initial state.
///
/// An action is recorded once it is judged, together with the state after it; it is on the disk when [`step`](Self::step)
/// returns. So whoever sends the next action only then loses at most the action that is under way, if the program is
/// killed, the environment dies or the power fails: the trace ends with the state before it.
#[derive(Debug)]
pub struct Recorder {
    folder: PathBuf,
    name: String,
    header: TraceHeader,
    current: Option<TraceWriter<Durable>>,
    files: Vec<PathBuf>,
}

impl Recorder {
    /// A recorder of the task of this name; nothing is written yet. The folder must be there.
    pub fn new(folder: &Path, name: &str, header: TraceHeader) -> Self {
        Self { folder: folder.to_owned(), name: name.to_owned(), header, current: None, files: Vec::new() }
    }

    /// The traces that were begun, in order.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// Begins a trace: the environment is in an initial state.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be written.
    pub fn begin(&mut self, first: &Scene) -> Result<(), FileError> {
        let mut bytes = Vec::new();
        TraceWriter::new(&mut bytes, &self.header, first).map_err(|e| FileError::from_write(&self.folder, &e))?;
        for number in 1.. {
            let suffix = if number == 1 { String::new() } else { format!("-{number}") };
            let path = self.folder.join(format!("{}{suffix}.jsonl", self.name));
            // What is there already need not be tried; between programs that record at once the file system decides.
            if path.symlink_metadata().is_ok() {
                continue;
            }
            match write_new_file(&path, &bytes).and_then(|()| OpenOptions::new().append(true).open(&path)) {
                Ok(file) => {
                    self.current = Some(TraceWriter::going_on(Durable(file)));
                    self.files.push(path);
                    break;
                }
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(FileError::from_write(&path, &error)),
            }
        }
        Ok(())
    }

    /// Records an action and what was observed after it.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be written, or if no trace was begun.
    pub fn step(&mut self, action: &TraceAction, after: &Scene) -> Result<(), FileError> {
        let (Some(writer), Some(path)) = (&mut self.current, self.files.last()) else {
            return Err(FileError::new(&self.folder, "nothing was observed before the first action"));
        };
        writer.step(action, after).map_err(|e| FileError::from_write(path, &e))
    }
}

/// A file whose content is on the disk whenever it was flushed.
#[derive(Debug)]
struct Durable(File);

impl Write for Durable {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.sync_data()
    }
}
