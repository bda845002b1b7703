//! Predicates of one name that take different numbers of arguments: `at/2` is `at` with two arguments.
//!
//! What is observed is kept under the names that were observed. A model, in which a name is one predicate, tells them apart
//! by the number.

use std::borrow::Cow;
use std::collections::BTreeSet;

use crate::{ArgumentTypes, Atom, Symbol};

/// The name that says how many arguments the predicate takes: `at/2`. One that says it already stays as it is.
pub fn name_with_arity(predicate: &Symbol, arity: usize) -> Symbol {
    match without_arity(predicate, arity) {
        None => Symbol::from(format!("{predicate}/{arity}")),
        Some(_) => predicate.clone(),
    }
}

/// What is left of a name that ends in so many arguments; `None` if it does not, or if nothing would be left.
fn without_arity(predicate: &Symbol, arity: usize) -> Option<&str> {
    let (name, number) = predicate.as_str().rsplit_once('/')?;
    (!name.is_empty() && number == arity.to_string()).then_some(name)
}

/// The name under which a model has a predicate, where `by_arity` are the names that it tells apart by the number of
/// arguments.
pub fn predicate_told_apart(by_arity: &BTreeSet<Symbol>, predicate: &Symbol, arity: usize) -> Symbol {
    let name = match without_arity(predicate, arity) {
        None => Cow::Borrowed(predicate),
        Some(name) => Cow::Owned(Symbol::new(name)),
    };
    match by_arity.contains(&*name) {
        true => name_with_arity(predicate, arity),
        false => name.into_owned(),
    }
}

impl<T: Clone> Atom<T> {
    /// The atom under the name that was observed: `at(a,b)` of `at/2(a,b)`. Nothing is copied if it has that.
    pub fn without_arity(&self) -> Cow<'_, Self> {
        match without_arity(&self.predicate, self.arity()) {
            None => Cow::Borrowed(self),
            Some(name) => Cow::Owned(Self { predicate: Symbol::new(name), args: self.args.clone() }),
        }
    }

    /// The atom under the name that these predicates have for it, with or without the number of arguments; as it is if
    /// they have none.
    pub fn named_as_in(&self, predicates: &ArgumentTypes) -> Self {
        let is_known = |name: &Symbol| predicates.get(name).is_some_and(|types| types.len() == self.arity());
        let candidates = [
            self.predicate.clone(),
            name_with_arity(&self.predicate, self.arity()),
            self.without_arity().predicate.clone(),
        ];
        let predicate = candidates.into_iter().find(is_known).unwrap_or_else(|| self.predicate.clone());
        Self { predicate, args: self.args.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{GroundAtom, Hierarchy};

    fn atom(text: &str) -> GroundAtom {
        GroundAtom::parse(text).expect(text)
    }

    #[test]
    fn only_the_right_number_is_a_number_of_arguments() {
        for (named, bare) in [
            ("at/2(a,b)", "at(a,b)"),
            ("lit/0()", "lit()"),
            ("a/b/1(a)", "a/b(a)"),
            ("at/2(a)", "at/2(a)"),
            ("at/02(a,b)", "at/02(a,b)"),
            ("at/+2(a,b)", "at/+2(a,b)"),
            ("/2(a,b)", "/2(a,b)"),
            ("/0()", "/0()"),
            ("at(a,b)", "at(a,b)"),
        ] {
            assert_eq!(*atom(named).without_arity(), atom(bare), "{named}");
        }
    }

    #[test]
    fn a_name_is_told_apart_once() {
        let by_arity = BTreeSet::from([Symbol::new("at")]);
        let named = |name: &str, arity| predicate_told_apart(&by_arity, &Symbol::new(name), arity).to_string();
        assert_eq!([named("at", 2), named("at/2", 2), named("at/2", 1)], ["at/2", "at/2", "at/2"]);
        assert_eq!([named("on", 2), named("on/2", 2)], ["on", "on"]);
    }

    #[test]
    fn an_atom_has_the_name_that_is_known() {
        let of = |names: &[(&str, usize)]| -> ArgumentTypes {
            names.iter().map(|&(name, arity)| (Symbol::new(name), vec![Hierarchy::default().root(); arity])).collect()
        };
        let (apart, one) = (of(&[("at/1", 1), ("at/2", 2)]), of(&[("at", 2)]));
        let named = |text: &str, predicates: &ArgumentTypes| atom(text).named_as_in(predicates).to_string();
        assert_eq!(named("at(a,b)", &apart), "at/2(a,b)");
        assert_eq!(named("at/1(a)", &apart), "at/1(a)");
        assert_eq!(named("at(a,b,c)", &apart), "at(a,b,c)", "there is none");
        assert_eq!(
            [named("at(a,b)", &one), named("at/2(a,b)", &one), named("at(a)", &one)],
            ["at(a,b)", "at(a,b)", "at(a)"]
        );
    }
}
