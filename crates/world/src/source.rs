//! Which source a trace is: the SHA-256 of its file's bytes, taken while they are read; of a trace that was made in memory,
//! that of its canonical text.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use sha2::{Digest, Sha256};
use typelift_model::{Hierarchy, SourceId, State, Unknown};

use crate::{FileError, Trace, TraceHeader, TraceLine};

/// Takes bytes as they come.
#[derive(Debug, Clone, Default)]
pub(crate) struct SourceHasher(Sha256);

impl SourceHasher {
    pub(crate) fn update(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    pub(crate) fn finish(self) -> SourceId {
        SourceId::new(self.0.finalize().into())
    }
}

impl Write for SourceHasher {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Which source a trace file is, without reading it as a trace.
///
/// # Errors
/// [`FileError`] if it cannot be read.
pub fn source_of_file(path: &Path) -> Result<SourceId, FileError> {
    let mut hasher = SourceHasher::default();
    let read = File::open(path).and_then(|mut file| io::copy(&mut file, &mut hasher));
    read.map_err(|error| FileError::from_io(path, &error))?;
    Ok(hasher.finish())
}

/// Which source a trace file with this content is.
pub fn source_of(bytes: &[u8]) -> SourceId {
    let mut hasher = SourceHasher::default();
    hasher.update(bytes);
    hasher.finish()
}

impl Trace {
    /// Which source it is: that of the file it was read from, or else of its canonical text, which is a line for each
    /// state and action, every set in order. `hierarchy` is the one that its states refer to.
    pub fn source_id(&self, hierarchy: &Hierarchy) -> SourceId {
        self.source.unwrap_or_else(|| {
            let mut hasher = SourceHasher::default();
            // A hasher takes everything.
            let _ = self.write_canonical(hierarchy, &mut hasher);
            hasher.finish()
        })
    }

    fn write_canonical(&self, hierarchy: &Hierarchy, out: &mut SourceHasher) -> io::Result<()> {
        let header = TraceHeader { task: self.task.clone(), goal: self.goal.clone() };
        write_line(&TraceLine::from(&header), out)?;
        for (index, state) in self.states.iter().enumerate() {
            write_state(state, hierarchy, out)?;
            if let Some(action) = self.actions.get(index) {
                write_line(&TraceLine::from(action), out)?;
            }
        }
        Ok(())
    }
}

fn write_line(line: &TraceLine<'_>, out: &mut SourceHasher) -> io::Result<()> {
    serde_json::to_writer(&mut *out, line)?;
    writeln!(out)
}

/// Names hold no white space, so that no two states are written alike.
fn write_state(state: &State, hierarchy: &Hierarchy, out: &mut SourceHasher) -> io::Result<()> {
    write!(out, "objects")?;
    for (name, ty) in &state.objects {
        write!(out, " {name} {}", hierarchy.name(*ty))?;
    }
    write!(out, " atoms")?;
    for atom in &state.atoms {
        write!(out, " {atom}")?;
    }
    match &state.unknown {
        Unknown::Matching(patterns) => {
            write!(out, " unknown")?;
            patterns.iter().try_for_each(|pattern| write!(out, " {pattern}"))?;
        }
        Unknown::AllBut(known) => {
            write!(out, " unknown but")?;
            known.iter().try_for_each(|atom| write!(out, " {atom}"))?;
        }
    }
    writeln!(out)
}
