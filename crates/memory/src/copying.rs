//! Entries of one log in another: under new numbers, with what they say of other entries.

use std::collections::BTreeMap;

use rusqlite::{Connection, params};
use serde_json::Value;

use crate::error::MemoryErrorKind;
use crate::log::{Entry, Kind};

/// Which number each entry has in the other log.
pub(crate) type Numbers = BTreeMap<i64, i64>;

/// An entry as it is in the other log. What it says of entries that are not there is left out; there is none of one that is
/// not there, nor of one that speaks of none that is.
pub(crate) fn renumbered(entry: &Entry, numbers: &Numbers) -> Result<Option<Entry>, MemoryErrorKind> {
    let Some(number) = numbers.get(&entry.number).copied() else { return Ok(None) };
    let episode = entry.episode.map(|episode| numbers.get(&episode).copied());
    if episode == Some(None) {
        return Ok(None);
    }
    let entry = Entry { number, episode: episode.flatten(), ..entry.clone() };
    if entry.kind != Kind::Forgotten {
        return Ok(Some(entry));
    }
    let mut content: Value = entry.content()?;
    let named = content["entries"].as_array().into_iter().flatten().filter_map(Value::as_i64);
    let mut named: Vec<i64> = named.filter_map(|number| numbers.get(&number).copied()).collect();
    named.sort_unstable();
    named.dedup();
    let is_about_something = !named.is_empty();
    content["entries"] = named.into();
    Ok(is_about_something.then(|| Entry { content: content.to_string(), ..entry }))
}

/// Writes an entry as it is, with its number and when it was written.
pub(crate) fn write(to: &Connection, entry: &Entry) -> Result<(), MemoryErrorKind> {
    to.execute(
        "INSERT INTO log (number, written, kind, episode, content) VALUES (?1, ?2, ?3, ?4, ?5)",
        params![entry.number, entry.written, entry.kind.word(), entry.episode, entry.content],
    )?;
    Ok(())
}
