//! The log: what is appended, and how it is read back.

use rusqlite::types::Type;
use rusqlite::{Connection, Row, params};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use typelift_model::{GroundCall, SourceId, Symbol};
use typelift_world::{Scene, Trace, TraceLine};

use crate::error::MemoryErrorKind;
use crate::scene_change::SceneChange;

/// What an entry is about: the column `kind`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Kind {
    /// What a model was learned from: [`Evidence`].
    Evidence,
    /// An episode begins, or goes on from a new beginning: [`Begun`].
    Begun,
    /// A step of an episode: [`Stepped`].
    Stepped,
    /// An episode ends: [`Ended`].
    Ended,
    /// A plan is proposed: [`Proposed`].
    Proposed,
    /// A person said something: [`Said`].
    Said,
    /// Something is taken back: [`Forgotten`].
    Forgotten,
}

impl Kind {
    const ALL: [Self; 7] =
        [Self::Evidence, Self::Begun, Self::Stepped, Self::Ended, Self::Proposed, Self::Said, Self::Forgotten];

    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::Evidence => "evidence",
            Self::Begun => "begun",
            Self::Stepped => "stepped",
            Self::Ended => "ended",
            Self::Proposed => "proposed",
            Self::Said => "said",
            Self::Forgotten => "forgotten",
        }
    }
}

