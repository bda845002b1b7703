//! Evidence as the model's file has it: each key once, with what each source contributes to it.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::model_error::{at_most, inconsistent, type_id};
use crate::open_file::OpenFile;
use crate::{
    Cluster, ClusterKey, Evidence, Hierarchy, MOST_PARAMETERS, ModelFileError, NegativeKey, Observations, PreStates,
    Source, SourceId, Symbol, Unexplained, Witness,
};

/// Observations that a model may rest on: products of three such numbers are calculated with.
const MOST_COUNTED: u64 = 1 << 40;

#[derive(Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct EvidenceFile {
    /// Whether totals are kept alone; then what was seen names no source.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) compact: bool,
    /// All transitions of all sources.
    #[serde(default)]
    pub(crate) transitions: u64,
    /// The traces that were learned from.
    #[serde(default)]
    pub(crate) sources: Vec<SourceFile>,
    #[serde(default)]
    pub(crate) predicates: Vec<PredicateFile>,
    #[serde(default)]
    pub(crate) clusters: Vec<ClusterFile>,
    #[serde(default)]
    pub(crate) negatives: Vec<NegativeFile>,
    #[serde(default)]
    pub(crate) unexplained: Vec<UnexplainedFile>,
    /// What was seen between open states.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) open: Vec<SeenFile<OpenFile>>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct SourceFile {
    id: SourceId,
    /// The trace's file name.
    name: Symbol,
    transitions: u64,
}

