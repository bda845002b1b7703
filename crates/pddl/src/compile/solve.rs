//! Conjunctions of literals: equalities are solved, and what cannot hold is noticed.
//!
//! An equality of two variables makes them one, of the more specific of their types; of types that share no object, it
//! cannot hold, and of types that only share a kind below both, it stays. An equality of a variable and an object puts the object in the variable's place.

use typelift_model::{Literal, Parameter, Term, TypeId};

use super::normal::equality;
use super::world::World;

/// A conjunction without equalities that could be solved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Solved {
    /// What each variable became.
    pub(super) image: Vec<Term>,
    /// The variables that are left.
    pub(super) variables: Vec<Parameter>,
    /// The literals over these, sorted, each once.
    pub(super) literals: Vec<Literal>,
}

impl Solved {
    /// A term over the former variables, over those that are left.
    pub(super) fn term(&self, term: &Term) -> Term {
        match term {
            Term::Param(index) => self.image[*index as usize].clone(),
            constant @ Term::Const(_) => constant.clone(),
        }
    }
}

/// Solves a conjunction over these variables; `None` if it can never hold. The first `rigid` variables are not replaced,
/// nor do their types change: equalities among them, or that would narrow them, stay.
pub(super) fn solve(world: World<'_>, variables: Vec<Parameter>, rigid: usize, literals: &[Literal]) -> Option<Solved> {
    let bound = vec![None; variables.len()];
    let mut solver = Solver { world, variables, bound, rigid };
    let is_equation = |literal: &&Literal| literal.positive && literal.atom.is_equality();
    let mut kept: Vec<Literal> = Vec::new();
    for literal in literals.iter().filter(is_equation) {
        let [a, b] = literal.atom.args.as_slice() else { return None };
        if !solver.unify(a, b)? {
            kept.push(literal.clone());
        }
    }
    kept.extend(literals.iter().filter(|literal| !is_equation(literal)).cloned());
    let mut rest = Vec::with_capacity(kept.len());
    for literal in &kept {
        let atom = literal.atom.map(|term| solver.resolve(term));
        if !atom.is_equality() {
            rest.push(Literal { atom, positive: literal.positive });
            continue;
        }
        let [a, b] = atom.args.as_slice() else { return None };
        match solver.decide(a, b) {
            Some(same) if same == literal.positive => {}
            Some(_) => return None,
            None => rest.push(equality(a.clone(), b.clone(), literal.positive)),
        }
    }
    solver.finish(rest)
}

struct Solver<'w> {
    world: World<'w>,
    variables: Vec<Parameter>,
    /// What stands in place of each variable, if it was replaced.
    bound: Vec<Option<Term>>,
    rigid: usize,
}

impl Solver<'_> {
    fn resolve(&self, term: &Term) -> Term {
        let mut term = term;
        while let Term::Param(index) = term {
            match &self.bound[*index as usize] {
                Some(next) => term = next,
                None => break,
            }
        }
        term.clone()
    }

    fn is_a(&self, ty: TypeId, ancestor: TypeId) -> bool {
        self.world.hierarchy.is_a(ty, ancestor)
    }

    /// The more specific of two types, if one is.
    fn meet(&self, a: TypeId, b: TypeId) -> Option<TypeId> {
        if self.is_a(a, b) { Some(a) } else { self.is_a(b, a).then_some(b) }
    }

    /// The type of what a term stands for: its variable's or its object's.
    fn ty(&self, term: &Term) -> Option<TypeId> {
        match term {
            Term::Param(index) => Some(self.variables[*index as usize].ty),
            Term::Const(name) => self.world.objects.get(name).copied(),
        }
    }

    /// Makes two terms one. `None` if they cannot be; whether this says all that the equality did.
    fn unify(&mut self, a: &Term, b: &Term) -> Option<bool> {
        let (a, b) = (self.resolve(a), self.resolve(b));
        if a == b {
            return Some(true);
        }
        match (a.clone().min(b.clone()), a.max(b)) {
            (Term::Param(kept), Term::Param(gone)) => {
                let (kept_type, gone_type) = (self.variables[kept as usize].ty, self.variables[gone as usize].ty);
                if self.world.hierarchy.disjoint(kept_type, gone_type) {
                    return None;
                }
                // What is of two types of which none is the other's is of no single one.
                let Some(both) = self.meet(kept_type, gone_type) else { return Some(false) };
                if (gone as usize) < self.rigid {
                    return Some(false);
                }
                if (kept as usize) < self.rigid && both != kept_type {
                    return Some(false);
                }
                self.variables[kept as usize].ty = both;
                self.bound[gone as usize] = Some(Term::Param(kept));
                Some(true)
            }
            (Term::Param(variable), object) => {
                if !self.is_a(self.ty(&object)?, self.variables[variable as usize].ty) {
                    return None;
                }
                if (variable as usize) < self.rigid {
                    return Some(false);
                }
                self.bound[variable as usize] = Some(object);
                Some(true)
            }
            (Term::Const(_), _) => None,
        }
    }

    /// Whether two resolved terms are the same, where that does not depend on the choice of objects.
    fn decide(&self, a: &Term, b: &Term) -> Option<bool> {
        let possible = match (a, b) {
            _ if a == b => return Some(true),
            (Term::Const(_), Term::Const(_)) => false,
            (Term::Param(_), Term::Const(_)) => self.is_a(self.ty(b)?, self.ty(a)?),
            (Term::Const(_), Term::Param(_)) => self.is_a(self.ty(a)?, self.ty(b)?),
            (Term::Param(_), Term::Param(_)) => !self.world.hierarchy.disjoint(self.ty(a)?, self.ty(b)?),
        };
        if possible { None } else { Some(false) }
    }

    /// Numbers the variables that are left.
    fn finish(self, mut literals: Vec<Literal>) -> Option<Solved> {
        let mut number = 0;
        let mut numbers = Vec::with_capacity(self.variables.len());
        for bound in &self.bound {
            numbers.push(number);
            number += u32::from(bound.is_none());
        }
        let renumbered = |term: &Term| match self.resolve(term) {
            Term::Param(index) => Term::Param(numbers[index as usize]),
            object @ Term::Const(_) => object,
        };
        let image = (0..self.variables.len() as u32).map(|index| renumbered(&Term::Param(index))).collect();
        for literal in &mut literals {
            literal.atom = literal.atom.map(renumbered);
        }
        literals.sort_unstable();
        literals.dedup();
        // An atom's negation is sorted directly before the atom.
        if literals.windows(2).any(|pair| pair[0].atom == pair[1].atom) {
            return None;
        }
        let left = self.variables.iter().zip(&self.bound).filter(|(_, bound)| bound.is_none());
        Some(Solved { image, variables: left.map(|(variable, _)| variable.clone()).collect(), literals })
    }
}
