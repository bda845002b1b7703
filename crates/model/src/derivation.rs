//! What follows from a state by a model's axioms.

use std::collections::BTreeSet;

use crate::{ActionModel, GroundAtom, State, Symbol};

impl ActionModel {
    /// The predicates that are derived.
    pub fn derived_predicates(&self) -> BTreeSet<&Symbol> {
        self.axioms.iter().map(|axiom| &axiom.head.predicate).collect()
    }

    /// The state with what follows from it: atoms of derived predicates that it holds are replaced. Plain, for replaying
    /// plans.
    pub fn with_derived(&self, state: &State) -> State {
        let mut state = state.clone();
        if self.axioms.is_empty() {
            return state;
        }
        let derived = self.derived_predicates();
        state.atoms.retain(|atom| !derived.contains(&atom.predicate));
        let strata: BTreeSet<u32> = self.axioms.iter().map(|axiom| axiom.stratum).collect();
        for stratum in strata {
            loop {
                let axioms = self.axioms.iter().filter(|axiom| axiom.stratum == stratum);
                let new: Vec<GroundAtom> =
                    axioms.flat_map(|axiom| axiom.consequences(&state, &self.hierarchy)).collect();
                let before = state.atoms.len();
                state.atoms.extend(new);
                if state.atoms.len() == before {
                    break;
                }
            }
        }
        state
    }
}
