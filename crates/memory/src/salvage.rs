//! What of a damaged memory can be read, entry by entry.
//!
//! Each entry is looked up by its number alone, since the file's indexes may be damaged where the entries are not.

use std::ops::RangeInclusive;
use std::path::Path;

use rusqlite::{Connection, OptionalExtension};
use typelift_model::LearnedModel;

use crate::error::MemoryErrorKind;
use crate::format;
use crate::log::{self, Entry, Kind};
use crate::logged::told;

/// The fewest bytes of a file that an entry takes.
const SMALLEST_ENTRY: u64 = 64;

/// The numbers of entries that cannot be read, and why.
pub(crate) type Unreadable = (RangeInclusive<i64>, String);

/// What can be read of a memory, and what cannot.
#[derive(Default)]
pub(crate) struct Salvaged {
    /// How scenes are read, if anything says it still.
    pub(crate) basis: Option<LearnedModel>,
    /// The entries that can be read, in order.
    pub(crate) entries: Vec<Entry>,
    /// What is wrong with the file's pages; all entries may be there for all that.
    pub(crate) pages: Option<String>,
    /// The entries that cannot be read.
    pub(crate) unreadable: Vec<Unreadable>,
    /// What else cannot be read.
    pub(crate) problems: Vec<String>,
}

impl Salvaged {
    /// Reads what can be read. Nothing in the file changes. In time of the file.
    pub(crate) fn read(file: &Path) -> Result<Self, MemoryErrorKind> {
        let (connection, _copy) = format::open_damaged(file)?;
        let mut found = Self { pages: pages(&connection), ..Self::default() };
        if found.pages.is_none() {
            let mut unreadable = found.read_entries(&connection, log::last(&connection)?);
            found.unreadable.append(&mut unreadable);
        } else {
            // What is said to be the last entry need not be, and what cannot be read behind the last that can need not be one.
            let unreadable = found.read_entries(&connection, most_entries(file));
            found.problems.extend(unreadable.first().map(|(_, why)| match found.entries.last() {
                None => format!("no entry can be read: {why}"),
                Some(last) => format!("no entry after {} can be read: {why}", last.number),
            }));
        }
        match read_basis(&connection) {
            Ok(basis) => found.basis = Some(basis),
            Err(kind) => {
                found.problems.push(format!("how scenes are read cannot be read where it stands: {}", why_of(0, kind)));
                found.basis = found.entries.iter().find_map(basis_of_entry);
            }
        }
        Ok(found)
    }

    /// Reads the entries up to this number. Gives what cannot be read behind the last that can.
    fn read_entries(&mut self, connection: &Connection, most: i64) -> Vec<Unreadable> {
        let mut unreadable: Vec<Unreadable> = Vec::new();
        for number in 1..=most {
            match entry(connection, number) {
                Ok(None) => {}
                Ok(Some(entry)) => {
                    self.unreadable.append(&mut unreadable);
                    self.entries.push(entry);
                }
                Err(kind) => {
                    let why = why_of(number, kind);
                    match unreadable.last_mut() {
                        Some((numbers, same)) if *numbers.end() == number - 1 && *same == why => {
                            *numbers = *numbers.start()..=number;
                        }
                        _ => unreadable.push((number..=number, why)),
                    }
                }
            }
        }
        unreadable
    }

    /// What cannot be read, in words.
    pub(crate) fn said(&self) -> Vec<String> {
        let unreadable = self.unreadable.iter().map(|(numbers, why)| match (numbers.start(), numbers.end()) {
            (first, last) if first == last => format!("entry {first} cannot be read: {why}"),
            (first, last) => format!("entries {first} to {last} cannot be read: {why}"),
        });
        unreadable.chain(self.problems.iter().cloned()).collect()
    }
}

/// What is wrong with the file's pages, in SQLite's words.
fn pages(connection: &Connection) -> Option<String> {
    let said = connection.prepare("PRAGMA integrity_check").and_then(|mut statement| {
        let lines = statement.query_map([], |row| row.get::<_, String>(0))?;
        lines.collect::<Result<Vec<_>, _>>()
    });
    let first = match said {
        // The first line says of which database.
        Ok(lines) => {
            let mut lines = lines.iter().flat_map(|line| line.lines());
            lines.find(|line| !line.starts_with("***")).filter(|line| *line != "ok")?.to_owned()
        }
        Err(error) => error.to_string(),
    };
    Some(format!("pages of the file are not in order: {first}"))
}

/// What is wrong with an entry of this number, without the number.
fn why_of(number: i64, kind: MemoryErrorKind) -> String {
    match kind {
        MemoryErrorKind::Damaged(why) => why.strip_prefix(&format!("entry {number}: ")).unwrap_or(&why).to_owned(),
        kind => kind.to_string(),
    }
}

/// The greatest number that an entry may have, by the size of the files.
fn most_entries(file: &Path) -> i64 {
    let bytes = |file: &Path| file.metadata().map_or(0, |data| data.len());
    let all = bytes(file) + bytes(&format::write_ahead_log(file));
    i64::try_from(all / SMALLEST_ENTRY).unwrap_or(i64::MAX)
}

/// An entry, if there is one of this number.
fn entry(connection: &Connection, number: i64) -> Result<Option<Entry>, MemoryErrorKind> {
    let query = "SELECT number, written, kind, episode, content FROM log NOT INDEXED WHERE number = ?1";
    let found = connection.query_row(query, [number], Entry::read).optional()?;
    found.map(|entry| told(entry.clone()).map(|_| entry)).transpose()
}

fn read_basis(connection: &Connection) -> Result<LearnedModel, MemoryErrorKind> {
    Ok(LearnedModel::from_json(&format::basis(connection)?)?)
}

/// What a model's evidence says of how scenes are read.
fn basis_of_entry(entry: &Entry) -> Option<LearnedModel> {
    if entry.kind != Kind::Evidence {
        return None;
    }
    let log::Evidence { model, .. } = entry.content().ok()?;
    LearnedModel::from_json(model.get()).ok()
}
