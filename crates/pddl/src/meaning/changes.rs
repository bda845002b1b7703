//! What an action does.

use thiserror::Error;
use typelift_model::{GroundAtom, Symbol};

use super::formulas::ground;
use super::{Atoms, Chosen, Meaning, chosen};
use crate::{Action, Amount, PddlEffect};

/// A function that a cost needs has no value.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0} has no value")]
pub struct NoValue(pub GroundAtom);

/// What one use of an action changes.
#[derive(Debug, Default)]
struct Changes {
    adds: Atoms,
    deletes: Atoms,
    cost: u64,
}

impl Meaning<'_> {
    /// What holds after an action that can be used with these objects, and what that costs. What it adds and deletes at
    /// once holds.
    ///
    /// # Errors
    /// [`NoValue`] if what it costs is not stated.
    pub fn after(&self, action: &Action, objects: &[Symbol], atoms: &Atoms) -> Result<(Atoms, u64), NoValue> {
        let mut changes = Changes::default();
        self.collect(&action.effect, atoms, &mut chosen(action, objects), &mut changes)?;
        let stays = |atom: &&GroundAtom| !self.derived.contains(&atom.predicate) && !changes.deletes.contains(*atom);
        let mut after: Atoms = atoms.iter().filter(stays).cloned().collect();
        after.append(&mut changes.adds);
        Ok((self.with_derived(after), if self.has_costs { changes.cost } else { 1 }))
    }

    fn collect(
        &self,
        effect: &PddlEffect,
        atoms: &Atoms,
        chosen: &mut Chosen,
        changes: &mut Changes,
    ) -> Result<(), NoValue> {
        match effect {
            PddlEffect::And(parts) => parts.iter().try_for_each(|part| self.collect(part, atoms, chosen, changes))?,
            PddlEffect::Add(atom) => drop(changes.adds.insert(ground(atom, chosen))),
            PddlEffect::Delete(atom) => drop(changes.deletes.insert(ground(atom, chosen))),
            PddlEffect::Forall(variables, body) => {
                let mut result = Ok(());
                self.any(variables, chosen, &mut |chosen| {
                    result = self.collect(body, atoms, chosen, changes);
                    result.is_err()
                });
                result?;
            }
            PddlEffect::When(condition, body) if self.is_true(condition, atoms, chosen) => {
                self.collect(body, atoms, chosen, changes)?;
            }
            PddlEffect::When(..) => {}
            PddlEffect::Increase(Amount::Number(number)) => changes.cost += u64::from(*number),
            PddlEffect::Increase(Amount::Function(function)) if self.has_costs => {
                let function = ground(function, chosen);
                let value = self.values.get(&function).ok_or(NoValue(function))?;
                changes.cost += u64::from(*value);
            }
            PddlEffect::Increase(Amount::Function(_)) => {}
        }
        Ok(())
    }
}
