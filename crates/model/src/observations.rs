//! What was observed, folded up: the only thing that learning sees.
//!
//! Observations are keyed by names and canonical labels. Adding transitions in any order, in any split, and merging the
//! parts gives the same value, and its size is bounded by the number of different lifted effects and pre-states,
//! not by the number of transitions.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::{AtomKind, LiftedAtom, PreStates, Symbol, View};

/// Parameters that an action may have, and arguments a predicate: far more than anybody writes. Distinct parameters are
/// compared pairwise, so there is a bound.
pub const MOST_PARAMETERS: usize = 256;
/// Witnesses kept of each cluster: the smallest by file and step.
pub const WITNESS_BOUND: usize = 3;

/// A place in a trace where something was observed.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Witness {
    /// The trace's file name.
    pub file: Symbol,
    /// The transition's number in it, from 1.
    pub step: u64,
}

/// What tells clusters apart: the action and its lifted effect in canonical labelling.
///
/// The parameters are the different arguments of the call in their order, then the other entities of the effect in
/// the labelling that makes the effect smallest.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClusterKey {
    /// The action's name.
    pub action: Symbol,
    /// The type of each parameter.
    pub types: Vec<Symbol>,
    /// The call's arguments, as parameters.
    pub call: Vec<u32>,
    /// The lifted atoms added, sorted.
    pub adds: Vec<LiftedAtom>,
    /// The lifted atoms deleted, sorted.
    pub deletes: Vec<LiftedAtom>,
}

impl ClusterKey {
    /// Adds and deletes as signed atoms, adds first.
    pub fn signed_effect(&self) -> Vec<(bool, LiftedAtom)> {
        let adds = self.adds.iter().map(|a| (true, a.clone()));
        adds.chain(self.deletes.iter().map(|a| (false, a.clone()))).collect()
    }
}

/// The observations of one cluster.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cluster {
    /// The number of transitions.
    pub count: u64,
    /// Their lifted pre-states: the atoms over parameters alone.
    pub states: PreStates,
    /// The smallest places where it was seen, at most [`WITNESS_BOUND`].
    pub witnesses: BTreeSet<Witness>,
}

impl Cluster {
    /// Adds one transition.
    pub fn add(&mut self, state: BTreeSet<LiftedAtom>, witness: Witness) {
        self.count += 1;
        self.states.add(state);
        keep_smallest(&mut self.witnesses, [witness]);
    }

    fn merge(&mut self, other: &Self) {
        self.count += other.count;
        self.states.merge(&other.states);
        keep_smallest(&mut self.witnesses, other.witnesses.iter().cloned());
    }
}

fn keep_smallest(witnesses: &mut BTreeSet<Witness>, more: impl IntoIterator<Item = Witness>) {
    witnesses.extend(more);
    while witnesses.len() > WITNESS_BOUND {
        witnesses.pop_last();
    }
}

/// What tells failures apart: an action that was not executed, or changed nothing, applied to entities of these types.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NegativeKey {
    /// The action's name.
    pub action: Symbol,
    /// The types of the different arguments of the call, in their order, then those of the other entities that the
    /// expected action was about, if that is recorded.
    pub types: Vec<Symbol>,
    /// The call's arguments, as parameters.
    pub call: Vec<u32>,
}

/// Why what changed in a transition belongs to no cluster.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Unexplained {
    /// Entities appeared or vanished.
    ObjectsChanged,
    /// An atom that it may have changed is unknown before or after.
    PartlyObserved,
    /// It lies between open states that do not list a kind of atoms that is met elsewhere: it may have changed such atoms.
    UnlistedKinds,
    /// More entities take part than [`MOST_PARAMETERS`].
    TooLarge,
    /// More entities of the effect than can be told apart within bounds.
    TooSymmetric,
    /// It was not executed, and left something behind nevertheless. It is among the negatives as well.
    NotExecuted,
    /// It was not finished in time, and may be half done.
    TimedOut,
}

/// What was observed in one source, or in many: a value that merges.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Observations {
    /// The number of transitions seen, of any kind.
    pub transitions: u64,
    /// Every predicate met, by its name and how many arguments it takes, with the types of the objects that were met as
    /// each of them.
    pub predicates: BTreeMap<(Symbol, usize), Vec<BTreeSet<Symbol>>>,
    /// Transitions that changed something, by action and lifted effect.
    pub clusters: BTreeMap<ClusterKey, Cluster>,
    /// Failures: transitions that were not executed, or changed nothing.
    pub negatives: BTreeMap<NegativeKey, Cluster>,
    /// Transitions that nothing explains.
    pub unexplained: BTreeMap<Unexplained, (u64, BTreeSet<Witness>)>,
    /// Transitions between open states of which nothing that they list is hidden.
    pub open: OpenObservations,
}

