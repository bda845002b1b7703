//! From the log to the evidence: a sum over its entries, in which their order does not matter.
//!
//! Each model's evidence and each episode contributes its sources; an episode is one, known by the hash of its trace as a
//! recorder would have written it, so that the same trace counts once however it came. What was taken back contributes
//! nothing. Once an episode has ended its entries never change, so the sum over all that has ended is kept, up to
//! an entry, and only what came after is added.

use std::collections::BTreeSet;
use std::fmt;
use std::path::Path;

use rusqlite::{Connection, OptionalExtension};
use typelift_learn::observe_trace;
use typelift_model::{Evidence, LearnedModel, SourceId};
use typelift_world::{FileError, Parser, Trace, TraceReader, source_of, trace_from};

use crate::error::MemoryErrorKind;
use crate::log::{self, Kind, Wanted, list, trace_name, trace_text};

/// The program whose folds are trusted: another one may learn otherwise from the same log.
pub(crate) const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// The sum over the log up to an entry, of episodes that had ended by then.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fold {
    pub(crate) up_to: i64,
    pub(crate) evidence: Evidence,
}

/// Something in a memory that nothing is learned from, or not all of it, since it is not as a trace must be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// The entry with which the episode began, or that holds a model's evidence.
    pub entry: i64,
    /// What is wrong.
    pub why: String,
    /// Whether what was before that counts.
    pub partly: bool,
}

impl fmt::Display for Unread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { entry, why, partly } = self;
        let learned = if *partly { "not all is learned" } else { "nothing is learned" };
        write!(f, "{learned} from entry {entry}: {why}")
    }
}

/// Everything that the log says now.
pub(crate) struct Sum {
    pub(crate) evidence: Evidence,
    pub(crate) unread: Vec<Unread>,
}

impl Fold {
    /// Adds what was written since, and gives the sum with the episodes that have not ended. `basis` says how scenes are
    /// read. In time of what was written since, and of the episodes that never ended.
    pub(crate) fn go_on(&mut self, connection: &Connection, basis: &LearnedModel) -> Result<Sum, MemoryErrorKind> {
        if forgets_in_part(connection, self.up_to)? {
            *self = Self::default();
        }
        let from = self.up_to;
        let last = log::last(connection)?;
        let mut unread = Vec::new();
        let taken_back = taken_back(connection)?;
        // First, since what was seen again after it was taken back counts again.
        for entry in list(connection, Wanted::After(Kind::Forgotten, from))? {
            let log::Forgotten { source, entries, .. } = entry.content()?;
            if let Some(source) = source.filter(|_| entries.iter().any(|entry| *entry <= from)) {
                // What never was compact is not compact now.
                let _ = self.evidence.take_out(source);
            }
        }
        for entry in list(connection, Wanted::After(Kind::Evidence, from))? {
            let evidence = model_evidence(&entry, &taken_back)?;
            self.add(entry.number, &evidence, &mut unread);
        }
        for entry in list(connection, Wanted::After(Kind::Ended, from))? {
            let episode = entry.episode.unwrap_or_default();
            if taken_back.iter().any(|(number, _)| *number == episode) {
                continue;
            }
            let log::Ended { source, .. } = entry.content()?;
            let shown = episode_evidence(connection, episode, basis)?;
            if shown.source == source {
                self.add(episode, &shown.evidence, &mut unread);
                unread.extend(shown.unread);
            } else {
                let why = "its trace is not as it was written".to_owned();
                unread.push(Unread { entry: episode, why, partly: false });
            }
        }
        self.up_to = last;
        let mut sum = Self { up_to: last, evidence: self.evidence.clone() };
        for episode in under_way(connection)? {
            if taken_back.iter().any(|(number, _)| *number == episode) {
                continue;
            }
            let shown = episode_evidence(connection, episode, basis)?;
            sum.add(episode, &shown.evidence, &mut unread);
            unread.extend(shown.unread);
        }
        Ok(Sum { evidence: sum.evidence, unread })
    }

    fn add(&mut self, entry: i64, evidence: &Evidence, unread: &mut Vec<Unread>) {
        if let Err(error) = self.evidence.merge(evidence) {
            unread.push(Unread { entry, why: error.to_string(), partly: false });
        }
    }
}

