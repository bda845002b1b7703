//! An object, taken back with all that was done with it and said of it.

use rusqlite::Connection;
use typelift_model::{GroundCall, Symbol};
use typelift_world::{TraceAction, source_of};

use crate::error::MemoryErrorKind;
use crate::fold::taken_back;
use crate::log::{self, Entry, Kind, Wanted, append, list, trace_text};
use crate::words::words;

/// What was taken back with an object.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct OfObject {
    /// Episodes.
    pub episodes: usize,
    /// Words.
    pub words: usize,
}

/// Appends that everything of an object is taken back.
pub(crate) fn forget_object(
    connection: &Connection,
    object: &Symbol,
    instance: Option<&Symbol>,
) -> Result<OfObject, MemoryErrorKind> {
    let forget = |source, entries| {
        append(connection, Kind::Forgotten, None, &log::Forgotten { source, entries, object: Some(object.clone()) })
    };
    let mut found = OfObject::default();
    let known = taken_back(connection)?;
    let mut steps = list(connection, Wanted::Of(Kind::Stepped))?;
    steps.sort_by_key(|step| step.episode);
    for begun in list(connection, Wanted::Of(Kind::Begun))? {
        let is_meant =
            instance.is_none_or(|instance| begun.content::<log::Begun>().is_ok_and(|b| b.instance == *instance));
        if !is_meant || known.iter().any(|(number, _)| *number == begun.number) {
            continue;
        }
        let first = steps.partition_point(|step| step.episode < Some(begun.number));
        let own = steps[first..].iter().take_while(|step| step.episode == Some(begun.number));
        for step in own {
            if takes_part(step, object)? {
                let source = source_of(trace_text(connection, begun.number)?.as_bytes());
                forget(Some(source), vec![begun.number])?;
                found.episodes += 1;
                break;
            }
        }
    }
    let is_about = |call: &GroundCall| call.args.contains(object);
    for (entry, said) in words(connection)? {
        if instance.is_none_or(|instance| said.instance == *instance) && said.call.as_ref().is_some_and(is_about) {
            forget(None, vec![entry])?;
            found.words += 1;
        }
    }
    if found == OfObject::default() { Err(MemoryErrorKind::NoSuchObject(object.clone())) } else { Ok(found) }
}

/// Whether a step was done with an object, or was meant to be.
fn takes_part(step: &Entry, object: &Symbol) -> Result<bool, MemoryErrorKind> {
    let log::Stepped { action, .. } = step.content()?;
    let Some(action) = TraceAction::from_line(action.get())? else { return Ok(false) };
    Ok(action.call.args.contains(object) || action.expected.is_some_and(|expected| expected.args.contains(object)))
}
