//! Symbolic states.

use std::collections::{BTreeMap, BTreeSet};

use crate::{GroundAtom, Symbol, TypeId};

/// A symbolic state: its objects with their types and its true atoms; every other atom is false unless it is
/// listed as unknown.
///
/// Planning takes an unknown atom as one that does not hold; learning leaves out transitions that depend on one; and
/// whoever compares expectation with observation lets it count neither way.
///
/// The types are ids of the hierarchy against which the state was read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct State {
    /// Every object, with its type.
    pub objects: BTreeMap<Symbol, TypeId>,
    /// The atoms that hold.
    pub atoms: BTreeSet<GroundAtom>,
    /// Atoms of which it is not known whether they hold; disjoint from `atoms`.
    pub unknown: BTreeSet<GroundAtom>,
}

impl State {
    /// Whether the atom is known to hold. An equality holds of equal objects.
    pub fn holds(&self, atom: &GroundAtom) -> bool {
        if atom.is_equality() { atom.args.windows(2).all(|pair| pair[0] == pair[1]) } else { self.atoms.contains(atom) }
    }

    /// Whether every atom is known to hold.
    pub fn satisfies<'a>(&self, atoms: impl IntoIterator<Item = &'a GroundAtom>) -> bool {
        atoms.into_iter().all(|atom| self.holds(atom))
    }

    /// What `after` adds to this state: atoms known false here and true there, in order.
    pub fn added<'a>(&'a self, after: &'a Self) -> impl Iterator<Item = &'a GroundAtom> {
        after.atoms.difference(&self.atoms).filter(|atom| !self.unknown.contains(*atom))
    }

    /// What `after` deletes from this state: atoms true here and known false there, in order.
    pub fn deleted<'a>(&'a self, after: &'a Self) -> impl Iterator<Item = &'a GroundAtom> {
        self.atoms.difference(&after.atoms).filter(|atom| !after.unknown.contains(*atom))
    }
}
