//! CreateSubstitutedAction: what was put in place of a type in one action is put in its place in the actions that
//! work on the same types. This is what makes picking up from and placing into a new tool follow when its use was
//! imagined.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionModel, ActionSchema, Hierarchy, Provenance, Replacement, TypeId};

use crate::create::raised;

/// The model's actions with the same set of parameter types as the action that was raised, under its replacements.
pub(crate) fn create_substituted_actions(model: &ActionModel, imagined: &ActionSchema) -> Vec<ActionSchema> {
    let Provenance::Imagined { from, replaced, .. } = &imagined.provenance else { return Vec::new() };
    let Some(original) = model.action(from.as_str()) else { return Vec::new() };
    let replacement = by_type(replaced, &model.hierarchy);
    let types = types_of(original);
    let alike = model.actions.iter().filter(|action| types_of(action) == types);
    alike
        .map(|action| {
            let (mut substituted, replaced) = raised(action, |_, ty| replacement.get(&ty).copied().unwrap_or(ty));
            substituted.provenance = Provenance::Substituted {
                from: action.name.clone(),
                replaced,
                following: imagined.name.clone(),
                observations: action.provenance.observations(),
            };
            substituted
        })
        .collect()
}

fn types_of(action: &ActionSchema) -> BTreeSet<TypeId> {
    action.parameters.iter().map(|parameter| parameter.ty).collect()
}

/// Old type to new; the more general one if a type was replaced by two.
fn by_type(replaced: &[Replacement], hierarchy: &Hierarchy) -> BTreeMap<TypeId, TypeId> {
    let mut map = BTreeMap::new();
    for replacement in replaced {
        let to = map.entry(replacement.from).or_insert(replacement.to);
        *to = hierarchy.lca(*to, replacement.to);
    }
    map
}
