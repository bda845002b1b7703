//! A proposal, and the very last resort where there is no plan: to do without preconditions which always held, and may be
//! accidents.
//!
//! That is tried only where there is no plan with imagined actions either. First all that could be done without is, at once:
//! if there is no plan then, there is none with less. Else one precondition is done without, the least doubtful first, and then
//! two; what that first plan lacks is always among them.

use std::collections::BTreeSet;
use std::sync::Arc;

use typelift_imagine::{Loosening, loosenings, without_all};
use typelift_model::{ActionModel, Budget, Plan, Stop, Task};
use typelift_plan::{Outcome, Restrictions};

use crate::options::Options;
use crate::propose::{Proposal, ProposeError, attempt, loosened_and_widened};

/// Preconditions that are tried alone, besides those that the first plan lacks.
const ALONE: usize = 8;

/// Preconditions that are tried two at a time, besides those that the first plan lacks.
const IN_PAIRS: usize = 8;

/// Pairs that are tried.
const PAIRS: usize = 28;

/// Expansions of each search: what is worth proposing is found soon.
const EXPANSIONS: u64 = 2_000;

/// What is asked, again and again.
#[derive(Clone, Copy)]
struct Question<'a> {
    model: &'a ActionModel,
    task: &'a Task,
    restrictions: &'a Restrictions,
    options: &'a Options,
    budget: &'a Budget,
}

/// Plans a task with a learned model. Where there is no plan, and the options say so, it tries to do without preconditions
/// that may be accidents, in some forty short searches at the most.
///
/// # Errors
/// [`ProposeError`]
pub fn propose(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    budget: &Budget,
) -> Result<Proposal, ProposeError> {
    let proposal = attempt(model, task, restrictions, options, &[], &[], budget)?;
    if proposal.outcome != Outcome::Unsolvable || !options.loosens() {
        return Ok(proposal);
    }
    Ok(propose_loosened(model, task, restrictions, options, budget)?.unwrap_or(proposal))
}

/// The model that every plan which [`propose`] may come to is one of: with what is imagined, and with each action that may do
/// without one or two preconditions. It is for judging plans, not for making them. In time of imagining.
///
/// # Errors
/// [`Stop`] if the budget ends it.
pub fn allowed(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    budget: &Budget,
) -> Result<Arc<ActionModel>, Stop> {
    let possible = if options.loosens() { loosenings(model, &task.goal) } else { Vec::new() };
    Ok(loosened_and_widened(model, task, restrictions, options, &possible, budget)?.model)
}

/// A plan that does without one or two preconditions, if there is one; none if the budget ends it. At the most it takes some
/// forty searches of 2,000 expansions.
///
/// # Errors
/// [`ProposeError`] but for `Stopped`: then the answer stands that there is no plan.
pub(crate) fn propose_loosened(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    budget: &Budget,
) -> Result<Option<Proposal>, ProposeError> {
    let expansions = budget.expansions.map_or(EXPANSIONS, |own| own.min(EXPANSIONS));
    let budget = Budget { expansions: Some(expansions), ..budget.clone() };
    let question = Question { model, task, restrictions, options, budget: &budget };
    match cheapest(question) {
        Err(ProposeError::Stopped(_)) => Ok(None),
        found => found,
    }
}

fn cheapest(question: Question<'_>) -> Result<Option<Proposal>, ProposeError> {
    let possible = loosenings(question.model, &question.task.goal);
    if possible.is_empty() {
        return Ok(None);
    }
    let without_any = Question { model: &without_all(question.model, &possible), ..question };
    let Some(found) = solved(without_any, &[])? else { return Ok(None) };
    let Outcome::Solved(plan) = &found.outcome else { return Ok(None) };
    let lacks = lacking(plan, &found.model, question, &possible);
    let first = |most: usize| -> Vec<&Loosening> {
        possible.iter().enumerate().filter(|(at, one)| *at < most || lacks.contains(one)).map(|(_, one)| one).collect()
    };
    for one in first(ALONE) {
        if let Some(proposal) = solved(question, std::slice::from_ref(one))? {
            return Ok(Some(proposal));
        }
    }
    let those = first(IN_PAIRS);
    let pairs = those.iter().enumerate().flat_map(|(at, one)| those[..at].iter().map(move |other| (*other, *one)));
    for (one, other) in pairs.take(PAIRS) {
        if let Some(proposal) = solved(question, &[one.clone(), other.clone()])? {
            return Ok(Some(proposal));
        }
    }
    Ok(None)
}

/// The proposal that does without these, if it has a plan.
fn solved(question: Question<'_>, loosened: &[Loosening]) -> Result<Option<Proposal>, ProposeError> {
    let Question { model, task, restrictions, options, budget } = question;
    let proposal = attempt(model, task, restrictions, options, loosened, &[], budget)?;
    Ok(matches!(proposal.outcome, Outcome::Solved(_)).then_some(proposal))
}

/// What a plan made without any of these does without.
fn lacking<'a>(
    plan: &Plan,
    planned_with: &ActionModel,
    question: Question<'_>,
    possible: &'a [Loosening],
) -> BTreeSet<&'a Loosening> {
    let mut state = planned_with.with_derived(&question.task.init);
    let mut lacking = BTreeSet::new();
    for step in &plan.steps {
        let Some(schema) = planned_with.action(step.action.as_str()) else { break };
        let Ok(action) = schema.instantiate(&step.objects, &state, &planned_with.hierarchy) else { break };
        let from = schema.provenance.imagined().map_or(&schema.name, |(from, _, _)| from);
        let of_action = possible.iter().filter(|loosening| loosening.action == *from);
        lacking.extend(
            of_action.filter(|loosening| !state.holds(&loosening.precondition.map(|term| term.object(&step.objects)))),
        );
        for atom in &action.deletes {
            state.atoms.remove(atom);
        }
        state.atoms.extend(action.adds.iter().cloned());
        state = planned_with.with_derived(&state);
    }
    lacking
}
