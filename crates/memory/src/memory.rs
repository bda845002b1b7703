//! A memory: opened, asked, and added to.

use std::path::{Path, PathBuf};

use rusqlite::{Connection, TransactionBehavior, params};
use serde_json::value::RawValue;
use typelift_learn::learn_evidence;
use typelift_model::{ActionModel, Evidence, LearnedModel, ParseConfig, SourceId, Symbol};
use typelift_world::{Said, TraceHeader, source_of};

use crate::episode::EpisodeLog;
use crate::error::{MemoryError, MemoryErrorKind};
use crate::fold::{Fold, PROGRAM, Sum, Unread, kept_fold, taken_back, under_way};
use crate::format::{self, Access};
use crate::log::{self, Kind, Wanted, append, list, trace_text};
use crate::logged::{Logged, logged};
use crate::object::{OfObject, forget_object};
use crate::recent::{PastEpisode, recent};
use crate::words::words;

/// The sum is written down once the log has grown by one part in so many: all that is written so, over the years, is in
/// proportion to the log.
const KEPT_SHARE: i64 = 4;

/// What an agent saw and was told, in a file, and the model that is learned from it.
///
/// The log alone decides: what is [`learned`](Self::learned) is a function of it, the same as from learning from all of its
/// models' demonstrations and episodes at once. The file also keeps the sum up to some entry, so that opening it need not
/// begin at the first.
#[derive(Debug)]
pub struct Memory {
    file: PathBuf,
    connection: Connection,
    access: Access,
    /// The types, and how scenes are read: a model without evidence.
    basis: LearnedModel,
    fold: Fold,
    /// Up to which entry the file keeps the sum.
    kept_up_to: i64,
    learned: LearnedModel,
    unread: Vec<Unread>,
}

impl Memory {
    /// Opens a memory that is there, and learns from what it says. In time of the kept sum and of what came after it.
    ///
    /// # Errors
    /// [`MemoryError`]: of kind [`Missing`](MemoryErrorKind::Missing) if there is none.
    pub fn open(file: &Path, access: Access) -> Result<Self, MemoryError> {
        let connection = format::open(file, access).map_err(|kind| kind.of(file))?;
        Self::begin(file, connection, access).map_err(|kind| kind.of(file))
    }

    /// Opens a memory to write to, and makes it if it is not there: with the types of this model, and its way of reading
    /// scenes. What the model was learned from is not added yet.
    ///
    /// # Errors
    /// [`MemoryError`].
    pub fn open_or_create(file: &Path, model: &LearnedModel) -> Result<Self, MemoryError> {
        let opened = match format::open(file, Access::Write) {
            Err(MemoryErrorKind::Missing) => {
                let basis = basis_of(model).to_json().map_err(MemoryErrorKind::from);
                basis.and_then(|basis| format::create(file, &basis))
            }
            opened => opened,
        };
        let begun = opened.and_then(|connection| Self::begin(file, connection, Access::Write));
        begun.map_err(|kind| kind.of(file))
    }

    fn begin(file: &Path, connection: Connection, access: Access) -> Result<Self, MemoryErrorKind> {
        let basis = LearnedModel::from_json(&format::basis(&connection)?)?;
        let (fold, learned) = kept_fold(&connection)?.unwrap_or_else(|| (Fold::default(), basis.clone()));
        let (file, kept_up_to) = (file.to_owned(), fold.up_to);
        let mut memory = Self { file, connection, access, basis, fold, kept_up_to, learned, unread: Vec::new() };
        memory.learn()?;
        Ok(memory)
    }

    /// The file, as it was named.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// What was learned from everything that it held when it was opened or last [`refresh`](Self::refresh)ed.
    pub fn learned(&self) -> &LearnedModel {
        &self.learned
    }

    /// What nothing is learned from, since it is not as a trace must be.
    pub fn unread(&self) -> &[Unread] {
        &self.unread
    }

    /// Learns from what was written since, by whomever. In time of what was written and, if there was anything, of the
    /// evidence.
    ///
    /// # Errors
    /// [`MemoryError`] if it cannot be read, or the sum cannot be kept.
    pub fn refresh(&mut self) -> Result<(), MemoryError> {
        self.learn().map_err(|kind| kind.of(&self.file))
    }

