//! What follows where a person wants another object in place of one of a step.

use std::cmp::Reverse;
use std::collections::BTreeSet;

use typelift_model::{ActionModel, GroundCall, State, Step, Symbol};

use crate::objection::Objection;

/// The same objection, naming the object of the step that another one is wanted for: if it names none, the one that is most of
/// the other's kind, does not act and, if possible, is not what the goal is about. It still names none, or another objection is
/// given back as it is, if there is no such object or the other one is not there.
pub(crate) fn named(
    objection: Objection,
    step: &Step,
    state: &State,
    model: &ActionModel,
    in_goal: impl Fn(&Symbol) -> bool,
) -> Objection {
    let Objection::Instead { object, with } = objection else { return objection };
    let object = match object {
        Some(object) => Some(object).filter(|object| step.call.args.contains(object)),
        None => nearest(step, &with, state, model, in_goal),
    };
    let object = object.filter(|_| state.objects.contains_key(&with) && !step.objects.contains(&with));
    Objection::Instead { object, with }
}

fn nearest(
    step: &Step,
    with: &Symbol,
    state: &State,
    model: &ActionModel,
    in_goal: impl Fn(&Symbol) -> bool,
) -> Option<Symbol> {
    let wanted = *state.objects.get(with)?;
    let hierarchy = &model.hierarchy;
    let kin = |arg: &Symbol| {
        let ty = *state.objects.get(arg)?;
        (!model.is_actor(ty)).then(|| (!in_goal(arg), hierarchy.depth(hierarchy.lca(ty, wanted))))
    };
    let places = step.call.args.iter().enumerate().filter_map(|(place, arg)| Some((kin(arg)?, Reverse(place), arg)));
    places.max().map(|(.., object)| object.clone())
}

/// The calls that are not made then: the same with any other object of the lowest kind that the two have in common; if they
/// have nothing in common, with one of the first one's type.
pub(crate) fn others(
    call: &GroundCall,
    object: &Symbol,
    with: &Symbol,
    state: &State,
    model: &ActionModel,
) -> BTreeSet<GroundCall> {
    let hierarchy = &model.hierarchy;
    let ty = |object: &Symbol| state.objects.get(object).copied().unwrap_or(hierarchy.root());
    let own = ty(object);
    let common = hierarchy.lca(own, ty(with));
    let kind = if common == hierarchy.root() { own } else { common };
    let others = state.objects.iter().filter(|(other, ty)| *other != with && hierarchy.is_a(**ty, kind));
    let with_it = |other: &Symbol| {
        let args = call.args.iter().map(|arg| if arg == object { other } else { arg });
        GroundCall { name: call.name.clone(), args: args.cloned().collect() }
    };
    others.map(|(other, _)| with_it(other)).chain([call.clone()]).collect()
}
