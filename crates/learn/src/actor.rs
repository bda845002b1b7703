//! Who acts, as far as the demonstrations show it.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActedOn, ClusterKey, Hierarchy, NoActor, Observations, Symbol, TypeId};

use crate::LearnError;

/// What something of a type does in the calls that were observed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// It is argument 0 of some.
    Acts,
    /// It takes part, but never as argument 0.
    ActedOn,
    /// It takes no part in any.
    Absent,
}

/// What is of this type, or may be, does in the calls that were observed. In time of the clusters.
pub fn part_of(ty: TypeId, observations: &Observations, hierarchy: &Hierarchy) -> Part {
    let may_be = |name: &Symbol| hierarchy.id(name.as_str()).is_some_and(|seen| !hierarchy.disjoint(seen, ty));
    let part = |key: &ClusterKey| {
        let acts = key.call.first().and_then(|&first| key.types.get(first as usize)).is_some_and(may_be);
        if acts {
            Part::Acts
        } else if key.types.iter().any(may_be) {
            Part::ActedOn
        } else {
            Part::Absent
        }
    };
    let parts: Vec<Part> = observations.clusters.keys().map(part).collect();
    let first_of = |wanted: &[Part]| wanted.iter().copied().find(|part| parts.contains(part));
    first_of(&[Part::Acts, Part::ActedOn]).unwrap_or(Part::Absent)
}

/// The type that filled argument 0 of every action and took no other part in any: the default actor; or why there is none.
/// What counts is what was seen, since an action that was generalized may take anything at all, the actor included, in
/// another place. With calls of a single name nothing tells who acts. Where all calls together show nobody, each name is
/// left out in turn: in time of the clusters, times the names.
///
/// # Errors
/// [`LearnError::UnknownType`] if something observed is of a type that `hierarchy` does not have.
pub(crate) fn demonstrated_actor(
    observations: &Observations,
    hierarchy: &Hierarchy,
) -> Result<Result<TypeId, NoActor>, LearnError> {
    let keys: Vec<&ClusterKey> = observations.clusters.keys().collect();
    let why = match shown_by(&keys, hierarchy)? {
        Err(why) if !matches!(why, NoActor::OneCall(_) | NoActor::NothingLearned) => why,
        settled => return Ok(settled),
    };
    let calls: BTreeSet<&Symbol> = keys.iter().map(|key| &key.action).collect();
    let mut but_for = None;
    for call in calls {
        let (own, others): (Vec<&ClusterKey>, Vec<&ClusterKey>) = keys.iter().partition(|key| key.action == *call);
        let Ok(actor) = shown_by(&others, hierarchy)? else { continue };
        let may_act = |name: &Symbol| hierarchy.id(name.as_str()).is_some_and(|ty| !hierarchy.disjoint(ty, actor));
        let is_without = !own.iter().flat_map(|key| &key.types).any(may_act);
        let found = NoActor::ButFor { call: call.clone(), actor: hierarchy.name(actor).clone(), is_without };
        // A call in which nobody acts explains more than one in which somebody else does.
        if is_without || but_for.is_none() {
            but_for = Some(found);
        }
        if is_without {
            break;
        }
    }
    Ok(Err(but_for.or_else(|| nearly_always(&keys, hierarchy)).unwrap_or(why)))
}

/// The one type that is argument 0 of calls of every name and takes no other part, and a call that begins with something else.
fn nearly_always(keys: &[&ClusterKey], hierarchy: &Hierarchy) -> Option<NoActor> {
    let first = |key: &ClusterKey| key.types.get(*key.call.first()? as usize).cloned();
    let calls: BTreeSet<&Symbol> = keys.iter().map(|key| &key.action).collect();
    let of_every_call = |ty: &Symbol| {
        let begins: BTreeSet<&Symbol> =
            keys.iter().filter(|key| first(key).as_ref() == Some(ty)).map(|key| &key.action).collect();
        begins == calls
    };
    let takes_no_other_part = |ty: &Symbol| {
        let may_be = |name: &Symbol| match (hierarchy.id(name.as_str()), hierarchy.id(ty.as_str())) {
            (Some(name), Some(ty)) => !hierarchy.disjoint(name, ty),
            _ => false,
        };
        let others = |key: &&ClusterKey| {
            let places = (0..).zip(&key.types).filter(|(place, _)| key.call.first() != Some(place));
            places.map(|(_, name)| name.clone()).collect::<Vec<_>>()
        };
        !keys.iter().flat_map(others).any(|name| may_be(&name))
    };
    let acting: BTreeSet<Symbol> = keys.iter().filter_map(|key| first(key)).collect();
    let mut alone = acting.iter().filter(|ty| of_every_call(ty) && takes_no_other_part(ty));
    let (actor, None) = (alone.next()?, alone.next()) else { return None };
    let (call, other) = keys.iter().find_map(|key| Some((&key.action, first(key).filter(|ty| ty != actor)?)))?;
    Some(NoActor::NotAlways { actor: actor.clone(), call: call.clone(), other })
}

