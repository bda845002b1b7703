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
    pub(crate) fn for_each(&self, bound: &[Symbol], each: &mut impl FnMut(&[Symbol])) {
        let mut binding: Vec<Option<Symbol>> = bound.iter().cloned().map(Some).collect();
        binding.resize(bound.len() + self.parameters.len(), None);
        let positive: Vec<&LiftedAtom> =
            self.condition.iter().filter(|l| l.positive && !l.atom.is_equality()).map(|l| &l.atom).collect();
        self.join(&positive, bound.len(), &mut binding, each);
    }

    fn join(
        &self,
        open: &[&LiftedAtom],
        first: usize,
        binding: &mut Vec<Option<Symbol>>,
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
            let before = binding.clone();
            if self.bind(pattern, fact, first, binding) {
                self.join(rest, first, binding, each);
            }
            *binding = before;
        }
    }

    fn bind(&self, pattern: &LiftedAtom, fact: &GroundAtom, first: usize, binding: &mut [Option<Symbol>]) -> bool {
        pattern.arity() == fact.arity()
            && pattern.args.iter().zip(&fact.args).all(|(term, object)| match term {
                Term::Const(name) => name == object,
                Term::Param(p) => {
                    let p = *p as usize;
                    match &binding[p] {
                        Some(known) => known == object,
                        None => {
                            binding[p] = Some(object.clone());
                            p.checked_sub(first).is_some_and(|own| self.fits(own, object))
                        }
                    }
                }
            })
    }

    fn fits(&self, own: usize, object: &Symbol) -> bool {
        let ty = self.state.objects.get(object);
        ty.is_some_and(|ty| self.hierarchy.is_a(*ty, self.parameters[own].ty))
    }

    fn complete(&self, first: usize, binding: &mut Vec<Option<Symbol>>, each: &mut impl FnMut(&[Symbol])) {
        let Some(free) = binding.iter().position(Option::is_none) else {
            let objects: Vec<Symbol> = binding.iter().flatten().cloned().collect();
            let holds = |l: &Literal| self.state.holds(&l.atom.map(|term| term.object(&objects))) == l.positive;
            if self.condition.iter().all(holds) {
                each(&objects);
            }
            return;
        };
        for object in self.state.objects.keys() {
            if free.checked_sub(first).is_some_and(|own| self.fits(own, object)) {
                binding[free] = Some(object.clone());
                self.complete(first, binding, each);
            }
        }
        binding[free] = None;
    }
}

fn ground(pattern: &LiftedAtom, binding: &[Option<Symbol>]) -> Option<GroundAtom> {
    let args = pattern.args.iter().map(|term| match term {
        Term::Const(name) => Some(name.clone()),
        Term::Param(p) => binding[*p as usize].clone(),
    });
    Some(Atom::new(pattern.predicate.clone(), args.collect::<Option<_>>()?))
}
