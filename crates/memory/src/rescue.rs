//! What of a damaged memory can be read, as a new one.
//!
//! An episode counts up to the first of its entries that cannot be read. One whose entries can all be read, and yet are not
//! those whose SHA-256 was written when it ended, is left out: any of them may be wrong.

use std::collections::BTreeMap;
use std::path::Path;

use crate::copying::write;
use crate::error::{MemoryError, MemoryErrorKind};
use crate::format;
use crate::log::{self, Entry, Kind, TraceWriter};
use crate::memory::basis_of;
use crate::salvage::Salvaged;
use typelift_world::source_of;

/// What became of a damaged memory.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Rescued {
    /// The entries of the new memory.
    pub entries: usize,
    /// What is lost, each in a sentence.
    pub lost: Vec<String>,
}

/// Writes what can be read of a memory to a new one, each entry under its number. The damaged one stays as it is. In time and
/// memory of the file.
///
/// # Errors
/// [`MemoryError`] if nothing of it can be read, or there is a file already where the new one is to be.
pub fn rescue(file: &Path, into: &Path) -> Result<Rescued, MemoryError> {
    let found = Salvaged::read(file).map_err(|kind| kind.of(file))?;
    let Some(basis) = &found.basis else {
        let why = "neither how scenes are read nor any model's evidence can be read".to_owned();
        return Err(MemoryErrorKind::Damaged(why).of(file));
    };
    let mut lost = found.said();
    let entries = whole(&found, &mut lost);
    if entries.is_empty() && !lost.is_empty() {
        return Err(MemoryErrorKind::Damaged(format!("nothing of it can be saved: {}", lost[0])).of(file));
    }
    let text = basis_of(basis).to_json().map_err(|error| MemoryErrorKind::from(error).of(into))?;
    let filled = format::create_filled(into, &text, |to| entries.iter().try_for_each(|entry| write(to, entry)));
    filled.map_err(|kind| kind.of(into))?;
    Ok(Rescued { entries: entries.len(), lost })
}

/// What makes sense without what cannot be read.
fn whole<'f>(found: &'f Salvaged, lost: &mut Vec<String>) -> Vec<&'f Entry> {
    let mut episodes: BTreeMap<i64, Vec<&Entry>> = BTreeMap::new();
    let mut kept: BTreeMap<i64, &Entry> = BTreeMap::new();
    for entry in &found.entries {
        match (entry.kind, entry.episode) {
            (Kind::Begun, _) => episodes.entry(entry.number).or_default().push(entry),
            (_, Some(episode)) => episodes.entry(episode).or_default().push(entry),
            (_, None) => drop(kept.insert(entry.number, entry)),
        }
    }
    for (episode, entries) in episodes {
        let all = entries.len();
        let rest = match entries.first() {
            Some(first) if first.kind == Kind::Begun => readable(entries, found),
            _ => Err("its beginning cannot be read".to_owned()),
        };
        match rest {
            Ok(rest) => {
                if let (true, Some(last)) = (rest.len() < all, rest.last()) {
                    lost.push(format!("the episode of entry {episode} is kept up to entry {}", last.number));
                }
                kept.extend(rest.into_iter().map(|entry| (entry.number, entry)));
            }
            Err(why) => lost.push(format!("the episode of entry {episode} is lost: {why}")),
        }
    }
    kept.into_values().collect()
}

/// The entries of an episode up to the first that is missing or wrong; or why there are none.
fn readable<'f>(mut entries: Vec<&'f Entry>, found: &Salvaged) -> Result<Vec<&'f Entry>, String> {
    let mut trace = TraceWriter::default();
    let fit = entries.iter().take_while(|entry| trace.add(entry).is_ok()).count();
    let ended = entries.last().filter(|last| last.kind == Kind::Ended);
    let ended = ended.and_then(|last| last.content::<log::Ended>().ok());
    if fit == entries.len() && ended.as_ref().is_some_and(|ended| ended.source == source_of(trace.text.as_bytes())) {
        return Ok(entries);
    }
    let (first, last) = (entries[0].number, entries[entries.len() - 1].number);
    let gap = found.unreadable.iter().map(|(numbers, _)| *numbers.start()).find(|start| (first..last).contains(start));
    if fit == entries.len() && gap.is_none() && ended.is_some() {
        return Err("its trace is not as it was written".to_owned());
    }
    entries.truncate(fit);
    entries.retain(|entry| gap.is_none_or(|gap| entry.number < gap) && entry.kind != Kind::Ended);
    if entries.is_empty() { Err("nothing of it can be read".to_owned()) } else { Ok(entries) }
}