/// Who acts, as far as these calls show it.
fn shown_by(keys: &[&ClusterKey], hierarchy: &Hierarchy) -> Result<Result<TypeId, NoActor>, LearnError> {
    let id = |name: &Symbol| hierarchy.id(name.as_str()).ok_or_else(|| LearnError::UnknownType(name.clone()));
    let (mut calls, mut acting, mut others) = (BTreeSet::new(), BTreeSet::new(), BTreeMap::new());
    for &key in keys {
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

    const DOCK: [(&str, &str); 4] = [("robot", "object"), ("box", "object"), ("gate", "object"), ("shelf", "object")];

    /// What calls of one effect each show: that they took place.
    fn shown(calls: &[&str]) -> (Hierarchy, Observations) {
        let hierarchy = Hierarchy::from_edges(DOCK).expect("a hierarchy");
        let mut observations = Observations::default();
        for call in calls {
            let atom = GroundAtom::parse(call).expect("a call");
            let call = GroundCall { name: atom.predicate.clone(), args: atom.args.clone() };
            let objects: Vec<&Symbol> = call.args.iter().collect();
            let [before, after] = [vec![], vec![atom.to_string()]].map(|atoms| state(&hierarchy, &objects, &atoms));
            let action = TraceAction::from(call);
            let step = Transition { before: &before, action: &action, after: &after, file: None, step: 1 };
            crate::observe(&mut observations, &step, &hierarchy);
        }
        (hierarchy, observations)
    }

    fn but_for(calls: &[&str]) -> Option<(String, String, bool)> {
        let (hierarchy, observations) = shown(calls);
        match demonstrated_actor(&observations, &hierarchy).expect("known types") {
            Err(NoActor::ButFor { call, actor, is_without }) => Some((call.to_string(), actor.to_string(), is_without)),
            _ => None,
        }
    }

    #[test]
    fn a_single_call_that_hides_who_acts_is_named() {
        let robot = ["lift(robot1,box1)", "lower(robot1,box1,shelf1)"];
        let with = |call| but_for(&[robot[0], robot[1], call]);
        let expected = |call: &str, is_without| Some((call.to_owned(), "robot".to_owned(), is_without));
        assert_eq!(with("close(gate1)"), expected("close", true), "something else acts");
        assert_eq!(with("push(box1,shelf1)"), expected("push", true), "what is acted on elsewhere acts");
        assert_eq!(with("give(robot1,robot2)"), expected("give", false), "who acts is acted on");
        assert_eq!(with("wait()"), expected("wait", true), "nothing is named");
        assert_eq!(with("tow(gate1,robot1)"), expected("tow", false));
        let robot_alone = [robot[0], robot[1], "close(robot1,gate1)"];
        assert_eq!(but_for(&robot_alone), None, "there is one");
        assert_eq!(
            but_for(&["lift(robot1,box1)", "close(gate1)"]),
            None,
            "what is left is one call, which tells nothing"
        );
        let two = [robot[0], robot[1], "close(gate1)", "push(box1,shelf1)"];
        assert_eq!(but_for(&two), None, "it takes more than one call");
    }

    #[test]
    fn the_part_of_a_type_is_the_greatest_that_it_takes() {
        let (hierarchy, observations) = shown(&["lift(robot1,box1)", "push(box1,shelf1)"]);
        let part = |name: &str| part_of(hierarchy.id(name).expect("a type"), &observations, &hierarchy);
        let of_all = ["robot", "box", "shelf", "gate", "object"].map(part);
        assert_eq!(of_all, [Part::Acts, Part::Acts, Part::ActedOn, Part::Absent, Part::Acts]);
    }
}
