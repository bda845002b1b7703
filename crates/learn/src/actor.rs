//! Who acts, as far as the demonstrations show it.

use std::collections::BTreeSet;

use typelift_model::{Hierarchy, Observations, Symbol, TypeId};

use crate::LearnError;

/// The type that filled argument 0 of every action and took no other part in any: the default actor. What counts is what
/// was seen, since an action that was generalized may take anything at all, the actor included, in another place. With
/// calls of a single name nothing tells who acts, and there is none.
///
/// # Errors
/// [`LearnError::UnknownType`] if something observed is of a type that `hierarchy` does not have.
pub(crate) fn demonstrated_actor(
    observations: &Observations,
    hierarchy: &Hierarchy,
) -> Result<Option<TypeId>, LearnError> {
    let id = |name: &Symbol| hierarchy.id(name.as_str()).ok_or_else(|| LearnError::UnknownType(name.clone()));
    let (mut calls, mut acting, mut others) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    for key in observations.clusters.keys() {
        let Some(&first) = key.call.first() else { return Ok(None) };
        calls.insert(&key.action);
        for (parameter, name) in (0..).zip(&key.types) {
            let part = if parameter == first { &mut acting } else { &mut others };
            part.insert(id(name)?);
        }
    }
    let actor = acting.into_iter().reduce(|a, b| hierarchy.lca(a, b));
    let is_alone = |actor: &TypeId| others.iter().all(|&other| hierarchy.disjoint(other, *actor));
    Ok(actor.filter(|actor| calls.len() > 1 && *actor != hierarchy.root() && is_alone(actor)))
}

#[cfg(test)]
mod tests {
    use typelift_model::{ActionModel, GroundAtom, GroundCall, State};
    use typelift_world::{TraceAction, Transition};

    use super::*;
    use crate::{Options, learn};

    /// The type of a thing is its name without its number.
    fn state(hierarchy: &Hierarchy, objects: &[&Symbol], atoms: &[String]) -> State {
        let ty = |object: &Symbol| hierarchy.id(object.as_str().trim_end_matches(|c: char| c.is_ascii_digit()));
        let objects = objects.iter().map(|&object| (object.clone(), ty(object).expect("declared"))).collect();
        let atoms = atoms.iter().map(|atom| GroundAtom::parse(atom).expect("an atom")).collect();
        State { objects, atoms, ..State::default() }
    }

    /// What is learned from `grasp(WHO, THING)` and `drop(WHO, THING, WHERE)`.
    fn learned(types: &[(&str, &str)], grasps: &[[&str; 2]], drops: &[[&str; 3]]) -> ActionModel {
        let hierarchy = Hierarchy::from_edges(types.iter().copied()).expect("a hierarchy");
        let mut observations = Observations::default();
        let mut observe = |name: &str, args: &[&str], before: &[String], after: &[String]| {
            let call = GroundCall { name: name.into(), args: args.iter().map(|arg| Symbol::new(arg)).collect() };
            let objects: Vec<&Symbol> = call.args.iter().collect();
            let (before, after) = (state(&hierarchy, &objects, before), state(&hierarchy, &objects, after));
            let action = TraceAction::from(call);
            let step = Transition { before: &before, action: &action, after: &after, file: None, step: 1 };
            crate::observe(&mut observations, &step, &hierarchy);
        };
        for [who, thing] in grasps {
            observe("grasp", &[who, thing], &[format!("empty({who})")], &[format!("holds({who},{thing})")]);
        }
        for [who, thing, place] in drops {
            let after = [format!("empty({who})"), format!("on({thing},{place})")];
            observe("drop", &[who, thing, place], &[format!("holds({who},{thing})")], &after);
        }
        learn(&hierarchy, &observations, &Options::default()).expect("known types").model
    }

    fn actor(model: &ActionModel) -> Option<&str> {
        model.actor.map(|ty| model.hierarchy.name(ty).as_str())
    }

    const FLAT: [(&str, &str); 4] = [("hand", "object"), ("cup", "object"), ("lid", "object"), ("table", "object")];

    #[test]
    fn a_place_for_anything_does_not_hide_who_acts() {
        let grasps = [["hand1", "cup1"], ["hand1", "lid1"]];
        let model = learned(&FLAT, &grasps, &[["hand1", "cup1", "table1"], ["hand1", "lid1", "cup1"]]);
        let names: Vec<&str> = model.actions.iter().map(|action| action.name.as_str()).collect();
        assert_eq!(names, ["drop-object-object", "grasp-object"], "things and places are as general as can be");
        assert_eq!(actor(&model), Some("hand"));
    }

    #[test]
    fn who_is_acted_on_as_well_is_no_actor() {
        let given = learned(&FLAT, &[["hand1", "cup1"]], &[["hand1", "cup1", "hand2"]]);
        assert_eq!(actor(&given), None);
        let single = learned(&FLAT, &[["hand1", "cup1"]], &[]);
        assert_eq!(actor(&single), None, "one call tells nothing");
    }

    #[test]
    fn those_who_act_have_a_type_in_common() {
        let types = [("left", "hand"), ("right", "hand"), ("hand", "object"), ("cup", "object"), ("table", "object")];
        let model = learned(&types, &[["left1", "cup1"]], &[["right1", "cup1", "table1"]]);
        assert_eq!(actor(&model), Some("hand"));
    }
}
