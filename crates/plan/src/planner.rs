//! From a model and a task to plans.

use std::collections::BTreeSet;

use typelift_model::{ActionModel, Budget, GroundCall, Plan, Stop, Task};

use crate::Restrictions;
use crate::alternatives::Alternatives;
use crate::explanation::Explanation;
use crate::ground::GroundTask;
use crate::options::Options;
use crate::outcome::Outcome;
use crate::reach::Reachable;
use crate::report::Report;
use crate::search::{Found, Search};
use crate::widening::Widening;

/// A task being planned: grounded once, searched on demand.
///
/// A task with many objects is planned with those that can matter first, and with more and more of them while no plan
/// is found; a plan with fewer objects is a plan of the task. So it is with better plans: with all objects they are looked
/// for when with fewer there are no more, or none is found for long. That there is none, no other,
/// or no better one is only ever said of all objects. A strategy whose first plan is a cheapest one takes all at once.
#[derive(Debug)]
pub struct Planner {
    search: Widening,
    /// The plans given so far: their calls, sorted, and what they cost.
    given: Vec<(Vec<GroundCall>, u64)>,
    /// The first of them.
    first: Option<Plan>,
    /// Where others are looked for, once there is one.
    alternatives: Option<Alternatives>,
}

impl Planner {
    /// Grounds the task and finds its landmarks.
    ///
    /// The model is taken as it is: for strict applicability or imagined actions, rewrite it first.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends grounding, or the work on landmarks.
    pub fn new(
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        options: &Options,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        Self::starting_from(None, model, task, restrictions, options, budget)
    }

    /// The same where reachability, of this model and these restrictions, is known already, perhaps with few of the objects: it
    /// is not computed again if the task is planned with the same objects.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends grounding, or the work on landmarks.
    pub fn starting_from(
        reachable: Option<Reachable>,
        model: &ActionModel,
        task: &Task,
        restrictions: &Restrictions,
        options: &Options,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let search = Widening::new(reachable, model, task, restrictions, options, budget)?;
        Ok(Self { search, given: Vec::new(), first: None, alternatives: None })
    }

    /// The next plan, without useless steps. A further one does without a call of every plan given before: that there
    /// is no more is said when every other plan makes all calls of a given one. Of a strategy whose first plan is a cheapest
    /// one the further ones are the cheapest of those. The budget's expansions are for this call.
    pub fn next_plan(&mut self, budget: &Budget) -> Outcome {
        let Some(first) = &self.first else { return self.search_on(None, budget) };
        let counted = self.search.report();
        let alternatives = self.alternatives.get_or_insert_with(|| Alternatives::to(first, counted));
        let is_new = |plan: &Plan| {
            let calls: BTreeSet<&GroundCall> = plan.steps.iter().map(|step| &step.call).collect();
            !self.given.iter().any(|(given, _)| given.iter().all(|call| calls.contains(call)))
        };
        match alternatives.next(self.search.asked(), is_new, budget) {
            Found::Plan(plan) => {
                self.given.push((calls(&plan), plan.cost()));
                Outcome::Solved(plan)
            }
            Found::Nothing => Outcome::NoMorePlans,
            Found::Stopped(stop) => stop.into(),
        }
    }

    /// A plan cheaper than `cost`, from where the search stands; everything dearer is pruned from now on.
    pub fn better_plan(&mut self, cost: u64, budget: &Budget) -> Outcome {
        self.search_on(Some(cost), budget)
    }

    fn search_on(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Outcome {
        let mut budget = budget.clone();
        loop {
            let before = self.search.report().expansions;
            match self.search.next(cost_bound, &budget) {
                Found::Plan(plan) => {
                    let calls = calls(&plan);
                    if !self.given.iter().any(|(given, cost)| *given == calls && *cost <= plan.cost()) {
                        self.given.push((calls, plan.cost()));
                        self.first.get_or_insert_with(|| plan.clone());
                        return Outcome::Solved(plan);
                    }
                }
                Found::Nothing if self.given.is_empty() && (cost_bound.is_none() || !self.search.level().is_open()) => {
                    return Outcome::Unsolvable;
                }
                Found::Nothing => return Outcome::NoMorePlans,
                // Looked for only now, since most tasks that take long have a plan.
                Found::Stopped(Stop::Expansions) if self.given.is_empty() && self.search.is_in_vain() => {
                    return Outcome::Unsolvable;
                }
                Found::Stopped(stop) => return stop.into(),
            }
            let spent = self.search.report().expansions - before;
            budget.expansions = budget.expansions.map(|left| left.saturating_sub(spent));
        }
    }

    /// What was counted so far, with fewer objects and with more.
    pub fn report(&self) -> Report {
        self.search.report() + self.alternatives.as_ref().map(Alternatives::report).unwrap_or_default()
    }

    /// The grounded task: with as many objects as are planned with now.
    pub fn ground_task(&self) -> &GroundTask {
        self.search.level().ground()
    }

    /// The task as it was asked.
    pub fn task(&self) -> &Task {
        self.search.task()
    }

    /// Why no plan was found.
    pub fn explain(&self) -> Explanation {
        self.search.explain()
    }
}

/// The calls of a plan, sorted.
fn calls(plan: &Plan) -> Vec<GroundCall> {
    let mut calls: Vec<GroundCall> = plan.steps.iter().map(|step| step.call.clone()).collect();
    calls.sort_unstable();
    calls
}
