//! Reading a file as text, and writing one so that it is never half written.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use crate::FileError;

/// Reads a file as UTF-8; a byte order mark at its start is dropped. Comments of PDDL may be in Latin-1.
///
/// # Errors
/// [`FileError`] if it cannot be read, or at the first byte that is not UTF-8.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    // Unlike a reader, this knows how much there will be.
    text_of(path, fs::read(path).map_err(|e| FileError::from_io(path, &e))?)
}

/// Reads whatever there is to read as [`read_text`] reads a file; errors call it `name`.
///
/// # Errors
/// [`FileError`] if it cannot be read, or at the first byte that is not UTF-8.
pub fn text_from(name: &Path, mut input: impl Read) -> Result<String, FileError> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes).map_err(|e| FileError::from_io(name, &e))?;
    text_of(name, bytes)
}

pub(crate) fn text_of(path: &Path, bytes: Vec<u8>) -> Result<String, FileError> {
    let mut text = String::from_utf8(bytes).or_else(|error| {
        if let Some(text) = with_latin1_comments(error.as_bytes()) {
            return Ok(text);
        }
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|&&b| b == b'\n').count();
        let line_start = valid.iter().rposition(|&b| b == b'\n').map_or(0, |at| at + 1);
        Err(not_utf8(path, line, valid.len() - line_start))
    })?;
    if text.starts_with('\u{FEFF}') {
        text.drain(..'\u{FEFF}'.len_utf8());
    }
    Ok(text)
}

/// PDDL whose comments, and nothing else, are in Latin-1: many an author's name is, in the benchmarks of the nineties.
fn with_latin1_comments(bytes: &[u8]) -> Option<String> {
    if !matches!(bytes.trim_ascii_start().first(), Some(b'(' | b';')) {
        return None;
    }
    let mut text = String::with_capacity(bytes.len() + 16);
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        let comment = line.iter().position(|&byte| byte == b';').unwrap_or(line.len());
        let (code, comment) = line.split_at(comment);
        text.push_str(std::str::from_utf8(code).ok()?);
        match std::str::from_utf8(comment) {
            Ok(comment) => text.push_str(comment),
            Err(_) => text.extend(comment.iter().copied().map(char::from)),
        }
    }
    Some(text)
}

/// The error about a line that is UTF-8 only up to the byte at `offset`.
pub(crate) fn not_utf8(path: &Path, line: usize, offset: usize) -> FileError {
    FileError::at_line(path, line, format!("this is not UTF-8 text from byte {} of the line on", offset + 1))
        .with_column(offset + 1)
        .with_hint("Save it as UTF-8.".to_owned())
}

/// Writes a file in one go: a reader sees the old content or the new, never a part. What is not a regular
/// file, as a pipe or a terminal, is written to directly. If the machine halts soon after, what was replaced is there in
/// one of the two; of a file that is new nothing may be.
///
/// # Errors
/// [`FileError`] if that fails; nothing is left behind then.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    replace(path, bytes).map_err(|error| FileError::from_write(path, &error))
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A link stays a link: what it leads to is replaced, or made.
    let missing = |_| fs::read_link(path).map(|to| path.parent().unwrap_or(Path::new("")).join(to));
    let target = fs::canonicalize(path).or_else(missing).unwrap_or_else(|_| path.to_owned());
    let existing = fs::metadata(&target).ok();
    if existing.as_ref().is_some_and(|data| !data.is_file()) {
        return OpenOptions::new().write(true).open(&target)?.write_all(bytes);
    }
    let (temporary, mut file) = create_beside(&target)?;
    let written = file.write_all(bytes).and_then(|()| match existing {
        // The old content is given up only when the new is on the disk; that takes milliseconds.
        Some(data) => file.set_permissions(data.permissions()).and_then(|()| file.sync_all()),
        None => Ok(()),
    });
    let done = written.and_then(|()| fs::rename(&temporary, &target));
    if done.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&temporary);
    }
    done
}

/// Writes a file that is not there yet. It is never found in part, and it is on the disk when this returns.
///
/// # Errors
/// Of kind `AlreadyExists` if there is something of this name.
pub(crate) fn write_new_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let (temporary, mut file) = create_beside(path)?;
    let written = file.write_all(bytes).and_then(|()| file.sync_all());
    let done = written.and_then(|()| match fs::hard_link(&temporary, path) {
        // Not every file system has links. There the name is taken first, and for a moment the file is empty.
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => {
            File::create_new(path).and_then(|_| fs::rename(&temporary, path))
        }
        linked => linked,
    });
    // After an error that one is to be reported; else it may be gone already.
    let _ = fs::remove_file(&temporary);
    if let (Ok(()), Some(Ok(folder))) = (&done, path.parent().map(File::open)) {
        // Not every system can put a folder's names on the disk.
        let _ = folder.sync_all();
    }
    done
}

/// A new file in the folder of `target`. It is locked as long as it is written, which tells it from what a program that was
/// killed left there; that is removed.
fn create_beside(target: &Path) -> io::Result<(PathBuf, File)> {
    let Some(name) = target.file_name() else {
        return Err(io::Error::other("this names no file"));
    };
    remove_temporaries(target.parent().unwrap_or(Path::new("")), |of| *of == *name.to_string_lossy());
    let mut attempt = 0_u32;
    loop {
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}-{attempt}.tmp", std::process::id()));
        let path = target.with_file_name(hidden);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => {
                // Not every file system knows locks; where there are none, nothing is taken for left behind.
                let _ = file.lock();
                // Somebody may have taken it for left behind before it was locked.
                if path.exists() {
                    return Ok((path, file));
                }
                attempt += 1;
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && attempt < 1000 => attempt += 1,
            Err(error) => return Err(error),
        }
    }
}

