//! Whether a formula holds.

use typelift_model::{GroundAtom, Symbol};

use super::{Atoms, Chosen, Meaning, chosen};
use crate::{Action, Formula, PddlAtom, PddlTerm};

impl Meaning<'_> {
    /// Whether a formula without free variables holds. In time of the product of the numbers of objects that its nested
    /// quantifiers go through.
    pub fn holds(&self, formula: &Formula, atoms: &Atoms) -> bool {
        self.is_true(formula, atoms, &mut Chosen::new())
    }

    /// Whether an action can be used with these objects, if they are of the right number and types.
    pub fn can_be_used(&self, action: &Action, objects: &[Symbol], atoms: &Atoms) -> bool {
        self.is_true(&action.precondition, atoms, &mut chosen(action, objects))
    }

    pub(super) fn is_true(&self, formula: &Formula, atoms: &Atoms, chosen: &mut Chosen) -> bool {
        match formula {
            Formula::Atom(atom) => atoms.contains(&ground(atom, chosen)),
            Formula::Equal(a, b) => object(a, chosen) == object(b, chosen),
            Formula::Not(inner) => !self.is_true(inner, atoms, chosen),
            Formula::And(parts) => parts.iter().all(|part| self.is_true(part, atoms, chosen)),
            Formula::Or(parts) => parts.iter().any(|part| self.is_true(part, atoms, chosen)),
            Formula::Imply(premise, conclusion) => {
                !self.is_true(premise, atoms, chosen) || self.is_true(conclusion, atoms, chosen)
            }
            Formula::Exists(variables, body) => {
                self.any(variables, chosen, &mut |chosen| self.is_true(body, atoms, chosen))
            }
            Formula::Forall(variables, body) => {
                !self.any(variables, chosen, &mut |chosen| !self.is_true(body, atoms, chosen))
            }
        }
    }
}

/// What a term stands for. A variable that is not in scope stands for its own name: the reader returns none.
fn object(term: &PddlTerm, chosen: &Chosen) -> Symbol {
    match term {
        PddlTerm::Object(name) => name.clone(),
        PddlTerm::Variable(name) => {
            let found = chosen.iter().rev().find(|(variable, _)| variable == name);
            found.map_or_else(|| name.clone(), |(_, object)| object.clone())
        }
    }
}

pub(super) fn ground(atom: &PddlAtom, chosen: &Chosen) -> GroundAtom {
    atom.map(|term| object(term, chosen))
}
