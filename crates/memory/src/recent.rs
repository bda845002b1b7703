//! What was done last, episode by episode.

use std::collections::BTreeSet;

use rusqlite::Connection;
use typelift_model::{LearnedModel, SourceId, Symbol};
use typelift_world::Trace;

use crate::error::MemoryErrorKind;
use crate::fold::{read_trace, taken_back};
use crate::log::{self, Kind, Wanted, list, trace_text};

/// An episode of a memory, up to where it ended or the environment was set back.
#[derive(Debug, Clone, PartialEq)]
pub struct PastEpisode {
    /// The source that it is.
    pub source: SourceId,
    /// The instance of the world.
    pub instance: Symbol,
    /// What was done and observed.
    pub trace: Trace,
    /// Whether it is the same task as in the episode before it, after the environment was set back.
    pub goes_on: bool,
}

/// The last episodes that can be read and were not taken back, so many tasks of them, in the order in which they began.
pub(crate) fn recent(
    connection: &Connection,
    basis: &LearnedModel,
    tasks: usize,
) -> Result<Vec<PastEpisode>, MemoryErrorKind> {
    let taken_back = taken_back(connection)?;
    let begun = list(connection, Wanted::Of(Kind::Begun))?;
    let set_back: BTreeSet<i64> = list(connection, Wanted::Of(Kind::Ended))?
        .into_iter()
        .filter_map(|entry| match entry.content::<log::Ended>() {
            Ok(ended) if ended.how == log::SET_BACK => entry.episode,
            _ => None,
        })
        .collect();
    let mut found = Vec::new();
    let mut left = tasks;
    for (at, entry) in begun.iter().enumerate().rev() {
        if left == 0 {
            break;
        }
        let goes_on = at > 0 && set_back.contains(&begun[at - 1].number);
        left -= usize::from(!goes_on);
        if taken_back.iter().any(|(number, _)| *number == entry.number) {
            continue;
        }
        let log::Begun { instance, .. } = entry.content()?;
        let Ok(trace) = read_trace(&trace_text(connection, entry.number)?, entry.number, basis) else { continue };
        let source = trace.source_id(&basis.model.hierarchy);
        found.push(PastEpisode { source, instance, trace, goes_on });
    }
    found.reverse();
    Ok(found)
}