/// Whether something that was summed up already was taken back later, and may be known from elsewhere, too.
fn forgets_in_part(connection: &Connection, up_to: i64) -> Result<bool, MemoryErrorKind> {
    for entry in list(connection, Wanted::After(Kind::Forgotten, up_to))? {
        let log::Forgotten { object, entries, .. } = entry.content()?;
        if object.is_some() && entries.iter().any(|entry| *entry <= up_to) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The evidence of a model, without what was taken back of it.
fn model_evidence(entry: &log::Entry, taken_back: &BTreeSet<(i64, SourceId)>) -> Result<Evidence, MemoryErrorKind> {
    let log::Evidence { model, .. } = entry.content()?;
    let mut evidence = LearnedModel::from_json(model.get())?.evidence;
    for (_, source) in taken_back.iter().filter(|(number, _)| *number == entry.number) {
        let _ = evidence.take_out(*source);
    }
    Ok(evidence)
}

/// Which sources of which entries were taken back.
pub(crate) fn taken_back(connection: &Connection) -> Result<BTreeSet<(i64, SourceId)>, MemoryErrorKind> {
    let mut all = BTreeSet::new();
    for entry in list(connection, Wanted::Of(Kind::Forgotten))? {
        let log::Forgotten { source, entries, .. } = entry.content()?;
        all.extend(source.into_iter().flat_map(|source| entries.iter().map(move |number| (*number, source))));
    }
    Ok(all)
}

/// The episodes that have not ended: under way, or broken off when the program was killed.
pub(crate) fn under_way(connection: &Connection) -> Result<Vec<i64>, MemoryErrorKind> {
    let mut statement = connection.prepare(
        "SELECT number FROM log AS begun WHERE kind = 'begun' AND NOT EXISTS
         (SELECT 1 FROM log WHERE episode = begun.number AND kind = 'ended') ORDER BY number",
    )?;
    let numbers = statement.query_map([], |row| row.get(0))?;
    Ok(numbers.collect::<Result<_, _>>()?)
}

pub(crate) fn read_trace(text: &str, episode: i64, basis: &LearnedModel) -> Result<Trace, FileError> {
    let mut parser = Parser::new(basis.model.hierarchy.clone(), basis.parse.clone());
    let place = format!("episode {episode}");
    let reader = TraceReader::new(Path::new(&place), text.as_bytes())?;
    let mut trace = trace_from(Path::new(&place), reader, &mut parser)?;
    trace.file = Some(trace_name(&trace));
    Ok(trace)
}

/// What an episode shows, as the one source that it is.
struct Shown {
    source: SourceId,
    evidence: Evidence,
    /// Why not all of it is learned from, if so.
    unread: Option<Unread>,
}

fn episode_evidence(connection: &Connection, episode: i64, basis: &LearnedModel) -> Result<Shown, MemoryErrorKind> {
    let text = trace_text(connection, episode)?;
    let source = source_of(text.as_bytes());
    let (trace, unread) = match read_trace(&text, episode, basis) {
        Ok(trace) => (Some(trace), None),
        Err(error) => {
            let before = read_trace(before(&text, error.line), episode, basis).ok();
            let unread = Unread { entry: episode, why: error.to_string(), partly: before.is_some() };
            (before, Some(unread))
        }
    };
    let hierarchy = &basis.model.hierarchy;
    let shown = trace.map(|trace| (source, trace_name(&trace), observe_trace(&trace, hierarchy)));
    Ok(Shown { source, evidence: shown.into_iter().collect(), unread })
}

/// A trace up to the last state before a line, from 1: there are states in every other line.
fn before(text: &str, line: Option<u32>) -> &str {
    let lines = line.unwrap_or_default().saturating_sub(1) / 2 * 2;
    let end = text.match_indices('\n').nth((lines as usize).saturating_sub(1)).map_or(0, |(at, _)| at + 1);
    &text[..end]
}

/// The sum that the file keeps, with what was learned from it, if this program made it.
pub(crate) fn kept_fold(connection: &Connection) -> Result<Option<(Fold, LearnedModel)>, MemoryErrorKind> {
    let query = "SELECT up_to, model FROM fold WHERE program = ?1";
    let kept = connection.query_row(query, [PROGRAM], |row| Ok((row.get(0)?, row.get::<_, String>(1)?)));
    let Some((up_to, model)) = kept.optional()? else { return Ok(None) };
    // What can be summed up again does no harm.
    let Ok(learned) = LearnedModel::from_json(&model) else { return Ok(None) };
    Ok(Some((Fold { up_to, evidence: learned.evidence.clone() }, learned)))
}
