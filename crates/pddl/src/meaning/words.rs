//! What is missing, in the words of the text.

use std::collections::BTreeSet;

use typelift_model::{Symbol, Term, Wording};

use super::formulas::ground;
use super::{Atoms, Chosen, Meaning, chosen};
use crate::formula_text::{free_variables, shortened};
use crate::{Action, Formula};

impl Meaning<'_> {
    /// What an action with these objects needs and does not have: of a conjunction its first part that does not hold, of
    /// alternatives each. Nothing if it can be used.
    pub fn missing(&self, action: &Action, objects: &[Symbol], atoms: &Atoms) -> Vec<String> {
        let chosen = &mut chosen(action, objects);
        let first = self.first_false(&action.precondition, atoms, chosen);
        let mut missing = Vec::new();
        match first {
            None => {}
            Some(Formula::Or(parts)) if !parts.is_empty() => {
                let of_part = |part| self.first_false(part, atoms, chosen);
                let parts: Vec<&Formula> = parts.iter().filter_map(of_part).collect();
                missing.extend(parts.iter().map(|part| said(part, chosen)));
                let mut known = BTreeSet::new();
                missing.retain(|text| known.insert(text.clone()));
            }
            Some(formula) => missing.push(said(formula, chosen)),
        }
        missing
    }

    /// The first part of the goal that does not hold, or what is to hold for every object and first does not for one; none
    /// if it is reached.
    pub fn missed(&self, atoms: &Atoms) -> Option<String> {
        self.missed_part(self.goal(), atoms, &mut Chosen::new())
    }

    fn missed_part(&self, formula: &Formula, atoms: &Atoms, chosen: &mut Chosen) -> Option<String> {
        match formula {
            Formula::And(parts) => parts.iter().find_map(|part| self.missed_part(part, atoms, chosen)),
            Formula::Forall(variables, body) => {
                let mut missed = None;
                self.any(variables, chosen, &mut |chosen| {
                    missed = self.missed_part(body, atoms, chosen);
                    missed.is_some()
                });
                missed
            }
            formula if self.is_true(formula, atoms, chosen) => None,
            // No action changes which objects are the same.
            Formula::Or(parts) => {
                let mut others = parts.iter().filter(|part| !matches!(part, Formula::Equal(..)));
                match (others.next(), others.next()) {
                    (Some(only), None) => self.missed_part(only, atoms, chosen),
                    _ => Some(said(formula, chosen)),
                }
            }
            formula => Some(said(formula, chosen)),
        }
    }

    /// The first part of nested conjunctions that does not hold.
    fn first_false<'f>(&self, formula: &'f Formula, atoms: &Atoms, chosen: &mut Chosen) -> Option<&'f Formula> {
        match formula {
            Formula::And(parts) => parts.iter().find_map(|part| self.first_false(part, atoms, chosen)),
            formula if self.is_true(formula, atoms, chosen) => None,
            formula => Some(formula),
        }
    }
}

/// An atom or its negation as everywhere, whatever else as it is written, with what its variables stand for.
fn said(formula: &Formula, chosen: &Chosen) -> String {
    match formula {
        Formula::Atom(atom) => ground(atom, chosen).to_string(),
        Formula::Not(inner) if matches!(&**inner, Formula::Atom(_)) => format!("not {}", said(inner, chosen)),
        formula => {
            let object = |name: &Symbol| chosen.iter().rev().find(|(variable, _)| variable == name).map(|(_, o)| o);
            let stands_for = |name: &Symbol| Some((name.clone(), Term::Const(object(name)?.clone())));
            let variables = free_variables(formula).into_iter().filter_map(stands_for).collect();
            Wording { formula: shortened(formula).into(), positive: true, variables }.say::<Symbol>(&[], true)
        }
    }
}
