//! What people said, and what of it is taken back.

use std::collections::BTreeSet;

use rusqlite::Connection;
use typelift_world::Said;

use crate::error::MemoryErrorKind;
use crate::log::{self, Kind, Wanted, list};

/// What people said and was not taken back, each with its entry, in the order in which it was said.
pub(crate) fn words(connection: &Connection) -> Result<Vec<(i64, Said)>, MemoryErrorKind> {
    let taken_back = taken_back(connection)?;
    let said = list(connection, Wanted::Of(Kind::Said))?;
    let said = said.iter().filter(|entry| !taken_back.contains(&entry.number));
    said.map(|entry| Ok((entry.number, entry.content::<log::Said>()?.said))).collect()
}

/// The entries that were taken back themselves.
fn taken_back(connection: &Connection) -> Result<BTreeSet<i64>, MemoryErrorKind> {
    let mut all = BTreeSet::new();
    for entry in list(connection, Wanted::Of(Kind::Forgotten))? {
        let log::Forgotten { source, entries, .. } = entry.content()?;
        all.extend(entries.into_iter().filter(|_| source.is_none()));
    }
    Ok(all)
}