    fn learn(&mut self) -> Result<(), MemoryErrorKind> {
        // One view of it, whoever is writing.
        let view = self.connection.unchecked_transaction()?;
        let Sum { evidence, unread } = self.fold.go_on(&view, &self.basis)?;
        view.finish()?;
        self.unread = unread;
        if evidence != self.learned.evidence {
            self.learned = learned_from(evidence, &self.basis)?;
        }
        if self.access == Access::Write && self.fold.up_to > self.kept_up_to + self.kept_up_to / KEPT_SHARE {
            match self.keep_fold() {
                // It can be summed up again.
                Err(MemoryErrorKind::DiskFull | MemoryErrorKind::Failing(_)) => {}
                kept => kept?,
            }
        }
        Ok(())
    }

    /// Writes the sum down.
    fn keep_fold(&mut self) -> Result<(), MemoryErrorKind> {
        let settled = match self.fold.evidence == self.learned.evidence {
            true => self.learned.to_json()?,
            false => learned_from(self.fold.evidence.clone(), &self.basis)?.to_json()?,
        };
        let transaction = self.connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        transaction.execute("DELETE FROM fold", [])?;
        let row = params![self.fold.up_to, PROGRAM, settled];
        transaction.execute("INSERT INTO fold (up_to, program, model) VALUES (?1, ?2, ?3)", row)?;
        transaction.commit()?;
        self.kept_up_to = self.fold.up_to;
        Ok(())
    }

    /// Adds what a model was learned from, as far as no model's evidence in it had these sources before: what was taken back
    /// does not come back with the model. `name` is what people call the model. Gives how many sources it added.
    ///
    /// # Errors
    /// [`MemoryError`] if the model was learned from scenes read in another way, keeps totals only, or read a trace that is
    /// known in another way; and if nothing can be written. Then nothing is added.
    pub fn add_model(&mut self, model: &LearnedModel, name: &str) -> Result<usize, MemoryError> {
        self.try_add(model, name, brought_by_models).map_err(|kind| kind.of(&self.file))
    }

    /// Adds demonstrations that were shown now, with the model that they alone give: as far as they are not known. What was
    /// taken back before counts again. `name` is what people call them. Gives how many sources it added.
    ///
    /// # Errors
    /// As [`add_model`](Self::add_model).
    pub fn add_demonstrations(&mut self, shown: &LearnedModel, name: &str) -> Result<usize, MemoryError> {
        self.try_add(shown, name, known_now).map_err(|kind| kind.of(&self.file))
    }

    fn try_add(
        &mut self,
        model: &LearnedModel,
        name: &str,
        known: impl FnOnce(&Connection, &LearnedModel) -> Result<Vec<SourceId>, MemoryErrorKind>,
    ) -> Result<usize, MemoryErrorKind> {
        self.check_kind(model, name)?;
        self.learn()?;
        let transaction = self.connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        let mut evidence = model.evidence.clone();
        for source in known(&transaction, &self.learned)? {
            let _ = evidence.take_out(source);
        }
        let sources: Vec<SourceId> = evidence.sources().keys().copied().collect();
        if sources.is_empty() {
            return Ok(0);
        }
        let merged = self.fold.evidence.clone().merge(&evidence);
        merged.map_err(|error| MemoryErrorKind::Merge { model: name.to_owned(), error })?;
        let added = sources.len();
        let text = LearnedModel { evidence, ..self.basis.clone() }.to_json()?;
        let model = RawValue::from_string(text.trim_end().to_owned())?;
        append(&transaction, Kind::Evidence, None, &log::Evidence { name: name.to_owned(), sources, model })?;
        transaction.commit()?;
        self.learn()?;
        Ok(added)
    }

    /// That a model's evidence can be added to this one's, and its scenes be read in the same way.
    ///
    /// # Errors
    /// [`MemoryError`] with the first difference.
    pub fn agrees(&self, model: &LearnedModel, name: &str) -> Result<(), MemoryError> {
        self.check_kind(model, name).map_err(|kind| kind.of(&self.file))
    }

