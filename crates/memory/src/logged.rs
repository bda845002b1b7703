//! The log as it is told: what each entry says.

use rusqlite::Connection;
use typelift_model::{SourceId, Symbol};
use typelift_world::{Said, TraceAction, TraceHeader};

use crate::error::MemoryErrorKind;
use crate::log::{self, Entry, Kind, ProposedStep, Wanted, list};

/// An entry of the log.
#[derive(Debug, Clone, PartialEq)]
pub struct Logged {
    /// Its number, from 1; numbers only grow.
    pub number: i64,
    /// When it was written, in UTC, as the system's clock had it. Nothing follows from it.
    pub written: String,
    /// The entry with which the episode began that it belongs to.
    pub episode: Option<i64>,
    /// What it says.
    pub what: What,
}

/// What an entry says.
#[derive(Debug, Clone, PartialEq)]
pub enum What {
    /// What a model was learned from was added.
    Evidence {
        /// What the model was called.
        model: String,
        /// How many sources of it were new.
        sources: usize,
    },
    /// An episode began, or began anew after the environment was set back.
    Begun {
        /// What the environment calls itself.
        environment: String,
        /// The instance of the world.
        instance: Symbol,
        /// The task and its goal.
        header: TraceHeader,
    },
    /// Something was done.
    Stepped(Box<TraceAction>),
    /// An episode ended.
    Ended {
        /// How, in a word.
        how: String,
        /// The source that it is.
        source: SourceId,
    },
    /// A plan was proposed.
    Proposed {
        /// The task's name.
        task: String,
        /// Its steps.
        steps: Vec<ProposedStep>,
    },
    /// A person said something.
    Said {
        /// The task's name.
        task: String,
        /// What.
        said: Box<Said>,
    },
    /// Something was taken back.
    Forgotten {
        /// The source; none if it is what a person said.
        source: Option<SourceId>,
        /// The entries from which it was known, or that are taken back themselves.
        entries: Vec<i64>,
        /// The object because of which it was.
        object: Option<Symbol>,
    },
}

/// All entries, in order.
pub(crate) fn logged(connection: &Connection) -> Result<Vec<Logged>, MemoryErrorKind> {
    list(connection, Wanted::All)?.into_iter().map(told).collect()
}

pub(crate) fn told(entry: Entry) -> Result<Logged, MemoryErrorKind> {
    let what = match entry.kind {
        Kind::Evidence => {
            let log::Evidence { name, sources, .. } = entry.content()?;
            What::Evidence { model: name, sources: sources.len() }
        }
        Kind::Begun => {
            let log::Begun { environment, instance, header, .. } = entry.content()?;
            What::Begun { environment, instance, header: TraceHeader::from_line(header.get())? }
        }
        Kind::Stepped => {
            let log::Stepped { action, .. } = entry.content()?;
            let none = || MemoryErrorKind::Damaged(format!("entry {} has no action", entry.number));
            What::Stepped(Box::new(TraceAction::from_line(action.get())?.ok_or_else(none)?))
        }
        Kind::Ended => {
            let log::Ended { how, source } = entry.content()?;
            What::Ended { how, source }
        }
        Kind::Proposed => {
            let log::Proposed { task, steps } = entry.content()?;
            What::Proposed { task, steps }
        }
        Kind::Said => {
            let log::Said { task, said } = entry.content()?;
            What::Said { task, said: Box::new(said) }
        }
        Kind::Forgotten => {
            let log::Forgotten { source, entries, object } = entry.content()?;
            What::Forgotten { source, entries, object }
        }
    };
    Ok(Logged { number: entry.number, written: entry.written, episode: entry.episode, what })
}
