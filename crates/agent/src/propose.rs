//! One proposal: imagine if allowed, plan, and have the plan checked.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use thiserror::Error;
use typelift_check::{Invalid, check};
use typelift_imagine::{Imagination, Loosening, contradicted, imagine_from};
use typelift_model::{ActionModel, Budget, GoalTypeMismatch, GroundAtom, Plan, Stop, Symbol, Task, strict};
use typelift_plan::{Explanation, ExternalFailure, Outcome, Planner, Reachable, Report, Restrictions};

use crate::options::Options;
use crate::risk::{Risk, repriced, risk_of, weighed};

/// What planning came to.
#[derive(Debug)]
pub struct Proposal {
    /// The model that was planned with: imagined actions added, strict if asked for.
    pub model: Arc<ActionModel>,
    /// What was imagined.
    pub imagination: Imagination,
    /// How often what can be reached was worked out before planning began.
    groundings: u64,
    /// What was planned around.
    restrictions: Restrictions,
    /// What was planned with.
    searched: Searched,
    /// How the search ended.
    pub outcome: Outcome,
}

/// Who planned, and what.
#[derive(Debug)]
enum Searched {
    /// The own planner, which can go on.
    Own(Box<Planner>),
    /// The same, with risks as costs.
    Weighed(Box<Weighed>),
    /// An external planner: the model and the task that it was asked, with the restrictions in them.
    External(Box<(ActionModel, Task)>),
}

/// The own planner, of a model and a task with risks as costs.
#[derive(Debug)]
struct Weighed {
    planner: Planner,
    model: ActionModel,
    /// The values of the functions that costs mention, without risks.
    values: BTreeMap<GroundAtom, u32>,
}

impl Proposal {
    /// The own planner, if it planned.
    fn planner(&self) -> Option<&Planner> {
        match &self.searched {
            Searched::Own(planner) => Some(planner),
            Searched::Weighed(weighed) => Some(&weighed.planner),
            Searched::External(_) => None,
        }
    }

    /// The counts of grounding and search; nothing if an external planner planned.
    pub fn report(&self) -> Report {
        let report = self.planner().map(Planner::report).unwrap_or_default();
        Report { groundings: self.groundings + report.groundings, ..report }
    }

    /// Why there is no plan, in the words of the text that the model was made from.
    pub fn explain(&self) -> Explanation<String> {
        self.planner().map_or(Explanation::ToldByPlanner, |planner| planner.explain().in_words(&self.model))
    }

    /// Where the goal goes beyond the types of which the model has its predicates: worth saying if there is no plan.
    pub fn goal_type_mismatches(&self) -> Vec<GoalTypeMismatch> {
        let task = self.task();
        task.goal.type_mismatches(&task.init, &self.model)
    }

    /// The task, with what was written into it for the planner.
    fn task(&self) -> &Task {
        match &self.searched {
            Searched::Own(planner) => planner.task(),
            Searched::Weighed(weighed) => weighed.planner.task(),
            Searched::External(asked) => &asked.1,
        }
    }

    /// A further plan, checked, in which nothing that was learned contradicts what was imagined. An external planner is asked
    /// only once.
    ///
    /// # Errors
    /// [`ProposeError::Invalid`] if the planner's plan is not one.
    pub fn next_plan(&mut self, budget: &Budget) -> Result<Outcome, ProposeError> {
        self.uncontradicted(|searched| match searched {
            Searched::Own(planner) => planner.next_plan(budget),
            Searched::Weighed(weighed) => weighed.planner.next_plan(budget),
            Searched::External(_) => Outcome::NoMorePlans,
        })
    }

    /// A plan cheaper than `cost`, checked. Where risks are costs, none is.
    ///
    /// # Errors
    /// [`ProposeError::Invalid`] if the planner's plan is not one.
    pub fn better_plan(&mut self, cost: u64, budget: &Budget) -> Result<Outcome, ProposeError> {
        self.uncontradicted(|searched| match searched {
            Searched::Own(planner) => planner.better_plan(cost, budget),
            Searched::Weighed(_) | Searched::External(_) => Outcome::NoMorePlans,
        })
    }

