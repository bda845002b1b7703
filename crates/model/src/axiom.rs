//! Derived predicates: what follows from a state, instead of being changed by actions.

use crate::choices::Choices;
use crate::{GroundAtom, Hierarchy, LiftedAtom, Literal, Parameter, State};

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

impl Axiom {
    /// The heads of which the body holds.
    pub(crate) fn consequences(&self, state: &State, hierarchy: &Hierarchy) -> Vec<GroundAtom> {
        let mut heads = Vec::new();
        let choices = Choices { parameters: &self.parameters, condition: &self.body, state, hierarchy };
        choices.for_each(&[], &mut |objects| heads.push(self.head.map(|term| term.object(objects))));
        heads
    }
}
