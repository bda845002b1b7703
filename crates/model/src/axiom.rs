//! Derived predicates: what follows from a state, instead of being changed by actions.

use std::collections::BTreeSet;

use crate::choices::Choices;
use crate::{ActionModel, GroundAtom, Hierarchy, LiftedAtom, Literal, Parameter, State, Symbol};

/// One way in which an atom follows (PDDL 2.2's derived predicates; Thiébaux, Hoffmann and Nebel 2005): for every choice
/// of objects for the parameters for which the body holds, the head holds.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Axiom {
    /// When it is evaluated: after all axioms of smaller strata, and together with those of its own, until nothing new
    /// follows. A derived predicate belongs to one stratum; its axioms' bodies mention derived predicates of smaller
    /// strata and, unnegated, of their own.
    pub stratum: u32,
    /// What follows; its predicate appears in no effect and in no initial state.
    pub head: LiftedAtom,
    /// The typed placeholders of head and body.
    pub parameters: Vec<Parameter>,
    /// What it follows from.
    pub body: Vec<Literal>,
}

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

impl Axiom {
    /// The heads of which the body holds.
    fn consequences(&self, state: &State, hierarchy: &Hierarchy) -> Vec<GroundAtom> {
        let mut heads = Vec::new();
        let choices = Choices { parameters: &self.parameters, condition: &self.body, state, hierarchy };
        choices.for_each(&[], &mut |objects| heads.push(self.head.map(|term| term.object(objects))));
        heads
    }
}
