//! Nothing that is read is written over: one guard, which every command asks about all that it reads and may write.

use std::path::{Path, PathBuf};

use crate::exit::Exit;
use crate::failure::Failure;

/// Something that a command may write.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Output<'a> {
    /// This file.
    File(&'a Path),
    /// This file, and those [`numbered`] from 1 to `most`.
    Numbered { file: &'a Path, most: u64 },
}

/// The file of this number that stands beside another.
pub(crate) fn numbered(file: &Path, number: u64) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(format!(".{number}"));
    name.into()
}

/// Refuses to write over what is read, and to a file that is called `-`. The same file under another name is the same.
pub(crate) fn keep_inputs<'a, P: AsRef<Path>>(
    outputs: impl IntoIterator<Item = Output<'a>>,
    inputs: impl IntoIterator<Item = P>,
) -> Result<(), Failure> {
    let read: Vec<FileId> = inputs.into_iter().filter_map(|input| FileId::of(input.as_ref())).collect();
    let outputs: Vec<Output> = outputs.into_iter().collect();
    if outputs.iter().any(|output| output.file() == Path::new("-")) {
        let message = "`-` is no file, and nothing is written to standard output in this way";
        return Err(Failure::new(Exit::Usage, message).with_hint("Name a file; one that is called so is `./-`."));
    }
    let mut written = outputs.into_iter().flat_map(Output::existing);
    let is_read = |path: &PathBuf| FileId::of(path).is_some_and(|id| read.contains(&id));
    match written.find(is_read) {
        None => Ok(()),
        Some(path) => Err(Failure::bad_input(format!("{} is read, and would be written over", path.display()))
            .with_hint("name another file to write to; a pattern such as *.jsonl after -o is expanded by the shell")),
    }
}

impl Output<'_> {
    /// The file that is named.
    fn file(&self) -> &Path {
        match self {
            Self::File(file) | Self::Numbered { file, .. } => file,
        }
    }

    /// Its files, as far as they are there; what is not there is no input.
    pub(crate) fn existing(self) -> Vec<PathBuf> {
        let (file, most) = match self {
            Self::File(file) => (file, 0),
            Self::Numbered { file, most } => (file, most),
        };
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let number = |other: &str| -> Option<u64> { other.strip_prefix(&name)?.strip_prefix('.')?.parse().ok() };
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let others = folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.file_name());
        let numbers = others.filter_map(|other| number(&other.to_string_lossy())).filter(|n| (1..=most).contains(n));
        let mut files: Vec<PathBuf> = numbers.map(|n| numbered(file, n)).collect();
        files.push(file.to_owned());
        files.retain(|file| file.is_file());
        files.sort_unstable();
        files
    }
}

/// What tells a regular file from every other, whatever it is called.
#[derive(Debug, PartialEq, Eq)]
struct FileId {
    #[cfg(unix)]
    device_and_number: (u64, u64),
    #[cfg(not(unix))]
    path: PathBuf,
}

impl FileId {
    /// None for what is not there, and for what is no regular file: a pipe or a terminal is not written over.
    #[cfg(unix)]
    fn of(path: &Path) -> Option<Self> {
        use std::os::unix::fs::MetadataExt;
        let data = path.metadata().ok().filter(std::fs::Metadata::is_file)?;
        Some(Self { device_and_number: (data.dev(), data.ino()) })
    }

    /// None for what is not there, and for what is no regular file: a pipe or a terminal is not written over.
    #[cfg(not(unix))]
    fn of(path: &Path) -> Option<Self> {
        path.canonicalize().ok().filter(|path| path.is_file()).map(|path| Self { path })
    }
}
