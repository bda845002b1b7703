//! Symbolic states, closed or open.

use std::collections::{BTreeMap, BTreeSet};

use crate::{GroundAtom, Symbol, TypeId, Unknown};

/// A symbolic state: its objects with their types, the atoms that hold, and of which others it is unknown whether they do.
///
/// An atom is *true* if it is in `atoms`, else *unknown* if `unknown` [contains](Unknown::contains) it, else *false*. Of a
/// closed state few are unknown or none, of an open one all but those known to be false.
///
/// - Whatever asks whether something holds (conditions of actions, goals, planning, `check`) takes an unknown atom for one
///   that does not: [`holds`](Self::holds) is "is known to hold".
/// - Whatever asks what changed (learning, the monitor, events) lets it count neither way: a change is what is known to
///   be false in one state and true in the other.
///
/// The types are ids of the hierarchy against which the state was read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct State {
    /// Every object, with its type.
    pub objects: BTreeMap<Symbol, TypeId>,
    /// The atoms that hold.
    pub atoms: BTreeSet<GroundAtom>,
    /// Of which other atoms it is not known whether they hold.
    pub unknown: Unknown<Symbol>,
}

impl State {
    /// Whether the atom is known to hold. An equality holds of equal objects.
    pub fn holds(&self, atom: &GroundAtom) -> bool {
        if atom.is_equality() { atom.args.windows(2).all(|pair| pair[0] == pair[1]) } else { self.atoms.contains(atom) }
    }

    /// Whether it is not known if the atom holds.
    pub fn is_unknown(&self, atom: &GroundAtom) -> bool {
        !atom.is_equality() && !self.atoms.contains(atom) && self.unknown.contains(atom)
    }

    /// Whether every atom is known to hold.
    pub fn satisfies<'a>(&self, atoms: impl IntoIterator<Item = &'a GroundAtom>) -> bool {
        atoms.into_iter().all(|atom| self.holds(atom))
    }

    /// What `after` adds to this state: atoms known false here and true there, in order.
    pub fn added<'a>(&'a self, after: &'a Self) -> impl Iterator<Item = &'a GroundAtom> {
        after.atoms.difference(&self.atoms).filter(|atom| !self.is_unknown(atom))
    }

    /// What `after` deletes from this state: atoms true here and known false there, in order.
    pub fn deleted<'a>(&'a self, after: &'a Self) -> impl Iterator<Item = &'a GroundAtom> {
        self.atoms.difference(&after.atoms).filter(|atom| !after.is_unknown(atom))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pattern;

    fn atoms(texts: &[&str]) -> BTreeSet<GroundAtom> {
        texts.iter().map(|text| GroundAtom::parse(text).expect(text)).collect()
    }

    fn state(held: &[&str], unknown: Unknown<Symbol>) -> State {
        State { atoms: atoms(held), unknown, ..State::default() }
    }

    /// The changes between two states, as `+added -deleted`.
    fn changes(before: &State, after: &State) -> String {
        let added = before.added(after).map(|atom| format!("+{atom}"));
        added.chain(before.deleted(after).map(|atom| format!("-{atom}"))).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_change_is_known_on_both_sides() {
        let (empty, full) = (["free(h)", "on(a,t)"], ["held(a)", "warm(a)"]);
        let closed = |held: &[&str]| state(held, Unknown::default());
        assert_eq!(changes(&closed(&empty), &closed(&full)), "+held(a) +warm(a) -free(h) -on(a,t)");
        // `warm(a)` and `on(a,t)` are listed in one of the states only.
        let before = state(&empty, Unknown::AllBut(atoms(&["held(a)"])));
        let after = state(&full, Unknown::AllBut(atoms(&["free(h)"])));
        assert_eq!(changes(&before, &after), "+held(a) -free(h)");
        let patterns = |texts: &[&str]| Unknown::Matching(texts.iter().map(|t| Pattern::parse(t).expect(t)).collect());
        let after = state(&["held(a)"], patterns(&["on(a,*)"]));
        assert_eq!(changes(&closed(&empty), &after), "+held(a) -free(h)");
        assert!(after.is_unknown(&GroundAtom::new("on", vec!["a".into(), "b".into()])));
        assert!(!after.holds(&GroundAtom::new("on", vec!["a".into(), "b".into()])));
    }

    #[test]
    fn what_holds_is_known() {
        let state = state(&["on(a,t)"], Unknown::Matching([Pattern::parse("on(a,*)").expect("a pattern")].into()));
        assert!(!state.is_unknown(&GroundAtom::new("on", vec!["a".into(), "t".into()])));
        let open = State { unknown: Unknown::AllBut(BTreeSet::new()), ..state };
        assert!(!open.is_unknown(&GroundAtom::new("=", vec!["a".into(), "t".into()])), "nor is equality ever unknown");
    }
}
