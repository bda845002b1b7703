//! Derived predicates for parts of conditions: their axioms, from the cases of which one is to hold.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{Atom, Axiom, LiftedAtom, Literal, MOST_PARAMETERS, Parameter, Symbol, Term, Wording};

use super::block::Block;
use super::case::Case;
use super::error::CompileError;
use super::inventions::{Rule, rule};
use super::said::of_predicate;
use super::solve::solve;
use super::world::World;

impl Block<'_> {
    /// What a case counts besides its literals.
    const EACH_CASE: usize = 3;

    /// An atom of a derived predicate that holds if and only if one of the cases does; `None` if none ever can.
    /// Its arguments are the variables that the cases mention and do not own; `said` is how the text puts that one of the
    /// cases holds.
    pub(super) fn invent(
        &mut self,
        kind: &str,
        said: Option<&Wording>,
        cases: &[Case],
    ) -> Result<Option<LiftedAtom>, CompileError> {
        let name = format!("{kind}-{}", self.name);
        self.invent_as(&name, said, cases)
    }

    /// As [`invent`](Self::invent), with this name before the number.
    pub(super) fn invent_as(
        &mut self,
        name: &str,
        said: Option<&Wording>,
        cases: &[Case],
    ) -> Result<Option<LiftedAtom>, CompileError> {
        let free = Self::free_variables(cases);
        self.check_parameters(free.len())?;
        let mut axioms = self.axioms(&Symbol::default(), &free, cases)?;
        if axioms.is_empty() {
            return Ok(None);
        }
        let mut rules: Vec<Rule> = axioms.iter().map(rule).collect();
        rules.sort_unstable();
        let predicate = match self.inventions.known.get(&rules) {
            Some(known) => known.clone(),
            None => {
                let predicate = self.inventions.predicate(name, said.map(|said| of_predicate(said, &free)));
                for axiom in &mut axioms {
                    axiom.head.predicate = predicate.clone();
                }
                self.inventions.axioms.extend(axioms);
                self.inventions.known.insert(rules, predicate.clone());
                predicate
            }
        };
        Ok(Some(Atom { predicate, args: free.into_iter().map(Term::Param).collect() }))
    }

    /// The axioms by which an atom over the variables `head` follows from any of the cases, each once, in the cases'
    /// order.
    pub(super) fn axioms(
        &mut self,
        predicate: &Symbol,
        head: &[u32],
        cases: &[Case],
    ) -> Result<Vec<Axiom>, CompileError> {
        let mut axioms = Vec::with_capacity(cases.len());
        let mut seen = BTreeSet::new();
        for case in cases {
            let variables = [head, &case.exists].concat();
            for typing in self.typings(&variables)? {
                self.count_literals(case.literals.len())?;
                let Some(axiom) = axiom(self.world, predicate, head.len(), &variables, typing, case) else { continue };
                self.check_parameters(axiom.parameters.len())?;
                if seen.insert(rule(&axiom)) {
                    axioms.push(axiom);
                }
            }
        }
        Ok(axioms)
    }

    /// That a model does not become too large, with these literals of one more case.
    pub(super) fn count_literals(&mut self, number: usize) -> Result<(), CompileError> {
        let (literals, most) = (&mut self.inventions.literals, self.world.limits.literals);
        *literals = literals.saturating_add(number).saturating_add(Self::EACH_CASE);
        if *literals <= most {
            return Ok(());
        }
        let message = format!("with it, the domain has more than {most} literals when all cases are written out");
        Err(self.error(message).not_supported())
    }

    /// That there are not too many parameters for a model.
    pub(super) fn check_parameters(&self, number: usize) -> Result<(), CompileError> {
        if number <= MOST_PARAMETERS {
            return Ok(());
        }
        Err(self
            .error(format!("it needs {number} variables at once, at most {MOST_PARAMETERS} are supported"))
            .not_supported())
    }
}

/// The axiom of one case with these types of its variables, of which the first `arity` are the head's.
fn axiom(
    world: World<'_>,
    predicate: &Symbol,
    arity: usize,
    variables: &[u32],
    typing: Vec<Parameter>,
    case: &Case,
) -> Option<Axiom> {
    let solved = solve(world, typing, 0, &renumbered(&case.literals, variables))?;
    let head = Atom { predicate: predicate.clone(), args: solved.image[..arity].to_vec() };
    Some(Axiom { stratum: 0, head, parameters: solved.variables, body: solved.literals })
}

/// The literals over positions in `variables`, which holds all that they mention.
pub(super) fn renumbered(literals: &[Literal], variables: &[u32]) -> Vec<Literal> {
    let position: BTreeMap<u32, u32> =
        variables.iter().enumerate().map(|(at, variable)| (*variable, at as u32)).collect();
    let term = |term: &Term| match term {
        Term::Param(variable) => Term::Param(position.get(variable).copied().unwrap_or(*variable)),
        object @ Term::Const(_) => object.clone(),
    };
    literals.iter().map(|literal| Literal { atom: literal.atom.map(term), positive: literal.positive }).collect()
}
