//! `learn --actor`: who acts, as it is said, beside what was seen.

use std::collections::BTreeSet;

use typelift::learn::{Actor, LearnError, Part, part_of};
use typelift::model::{ActionModel, ClusterKey, NoActor, Observations, Symbol};

use crate::failure::{Failure, or_one_of};
use crate::style::{HINT, WARNING};

/// What the option says, if it is given.
pub(crate) fn declared(option: Option<&str>) -> Option<Actor> {
    option.map(|name| if name == "none" { Actor::Nobody } else { Actor::Type(Symbol::new(name)) })
}

/// That the types do not have the one that is to act.
pub(crate) fn unknown(error: &LearnError, types: &[Symbol]) -> Failure {
    let LearnError::UnknownType(name) = error;
    let hint = format!("{} Or say `none`.", or_one_of(name.as_str(), types));
    Failure::bad_input(format!("--actor {name}: {error}")).with_hint(hint)
}

/// The type that is said to act, and what of it was seen in the actions; nothing if none is said, or nothing was learned.
fn part<'a>(actor: Option<&'a Actor>, model: &ActionModel, observed: &Observations) -> Option<(&'a Symbol, Part)> {
    let (Some(Actor::Type(name)), Some(ty)) = (actor, model.actor) else { return None };
    (!observed.clusters.is_empty()).then(|| (name, part_of(ty, observed, &model.hierarchy)))
}

/// Refuses a type of which nothing takes part in any action.
pub(crate) fn refuse_absent(
    actor: Option<&Actor>,
    model: &ActionModel,
    observed: &Observations,
) -> Result<(), Failure> {
    match part(actor, model, observed) {
        Some((name, Part::Absent)) => {
            let message = format!("--actor {name}: nothing of that type takes part in any action");
            Err(Failure::bad_input(message).with_hint(format!("{} Or say `none`.", who_acts(observed))))
        }
        _ => Ok(()),
    }
}

/// Warns of a type that only takes other parts than who acts: it may be a slip.
pub(crate) fn warn_of_acted_on(actor: Option<&Actor>, model: &ActionModel, observed: &Observations) {
    if let Some((name, Part::ActedOn)) = part(actor, model, observed) {
        anstream::eprintln!(
            "{WARNING}warning{WARNING:#}: --actor {name}: who acts is argument 0 of an action, and no {name} ever was"
        );
        anstream::eprintln!("{HINT}hint{HINT:#}: {}", who_acts(observed));
    }
}

fn who_acts(observed: &Observations) -> String {
    let first = |key: &ClusterKey| key.types.get(*key.call.first()? as usize).cloned();
    let types: BTreeSet<Symbol> = observed.clusters.keys().filter_map(first).collect();
    let types: Vec<&str> = types.iter().map(Symbol::as_str).collect();
    format!("Argument 0 of the actions is of type {}.", types.join(" or "))
}

/// Says how an actor that the demonstrations do not show is said.
pub(crate) fn hint(why: Option<&NoActor>) {
    let actor = match why {
        Some(NoActor::ButFor { actor, .. } | NoActor::NotAlways { actor, .. }) => actor.as_str(),
        _ => "TYPE",
    };
    anstream::eprintln!("{HINT}hint{HINT:#}: --actor {actor} says who acts");
}
