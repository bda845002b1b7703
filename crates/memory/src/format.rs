//! The file: which tables it has, and how one is made and opened.
//!
//! It is a SQLite database with a write-ahead log, so that a reader does not wait for a writer, and each entry is on the
//! disk when it was appended. `application_id` says that it is a memory, `user_version` of which version.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, OpenFlags, TransactionBehavior};

use tempfile::TempDir;

use crate::error::MemoryErrorKind;
use crate::migration::{is_readable, migrate};
use crate::version::VERSION;

/// `tlmy`: what tells a memory from other databases.
const APPLICATION: i64 = 0x746c_6d79;

/// How long another writer is waited for. One entry takes it milliseconds.
const PATIENCE: Duration = Duration::from_secs(5);

/// `written` is for people: nothing reads it but what lists the entries.
const TABLES: &str = "
CREATE TABLE basis (model TEXT NOT NULL) STRICT;
CREATE TABLE log (
    number INTEGER PRIMARY KEY,
    written TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
    kind TEXT NOT NULL,
    episode INTEGER REFERENCES log (number),
    content TEXT NOT NULL
) STRICT;
CREATE INDEX log_by_kind ON log (kind);
CREATE INDEX log_by_episode ON log (episode) WHERE episode IS NOT NULL;
CREATE TRIGGER basis_stays BEFORE UPDATE ON basis BEGIN SELECT RAISE (ABORT, 'the basis of a memory never changes'); END;
CREATE TRIGGER log_stays BEFORE UPDATE ON log BEGIN SELECT RAISE (ABORT, 'entries never change'); END;
CREATE TRIGGER log_keeps BEFORE DELETE ON log BEGIN SELECT RAISE (ABORT, 'entries are never removed'); END;
CREATE TABLE fold (up_to INTEGER NOT NULL, program TEXT NOT NULL, model TEXT NOT NULL) STRICT;
";

/// What a memory is opened for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// To read it. Nothing in it changes.
    Read,
    /// To append to it as well.
    Write,
}

/// How every SQLite database begins.
const DATABASE: &[u8] = b"SQLite format 3\0";

/// Whether a file is a database, and so a memory if it is anything of typelift's. Only the beginning of a regular file is read.
pub fn looks_like_memory(file: &Path) -> bool {
    let begins = |file: &Path| -> std::io::Result<bool> {
        let mut first = [0; DATABASE.len()];
        File::open(file)?.read_exact(&mut first)?;
        Ok(first == DATABASE)
    };
    file.is_file() && begins(file).unwrap_or(false)
}

/// Opens a memory that is there.
pub(crate) fn open(path: &Path, access: Access) -> Result<Connection, MemoryErrorKind> {
    if path.is_dir() {
        return Err(MemoryErrorKind::CannotOpen("this is a folder, not a file".to_owned()));
    }
    if !path.exists() {
        return Err(MemoryErrorKind::Missing);
    }
    // What may be written is opened so even to be read: else the files beside it would stay.
    let mut connection = connect(path, OpenFlags::SQLITE_OPEN_READ_WRITE)?;
    let is_there = match is_memory(&connection) {
        Err(MemoryErrorKind::CannotOpen(_) | MemoryErrorKind::ReadOnly)
            if access == Access::Read && !write_ahead_log(path).exists() =>
        {
            connection = connect_immutable(path)?;
            is_memory(&connection)?
        }
        is_there => is_there?,
    };
    if !is_there {
        return Err(MemoryErrorKind::Missing);
    }
    match access {
        Access::Read => connection.pragma_update(None, "query_only", true)?,
        Access::Write if connection.is_readonly("main")? => return Err(MemoryErrorKind::ReadOnly),
        Access::Write => {
            durable(&connection)?;
            migrate(&mut connection)?;
        }
    }
    Ok(connection)
}

/// Makes a memory with this basis, in one go. If another program makes it at the same time, that one's is opened.
pub(crate) fn create(path: &Path, basis: &str) -> Result<Connection, MemoryErrorKind> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if folder.is_some_and(|folder| !folder.is_dir()) {
        return Err(MemoryErrorKind::CannotOpen("there is no such folder to write to".to_owned()));
    }
    let mut connection = connect(path, OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_CREATE)?;
    if is_memory(&connection)? {
        durable(&connection)?;
        migrate(&mut connection)?;
        return Ok(connection);
    }
    durable(&connection)?;
    let transaction = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
    if !is_memory(&transaction)? {
        transaction.execute_batch(TABLES)?;
        transaction.execute("INSERT INTO basis (model) VALUES (?1)", [basis])?;
        transaction.pragma_update(None, "application_id", APPLICATION)?;
        transaction.pragma_update(None, "user_version", VERSION)?;
    }
    transaction.commit()?;
    Ok(connection)
}

