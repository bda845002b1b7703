//! Goals.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{ArgumentTypes, GroundAtom, State, Symbol, nearest};

/// What is to be achieved: the atoms that must all hold in the end, and those of which none may.
///
/// ```
/// use typelift_model::{Goal, GroundAtom, State};
///
/// let goal = Goal::from(vec![GroundAtom::parse("cut(lettuce_1)")?]);
/// let mut state = State::default();
/// assert!(!goal.holds_in(&state));
/// state.atoms.insert(GroundAtom::parse("cut(lettuce_1)")?);
/// assert!(goal.holds_in(&state));
/// # Ok::<(), typelift_model::AtomTextError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Goal {
    /// The atoms that must all hold, in the order in which they were asked for.
    pub required: Vec<GroundAtom>,
    /// The atoms of which none may hold.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub forbidden: Vec<GroundAtom>,
}

/// Why a goal is not one for this model and state.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum GoalError {
    /// A predicate that the model does not know.
    #[error("in the goal {atom}: the model has no predicate `{}`", .atom.predicate)]
    UnknownPredicate {
        /// The goal atom.
        atom: GroundAtom,
        /// The predicate that may have been meant.
        near: Option<Symbol>,
    },
    /// A predicate with another number of arguments.
    #[error("in the goal {atom}: `{}` takes {expected} argument{}, not {}", .atom.predicate, if *.expected == 1 { "" } else { "s" }, .atom.arity())]
    Arity {
        /// The goal atom.
        atom: GroundAtom,
        /// The predicate's number of arguments.
        expected: usize,
    },
    /// An object that the state does not have.
    #[error("in the goal {atom}: there is no `{object}` in the state")]
    UnknownObject {
        /// The goal atom.
        atom: GroundAtom,
        /// The object.
        object: Symbol,
        /// The object that may have been meant.
        near: Option<Symbol>,
    },
}

impl GoalError {
    /// What to do about it, if that is known.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::UnknownPredicate { near, .. } | Self::UnknownObject { near, .. } => {
                near.as_ref().map(|name| format!("Did you mean `{name}`?"))
            }
            Self::Arity { atom, expected } => {
                let args: Vec<String> = (1..=*expected).map(|i| format!("x{i}")).collect();
                Some(format!("Write `{}({})`, with the names of entities.", atom.predicate, args.join(",")))
            }
        }
    }
}

impl Goal {
    /// The goal with each atom under the name that these predicates have for it: `at(a,b)` is `at/2(a,b)` where they tell
    /// `at` apart by the number of arguments.
    #[must_use]
    pub fn named_as_in(&self, predicates: &ArgumentTypes) -> Self {
        let named = |atoms: &[GroundAtom]| atoms.iter().map(|atom| atom.named_as_in(predicates)).collect();
        Self { required: named(&self.required), forbidden: named(&self.forbidden) }
    }

    /// Checks that every atom is over known predicates with as many arguments as they take, and over objects of the
    /// state.
    ///
    /// # Errors
    /// [`GoalError`] for the first that is not.
    pub fn check(&self, state: &State, predicates: &ArgumentTypes) -> Result<(), GoalError> {
        for (atom, _) in self.literals() {
            match predicates.get(&atom.predicate) {
                Some(types) if types.len() != atom.arity() => {
                    return Err(GoalError::Arity { atom: atom.clone(), expected: types.len() });
                }
                Some(_) => {}
                None => {
                    let near = nearest(atom.predicate.as_str(), predicates.keys());
                    let near = near.or_else(|| made_from(atom, predicates)).cloned();
                    return Err(GoalError::UnknownPredicate { atom: atom.clone(), near });
                }
            }
            if let Some(object) = atom.args.iter().find(|arg| !state.objects.contains_key(*arg)) {
                let near = nearest(object.as_str(), state.objects.keys()).cloned();
                return Err(GoalError::UnknownObject { atom: atom.clone(), object: object.clone(), near });
            }
        }
        Ok(())
    }

    /// Whether it holds in a state, which holds all that follows from it.
    pub fn holds_in(&self, state: &State) -> bool {
        self.literals().all(|(atom, positive)| state.holds(atom) == positive)
    }

    /// Each atom, and whether it must hold: the required ones first.
    pub fn literals(&self) -> impl Iterator<Item = (&GroundAtom, bool)> {
        self.required.iter().map(|atom| (atom, true)).chain(self.forbidden.iter().map(|atom| (atom, false)))
    }

    /// Whether one of its atoms mentions this object.
    pub fn mentions(&self, object: &Symbol) -> bool {
        self.literals().any(|(atom, _)| atom.args.contains(object))
    }
}

/// A predicate that is made from what a snapshot calls so: the relation `holding` gives `holding_holds`, the attribute
/// `cut` gives `cut_Fresh`; or that is told apart from others of its name, as `at/2`. One with as many arguments, if there is one.
fn made_from<'a>(atom: &GroundAtom, predicates: &'a ArgumentTypes) -> Option<&'a Symbol> {
    let is_made_from = |name: &Symbol| {
        let rest = name.as_str().strip_prefix(atom.predicate.as_str());
        rest.is_some_and(|rest| rest.starts_with(['_', '/']))
    };
    let made = predicates.iter().filter(|(name, _)| is_made_from(name));
    made.min_by_key(|(_, types)| types.len() != atom.arity()).map(|(name, _)| name)
}

impl From<Vec<GroundAtom>> for Goal {
    /// The goal that these atoms hold.
    fn from(required: Vec<GroundAtom>) -> Self {
        Self { required, forbidden: Vec::new() }
    }
}
