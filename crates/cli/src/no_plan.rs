//! What may help where there is no plan, as `plan` and `run` say it.

use std::collections::BTreeSet;

use typelift::agent::Episode;
use typelift::imagine;
use typelift::model::{ActionModel, Budget, Goal, Plan, State, Symbol};
use typelift::words::count;

use crate::style::{HINT, WARNING};

/// Nodes that are expanded to find out whether a hint holds.
const HINT_EXPANSIONS: u64 = 20_000;

/// The same budget, with few expansions: for a hint nobody waits long.
pub(crate) fn within_a_hint(budget: &Budget) -> Budget {
    Budget { expansions: Some(HINT_EXPANSIONS), ..budget.clone() }
}

/// The plan that an episode that ended without one would find if actions were imagined, and it has not tried that.
pub(crate) fn if_imagining(episode: &Episode, imagines: bool, budget: &Budget) -> Option<Plan> {
    if imagines {
        return None;
    }
    episode.plan_if_imagining(imagine::Options::default(), &within_a_hint(budget)).ok().flatten()
}

/// Says that this plan is found if actions are imagined.
pub(crate) fn say_what_imagining_finds(plan: &Plan) {
    anstream::eprintln!(
        "{HINT}hint{HINT:#}: --imagine finds a plan of {} resting on {}",
        count(plan.len() as u64, "step"),
        count(plan.imagined_actions() as u64, "imagined action")
    );
}

/// Says of which predicates no demonstration shows how what the goal asks of them in this state comes about. Alternatives and
/// quantifiers of a goal stand for all that they mention.
pub(crate) fn say_undemonstrated(undemonstrated: &BTreeSet<Symbol>, model: &ActionModel, goal: &Goal, state: &State) {
    let asked = goal.literals().filter(|(atom, positive)| state.holds(atom) != *positive);
    let asked: BTreeSet<&Symbol> = asked.map(|(atom, _)| &atom.predicate).collect();
    let is_asked = |predicate: &&Symbol| {
        let mut formulas = asked.iter().filter_map(|invented| model.wordings.get(*invented));
        asked.contains(predicate) || formulas.any(|wording| wording.mentions(predicate))
    };
    for predicate in undemonstrated.iter().filter(is_asked) {
        anstream::eprintln!(
            "{WARNING}note{WARNING:#}: no demonstration showed `{predicate}`: the domain declares it, and no learned action changes it"
        );
    }
}
