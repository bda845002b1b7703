//! GetPotentialActions: the model's actions that add an atom of the unreachable atom's predicate.
//!
//! Algorithm 2 speaks of atoms that are to hold. For one that is to hold no longer, and that nothing deletes, the same is asked
//! of the actions that delete an atom of its predicate.

use typelift_model::{ActionModel, ActionSchema, Effect, Symbol};

use crate::Wanted;

/// An action that could bring about what is wanted if its parameters were wide enough.
pub(crate) struct Potential<'a> {
    pub(crate) schema: &'a ActionSchema,
    /// The goal's objects, in place of the parameters that the matching effect mentions.
    pub(crate) binding: Vec<Option<&'a Symbol>>,
}

/// Whether different objects stand where an action's parameters must differ.
pub(crate) fn are_distinct(schema: &ActionSchema, binding: &[Option<&Symbol>]) -> bool {
    let bound = |p: u32| binding[p as usize];
    schema.distinct.iter().all(|&(a, b)| bound(a).is_none() || bound(a) != bound(b))
}

/// One potential action for every effect that can be made equal to what is wanted. An effect for every choice of objects of
/// its own is none: wider parameters of the action do not widen that choice.
pub(crate) fn get_potential_actions<'a>(
    model: &'a ActionModel,
    Wanted { atom, positive }: &'a Wanted,
) -> Vec<Potential<'a>> {
    if *positive { potential(model.adding(atom)) } else { potential(model.deleting(atom)) }
}

fn potential<'a>(
    changing: impl Iterator<Item = (&'a ActionSchema, &'a Effect, Vec<Option<&'a Symbol>>)>,
) -> Vec<Potential<'a>> {
    let changing = changing.filter(|(_, effect, _)| effect.parameters.is_empty());
    let potential = changing.map(|(schema, _, binding)| Potential { schema, binding });
    potential.filter(|potential| are_distinct(potential.schema, &potential.binding)).collect()
}
