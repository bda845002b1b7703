//! From a lifted to a ground action, plainly, as `check` and `agent` see it. `plan` has its own,
//! packed, and since its plans are replayed by this one, a mistake in either is found by the other.

use std::collections::BTreeMap;

use thiserror::Error;

use crate::choices::Choices;
use crate::{ActionSchema, GroundAtom, GroundCall, Hierarchy, State, Symbol, Term};

/// Why an action schema and a list of objects do not make a ground action.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InstantiateError {
    /// The number of objects is not the number of parameters.
    #[error("{action} takes {expected} objects, not {found}")]
    Arity {
        /// The action's name.
        action: Symbol,
        /// Its number of parameters.
        expected: usize,
        /// The number of objects given.
        found: usize,
    },
    /// An object that the state does not have.
    #[error("there is no object `{object}`")]
    UnknownObject {
        /// The object's name.
        object: Symbol,
    },
    /// An object of the wrong type.
    #[error("{object} is of type {found}, where {action} takes one of type {expected}")]
    Type {
        /// The action's name.
        action: Symbol,
        /// The object's name.
        object: Symbol,
        /// The parameter's type, or its types.
        expected: Symbol,
        /// The object's type.
        found: Symbol,
    },
    /// One object for two parameters that must differ.
    #[error("{action} takes different objects where both are {object}")]
    NotDistinct {
        /// The action's name.
        action: Symbol,
        /// The object's name.
        object: Symbol,
    },
    /// What it costs is not stated.
    #[error("what {action} costs there is not stated")]
    NoCost {
        /// The action's name.
        action: Symbol,
    },
}

/// A ground action whose conditional effects were resolved in the state it was made for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GroundAction {
    /// The schema's name.
    pub schema: Symbol,
    /// The objects put in place of the parameters, in order.
    pub objects: Vec<Symbol>,
    /// What the environment is told.
    pub call: GroundCall,
    /// Preconditions: an atom, and whether it must hold.
    pub preconditions: Vec<(GroundAtom, bool)>,
    /// Atoms that it adds, sorted.
    pub adds: Vec<GroundAtom>,
    /// Atoms that it deletes and does not add, sorted.
    pub deletes: Vec<GroundAtom>,
}

impl GroundAction {
    /// The preconditions that do not hold in `state`. An unknown atom counts as not holding.
    pub fn unmet<'a>(&'a self, state: &'a State) -> impl Iterator<Item = &'a (GroundAtom, bool)> {
        self.preconditions.iter().filter(|(atom, positive)| state.holds(atom) != *positive)
    }
}

impl ActionSchema {
    /// Puts objects in place of the parameters. Conditional effects are resolved in `state`; preconditions are not
    /// checked.
    ///
    /// # Errors
    /// [`InstantiateError`] if number, type or distinctness of the objects does not fit.
    pub fn instantiate(
        &self,
        objects: &[Symbol],
        state: &State,
        hierarchy: &Hierarchy,
    ) -> Result<GroundAction, InstantiateError> {
        if objects.len() != self.parameters.len() {
            return Err(InstantiateError::Arity {
                action: self.name.clone(),
                expected: self.parameters.len(),
                found: objects.len(),
            });
        }
        for (object, parameter) in objects.iter().zip(&self.parameters) {
            let ty =
                *state.objects.get(object).ok_or_else(|| InstantiateError::UnknownObject { object: object.clone() })?;
            if !hierarchy.is_a(ty, parameter.ty) {
                return Err(InstantiateError::Type {
                    action: self.name.clone(),
                    object: object.clone(),
                    expected: hierarchy.name(parameter.ty).clone(),
                    found: hierarchy.name(ty).clone(),
                });
            }
        }
        for &(i, j) in &self.distinct {
            if objects[i as usize] == objects[j as usize] {
                return Err(InstantiateError::NotDistinct {
                    action: self.name.clone(),
                    object: objects[i as usize].clone(),
                });
            }
        }
        let mut changes: BTreeMap<GroundAtom, bool> = BTreeMap::new();
        for effect in &self.effects {
            let choices = Choices { parameters: &effect.parameters, condition: &effect.condition, state, hierarchy };
            choices.for_each(objects, &mut |chosen| {
                let added = changes.entry(effect.literal.atom.map(|term| term.object(chosen))).or_default();
                *added |= effect.literal.positive;
            });
        }
        let term = |term: &Term| term.object(objects);
        let select = |added: bool| changes.iter().filter(|(_, a)| **a == added).map(|(atom, _)| atom.clone()).collect();
        Ok(GroundAction {
            schema: self.name.clone(),
            objects: objects.to_vec(),
            call: GroundCall { name: self.call.name.clone(), args: self.call.args.iter().map(term).collect() },
            preconditions: self.preconditions.iter().map(|l| (l.atom.map(term), l.positive)).collect(),
            adds: select(true),
            deletes: select(false),
        })
    }
}
