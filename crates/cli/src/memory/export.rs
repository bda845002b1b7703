//! `typelift memory export`: what a memory knows, as files that need no memory.

use std::fs::create_dir_all;
use std::path::{Path, PathBuf};

use typelift::words::count;
use typelift::world::{FileError, write_file};
use typelift_memory::Memory;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::overwriting::{Output, keep_inputs};

pub(crate) fn export(
    memory: &Memory,
    folder: Option<&Path>,
    model: Option<&Path>,
    quiet: bool,
) -> Result<Exit, Failure> {
    keep_inputs(model.map(Output::File), [memory.file()])?;
    if let Some(folder) = folder {
        create_dir_all(folder).map_err(|error| FileError::from_write(folder, &error))?;
        let mut written = 0;
        for (task, text) in memory.traces()? {
            if let Some(path) = free_name(folder, task.as_str(), &text) {
                write_file(&path, text.as_bytes())?;
                written += 1;
            }
        }
        if !quiet {
            anstream::eprintln!("wrote {} to {}", count(written, "trace"), folder.display());
        }
    }
    if let Some(path) = model {
        write_file(path, memory.learned().to_json()?.as_bytes())?;
        if !quiet {
            anstream::eprintln!("wrote {}", path.display());
        }
    }
    Ok(Exit::Success)
}

/// Where a trace is written: NAME.jsonl, NAME-2.jsonl and so on, since no file is written over; nowhere if one of these is
/// that trace already.
fn free_name(folder: &Path, task: &str, text: &str) -> Option<PathBuf> {
    let name = Path::new(task).file_name().map_or("trace".into(), |name| name.to_string_lossy());
    let names = (1..).map(|number: u64| match number {
        1 => folder.join(format!("{name}.jsonl")),
        _ => folder.join(format!("{name}-{number}.jsonl")),
    });
    for path in names {
        match std::fs::read(&path) {
            Ok(there) if there == text.as_bytes() => return None,
            Err(_) if path.symlink_metadata().is_err() => return Some(path),
            _ => {}
        }
    }
    None
}
