//! What held before the transitions of one cluster. The size is bounded: up to a number of different states each is kept, with
//! how often it was seen; beyond it only how often each atom held.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::LiftedAtom;

/// Different pre-states that one cluster keeps apart; beyond it only how often each atom held.
pub const PRE_STATE_BOUND: usize = 256;

/// The lifted pre-states of the transitions of one cluster, with multiplicity.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PreStates {
    /// Each different pre-state and how often it was seen; at most [`PRE_STATE_BOUND`].
    Exact(
        #[serde(with = "exact_as_list")]
        #[cfg_attr(feature = "schema", schemars(with = "Vec<CountedState>"))]
        BTreeMap<BTreeSet<LiftedAtom>, u64>,
    ),
    /// How many were seen, and in how many of them each atom held.
    Counted {
        /// The number of pre-states.
        total: u64,
        /// In how many of them each atom held.
        atoms: BTreeMap<LiftedAtom, u64>,
    },
}

impl Default for PreStates {
    fn default() -> Self {
        Self::Exact(BTreeMap::new())
    }
}

impl PreStates {
    /// Adds one pre-state.
    pub fn add(&mut self, state: BTreeSet<LiftedAtom>) {
        match self {
            Self::Exact(states) => *states.entry(state).or_default() += 1,
            Self::Counted { total, atoms } => {
                *total += 1;
                for atom in state {
                    *atoms.entry(atom).or_default() += 1;
                }
            }
        }
        self.bound();
    }

    /// Adds all pre-states of another.
    pub fn merge(&mut self, other: &Self) {
        match (&mut *self, other) {
            (Self::Exact(states), Self::Exact(others)) => {
                for (state, count) in others {
                    *states.entry(state.clone()).or_default() += count;
                }
            }
            _ => {
                let (mut total, mut atoms) = self.counts();
                let (other_total, other_atoms) = other.counts();
                total += other_total;
                for (atom, count) in other_atoms {
                    *atoms.entry(atom).or_default() += count;
                }
                *self = Self::Counted { total, atoms };
            }
        }
        self.bound();
    }

    fn bound(&mut self) {
        if matches!(self, Self::Exact(states) if states.len() > PRE_STATE_BOUND) {
            let (total, atoms) = self.counts();
            *self = Self::Counted { total, atoms };
        }
    }

    /// How many were seen, and in how many of them each atom held.
    pub fn counts(&self) -> (u64, BTreeMap<LiftedAtom, u64>) {
        match self {
            Self::Counted { total, atoms } => (*total, atoms.clone()),
            Self::Exact(states) => {
                let mut atoms = BTreeMap::new();
                for (state, count) in states {
                    for atom in state {
                        *atoms.entry(atom.clone()).or_default() += count;
                    }
                }
                (states.values().sum(), atoms)
            }
        }
    }

    /// The atoms that held in any pre-state, some of them several times.
    pub fn atoms(&self) -> impl Iterator<Item = &LiftedAtom> {
        let (exact, counted) = match self {
            Self::Exact(states) => (Some(states.keys().flatten()), None),
            Self::Counted { atoms, .. } => (None, Some(atoms.keys())),
        };
        exact.into_iter().flatten().chain(counted.into_iter().flatten())
    }

    /// The atoms that held in every pre-state.
    pub fn always(&self) -> BTreeSet<LiftedAtom> {
        let (total, atoms) = self.counts();
        atoms.into_iter().filter(|(_, count)| *count == total).map(|(atom, _)| atom).collect()
    }

    /// `(hits, total)`: in how many pre-states all of `atoms` held. Beyond the bound it is exact when an atom never or
    /// always fails to hold, else the upper bound that the counts give.
    pub fn containing(&self, atoms: &BTreeSet<LiftedAtom>) -> (u64, u64) {
        match self {
            Self::Exact(states) => (
                states.iter().filter(|(state, _)| atoms.is_subset(state)).map(|(_, count)| count).sum(),
                states.values().sum(),
            ),
            Self::Counted { total, atoms: counts } => {
                (atoms.iter().map(|atom| counts.get(atom).copied().unwrap_or(0)).min().unwrap_or(*total), *total)
            }
        }
    }
}

/// One pre-state as the file has it.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct CountedState {
    count: u64,
    atoms: BTreeSet<LiftedAtom>,
}

mod exact_as_list {
    use serde::{Deserializer, Serializer};

    use super::{BTreeMap, BTreeSet, CountedState, Deserialize, LiftedAtom};

    pub(super) fn serialize<S: Serializer>(
        states: &BTreeMap<BTreeSet<LiftedAtom>, u64>,
        s: S,
    ) -> Result<S::Ok, S::Error> {
        s.collect_seq(states.iter().map(|(atoms, count)| CountedState { count: *count, atoms: atoms.clone() }))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        d: D,
    ) -> Result<BTreeMap<BTreeSet<LiftedAtom>, u64>, D::Error> {
        let mut states = BTreeMap::new();
        for CountedState { count, atoms } in Vec::<CountedState>::deserialize(d)? {
            *states.entry(atoms).or_default() += count;
        }
        Ok(states)
    }
}