    fn check_kind(&self, model: &LearnedModel, name: &str) -> Result<(), MemoryErrorKind> {
        check_addable(model, name)?;
        match difference_between(model, &self.basis, ["the model", "the memory"]) {
            Some(difference) => Err(MemoryErrorKind::Disagrees { model: name.to_owned(), difference }),
            None => Ok(()),
        }
    }

    /// Keeps what happens in an episode, as it happens.
    pub fn episode(&mut self, header: TraceHeader) -> EpisodeLog<'_> {
        EpisodeLog::new(&self.file, &self.connection, header)
    }

    /// Takes a source back: from now on everything is as if it had never been there. Its entries stay in the log. The same
    /// trace seen again later counts again.
    ///
    /// # Errors
    /// [`MemoryError`]: of kind [`NotKnown`](MemoryErrorKind::NotKnown) if nothing is known from it.
    pub fn forget(&mut self, source: SourceId) -> Result<(), MemoryError> {
        self.try_forget(source).map_err(|kind| kind.of(&self.file))
    }

    fn try_forget(&mut self, source: SourceId) -> Result<(), MemoryErrorKind> {
        let transaction = self.connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
        let mut entries = Vec::new();
        for entry in list(&transaction, Wanted::Of(Kind::Evidence))? {
            if entry.content::<log::Evidence>()?.sources.contains(&source) {
                entries.push(entry.number);
            }
        }
        for entry in list(&transaction, Wanted::Of(Kind::Ended))? {
            if entry.content::<log::Ended>()?.source == source {
                entries.extend(entry.episode);
            }
        }
        for episode in under_way(&transaction)? {
            if source_of(trace_text(&transaction, episode)?.as_bytes()) == source {
                entries.push(episode);
            }
        }
        let before = taken_back(&transaction)?;
        entries.retain(|entry| !before.contains(&(*entry, source)));
        if entries.is_empty() {
            return Err(MemoryErrorKind::NotKnown(source));
        }
        append(&transaction, Kind::Forgotten, None, &log::Forgotten { source: Some(source), entries, object: None })?;
        transaction.commit()?;
        self.learn()
    }

    /// What people said and was not taken back, each with the number of its entry, in the order in which it was said.
    ///
    /// # Errors
    /// [`MemoryError`] if an entry cannot be read.
    pub fn words(&self) -> Result<Vec<(i64, Said)>, MemoryError> {
        words(&self.connection).map_err(|kind| kind.of(&self.file))
    }

    /// Takes back what a person said: the entry with this number. It stays in the log.
    ///
    /// # Errors
    /// [`MemoryError`]: of kind [`NotSaid`](MemoryErrorKind::NotSaid) if that is no word, or was taken back before.
    pub fn take_back(&mut self, entry: i64) -> Result<(), MemoryError> {
        let mut take_back = || {
            let transaction = self.connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
            if words(&transaction)?.iter().all(|(number, _)| *number != entry) {
                return Err(MemoryErrorKind::NotSaid(entry));
            }
            append(
                &transaction,
                Kind::Forgotten,
                None,
                &log::Forgotten { source: None, entries: vec![entry], object: None },
            )?;
            Ok(transaction.commit()?)
        };
        take_back().map_err(|kind| kind.of(&self.file))
    }

    /// Takes an object back: each episode in which something was done with it, or was meant to be, and each word about such a
    /// step; in this instance of the world, or in all. What models brought does not say which objects it was about, and stays.
    /// In time of the log.
    ///
    /// # Errors
    /// [`MemoryError`]: of kind [`NoSuchObject`](MemoryErrorKind::NoSuchObject) if there is nothing to take back.
    pub fn forget_object(&mut self, object: &Symbol, instance: Option<&Symbol>) -> Result<OfObject, MemoryError> {
        let mut forget = || {
            let transaction = self.connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
            let found = forget_object(&transaction, object, instance)?;
            transaction.commit()?;
            self.learn()?;
            Ok(found)
        };
        forget().map_err(|kind: MemoryErrorKind| kind.of(&self.file))
    }

    /// The episodes that were not taken back, as the traces that they are, each with its name and its text, in order.
    ///
    /// # Errors
    /// [`MemoryError`] if one cannot be read.
    pub fn traces(&self) -> Result<Vec<(Symbol, String)>, MemoryError> {
        self.list_traces().map_err(|kind| kind.of(&self.file))
    }

    fn list_traces(&self) -> Result<Vec<(Symbol, String)>, MemoryErrorKind> {
        let taken_back = taken_back(&self.connection)?;
        let mut traces = Vec::new();
        for entry in list(&self.connection, Wanted::Of(Kind::Begun))? {
            if taken_back.iter().all(|(number, _)| *number != entry.number) {
                let header = TraceHeader::from_line(entry.content::<log::Begun>()?.header.get())?;
                traces.push((Symbol::from(header.task), trace_text(&self.connection, entry.number)?));
            }
        }
        Ok(traces)
    }

    /// What was done in the last `tasks` tasks, in the order in which they began: what can be read and was not taken back. In
    /// time of the names of all episodes, and of the entries of these.
    ///
    /// # Errors
    /// [`MemoryError`] if an entry cannot be read.
    pub fn recent(&self, tasks: usize) -> Result<Vec<PastEpisode>, MemoryError> {
        recent(&self.connection, &self.basis, tasks).map_err(|kind| kind.of(&self.file))
    }

    /// All entries, in the order in which they were written. In time and memory of the log.
    ///
    /// # Errors
    /// [`MemoryError`] at the first that cannot be read.
    pub fn entries(&self) -> Result<Vec<Logged>, MemoryError> {
        logged(&self.connection).map_err(|kind| kind.of(&self.file))
    }
}