    /// The first outcome, checked, that is no plan in which what was learned contradicts what was imagined.
    fn uncontradicted(&mut self, mut next: impl FnMut(&mut Searched) -> Outcome) -> Result<Outcome, ProposeError> {
        loop {
            let outcome = next(&mut self.searched);
            let outcome = self.checked(outcome)?;
            if self.contradicted(&outcome).is_empty() {
                return Ok(outcome);
            }
        }
    }

    /// The imagined actions of a plan that what was learned contradicts.
    fn contradicted(&self, outcome: &Outcome) -> BTreeSet<Symbol> {
        let Outcome::Solved(plan) = outcome else { return BTreeSet::new() };
        contradicted(plan, &self.model, self.task(), &self.restrictions)
    }

    fn checked(&self, outcome: Outcome) -> Result<Outcome, ProposeError> {
        let Outcome::Solved(plan) = &outcome else { return Ok(outcome) };
        match &self.searched {
            Searched::Own(planner) => check(&self.model, planner.task(), plan)
                .map_err(|error| ProposeError::Invalid { plan: plan.clone(), error })?,
            Searched::Weighed(weighed) => {
                check(&weighed.model, weighed.planner.task(), plan)
                    .map_err(|error| ProposeError::Invalid { plan: plan.clone(), error })?;
                return Ok(Outcome::Solved(repriced(plan, &self.model, &weighed.values)));
            }
            Searched::External(asked) => check(&asked.0, &asked.1, plan)
                .map_err(|error| ProposeError::ExternalPlan { plan: plan.clone(), error })?,
        };
        Ok(outcome)
    }
}

