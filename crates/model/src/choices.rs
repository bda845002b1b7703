//! The choices of objects for which a conjunction of literals holds in a state.

use std::ops::Bound;

use crate::{Atom, GroundAtom, Hierarchy, LiftedAtom, Literal, Parameter, State, Symbol, Term};

/// What to choose objects for, and which choices count.
pub(crate) struct Choices<'a> {
    /// The parameters, numbered after those that are bound already.
    pub(crate) parameters: &'a [Parameter],
    /// What must hold.
    pub(crate) condition: &'a [Literal],
    pub(crate) state: &'a State,
    pub(crate) hierarchy: &'a Hierarchy,
}

impl Choices<'_> {
    /// Calls `each` with all objects, those bound already first, for every choice. Positive literals are joined in
    /// their order; parameters that none mentions range over all objects of their type.
    pub(crate) fn for_each<'b>(&'b self, bound: &'b [Symbol], each: &mut impl FnMut(&[Symbol])) {
        let mut binding: Vec<Option<&Symbol>> = bound.iter().map(Some).collect();
        binding.resize(bound.len() + self.parameters.len(), None);
        self.join(&self.positive(), bound.len(), &mut binding, each);
    }

    /// The same where no parameter precedes these, and the objects of some are chosen already, whatever their types.
    pub(crate) fn for_each_with<'b>(&'b self, chosen: &mut [Option<&'b Symbol>], each: &mut impl FnMut(&[Symbol])) {
        self.join(&self.positive(), 0, chosen, each);
    }

    fn positive(&self) -> Vec<&LiftedAtom> {
        self.condition.iter().filter(|l| l.positive && !l.atom.is_equality()).map(|l| &l.atom).collect()
    }

    fn join<'b>(
        &'b self,
        open: &[&'b LiftedAtom],
        first: usize,
        binding: &mut [Option<&'b Symbol>],
        each: &mut impl FnMut(&[Symbol]),
    ) {
        let Some((pattern, rest)) = open.split_first() else { return self.complete(first, binding, each) };
        if let Some(atom) = ground(pattern, binding) {
            if self.state.atoms.contains(&atom) {
                self.join(rest, first, binding, each);
            }
            return;
        }
        let from = Atom::new(pattern.predicate.clone(), Vec::new());
        let facts = self.state.atoms.range((Bound::Included(from), Bound::Unbounded));
        for fact in facts.take_while(|fact| fact.predicate == pattern.predicate) {
            let may_take = |p: usize, object: &Symbol, _: &_| self.may_take(first, p, object);
            if let Some(bound) = pattern.bind(fact, binding, may_take) {
                self.join(rest, first, binding, each);
                bound.into_iter().for_each(|p| binding[p] = None);
            }
        }
    }

    /// Whether an object may take the place of a parameter; not of one that should be bound already.
    fn may_take(&self, first: usize, parameter: usize, object: &Symbol) -> bool {
        let Some(own) = parameter.checked_sub(first) else { return false };
        self.state.objects.get(object).is_some_and(|ty| self.hierarchy.is_a(*ty, self.parameters[own].ty))
    }

    fn complete<'b>(&'b self, first: usize, binding: &mut [Option<&'b Symbol>], each: &mut impl FnMut(&[Symbol])) {
        let Some(free) = binding.iter().position(Option::is_none) else {
            let objects: Vec<Symbol> = binding.iter().copied().flatten().cloned().collect();
            let holds = |l: &Literal| self.state.holds(&l.atom.map(|term| term.object(&objects))) == l.positive;
            if self.condition.iter().all(holds) {
                each(&objects);
            }
            return;
        };
        for object in self.state.objects.keys() {
            if self.may_take(first, free, object) {
                binding[free] = Some(object);
                self.complete(first, binding, each);
            }
        }
        binding[free] = None;
    }
}

fn ground(pattern: &LiftedAtom, binding: &[Option<&Symbol>]) -> Option<GroundAtom> {
    let args = pattern.args.iter().map(|term| match term {
        Term::Const(name) => Some(name.clone()),
        Term::Param(p) => binding[*p as usize].cloned(),
    });
    Some(Atom::new(pattern.predicate.clone(), args.collect::<Option<_>>()?))
}
