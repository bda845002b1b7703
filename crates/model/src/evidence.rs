//! What a model was learned from, source by source.
//!
//! Evidence is a map from sources to what each contributes, and what is learned from is the sum. So parts can be added in
//! any order and any split, a trace that is given twice counts once, and what a source contributed can be taken out
//! again: the rest is as if it had never been there. Compact evidence keeps the sum and the names of the sources only.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use thiserror::Error;

use crate::{Observations, Source, SourceId, Symbol};

/// Everything that was observed, by source.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Evidence {
    sources: BTreeMap<SourceId, Source>,
    observed: Observed,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Observed {
    /// What each source contributes.
    BySource(Parts),
    /// The sum alone.
    Total(Box<Observations>),
}

impl Default for Observed {
    fn default() -> Self {
        Self::BySource(Parts::default())
    }
}

/// What each source contributes. Copies share it.
#[derive(Debug, Clone, Default)]
struct Parts {
    by_source: BTreeMap<SourceId, Arc<Observations>>,
    /// The sum, once it was asked for: what is added later is added to it.
    sum: OnceLock<Arc<Observations>>,
}

impl PartialEq for Parts {
    fn eq(&self, other: &Self) -> bool {
        self.by_source == other.by_source
    }
}

impl Eq for Parts {}

impl Parts {
    /// Adds what a source contributes, which is not there yet or is replaced.
    fn insert(&mut self, id: SourceId, part: &Arc<Observations>) {
        match (self.by_source.insert(id, Arc::clone(part)), self.sum.get_mut()) {
            (None, Some(sum)) => Arc::make_mut(sum).merge(part),
            (Some(_), _) => drop(self.sum.take()),
            (None, None) => {}
        }
    }

    fn remove(&mut self, id: SourceId) {
        self.by_source.remove(&id);
        self.sum.take();
    }

    /// The sum of all. The first time in time of all, later of what was added.
    fn sum(&self) -> &Observations {
        self.sum.get_or_init(|| {
            let mut total = Observations::default();
            self.by_source.values().for_each(|part| total.merge(part));
            Arc::new(total)
        })
    }
}

/// Why two parts of evidence do not become one.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum MergeError {
    /// Both hold these sources, and one has nothing but totals.
    #[error("both hold {}, and one keeps totals only, so that it would count twice", listed(.0))]
    Shared(Vec<(SourceId, Symbol)>),
    /// The same trace was read with other types, or other assumptions.
    #[error("{name} ({}) is in both, and was read in another way", .id.short())]
    ReadDifferently {
        /// The trace.
        id: SourceId,
        /// Its file's name.
        name: Symbol,
    },
    /// A part does not name all that it was learned from, as in format 1.
    #[error("it does not say what it was learned from, so that it is not known what would count twice")]
    UnknownSources,
}

fn listed(sources: &[(SourceId, Symbol)]) -> String {
    sources.iter().map(|(id, name)| format!("{name} ({})", id.short())).collect::<Vec<_>>().join(", ")
}

/// Why nothing can be taken out of compact evidence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("it keeps totals only, and not what each source contributed")]
pub struct CompactError;

impl FromIterator<(SourceId, Symbol, Observations)> for Evidence {
    /// What was observed in each source, which has a name for people. A source that comes twice counts once.
    fn from_iter<I: IntoIterator<Item = (SourceId, Symbol, Observations)>>(all: I) -> Self {
        let (mut sources, mut parts) = (BTreeMap::<SourceId, Source>::new(), Parts::default());
        for (id, name, observations) in all {
            if sources.get(&id).is_none_or(|known| name < known.name) {
                sources.insert(id, Source { name, transitions: observations.transitions });
                parts.insert(id, &Arc::new(observations));
            }
        }
        Self { sources, observed: Observed::BySource(parts) }
    }
}

impl Evidence {
    /// A sum of which it is unknown, or not kept, what each of these sources contributed.
    pub fn of_total(sources: BTreeMap<SourceId, Source>, total: Observations) -> Self {
        Self { sources, observed: Observed::Total(Box::new(total)) }
    }

    /// The sources, by id.
    pub fn sources(&self) -> &BTreeMap<SourceId, Source> {
        &self.sources
    }

    /// Whether totals alone are kept.
    pub fn is_compact(&self) -> bool {
        matches!(self.observed, Observed::Total(_))
    }

    /// What each source contributes; of compact evidence the total, without a source.
    pub fn parts(&self) -> Vec<(Option<SourceId>, &Observations)> {
        match &self.observed {
            Observed::BySource(parts) => parts.by_source.iter().map(|(id, part)| (Some(*id), &**part)).collect(),
            Observed::Total(total) => vec![(None, total)],
        }
    }