/// Removes what programs that were killed while they wrote files of a folder left there: `.table.csv.123-0.tmp`. What is
/// being written stays. If it fails they stay, which does no harm. It looks at every name in the folder.
pub fn remove_left_behind(folder: &Path) {
    remove_temporaries(folder, |_| true);
}

/// Removes what is left behind of files whose names are wanted.
fn remove_temporaries(folder: &Path, wanted: impl Fn(&str) -> bool) {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if !temporary_of(&entry.file_name().to_string_lossy()).is_some_and(&wanted) {
            continue;
        }
        let Ok(file) = OpenOptions::new().write(true).open(entry.path()) else { continue };
        if file.try_lock().is_ok() {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// The name of the file that a temporary file of this name stands for.
fn temporary_of(name: &str) -> Option<&str> {
    let (of, number) = name.strip_prefix('.')?.strip_suffix(".tmp")?.rsplit_once('.')?;
    let (process, attempt) = number.split_once('-')?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    (is_number(process) && is_number(attempt)).then_some(of)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(folder: &Path) -> usize {
        fs::read_dir(folder).expect("a folder").count()
    }

    #[test]
    fn a_file_is_replaced_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out.json");
        for text in ["one", "two"] {
            write_file(&path, text.as_bytes()).expect("written");
            assert_eq!(read_text(&path).as_deref(), Ok(text));
            assert_eq!(entries(folder.path()), 1);
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_and_devices_survive() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, link) = (folder.path().join("out"), folder.path().join("link"));
        write_file(&path, b"old").expect("written");
        std::os::unix::fs::symlink(&path, &link).expect("linked");
        write_file(&link, b"new").expect("written");
        assert_eq!(read_text(&path).as_deref(), Ok("new"));
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
        std::fs::remove_file(&path).expect("removed");
        write_file(&link, b"made").expect("written");
        assert_eq!(read_text(&path).as_deref(), Ok("made"));
        write_file(Path::new("/dev/null"), b"gone").expect("written");
        assert!(!fs::metadata("/dev/null").expect("there").is_file());
    }

    #[test]
    fn what_a_killed_program_left_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        let others = [".out.7.tmp", ".out.7-.tmp", ".other.7-0.tmp", "out.7-0.tmp", ".out.7-0.tmp.bak"];
        for name in [".out.7-0.tmp", ".out.8-12.tmp"].iter().chain(&others) {
            fs::write(path(name), "half").expect("written");
        }
        let being_written = File::create(path(".out.9-0.tmp")).expect("made");
        being_written.lock().expect("locked");
        write_file(&path("out"), b"whole").expect("written");
        let left = |names: &[&str]| names.iter().filter(|name| path(name).exists()).count();
        assert_eq!(
            (left(&[".out.7-0.tmp", ".out.8-12.tmp"]), left(&[".out.9-0.tmp"]), left(&others)),
            (0, 1, others.len())
        );
        remove_left_behind(folder.path());
        assert_eq!((left(&[".out.9-0.tmp"]), left(&others)), (1, others.len() - 1));
    }

    #[test]
    fn errors_name_the_path() {
        let folder = tempfile::tempdir().expect("a folder");
        let shown = folder.path().display();
        let missing = folder.path().join("no").join("out.json");
        let error = write_file(&missing, b"x").expect_err("no folder");
        assert_eq!(error.to_string(), format!("{shown}/no/out.json: there is no such folder to write to"));
        let error = read_text(&missing).expect_err("no file");
        assert_eq!(error.to_string(), format!("{shown}/no/out.json: there is no such file"));
        let error = read_text(folder.path()).expect_err("a folder");
        assert_eq!(error.to_string(), format!("{shown}: this is a folder, not a file"));
        let error = write_file(folder.path(), b"x").expect_err("a folder");
        assert_eq!(error.to_string(), format!("{shown}: this is a folder, not a file"));
    }

    #[test]
    fn text_is_utf8() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        write_file(&path, b"\xEF\xBB\xBFtext").expect("written");
        assert_eq!(read_text(&path).as_deref(), Ok("text"));
        write_file(&path, b"one\ntwo \xFF").expect("written");
        let error = read_text(&path).expect_err("not UTF-8");
        let shown = path.display();
        assert_eq!(error.to_string(), format!("{shown}:2:5: this is not UTF-8 text from byte 5 of the line on"));
    }

    #[test]
    fn comments_of_pddl_may_be_latin1() {
        let read = |bytes: &[u8]| text_of(Path::new("a"), bytes.to_vec()).map_err(|error| error.to_string());
        assert_eq!(read(b" ; J\xF6rg\n(define) ; \xE9\n").as_deref(), Ok(" ; J\u{F6}rg\n(define) ; \u{E9}\n"));
        // In a line of its own each is what it says it is.
        assert_eq!(read(b"(a) ; \xC3\xB6\n; \xF6").as_deref(), Ok("(a) ; \u{F6}\n; \u{F6}"));
        let wrong = Err("a:1:2: this is not UTF-8 text from byte 2 of the line on".to_owned());
        assert_eq!(read(b"(\xF6) ; o"), wrong);
        assert_eq!(read(b"\"\xF6;\""), wrong);
    }
}
