//! One proposal: imagine if allowed, plan, and have the plan checked.

use thiserror::Error;
use typelift_check::{Invalid, check};
use typelift_imagine::{Imagination, imagine};
use typelift_model::{ActionModel, Budget, Plan, Task, strict};
use typelift_plan::{Cut, Explanation, Outcome, Planner, Report, Restrictions};

use crate::options::Options;

/// What planning came to.
#[derive(Debug)]
pub struct Proposal {
    /// The model that was planned with: imagined actions added, strict if asked for.
    pub model: ActionModel,
    /// What was imagined.
    pub imagination: Imagination,
    /// The planner, for further plans.
    pub planner: Planner,
    /// How the search ended.
    pub outcome: Outcome,
}

impl Proposal {
    /// The counts of grounding and search.
    pub fn report(&self) -> Report {
        self.planner.report()
    }

    /// Why there is no plan.
    pub fn explain(&self) -> Explanation {
        self.planner.explain()
    }

    /// A further plan, checked.
    ///
    /// # Errors
    /// [`ProposeError::Invalid`] if the planner's plan is not one.
    pub fn next_plan(&mut self, budget: &Budget) -> Result<Outcome, ProposeError> {
        let outcome = self.planner.next_plan(budget);
        self.checked(outcome)
    }

    /// A plan cheaper than `cost`, checked.
    ///
    /// # Errors
    /// [`ProposeError::Invalid`] if the planner's plan is not one.
    pub fn better_plan(&mut self, cost: u64, budget: &Budget) -> Result<Outcome, ProposeError> {
        let outcome = self.planner.better_plan(cost, budget);
        self.checked(outcome)
    }

    fn checked(&self, outcome: Outcome) -> Result<Outcome, ProposeError> {
        if let Outcome::Solved(plan) = &outcome {
            check(&self.model, self.planner.task(), plan)
                .map_err(|error| ProposeError::Invalid { plan: plan.clone(), error })?;
        }
        Ok(outcome)
    }
}

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ProposeError {
    /// The budget ended grounding.
    #[error(transparent)]
    Cut(#[from] Cut),
    /// The planner's plan does not survive the check: a defect of the planner.
    #[error("the planner's plan is not valid: {error}")]
    Invalid {
        /// The plan.
        plan: Plan,
        /// What is wrong with it.
        error: Invalid,
    },
}

/// Plans a task with a learned model.
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
    let imagination = match &options.imagine {
        Some(imagining) => imagine(model, task, restrictions, imagining, budget)?,
        None => Imagination::default(),
    };
    let widened = imagination.added_to(model);
    let model = if options.strict { strict(&widened) } else { widened };
    let mut planner = Planner::new(&model, task, restrictions, &options.plan, budget)?;
    let outcome = planner.next_plan(budget);
    let proposal = Proposal { model, imagination, planner, outcome };
    proposal.checked(proposal.outcome.clone())?;
    Ok(proposal)
}
