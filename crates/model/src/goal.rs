//! Goals.

use crate::{GroundAtom, State, Symbol};

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
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Goal {
    /// The atoms that must all hold, in the order in which they were asked for.
    pub required: Vec<GroundAtom>,
    /// The atoms of which none may hold. Goals for learned models have none.
    pub forbidden: Vec<GroundAtom>,
}

impl Goal {
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
