//! Axioms as derived predicates.

use typelift_model::{Axiom, Symbol, Term};

use super::Writer;
use super::action::variables;
use super::names::pddl;
use crate::{Derived, Formula, PddlTerm, Signature, Typed};

impl Writer<'_> {
    /// An axiom as a `:derived` block of its own: several for one predicate are alternatives.
    pub(super) fn derived(&self, axiom: &Axiom) -> Derived {
        let variables = variables(&axiom.parameters);
        let mut conditions: Vec<Formula> = axiom.body.iter().map(|l| self.literal(l, &variables)).collect();
        let mut head: Vec<Typed> = Vec::new();
        let mut in_head = vec![false; variables.len()];
        for (position, term) in axiom.head.args.iter().enumerate() {
            match term {
                Term::Param(index) if !in_head[*index as usize] => {
                    let index = *index as usize;
                    in_head[index] = true;
                    head.push(self.typed(variables[index].clone(), axiom.parameters[index].ty));
                }
                // PDDL wants different variables in the head: an equality says what they are.
                Term::Param(index) => {
                    let index = *index as usize;
                    let name = unused(position, &variables);
                    let is = PddlTerm::Variable(variables[index].clone());
                    conditions.push(Formula::Equal(PddlTerm::Variable(name.clone()), is));
                    head.push(self.typed(name, axiom.parameters[index].ty));
                }
                Term::Const(constant) => {
                    let name = unused(position, &variables);
                    let is = PddlTerm::Object(pddl(&self.names.objects, constant));
                    conditions.push(Formula::Equal(PddlTerm::Variable(name.clone()), is));
                    head.push(self.typed(name, self.types.constants[constant]));
                }
            }
        }
        let mut condition = if conditions.len() == 1 { conditions.remove(0) } else { Formula::And(conditions) };
        let others = (0..variables.len()).filter(|&index| !in_head[index]);
        let others: Vec<Typed> =
            others.map(|index| self.typed(variables[index].clone(), axiom.parameters[index].ty)).collect();
        if !others.is_empty() {
            condition = Formula::Exists(others, Box::new(condition));
        }
        let name = pddl(&self.names.predicates, &axiom.head.predicate);
        Derived { head: Signature { name, parameters: head }, condition, comment: Vec::new() }
    }
}

/// A variable for this argument of a head that is none of these.
fn unused(position: usize, variables: &[Symbol]) -> Symbol {
    let mut name = format!("argument{position}");
    while variables.iter().any(|variable| *variable == name.as_str()) {
        name.push('x');
    }
    Symbol::from(name)
}