    /// What is learned from: the sum of all that was observed, [settled](Observations::settled). The first time in time of its
    /// size, later of what was added.
    pub fn total(&self) -> Cow<'_, Observations> {
        self.sum().settled()
    }

    /// The sum of all that was observed.
    fn sum(&self) -> &Observations {
        match &self.observed {
            Observed::BySource(parts) => parts.sum(),
            Observed::Total(total) => total,
        }
    }

    /// Adds everything that another holds, what both hold once. Gives the sources that both held. Where one holds nothing,
    /// the sum is what the other holds, whether or not that names all of its sources; it is compact if either is.
    ///
    /// # Errors
    /// [`MergeError`]; then nothing is added.
    pub fn merge(&mut self, other: &Self) -> Result<Vec<SourceId>, MergeError> {
        let shared: Vec<SourceId> = other.sources.keys().copied().filter(|id| self.sources.contains_key(id)).collect();
        if let (Observed::BySource(parts), Observed::BySource(others)) = (&mut self.observed, &other.observed) {
            for id in &shared {
                // Under one name they are the same, unless they were read in different ways.
                let name = &self.sources[id].name;
                let (own, other) = (&parts.by_source[id], &others.by_source[id]);
                if !Arc::ptr_eq(own, other) && own.renamed(name) != other.renamed(name) {
                    return Err(MergeError::ReadDifferently { id: *id, name: name.clone() });
                }
            }
            for (id, source) in &other.sources {
                if self.sources.get(id).is_none_or(|known| source.name < known.name) {
                    self.sources.insert(*id, source.clone());
                    parts.insert(*id, &others.by_source[id]);
                }
            }
            return Ok(shared);
        }
        let all_are_named = self.names_all_sources() && other.names_all_sources();
        if !all_are_named && !self.is_empty() && !other.is_empty() {
            return Err(MergeError::UnknownSources);
        }
        if !shared.is_empty() {
            return Err(MergeError::Shared(
                shared.into_iter().map(|id| (id, self.sources[&id].name.clone())).collect(),
            ));
        }
        self.compact();
        if let Observed::Total(total) = &mut self.observed {
            total.merge(other.sum());
        }
        self.sources.extend(other.sources.clone());
        Ok(shared)
    }

    /// Whether there is neither a source nor anything observed.
    fn is_empty(&self) -> bool {
        self.sources.is_empty() && *self.sum() == Observations::default()
    }

    /// Whether every transition is of a source that is named.
    fn names_all_sources(&self) -> bool {
        let named = self.sources.values().fold(0_u64, |sum, source| sum.saturating_add(source.transitions));
        match &self.observed {
            Observed::BySource(_) => true,
            Observed::Total(total) => total.transitions == named,
        }
    }

    /// Takes a source out: what is left is as if it had never been added. Gives whether it was there.
    ///
    /// # Errors
    /// [`CompactError`] if totals alone are kept.
    pub fn take_out(&mut self, id: SourceId) -> Result<bool, CompactError> {
        let Observed::BySource(parts) = &mut self.observed else { return Err(CompactError) };
        parts.remove(id);
        Ok(self.sources.remove(&id).is_some())
    }

    /// Keeps the totals and the names of the sources only. What the sources contributed is gone: nothing can be taken out
    /// any more, and only parts that share no source can be added.
    pub fn compact(&mut self) {
        if !self.is_compact() {
            self.observed = Observed::Total(Box::new(self.sum().clone()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(digit: &str, name: &str, transitions: u64) -> (SourceId, Symbol, Observations) {
        let id = digit.repeat(64).parse().unwrap_or_else(|_| panic!("an id"));
        (id, name.into(), Observations { transitions, ..Observations::default() })
    }

    #[test]
    fn the_kept_sum_is_the_sum() {
        let (one, other) = (part("1", "one", 2), part("2", "other", 3));
        let mut evidence: Evidence = [one.clone()].into_iter().collect();
        assert_eq!(evidence.total().transitions, 2);
        let before = evidence.clone();
        evidence.merge(&[other.clone()].into_iter().collect()).expect("of other sources");
        assert_eq!((evidence.total().transitions, before.total().transitions), (5, 2));
        assert_eq!(evidence, [one.clone(), other.clone()].into_iter().collect());
        evidence.merge(&[(one.0, "a name before".into(), one.2.clone())].into_iter().collect()).expect("the same");
        assert_eq!(evidence.total().transitions, 5, "what both hold counts once");
        evidence.take_out(one.0).expect("it is kept by source");
        assert_eq!(evidence.total().transitions, 3);
        assert_eq!(evidence, [other].into_iter().collect());
    }
}
