//! GetPotentialActions: the model's actions that add an atom of the unreachable atom's predicate.

use typelift_model::{ActionModel, ActionSchema, GroundAtom, Symbol, Term};

/// An action that could add the unreachable atom if its parameters were wide enough.
pub(crate) struct Potential<'a> {
    pub(crate) schema: &'a ActionSchema,
    /// The goal's objects, in place of the parameters that the matching add effect mentions.
    pub(crate) binding: Vec<Option<&'a Symbol>>,
}

/// One potential action for every add effect that can be made equal to the atom.
pub(crate) fn get_potential_actions<'a>(model: &'a ActionModel, atom: &'a GroundAtom) -> Vec<Potential<'a>> {
    let mut found = Vec::new();
    for schema in &model.actions {
        for add in schema.adds().filter(|add| add.predicate == atom.predicate && add.arity() == atom.arity()) {
            let mut binding: Vec<Option<&Symbol>> = vec![None; schema.parameters.len()];
            let fits = add.args.iter().zip(&atom.args).all(|(term, object)| match term {
                Term::Const(name) => name == object,
                Term::Param(p) => *binding[*p as usize].get_or_insert(object) == object,
            });
            let bound = |i: u32| binding[i as usize];
            let distinct = schema.distinct.iter().all(|&(a, b)| bound(a).is_none() || bound(a) != bound(b));
            if fits && distinct {
                found.push(Potential { schema, binding });
            }
        }
    }
    found
}
