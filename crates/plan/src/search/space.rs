//! The state space that searches work on.

use std::sync::Arc;

use typelift_model::{GroundAtom, Plan};

use crate::fdr::{ActionIndex, Fdr, SuccessorGenerator, Values};
use crate::ground::GroundTask;
use crate::symmetry::Symmetry;

/// A ground task as searches work on it; they share one.
#[derive(Debug)]
pub(crate) struct Space {
    pub(crate) ground: Arc<GroundTask>,
    pub(crate) task: Fdr,
    pub(crate) successors: SuccessorGenerator,
    pub(crate) symmetry: Symmetry,
}

impl Space {
    /// The space of a ground task; `task` is the same task in finite-domain representation.
    pub(crate) fn new(ground: Arc<GroundTask>, task: Fdr, symmetry: Symmetry) -> Self {
        let successors = SuccessorGenerator::new(&task);
        Self { ground, task, successors, symmetry }
    }

    /// These actions as a plan.
    pub(crate) fn plan(&self, actions: &[ActionIndex]) -> Plan {
        let ids = &self.task.actions.ids;
        Plan { steps: actions.iter().map(|&action| self.ground.step(ids[action as usize])).collect() }
    }

    /// The goal's literals that do not hold in a state, and whether each must.
    pub(crate) fn missing(&self, values: &Values) -> Vec<(GroundAtom, bool)> {
        let wanted = self.ground.goal().iter().map(|&fact| (fact, true));
        let unwanted = self.ground.negative_goal().iter().map(|&fact| (fact, false));
        let open = wanted.chain(unwanted).filter(|&(fact, positive)| self.task.holds(values, fact) != positive);
        open.map(|(fact, positive)| (self.ground.atom(fact), positive)).collect()
    }
}