/// What was observed between open states.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct OpenObservations {
    /// Every kind of atom that an open state lists, as true or as false.
    pub kinds: BTreeSet<AtomKind>,
    /// The clusters and the failures of steps, by how much is known of them.
    pub by_view: BTreeMap<View, Observations>,
}

impl OpenObservations {
    pub(crate) fn is_empty(&self) -> bool {
        self.kinds.is_empty() && self.by_view.is_empty()
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        self.kinds.extend(other.kinds.iter().cloned());
        for (view, seen) in &other.by_view {
            self.by_view.entry(view.clone()).or_default().merge(seen);
        }
    }
}

impl Observations {
    /// Where a step belongs of which so much is known; `None` if everything is.
    pub fn seen_in(&mut self, view: Option<View>) -> &mut Self {
        match view {
            None => self,
            Some(view) => self.open.by_view.entry(view).or_default(),
        }
    }

    /// Adds an atom that was met: its predicate, and the types of its objects as far as they are named.
    pub fn add_predicate<'a>(&mut self, predicate: &Symbol, types: impl IntoIterator<Item = Option<&'a Symbol>>) {
        let types: Vec<Option<&Symbol>> = types.into_iter().collect();
        let none = || vec![BTreeSet::new(); types.len()];
        let known = self.predicates.entry((predicate.clone(), types.len())).or_insert_with(none);
        for (known, ty) in known.iter_mut().zip(types) {
            if let Some(ty) = ty
                && !known.contains(ty)
            {
                known.insert(ty.clone());
            }
        }
    }

    /// The names that were met with several numbers of arguments.
    pub fn names_of_several_arities(&self) -> BTreeSet<Symbol> {
        let names: Vec<&Symbol> = self.predicates.keys().map(|(name, _)| name).collect();
        names.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0].clone()).collect()
    }

    /// Adds a transition that nothing explains.
    pub fn add_unexplained(&mut self, reason: Unexplained, witness: &Witness) {
        self.add_all_unexplained(reason, 1, [witness]);
    }

    /// Adds `count` transitions that nothing explains, some of which were seen at these places.
    pub(crate) fn add_all_unexplained<'a>(
        &mut self,
        reason: Unexplained,
        count: u64,
        witnesses: impl IntoIterator<Item = &'a Witness>,
    ) {
        let entry = self.unexplained.entry(reason).or_default();
        entry.0 += count;
        keep_smallest(&mut entry.1, witnesses.into_iter().cloned());
    }

    /// Adds everything that another holds.
    pub fn merge(&mut self, other: &Self) {
        self.transitions += other.transitions;
        for (predicate, types) in &other.predicates {
            let known = self.predicates.entry(predicate.clone()).or_default();
            known.resize(types.len(), BTreeSet::new());
            known.iter_mut().zip(types).for_each(|(known, types)| known.extend(types.iter().cloned()));
        }
        for (key, cluster) in &other.clusters {
            self.clusters.entry(key.clone()).or_default().merge(cluster);
        }
        for (key, cluster) in &other.negatives {
            self.negatives.entry(key.clone()).or_default().merge(cluster);
        }
        for (reason, (count, witnesses)) in &other.unexplained {
            self.add_all_unexplained(*reason, *count, witnesses);
        }
        self.open.merge(&other.open);
    }

    /// The same, observed in a file of this name.
    pub fn renamed(&self, file: &Symbol) -> Self {
        let mut renamed = self.clone();
        let clusters = renamed.clusters.values_mut().chain(renamed.negatives.values_mut()).map(|c| &mut c.witnesses);
        for witnesses in clusters.chain(renamed.unexplained.values_mut().map(|(_, witnesses)| witnesses)) {
            let steps = std::mem::take(witnesses).into_iter().map(|witness| witness.step);
            witnesses.extend(steps.map(|step| Witness { file: file.clone(), step }));
        }
        renamed.open.by_view.values_mut().for_each(|seen| *seen = seen.renamed(file));
        renamed
    }

    /// Transitions that were not executed, or changed nothing.
    pub fn failures(&self) -> u64 {
        self.negatives.values().map(|cluster| cluster.count).sum()
    }
}