/// A plan that is as risky as one more step would cost is good enough; else less risky ones are looked for, with so many
/// expansions.
const NOTABLE: u64 = 1_000;
const LESS_RISKY: u64 = 500;

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ProposeError {
    /// The budget ended grounding.
    #[error("{0} before the search")]
    Stopped(#[from] Stop),
    /// The planner's plan does not survive the check: a defect of the planner.
    #[error("the planner's plan is not valid: {error}")]
    Invalid {
        /// The plan.
        plan: Plan,
        /// What is wrong with it.
        error: Invalid,
    },
    /// The external planner gave no usable answer.
    #[error(transparent)]
    External(#[from] ExternalFailure),
    /// The external planner's plan does not survive the check.
    #[error("the planner's plan is not valid: {error}")]
    ExternalPlan {
        /// The plan.
        plan: Plan,
        /// What is wrong with it.
        error: Invalid,
    },
}

/// Plans a task with a learned model, doing without these preconditions of it and no others. Where the plan has an imagined
/// step that what was learned contradicts, it plans again, and that action gives way.
///
/// # Errors
/// [`ProposeError`]
pub(crate) fn attempt(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    loosened: &[Loosening],
    risks: &[Risk],
    budget: &Budget,
) -> Result<Proposal, ProposeError> {
    let mut giving_way = BTreeSet::new();
    loop {
        let mut widened = loosened_and_widened(model, task, restrictions, options, loosened, budget)?;
        if !giving_way.is_empty() {
            widened.give_way(model, options, &giving_way);
        }
        let proposal = planned(widened, task, restrictions, options, risks, budget)?;
        let contradicted = proposal.contradicted(&proposal.outcome);
        if contradicted.is_subset(&giving_way) {
            return Ok(proposal);
        }
        giving_way.extend(contradicted);
    }
}

/// Plans a task with such a model.
fn planned(
    widened: Widened,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    risks: &[Risk],
    budget: &Budget,
) -> Result<Proposal, ProposeError> {
    let Widened { model, imagination, reachable, groundings } = widened;
    let (searched, outcome) = match &options.planner {
        None => {
            let mut planner = Planner::starting_from(reachable, &model, task, restrictions, &options.plan, budget)?;
            let outcome = planner.next_plan(budget);
            match &outcome {
                Outcome::Solved(plan) if !risks.is_empty() => {
                    less_risky(plan, &model, task, restrictions, options, risks, budget)
                        .unwrap_or((Searched::Own(Box::new(planner)), outcome))
                }
                _ => (Searched::Own(Box::new(planner)), outcome),
            }
        }
        Some(planner) => {
            let asked = restrictions.compiled_into(&model, task);
            let outcome = planner.plan(&asked.0, &asked.1, budget)?;
            (Searched::External(Box::new(asked)), outcome)
        }
    };
    let restrictions = restrictions.clone();
    let mut proposal = Proposal { model, imagination, groundings, restrictions, searched, outcome };
    proposal.outcome = proposal.checked(proposal.outcome.clone())?;
    Ok(proposal)
}

/// A plan that is less risky than this one, if it is found soon.
fn less_risky(
    plan: &Plan,
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    risks: &[Risk],
    budget: &Budget,
) -> Option<(Searched, Outcome)> {
    let (risky, with_risks) = weighed(model, task, risks);
    let mut best = repriced(plan, &risky, &with_risks.values);
    if risk_of(&best, plan) <= NOTABLE {
        return None;
    }
    let mut budget = Budget { expansions: Some(LESS_RISKY), ..budget.clone() };
    let mut planner = Planner::new(&risky, &with_risks, restrictions, &options.plan, &budget).ok()?;
    let mut found = None;
    let mut outcome = planner.next_plan(&budget);
    while let Outcome::Solved(plan) = &outcome {
        if plan.cost() < best.cost() {
            best.clone_from(plan);
            found = Some(plan.clone());
        }
        budget.expansions = Some(LESS_RISKY.saturating_sub(planner.report().expansions));
        if risk_of(&best, &repriced(&best, model, &task.values)) <= NOTABLE {
            break;
        }
        outcome = planner.better_plan(best.cost(), &budget);
    }
    let plan = found?;
    let weighed = Weighed { planner, model: risky, values: task.values.clone() };
    Some((Searched::Weighed(Box::new(weighed)), Outcome::Solved(plan)))
}

/// A model to plan a task with.
#[derive(Debug)]
pub struct Widened {
    /// Imagined actions added if that is allowed, strict if asked for.
    pub model: Arc<ActionModel>,
    /// What was imagined.
    pub imagination: Imagination,
    /// What can be reached with this model, if that is known: planning starts where imagination ended.
    reachable: Option<Reachable>,
    /// How often what can be reached was worked out with another model.
    groundings: u64,
}

impl Widened {
    /// Has the imagined actions of these names give way to what was learned.
    fn give_way(&mut self, model: &ActionModel, options: &Options, names: &BTreeSet<Symbol>) {
        self.imagination.give_way(model, names);
        self.model = Arc::new(applied(self.imagination.added_to(model), options));
    }
}

/// The model as the options have it used.
fn applied(model: ActionModel, options: &Options) -> ActionModel {
    if options.strict { strict(&model) } else { model }
}

/// The model to plan a task with: with what is imagined for it under these restrictions, if the options allow that, and
/// strict if they ask for it. In time of a copy of the model and, if actions may be imagined, of
/// [imagining](typelift_imagine::imagine) them.
///
/// # Errors
/// [`Stop`] if the budget ends it.
pub fn widened(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    budget: &Budget,
) -> Result<Widened, Stop> {
    loosened_and_widened(model, task, restrictions, options, &[], budget)
}

/// The same, with what does without these preconditions.
///
/// # Errors
/// [`Stop`] if the budget ends it.
pub(crate) fn loosened_and_widened(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    options: &Options,
    loosened: &[Loosening],
    budget: &Budget,
) -> Result<Widened, Stop> {
    let applied = |model| Arc::new(applied(model, options));
    let nothing = Imagination::default();
    let own = applied(nothing.added_to(model));
    let Some(imagining) = &options.imagine else {
        return Ok(Widened { model: own, imagination: nothing, reachable: None, groundings: 0 });
    };
    let reached = Reachable::with_few_objects(&own, task, restrictions, budget)?;
    let mut imagination = imagine_from(&reached, model, task, restrictions, imagining, budget)?;
    imagination.loosen(model, loosened);
    if imagination.actions.is_empty() {
        return Ok(Widened { model: own, imagination, reachable: Some(reached), groundings: 0 });
    }
    let model = applied(imagination.added_to(model));
    Ok(Widened { model, imagination, reachable: None, groundings: reached.computed() })
}
