//! GetPotentialActions: the model's actions that add an atom of the unreachable atom's predicate.

use typelift_model::{ActionModel, ActionSchema, GroundAtom, Symbol};

/// An action that could add the unreachable atom if its parameters were wide enough.
pub(crate) struct Potential<'a> {
    pub(crate) schema: &'a ActionSchema,
    /// The goal's objects, in place of the parameters that the matching add effect mentions.
    pub(crate) binding: Vec<Option<&'a Symbol>>,
}

/// Whether different objects stand where an action's parameters must differ.
pub(crate) fn are_distinct(schema: &ActionSchema, binding: &[Option<&Symbol>]) -> bool {
    let bound = |p: u32| binding[p as usize];
    schema.distinct.iter().all(|&(a, b)| bound(a).is_none() || bound(a) != bound(b))
}

/// One potential action for every add effect that can be made equal to the atom. An effect for every choice of objects of
/// its own is none: wider parameters of the action do not widen that choice.
pub(crate) fn get_potential_actions<'a>(model: &'a ActionModel, atom: &'a GroundAtom) -> Vec<Potential<'a>> {
    let adding = model.adding(atom).filter(|(_, effect, _)| effect.parameters.is_empty());
    let potential = adding.map(|(schema, _, binding)| Potential { schema, binding });
    potential.filter(|potential| are_distinct(potential.schema, &potential.binding)).collect()
}
