//! Goals.

use serde::{Deserialize, Serialize};

use crate::{ArgumentTypes, GoalError, GoalErrorKind, GroundAtom, Hierarchy, State, Symbol};

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

impl Goal {
    /// The goal with each atom under the name that these predicates have for it: `at(a,b)` is `at/2(a,b)` where they tell
    /// `at` apart by the number of arguments.
    #[must_use]
    pub fn named_as_in(&self, predicates: &ArgumentTypes) -> Self {
        let named = |atoms: &[GroundAtom]| atoms.iter().map(|atom| atom.named_as_in(predicates)).collect();
        Self { required: named(&self.required), forbidden: named(&self.forbidden) }
    }

    /// Checks that every atom is over known predicates with as many arguments as they take, and over objects of the
    /// state, whose types are of `hierarchy`.
    ///
    /// # Errors
    /// [`GoalError`] for the first that is not.
    pub fn check(&self, state: &State, predicates: &ArgumentTypes, hierarchy: &Hierarchy) -> Result<(), GoalError> {
        let wrong = |(atom, positive): (&GroundAtom, bool)| {
            let kind = GoalErrorKind::of(atom, state, predicates, hierarchy)?;
            Some(GoalError { atom: atom.clone(), positive, kind })
        };
        self.literals().find_map(wrong).map_or(Ok(()), Err)
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

impl From<Vec<GroundAtom>> for Goal {
    /// The goal that these atoms hold.
    fn from(required: Vec<GroundAtom>) -> Self {
        Self { required, forbidden: Vec::new() }
    }
}