/// Makes a memory with this basis and what `fill` writes to it, where there is nothing yet. If that fails there is still
/// nothing.
pub(crate) fn create_filled(
    path: &Path,
    basis: &str,
    fill: impl FnOnce(&Connection) -> Result<(), MemoryErrorKind>,
) -> Result<(), MemoryErrorKind> {
    if path.symlink_metadata().is_ok() {
        return Err(MemoryErrorKind::Exists);
    }
    let filled = create(path, basis).and_then(|mut connection| {
        let transaction = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        fill(&transaction)?;
        Ok(transaction.commit()?)
    });
    if filled.is_err() {
        for file in ["", "-wal", "-shm"] {
            let mut name = path.as_os_str().to_owned();
            name.push(file);
            // What was not made cannot be removed.
            let _ = std::fs::remove_file(name);
        }
    }
    filled
}

/// The model without evidence that says how scenes are read.
pub(crate) fn basis(connection: &Connection) -> Result<String, MemoryErrorKind> {
    Ok(connection.query_row("SELECT model FROM basis", [], |row| row.get(0))?)
}

/// The file beside a memory that holds what was written last, as long as it is open or after the program was killed.
pub(crate) fn write_ahead_log(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push("-wal");
    name.into()
}

/// A damaged memory, to read what can be read: nothing in it changes. What was written last is read too, from a copy of both
/// files, which is gone when the folder is dropped.
pub(crate) fn open_damaged(path: &Path) -> Result<(Connection, Option<TempDir>), MemoryErrorKind> {
    if !looks_like_memory(path) {
        return Err(if path.is_file() { MemoryErrorKind::NotAMemory } else { MemoryErrorKind::Missing });
    }
    let log = write_ahead_log(path);
    let (connection, folder) = if log.exists() {
        let unreadable = |error: std::io::Error| MemoryErrorKind::CannotOpen(error.to_string());
        let folder = tempfile::tempdir().map_err(unreadable)?;
        let copy = folder.path().join("memory");
        std::fs::copy(path, &copy).map_err(unreadable)?;
        std::fs::copy(log, write_ahead_log(&copy)).map_err(unreadable)?;
        (connect(&copy, OpenFlags::SQLITE_OPEN_READ_WRITE)?, Some(folder))
    } else {
        (connect_immutable(path)?, None)
    };
    // Else a file that was cut off is not even looked into.
    connection.pragma_update(None, "writable_schema", true)?;
    let number = |pragma| connection.pragma_query_value(None, pragma, |row| row.get::<_, i64>(0));
    match (number("application_id")?, number("user_version")?) {
        (APPLICATION, found) if is_readable(found) => Ok((connection, folder)),
        (APPLICATION, found) => Err(MemoryErrorKind::Version { found }),
        _ => Err(MemoryErrorKind::NotAMemory),
    }
}

/// Opens what lies where nothing can be written, not even beside it, so that nobody else can write it.
fn connect_immutable(path: &Path) -> Result<Connection, MemoryErrorKind> {
    let name = path.to_str().ok_or_else(|| MemoryErrorKind::CannotOpen("its name is not UTF-8".to_owned()))?;
    let name = name.replace('%', "%25").replace('?', "%3f").replace('#', "%23");
    let address = format!("file:{name}?immutable=1");
    connect(Path::new(&address), OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI)
}

fn connect(path: &Path, flags: OpenFlags) -> Result<Connection, MemoryErrorKind> {
    let connection = Connection::open_with_flags(path, flags | OpenFlags::SQLITE_OPEN_NO_MUTEX)?;
    connection.busy_timeout(PATIENCE)?;
    Ok(connection)
}

/// An entry that was appended is on the disk.
fn durable(connection: &Connection) -> Result<(), MemoryErrorKind> {
    connection.pragma_update(None, "journal_mode", "wal")?;
    connection.pragma_update(None, "synchronous", "full")?;
    connection.pragma_update(None, "foreign_keys", true)?;
    Ok(())
}

/// Whether it is a memory, or else empty: a program that was killed while it made one leaves nothing in it.
fn is_memory(connection: &Connection) -> Result<bool, MemoryErrorKind> {
    let number = |pragma| connection.pragma_query_value(None, pragma, |row| row.get::<_, i64>(0));
    let tables: i64 = connection.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))?;
    match (number("application_id")?, tables) {
        (0, 0) => Ok(false),
        (APPLICATION, _) => match number("user_version")? {
            found if is_readable(found) => Ok(true),
            found => Err(MemoryErrorKind::Version { found }),
        },
        _ => Err(MemoryErrorKind::NotAMemory),
    }
}
