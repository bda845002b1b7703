//! Plans.

use crate::{GroundAtom, GroundCall, Replacement, Symbol};

/// What makes a step of a plan an imagined one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Imagined {
    /// The learned action that was raised or loosened.
    pub from: Symbol,
    /// The raised parameters.
    pub replaced: Vec<Replacement>,
    /// What does not hold, although it did whenever the learned action was seen.
    pub without: Vec<GroundAtom>,
    /// Observations behind the learned action.
    pub observations: u64,
}

/// One ground action of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Step {
    /// The action schema's name.
    pub action: Symbol,
    /// The objects put in place of its parameters, in order.
    pub objects: Vec<Symbol>,
    /// What the environment is told.
    pub call: GroundCall,
    /// The cost.
    pub cost: u32,
    /// Set if the step rests on an imagined action.
    pub imagined: Option<Imagined>,
}

/// A sequence of ground actions.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Plan {
    /// The steps, first to last.
    pub steps: Vec<Step>,
}

impl Plan {
    /// The sum of the steps' costs.
    pub fn cost(&self) -> u64 {
        self.steps.iter().map(|step| u64::from(step.cost)).sum()
    }

    /// The number of steps.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Whether each step costs 1.
    pub fn has_unit_costs(&self) -> bool {
        self.steps.iter().all(|step| step.cost == 1)
    }

    /// The number of imagined steps.
    pub fn imagined_steps(&self) -> usize {
        self.steps.iter().filter(|step| step.imagined.is_some()).count()
    }

    /// The number of different imagined actions that it rests on.
    pub fn imagined_actions(&self) -> usize {
        let mut names: Vec<&Symbol> =
            self.steps.iter().filter(|step| step.imagined.is_some()).map(|step| &step.action).collect();
        names.sort_unstable();
        names.dedup();
        names.len()
    }
}
