//! Who acts, as far as the demonstrations show it.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActedOn, ClusterKey, Hierarchy, NoActor, Observations, Symbol, TypeId};

use crate::LearnError;

/// The type that filled argument 0 of every action and took no other part in any: the default actor; or why there is none.
/// What counts is what was seen, since an action that was generalized may take anything at all, the actor included, in
/// another place. With calls of a single name nothing tells who acts.
///
/// # Errors
/// [`LearnError::UnknownType`] if something observed is of a type that `hierarchy` does not have.
pub(crate) fn demonstrated_actor(
    observations: &Observations,
    hierarchy: &Hierarchy,
) -> Result<Result<TypeId, NoActor>, LearnError> {
    let id = |name: &Symbol| hierarchy.id(name.as_str()).ok_or_else(|| LearnError::UnknownType(name.clone()));
    let (mut calls, mut acting, mut others) = (BTreeSet::new(), BTreeSet::new(), BTreeMap::new());
    for key in observations.clusters.keys() {
        let Some(&first) = key.call.first() else { return Ok(Err(NoActor::NoArgument(key.action.clone()))) };
        calls.insert(&key.action);
        for (parameter, name) in (0..).zip(&key.types) {
            if parameter == first {
                acting.insert(id(name)?);
            } else {
                others.entry(id(name)?).or_insert((key, parameter));
            }
        }
    }
    if let (Some(&call), 1) = (calls.first(), calls.len()) {
        return Ok(Err(NoActor::OneCall(call.clone())));
    }
    Ok(acts_alone(&acting, &others, hierarchy))
}

/// The type in which the acting types meet, if nothing else may be of it; `others` are the types that take another part,
/// each with a place where.
fn acts_alone(
    acting: &BTreeSet<TypeId>,
    others: &BTreeMap<TypeId, (&ClusterKey, u32)>,
    hierarchy: &Hierarchy,
) -> Result<TypeId, NoActor> {
    let Some(meet) = acting.iter().copied().reduce(|a, b| hierarchy.lca(a, b)) else {
        return Err(NoActor::NothingLearned);
    };
    let acted_on = |ty: TypeId, (key, parameter): (&ClusterKey, u32)| ActedOn {
        call: key.action.clone(),
        argument: key.call.iter().position(|&place| place == parameter),
        ty: hierarchy.name(ty).clone(),
    };
    if let Some((&ty, place)) = acting.iter().find_map(|ty| others.get_key_value(ty)) {
        return Err(NoActor::ActedOn(acted_on(ty, *place)));
    }
    let names = || acting.iter().map(|ty| hierarchy.name(*ty).clone()).collect();
    if meet == hierarchy.root() {
        return Err(NoActor::NothingInCommon { acting: names(), root: hierarchy.name(meet).clone() });
    }
    match others.iter().find(|&(&other, _)| !hierarchy.disjoint(other, meet)) {
        None => Ok(meet),
        Some((&other, &place)) => Err(NoActor::NotAlone {
            acting: names(),
            meet: hierarchy.name(meet).clone(),
            other: acted_on(other, place),
            is_covered: hierarchy.is_a(other, meet),
        }),
    }
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
