//! How much is known of a step between open states, by kinds of atoms.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{GroundAtom, LiftedAtom, Symbol, Term};

/// What atoms are alike in: the predicate and the types of their arguments. An object that stands in two places is another
/// kind. Written `on(block,table)`, and `on(block,?0)` where the second argument is the first.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct AtomKind(LiftedAtom);

impl AtomKind {
    /// The kind of an atom over objects of these types; `None` if the type of one is not known.
    pub fn of_ground<'a>(atom: &GroundAtom, ty: impl Fn(&Symbol) -> Option<&'a Symbol>) -> Option<Self> {
        Self::of(&atom.predicate, &atom.args, ty)
    }

    /// The kind of an atom over parameters of these types; `None` if it has others, or constants.
    pub fn of_lifted(atom: &LiftedAtom, types: &[Symbol]) -> Option<Self> {
        Self::of(&atom.predicate, &atom.args, |term| match term {
            Term::Param(i) => types.get(*i as usize),
            Term::Const(_) => None,
        })
    }

    fn of<'a, T: PartialEq>(predicate: &Symbol, args: &[T], ty: impl Fn(&T) -> Option<&'a Symbol>) -> Option<Self> {
        let argument = |(place, arg): (usize, &T)| match args[..place].iter().position(|earlier| earlier == arg) {
            Some(first) => Some(Term::Param(first as u32)),
            None => ty(arg).cloned().map(Term::Const),
        };
        let args = args.iter().enumerate().map(argument).collect::<Option<_>>()?;
        Some(Self(LiftedAtom { predicate: predicate.clone(), args }))
    }

    /// How many atoms of this kind there are, where there are so many objects of each type.
    pub fn number(&self, objects: &BTreeMap<Symbol, u64>) -> u64 {
        let types: Vec<&Symbol> = self.types().collect();
        let choices = |(place, ty): (usize, &&Symbol)| {
            let taken = types[..place].iter().filter(|earlier| *earlier == ty).count() as u64;
            objects.get(*ty).map_or(0, |all| all.saturating_sub(taken))
        };
        types.iter().enumerate().map(choices).fold(1, u64::saturating_mul)
    }

    /// The number of arguments.
    pub fn arity(&self) -> usize {
        self.0.arity()
    }

    /// The types of its different arguments.
    pub(crate) fn types(&self) -> impl Iterator<Item = &Symbol> {
        self.0.args.iter().filter_map(|term| match term {
            Term::Const(ty) => Some(ty),
            Term::Param(_) => None,
        })
    }

    /// Whether it is the kind of some atom: an argument that is the same as another refers to an earlier one, the first of
    /// them.
    pub(crate) fn is_sound(&self) -> bool {
        let is_first = |i: &u32| matches!(self.0.args.get(*i as usize), Some(Term::Const(_)));
        let refers = |(place, term): (usize, &Term)| match term {
            Term::Const(_) => true,
            Term::Param(i) => (*i as usize) < place && is_first(i),
        };
        self.0.args.iter().enumerate().all(refers)
    }
}

impl fmt::Display for AtomKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Debug for AtomKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// How much is known of a step between open states.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct View {
    /// The kinds of which every atom that the step may have changed is known before and after.
    pub known: BTreeSet<AtomKind>,
    /// How many objects of each type there are.
    pub objects: BTreeMap<Symbol, u64>,
}

impl View {
    /// Whether no atom of these kinds may have changed unseen: each is known, or there is none.
    pub(crate) fn shows_all<'k>(&self, kinds: impl IntoIterator<Item = &'k AtomKind>) -> bool {
        kinds.into_iter().all(|kind| self.known.contains(kind) || kind.number(&self.objects) == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(atom: &str) -> AtomKind {
        let types = BTreeMap::from([("a", "block"), ("b", "block"), ("t", "table")].map(|(o, t)| (o, Symbol::new(t))));
        AtomKind::of_ground(&GroundAtom::parse(atom).expect(atom), |name| types.get(name.as_str())).expect(atom)
    }

    #[test]
    fn atoms_of_a_kind_are_counted() {
        let objects = BTreeMap::from([("block", 3), ("table", 2)].map(|(ty, n)| (Symbol::new(ty), n)));
        let number = |atom: &str| (kind(atom).to_string(), kind(atom).number(&objects));
        assert_eq!(number("on(a,t)"), ("on(block,table)".to_owned(), 6));
        assert_eq!(number("on(a,b)"), ("on(block,block)".to_owned(), 6));
        assert_eq!(number("on(a,a)"), ("on(block,?0)".to_owned(), 3));
        assert_eq!(number("dark()"), ("dark()".to_owned(), 1));
        assert_eq!(kind("on(a,b)").number(&BTreeMap::from([(Symbol::new("block"), 1)])), 0);
        assert_eq!(kind("on(a,t)").number(&BTreeMap::from([(Symbol::new("block"), 1)])), 0);
    }

    #[test]
    fn the_kind_of_a_lifted_atom_is_that_of_its_instances() {
        let types = ["block", "block", "table"].map(Symbol::new);
        for (lifted, ground) in [("on(?0,?2)", "on(a,t)"), ("on(?1,?0)", "on(a,b)"), ("on(?1,?1)", "on(b,b)")] {
            let lifted = LiftedAtom::parse(lifted).expect(lifted);
            assert_eq!(AtomKind::of_lifted(&lifted, &types), Some(kind(ground)));
        }
        assert!(
            ["on(block,?0)", "on(block,block,?1)"]
                .map(|text| LiftedAtom::parse(text).expect(text))
                .into_iter()
                .all(|atom| AtomKind(atom).is_sound())
        );
        assert!(
            !["on(?0,block)", "on(block,?1)", "on(block,?0,?1)"]
                .map(|text| LiftedAtom::parse(text).expect(text))
                .into_iter()
                .any(|atom| AtomKind(atom).is_sound())
        );
    }
}