/// What one source contributes.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct SeenFile<T> {
    /// The source's number in `sources`, from 0; none in totals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    source: Option<usize>,
    #[serde(flatten)]
    what: T,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct PredicateFile {
    name: Symbol,
    seen: Vec<SeenFile<TypesFile>>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct TypesFile {
    /// For each argument, the types of the objects that were met there.
    types: Vec<BTreeSet<Symbol>>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct ClusterFile {
    #[serde(flatten)]
    pub(crate) key: ClusterKey,
    seen: Vec<SeenFile<Cluster>>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct NegativeFile {
    #[serde(flatten)]
    key: NegativeKey,
    seen: Vec<SeenFile<Cluster>>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct UnexplainedFile {
    reason: Unexplained,
    seen: Vec<SeenFile<PlacesFile>>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct PlacesFile {
    count: u64,
    witnesses: BTreeSet<Witness>,
}

impl<T> SeenFile<T> {
    fn of_total(what: T) -> Vec<Self> {
        vec![Self { source: None, what }]
    }
}

impl ClusterFile {
    pub(crate) fn of_total(key: ClusterKey, cluster: Cluster) -> Self {
        Self { key, seen: SeenFile::of_total(cluster) }
    }
}

impl NegativeFile {
    pub(crate) fn of_total(key: NegativeKey, cluster: Cluster) -> Self {
        Self { key, seen: SeenFile::of_total(cluster) }
    }
}

impl UnexplainedFile {
    pub(crate) fn of_total(reason: Unexplained, count: u64, witnesses: BTreeSet<Witness>) -> Self {
        Self { reason, seen: SeenFile::of_total(PlacesFile { count, witnesses }) }
    }
}

/// The parts of evidence, with the number of each one's source.
type Numbered<'e> = [(Option<usize>, &'e Observations)];

/// Every key of the parts, with what each part has of it.
fn by_key<'e, K: Ord + 'e, V: 'e, T>(
    parts: &Numbered<'e>,
    map: impl Fn(&'e Observations) -> &'e BTreeMap<K, V>,
    write: impl Fn(&'e V) -> T,
) -> BTreeMap<&'e K, Vec<SeenFile<T>>> {
    let mut all: BTreeMap<&K, Vec<SeenFile<T>>> = BTreeMap::new();
    for &(source, part) in parts {
        for (key, value) in map(part) {
            all.entry(key).or_default().push(SeenFile { source, what: write(value) });
        }
    }
    all
}

impl EvidenceFile {
    /// `total` is what is learned from it; its clusters are those that actions refer to by number.
    pub(crate) fn of(evidence: &Evidence, total: &Observations) -> Self {
        let parts: Vec<(Option<usize>, &Observations)> =
            (0..).zip(evidence.parts()).map(|(number, (id, part))| (id.map(|_| number), part)).collect();
        let source = |(id, source): (&SourceId, &Source)| SourceFile {
            id: *id,
            name: source.name.clone(),
            transitions: source.transitions,
        };
        let predicates = by_key(&parts, |part| &part.predicates, |types| TypesFile { types: types.clone() });
        let mut clusters = by_key(&parts, |part| &part.clusters, Cluster::clone);
        for key in total.clusters.keys() {
            clusters.entry(key).or_default();
        }
        let negatives = by_key(&parts, |part| &part.negatives, Cluster::clone);
        let places =
            |(count, witnesses): &(u64, BTreeSet<Witness>)| PlacesFile { count: *count, witnesses: witnesses.clone() };
        let unexplained = by_key(&parts, |part| &part.unexplained, places);
        let open = parts.iter().filter(|(_, part)| !part.open.is_empty());
        let open = open.map(|(source, part)| SeenFile { source: *source, what: OpenFile::of(&part.open) });
        Self {
            compact: evidence.is_compact(),
            transitions: parts.iter().map(|(_, part)| part.transitions).sum(),
            sources: evidence.sources().iter().map(source).collect(),
            predicates: predicates
                .into_iter()
                .map(|((name, _), seen)| PredicateFile { name: name.clone(), seen })
                .collect(),
            clusters: clusters.into_iter().map(|(key, seen)| ClusterFile { key: key.clone(), seen }).collect(),
            negatives: negatives.into_iter().map(|(key, seen)| NegativeFile { key: key.clone(), seen }).collect(),
            unexplained: unexplained
                .into_iter()
                .map(|(reason, seen)| UnexplainedFile { reason: *reason, seen })
                .collect(),
            open: open.collect(),
        }
    }

    /// The evidence; everything that a later step relies on is checked.
    pub(crate) fn read(self, hierarchy: &Hierarchy) -> Result<Evidence, ModelFileError> {
        let transitions = match self.compact {
            true => vec![self.transitions],
            false => self.sources.iter().map(|source| source.transitions).collect(),
        };
        let part = |transitions| Observations { transitions, ..Observations::default() };
        let mut parts = Parts { compact: self.compact, parts: transitions.into_iter().map(part).collect() };
        for PredicateFile { name, seen } in self.predicates {
            parts.insert(name.as_str(), seen, |part, TypesFile { types }| {
                part.predicates.insert((name.clone(), types.len()), types)
            })?;
        }
        for ClusterFile { key, seen } in self.clusters {
            parts.insert(key.action.as_str(), seen, |part, cluster| part.clusters.insert(key.clone(), cluster))?;
        }
        for NegativeFile { key, seen } in self.negatives {
            parts.insert(key.action.as_str(), seen, |part, cluster| part.negatives.insert(key.clone(), cluster))?;
        }
        for UnexplainedFile { reason, seen } in self.unexplained {
            let insert = |part: &mut Observations, PlacesFile { count, witnesses }| {
                part.unexplained.insert(reason, (count, witnesses))
            };
            parts.insert("what is unexplained", seen, insert)?;
        }
        let mut open = Vec::with_capacity(self.open.len());
        for SeenFile { source, what } in self.open {
            open.push(SeenFile { source, what: what.read(hierarchy)? });
        }
        parts.insert("open states", open, |part, open| {
            let known = std::mem::replace(&mut part.open, open);
            (!known.is_empty()).then_some(known)
        })?;
        parts.check(hierarchy)?;
        let mut ids = BTreeSet::new();
        if let Some(twice) = self.sources.iter().find(|source| !ids.insert(source.id)) {
            return Err(inconsistent("\"evidence\"".to_owned(), &format!("there are two sources {}", twice.id)));
        }
        if !self.compact {
            let part = |(source, part): (SourceFile, Observations)| (source.id, source.name, part);
            return Ok(self.sources.into_iter().zip(parts.parts).map(part).collect());
        }
        let named = |SourceFile { id, name, transitions }| (id, Source { name, transitions });
        let total = parts.parts.pop().unwrap_or_default();
        Ok(Evidence::of_total(self.sources.into_iter().map(named).collect(), total))
    }
}

/// What is read, source by source, or the one total.
struct Parts {
    compact: bool,
    parts: Vec<Observations>,
}

impl Parts {
    /// Puts what was seen of one key into the parts that it is of. `insert` gives what was there already.
    fn insert<T, V>(
        &mut self,
        key: &str,
        seen: Vec<SeenFile<T>>,
        mut insert: impl FnMut(&mut Observations, T) -> Option<V>,
    ) -> Result<(), ModelFileError> {
        let error = |message: &str| Err(inconsistent(format!("\"evidence\" of {key}"), message));
        for SeenFile { source, what } in seen {
            let part = match (self.compact, source) {
                (true, None) => self.parts.first_mut(),
                (false, Some(source)) => self.parts.get_mut(source),
                (true, Some(_)) => return error("a source is named, where totals are kept alone"),
                (false, None) => return error("no source is named"),
            };
            let Some(part) = part else { return error("there is no such source") };
            if insert(part, what).is_some() {
                return error("it is there twice");
            }
        }
        Ok(())
    }

    fn check(&self, hierarchy: &Hierarchy) -> Result<(), ModelFileError> {
        let mut total = 0_u64;
        for part in &self.parts {
            part.check(hierarchy, &mut total)?;
        }
        Ok(())
    }
}

impl Observations {
    /// Adds up all counts in `total`, so that no sum of them can be too large.
    fn check(&self, hierarchy: &Hierarchy, total: &mut u64) -> Result<(), ModelFileError> {
        let mut add = |counts: Vec<u64>, place: &dyn Fn() -> String| {
            let sum = counts.into_iter().try_fold(*total, u64::checked_add).filter(|sum| *sum <= MOST_COUNTED);
            *total = sum.ok_or_else(|| inconsistent(place(), "its counts are too large"))?;
            Ok::<(), ModelFileError>(())
        };
        add(vec![self.transitions], &|| "\"evidence\"".to_owned())?;
        for (reason, (count, _)) in &self.unexplained {
            add(vec![*count], &|| format!("\"evidence\" of {reason:?}"))?;
        }
        for ((name, _), types) in &self.predicates {
            let place = || format!("\"evidence\" of {name}");
            at_most(types.len(), MOST_PARAMETERS, "arguments", place)?;
            for ty in types.iter().flatten() {
                type_id(hierarchy, ty, place)?;
            }
        }
        let clusters = self.clusters.iter().map(|(key, cluster)| {
            let atoms = key.adds.iter().chain(&key.deletes);
            (&key.action, &key.types, &key.call, atoms.collect::<Vec<_>>(), cluster)
        });
        let negatives =
            self.negatives.iter().map(|(key, cluster)| (&key.action, &key.types, &key.call, Vec::new(), cluster));
        for (action, types, call, mut atoms, cluster) in clusters.chain(negatives) {
            let place = || format!("\"evidence\" of {action}");
            for ty in types {
                type_id(hierarchy, ty, place)?;
            }
            let mut counts = vec![cluster.count];
            match &cluster.states {
                PreStates::Exact(states) => {
                    atoms.extend(states.keys().flatten());
                    counts.extend(states.values());
                }
                PreStates::Counted { total, atoms: counted } => {
                    atoms.extend(counted.keys());
                    counts.push(*total);
                    counts.extend(counted.values());
                }
            }
            let mut params = atoms.iter().flat_map(|atom| atom.params()).chain(call.iter().copied());
            if let Some(bad) = params.find(|&i| i as usize >= types.len()) {
                return Err(inconsistent(place(), &format!("there is no parameter ?{bad}")));
            }
            add(counts, &place)?;
        }
        self.open.by_view.values().try_for_each(|seen| seen.check(hierarchy, total))
    }
}
