//! What may help where there is no plan, as `plan` and `run` say it.

use std::collections::BTreeSet;

use typelift::agent::{Episode, GivenUp, Options, Proposal, propose};
use typelift::imagine::{self, Guard};
use typelift::model::{ActionModel, Budget, Goal, Plan, State, Symbol, Task};
use typelift::plan::{Outcome, Restrictions};
use typelift::words::{count, without_phrase};

use crate::style::{HINT, WARNING};

/// Nodes that are expanded to find out whether a hint holds.
const HINT_EXPANSIONS: u64 = 20_000;

/// A plan that another option would find.
pub(crate) struct Hint {
    option: &'static str,
    plan: Plan,
}

/// What imagination might still do where there is no plan: anything at all, if it was not allowed; what it gave up, if it gave
/// something up.
fn wider(imagining: Option<imagine::Options>, given_up: &[GivenUp]) -> Option<(&'static str, imagine::Options)> {
    match imagining {
        None => Some(("--imagine", imagine::Options { loosen: true, ..Default::default() })),
        Some(_) if given_up.is_empty() => None,
        Some(_) => Some(("--guard off", imagine::Options { guard: Guard::Off, loosen: false })),
    }
}

/// The same budget, with few expansions: for a hint nobody waits long.
fn within_a_hint(budget: &Budget) -> Budget {
    Budget { expansions: Some(HINT_EXPANSIONS), ..budget.clone() }
}

/// The plan that an episode that ended without one would find if imagination might do more.
pub(crate) fn for_episode(
    episode: &Episode,
    imagining: Option<imagine::Options>,
    given_up: &[GivenUp],
    budget: &Budget,
) -> Option<Hint> {
    let (option, imagining) = wider(imagining, given_up)?;
    let plan = episode.plan_if_imagining(imagining, &within_a_hint(budget)).ok().flatten()?;
    Some(Hint { option, plan })
}

/// The plan that there would be for this task if imagination might do more; `options` are those without one.
pub(crate) fn for_task(
    model: &ActionModel,
    task: &Task,
    options: Options,
    given_up: &[GivenUp],
    budget: &Budget,
) -> Option<Hint> {
    let (option, imagining) = wider(options.imagine, given_up)?;
    let options = Options { imagine: Some(imagining), ..options };
    match propose(model, task, &Restrictions::default(), &options, &within_a_hint(budget)) {
        Ok(Proposal { outcome: Outcome::Solved(plan), .. }) => Some(Hint { option, plan }),
        _ => None,
    }
}

/// Says which plan is found if actions are imagined, or further ones, and what it does without.
pub(crate) fn say_hint(Hint { option, plan }: &Hint) {
    if let Some(without) = without_phrase(plan) {
        anstream::eprintln!("{HINT}hint{HINT:#}: {without}; {option} proposes it");
        return;
    }
    anstream::eprintln!(
        "{HINT}hint{HINT:#}: {option} finds a plan of {} resting on {}",
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
