//! Names that nothing else has, neither as they are written nor as PDDL spells them.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{PddlNames, Symbol};

/// The names of one kind that are in use.
#[derive(Debug, Clone, Default)]
pub(super) struct FreshNames {
    used: BTreeSet<Symbol>,
    /// For each base, a number below which all are in use from the one on that was asked for first.
    next: BTreeMap<(String, usize), usize>,
}

impl FreshNames {
    /// With names that are in use already.
    pub(super) fn with(used: impl IntoIterator<Item = Symbol>) -> Self {
        let mut names = Self::default();
        for name in used {
            names.take(&name);
        }
        names
    }

    /// `base` itself, or else with the first number from 2 that makes it new.
    pub(super) fn fresh(&mut self, base: &Symbol) -> Symbol {
        if self.take(base) { base.clone() } else { self.numbered(base.as_str(), 2) }
    }

    /// `base` with the first number from `first` that makes it new.
    pub(super) fn numbered(&mut self, base: &str, first: usize) -> Symbol {
        let key = (base.to_owned(), first);
        let mut number = self.next.get(&key).copied().unwrap_or(first);
        loop {
            let name = Symbol::from(format!("{base}-{number}"));
            number += 1;
            if self.take(&name) {
                self.next.insert(key, number);
                return name;
            }
        }
    }

    /// Whether the name was new; it is in use from now on.
    fn take(&mut self, name: &Symbol) -> bool {
        // One name alone collides with nothing.
        let pddl = PddlNames::fold("name", [name]).ok().and_then(|names| names.pddl(name.as_str()).cloned());
        self.used.insert(pddl.unwrap_or_else(|| name.clone()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_is_given_twice() {
        let mut names = FreshNames::with([Symbol::new("go-2"), Symbol::new("a.b")]);
        assert_eq!(names.fresh(&Symbol::new("go")), "go");
        assert_eq!(names.fresh(&Symbol::new("go")), "go-3");
        assert_eq!(names.fresh(&Symbol::new("a_b")), "a_b-2");
        assert_eq!(names.numbered("forall-go", 1), "forall-go-1");
        assert_eq!(names.numbered("forall-go", 1), "forall-go-2");
        assert_eq!(names.numbered("go", 1), "go-1");
        assert_eq!(names.numbered("go", 2), "go-4");
    }

    #[test]
    fn many_names_of_one_base_are_numbered_soon() {
        let mut names = FreshNames::default();
        let last = (0..100_000).map(|_| names.fresh(&Symbol::new("x"))).last();
        assert_eq!(last, Some(Symbol::new("x-100000")));
    }
}