/// The sources that any model brought, those that were taken back too.
fn brought_by_models(log: &Connection, _: &LearnedModel) -> Result<Vec<SourceId>, MemoryErrorKind> {
    let mut all = Vec::new();
    for entry in list(log, Wanted::Of(Kind::Evidence))? {
        all.extend(entry.content::<log::Evidence>()?.sources);
    }
    Ok(all)
}

/// The sources that something is learned from.
fn known_now(_: &Connection, learned: &LearnedModel) -> Result<Vec<SourceId>, MemoryErrorKind> {
    Ok(learned.evidence.sources().keys().copied().collect())
}

/// The first difference in how scenes are read and learned from, where the two are called so.
pub(crate) fn difference_between(one: &LearnedModel, other: &LearnedModel, names: [&str; 2]) -> Option<String> {
    match one.agrees(&other.model.hierarchy, &other.parse) {
        Err(difference) => Some(difference.between(names[0], names[1])),
        Ok(()) if one.options != other.options => Some("it was learned with other options".to_owned()),
        Ok(()) => None,
    }
}

/// That what a model was learned from can be kept source by source.
fn check_addable(model: &LearnedModel, name: &str) -> Result<(), MemoryErrorKind> {
    let is_compact = model.evidence.is_compact();
    if is_compact { Err(MemoryErrorKind::Compact { model: name.to_owned() }) } else { Ok(()) }
}

/// What of a model does not follow from its evidence.
pub(crate) fn basis_of(model: &LearnedModel) -> LearnedModel {
    let LearnedModel { model, domain, declared_predicates, parse, options, .. } = model;
    let (hierarchy, constants) = (model.hierarchy.clone(), model.constants.clone());
    let mut basis = LearnedModel {
        model: ActionModel { hierarchy, constants, ..ActionModel::default() },
        domain: domain.clone(),
        parse: ParseConfig { ignore: parse.ignore.clone(), ..ParseConfig::default() },
        options: options.clone(),
        ..LearnedModel::default()
    };
    basis.declare(declared_predicates.clone());
    basis
}

fn learned_from(evidence: Evidence, basis: &LearnedModel) -> Result<LearnedModel, MemoryErrorKind> {
    let LearnedModel { model, domain, declared_predicates, parse, options, .. } = basis;
    let (mut learned, _) = learn_evidence(&model.hierarchy, parse, evidence, options)?;
    learned.domain.clone_from(domain);
    learned.model.constants.clone_from(&model.constants);
    learned.declare(declared_predicates.clone());
    Ok(learned)
}