/// What of a model's evidence was not known before.
#[derive(Serialize, Deserialize)]
pub(crate) struct Evidence {
    /// What the model was called.
    pub(crate) name: String,
    pub(crate) sources: Vec<SourceId>,
    /// A model file with this evidence and without actions.
    pub(crate) model: Box<RawValue>,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct Begun {
    pub(crate) environment: String,
    pub(crate) instance: Symbol,
    /// The first line of the trace.
    pub(crate) header: Box<RawValue>,
    pub(crate) scene: Scene,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct Stepped {
    /// The line of the trace.
    pub(crate) action: Box<RawValue>,
    pub(crate) change: SceneChange,
}

/// How an episode ends where the environment is set back: another one goes on with the task.
pub(crate) const SET_BACK: &str = "set_back";

#[derive(Serialize, Deserialize)]
pub(crate) struct Ended {
    /// How, in a word.
    pub(crate) how: String,
    /// The SHA-256 of the trace.
    pub(crate) source: SourceId,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct Proposed {
    /// The task's name.
    pub(crate) task: String,
    pub(crate) steps: Vec<ProposedStep>,
}

/// A step of a plan that was proposed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ProposedStep {
    /// What the environment would be told.
    pub call: GroundCall,
    /// Whether it rests on an imagined action.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub imagined: bool,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct Said {
    /// The task's name.
    pub(crate) task: String,
    #[serde(flatten)]
    pub(crate) said: typelift_world::Said,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct Forgotten {
    /// A source; none where it is what a person said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) source: Option<SourceId>,
    /// The entries from which it was known: [`Evidence`], or the beginning of an episode. Or those that are taken back
    /// themselves.
    pub(crate) entries: Vec<i64>,
    /// The object because of which it is taken back; then the same source may still be known from other entries.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) object: Option<Symbol>,
}

/// An entry as it is kept.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) number: i64,
    /// When, for people.
    pub(crate) written: String,
    pub(crate) kind: Kind,
    /// The entry with which the episode began that it belongs to.
    pub(crate) episode: Option<i64>,
    /// What it says, as it is kept.
    pub(crate) content: String,
}

impl Entry {
    /// What it says.
    pub(crate) fn content<'a, T: Deserialize<'a>>(&'a self) -> Result<T, MemoryErrorKind> {
        serde_json::from_str(&self.content)
            .map_err(|error| MemoryErrorKind::Damaged(format!("entry {}: {error}", self.number)))
    }

    pub(crate) fn read(row: &Row<'_>) -> rusqlite::Result<Self> {
        let word: String = row.get(2)?;
        let unknown = || rusqlite::Error::FromSqlConversionFailure(2, Type::Text, format!("no kind `{word}`").into());
        let kind = Kind::ALL.into_iter().find(|kind| kind.word() == word).ok_or_else(unknown)?;
        Ok(Self { number: row.get(0)?, written: row.get(1)?, kind, episode: row.get(3)?, content: row.get(4)? })
    }
}

/// Appends an entry, and gives its number.
pub(crate) fn append(
    connection: &Connection,
    kind: Kind,
    episode: Option<i64>,
    content: &impl Serialize,
) -> Result<i64, MemoryErrorKind> {
    let content = serde_json::to_string(content)?;
    connection.execute(
        "INSERT INTO log (kind, episode, content) VALUES (?1, ?2, ?3)",
        params![kind.word(), episode, content],
    )?;
    Ok(connection.last_insert_rowid())
}

/// Which entries are wanted, in the order in which they were written.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Wanted {
    All,
    Of(Kind),
    /// Later ones of a kind.
    After(Kind, i64),
    /// The beginning of an episode, its steps and its end.
    Episode(i64),
}

/// Gives each entry that is wanted to `each`.
pub(crate) fn entries(
    connection: &Connection,
    wanted: Wanted,
    mut each: impl FnMut(Entry) -> Result<(), MemoryErrorKind>,
) -> Result<(), MemoryErrorKind> {
    let (condition, value): (&str, [&dyn rusqlite::ToSql; 2]) = match &wanted {
        Wanted::All => ("?1 = ?2", [&0, &0]),
        Wanted::Of(kind) => ("kind = ?1 AND ?2 = 0", [&kind.word(), &0]),
        Wanted::After(kind, number) => ("kind = ?1 AND number > ?2", [&kind.word(), number]),
        Wanted::Episode(number) => ("number = ?1 OR episode = ?2", [number, number]),
    };
    let query = format!("SELECT number, written, kind, episode, content FROM log WHERE {condition} ORDER BY number");
    let mut statement = connection.prepare(&query)?;
    let mut rows = statement.query(value)?;
    while let Some(row) = rows.next()? {
        each(Entry::read(row)?)?;
    }
    Ok(())
}

/// As [`entries`], all at once.
pub(crate) fn list(connection: &Connection, wanted: Wanted) -> Result<Vec<Entry>, MemoryErrorKind> {
    let mut all = Vec::new();
    entries(connection, wanted, |entry| {
        all.push(entry);
        Ok(())
    })?;
    Ok(all)
}

/// The number of the last entry; 0 if there is none.
pub(crate) fn last(connection: &Connection) -> Result<i64, MemoryErrorKind> {
    Ok(connection.query_row("SELECT coalesce(max(number), 0) FROM log", [], |row| row.get(0))?)
}

/// The trace of an episode: byte by byte as a recorder would have written it.
pub(crate) fn trace_text(connection: &Connection, episode: i64) -> Result<String, MemoryErrorKind> {
    let mut writer = TraceWriter::default();
    entries(connection, Wanted::Episode(episode), |entry| writer.add(&entry))?;
    Ok(writer.text)
}

/// Makes a trace of an episode's entries.
#[derive(Default)]
pub(crate) struct TraceWriter {
    pub(crate) text: String,
    scene: Option<Scene>,
}

impl TraceWriter {
    /// Adds the next entry of the episode. After an error nothing more is to be added.
    pub(crate) fn add(&mut self, entry: &Entry) -> Result<(), MemoryErrorKind> {
        let (line, next) = match (entry.kind, self.scene.take()) {
            (Kind::Begun, None) => {
                let Begun { header, scene, .. } = entry.content()?;
                (header, scene)
            }
            (Kind::Stepped, Some(before)) => {
                let Stepped { action, change } = entry.content()?;
                (action, change.of(before)?)
            }
            (Kind::Ended | Kind::Proposed | Kind::Said, before) => {
                self.scene = before;
                return Ok(());
            }
            _ => return Err(MemoryErrorKind::Damaged(format!("entry {} is out of turn", entry.number))),
        };
        self.text.push_str(line.get());
        self.text.push('\n');
        self.text.push_str(&serde_json::to_string(&TraceLine::from(&next))?);
        self.text.push('\n');
        self.scene = Some(next);
        Ok(())
    }
}

/// The name of an episode as a source: that of the file in which a recorder writes it.
pub(crate) fn trace_name(trace: &Trace) -> Symbol {
    Symbol::from(format!("{}.jsonl", trace.task))
}
