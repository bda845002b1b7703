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

    /// The plan that actions which lead to the goal are, without the steps that it does as well without: each in turn is
    /// left out, with what can then not be done any more, if the rest still is a plan (Nakhost and Müller 2010). Which steps
    /// are left over depends on the order, and finding the fewest is hard (Fink and Yang 1992). In time of the square of the
    /// plan's length.
    pub(crate) fn plan(&self, mut actions: Vec<ActionIndex>) -> Plan {
        let mut step = 0;
        while step < actions.len() {
            match self.without(&actions, step) {
                Some(fewer) => actions = fewer,
                None => step += 1,
            }
        }
        let ids = &self.task.actions.ids;
        Plan { steps: actions.iter().map(|&action| self.ground.step(ids[action as usize])).collect() }
    }

    /// The actions but for one and those that cannot be done without it, if they still lead to the goal.
    fn without(&self, actions: &[ActionIndex], left_out: usize) -> Option<Vec<ActionIndex>> {
        let mut values = self.task.init.clone();
        let mut after = values.clone();
        let mut kept = Vec::with_capacity(actions.len());
        for (i, &action) in actions.iter().enumerate() {
            if i != left_out && self.task.is_applicable(action, &values) {
                after.copy_from_slice(&values);
                self.task.apply(action, &values, &mut after);
                std::mem::swap(&mut values, &mut after);
                kept.push(action);
            }
        }
        self.task.is_goal(&values).then_some(kept)
    }

    /// The goal's literals that do not hold in a state, and whether each must.
    pub(crate) fn missing(&self, values: &Values) -> Vec<(GroundAtom, bool)> {
        let wanted = self.ground.goal().iter().map(|&fact| (fact, true));
        let unwanted = self.ground.negative_goal().iter().map(|&fact| (fact, false));
        let open = wanted.chain(unwanted).filter(|&(fact, positive)| self.task.holds(values, fact) != positive);
        open.map(|(fact, positive)| (self.ground.atom(fact), positive)).collect()
    }
}
