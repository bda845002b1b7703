//! Which atoms a state says nothing about.

use std::collections::BTreeSet;
use std::fmt;

use serde::{Deserialize, Deserializer};

use crate::atom::split;
use crate::{Atom, AtomTextError, Symbol, check_name};

/// An argument of a [`Pattern`].
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Slot<T> {
    /// Anything; written `*`.
    Any,
    /// This alone.
    Is(T),
}

/// Atoms of one predicate that are alike: `holding_holds(agent_1,*)` is `holding_holds` of `agent_1` and anything.
pub type Pattern<T> = Atom<Slot<T>>;

/// The atoms of which it is not known whether they hold, without listing them. What does hold is known, whatever is said
/// here, and equality always is.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unknown<T: Ord> {
    /// The state is *closed*: every atom that matches one of these, and none besides.
    Matching(BTreeSet<Pattern<T>>),
    /// The state is *open*: every atom but these, which are known to be false.
    AllBut(BTreeSet<Atom<T>>),
}

impl<T: Ord + fmt::Display> fmt::Debug for Unknown<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Matching(patterns) => f.debug_tuple("Matching").field(patterns).finish(),
            Self::AllBut(known) => f.debug_tuple("AllBut").field(known).finish(),
        }
    }
}

impl<T: Ord> Default for Unknown<T> {
    /// Nothing is unknown.
    fn default() -> Self {
        Self::Matching(BTreeSet::new())
    }
}

impl<T: Ord> Unknown<T> {
    /// Whether this atom, which does not hold, may hold for all that is known. Linear in the number of patterns.
    pub fn contains(&self, atom: &Atom<T>) -> bool {
        match self {
            Self::Matching(patterns) => patterns.iter().any(|pattern| pattern.matches(atom)),
            Self::AllBut(known) => !known.contains(atom),
        }
    }

    /// Whether nothing is unknown.
    pub fn is_nothing(&self) -> bool {
        matches!(self, Self::Matching(patterns) if patterns.is_empty())
    }
}

impl<T: PartialEq> Pattern<T> {
    /// Whether it means this atom and no other.
    pub fn is_of(&self, atom: &Atom<T>) -> bool {
        !self.args.contains(&Slot::Any) && self.matches(atom)
    }

    /// Whether the atom is one of those meant.
    pub fn matches(&self, atom: &Atom<T>) -> bool {
        let fits = |(slot, arg): (&Slot<T>, &T)| match slot {
            Slot::Any => true,
            Slot::Is(wanted) => wanted == arg,
        };
        self.predicate == atom.predicate && self.arity() == atom.arity() && self.args.iter().zip(&atom.args).all(fits)
    }
}

impl<T> Pattern<T> {
    /// The arguments that are fixed, in order.
    pub fn names(&self) -> impl Iterator<Item = &T> {
        self.args.iter().filter_map(|slot| match slot {
            Slot::Any => None,
            Slot::Is(arg) => Some(arg),
        })
    }
}

impl Pattern<Symbol> {
    /// Reads `predicate(entity,*)`.
    ///
    /// # Errors
    /// [`AtomTextError`] if the text has another form.
    pub fn parse(text: &str) -> Result<Self, AtomTextError> {
        let form = || AtomTextError::Form { text: text.to_owned() };
        let (predicate, args) = split(text)?;
        if predicate == "*" || check_name(predicate).is_err() {
            return Err(form());
        }
        let slot = |arg: &str| match arg {
            "*" => Ok(Slot::Any),
            name => check_name(name).map(|()| Slot::Is(Symbol::new(name))).map_err(|_| form()),
        };
        Ok(Self::new(predicate, args.into_iter().map(slot).collect::<Result<_, _>>()?))
    }
}

impl<T> From<Atom<T>> for Pattern<T> {
    /// The pattern of this atom alone.
    fn from(atom: Atom<T>) -> Self {
        Self { predicate: atom.predicate, args: atom.args.into_iter().map(Slot::Is).collect() }
    }
}

impl<T: fmt::Display> fmt::Display for Slot<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => f.write_str("*"),
            Self::Is(arg) => fmt::Display::fmt(arg, f),
        }
    }
}

impl<'de> Deserialize<'de> for Pattern<Symbol> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        Self::parse(&text).map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GroundAtom;

    fn matches(pattern: &str, atom: &str) -> bool {
        Pattern::parse(pattern).expect(pattern).matches(&GroundAtom::parse(atom).expect(atom))
    }

    #[test]
    fn a_star_stands_for_anything() {
        assert!(matches("on(a,*)", "on(a,b)") && matches("on(*,*)", "on(a,a)") && matches("dark", "dark()"));
        assert!(!matches("on(a,*)", "on(b,a)") && !matches("on(*)", "on(a,b)") && !matches("on(a,*)", "in(a,b)"));
        for text in ["on(a,*)", "on(*,*)", "dark()"] {
            assert_eq!(Pattern::parse(text).map(|pattern| pattern.to_string()).as_deref(), Ok(text));
        }
        for text in ["*", "*(a)", "on(**", "on(a,?)", "on(*,)"] {
            assert!(Pattern::parse(text).is_err(), "{text}");
        }
    }
}
