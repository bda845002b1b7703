//! CreateImaginedAction: raises the types of a potential action until the unreachable atom fits.
//!
//! A parameter that the atom binds rises to the lowest common ancestor of its type and the object's. Any other
//! parameter keeps its type while the task has an object for it that may be used; if it has none, it rises to the
//! deepest ancestor that it shares with the type of any such object.

use std::collections::BTreeSet;

use typelift_model::{ActionSchema, Provenance, Replacement, Symbol, TypeId};

use crate::potential::Potential;
use crate::{Context, Wanted};

/// A potential action with raised types.
pub(crate) struct Proposal<'a> {
    pub(crate) schema: &'a ActionSchema,
    pub(crate) binding: Vec<Option<&'a Symbol>>,
    /// The type of each parameter, raised where necessary.
    pub(crate) types: Vec<TypeId>,
}

/// The proposal for a potential action; `None` if a bound object does not exist or may not be used.
pub(crate) fn create_imagined_action<'a>(context: &Context<'_>, potential: &Potential<'a>) -> Option<Proposal<'a>> {
    let Potential { schema, binding } = potential;
    let hierarchy = &context.model.hierarchy;
    let bound: BTreeSet<&Symbol> = binding.iter().copied().flatten().collect();
    let types_bound: Vec<Option<TypeId>> =
        binding.iter().map(|object| context.task.init.objects.get((*object)?).copied()).collect();
    if !context.restrictions.allows_types(schema, &types_bound, hierarchy) {
        return None;
    }
    let mut types = Vec::with_capacity(binding.len());
    for (parameter, object) in schema.parameters.iter().zip(binding) {
        types.push(match object {
            Some(object) => {
                let ty = *context.task.init.objects.get(*object)?;
                if !context.restrictions.allows(object, &schema.call.name) {
                    return None;
                }
                hierarchy.lca(parameter.ty, ty)
            }
            None => context
                .available(&bound)
                .map(|(_, ty)| hierarchy.lca(parameter.ty, ty))
                .max_by_key(|&ancestor| hierarchy.depth(ancestor))
                .unwrap_or(parameter.ty),
        });
    }
    Some(Proposal { schema, binding: binding.clone(), types })
}

impl Proposal<'_> {
    /// Whether any type was raised.
    pub(crate) fn is_new(&self) -> bool {
        self.schema.parameters.iter().zip(&self.types).any(|(parameter, ty)| parameter.ty != *ty)
    }

    /// The imagined action, still with the name of the one it raises.
    pub(crate) fn into_schema(self, wanted: &Wanted) -> ActionSchema {
        let (mut action, replaced) = raised(self.schema, |i, _| self.types[i]);
        action.provenance = Provenance::Imagined {
            from: self.schema.name.clone(),
            replaced,
            goal: wanted.atom.clone(),
            positive: wanted.positive,
            observations: self.schema.provenance.observations(),
        };
        action
    }
}

/// The action with `new_type(index, old)` as the type of each parameter, and which were replaced.
pub(crate) fn raised(
    schema: &ActionSchema,
    new_type: impl Fn(usize, TypeId) -> TypeId,
) -> (ActionSchema, Vec<Replacement>) {
    let mut action = schema.clone();
    let mut replaced = Vec::new();
    for (i, parameter) in action.parameters.iter_mut().enumerate() {
        let (from, to) = (parameter.ty, new_type(i, parameter.ty));
        if from != to {
            replaced.push(Replacement { parameter: i as u32, from, to });
            parameter.ty = to;
        }
    }
    (action, replaced)
}
