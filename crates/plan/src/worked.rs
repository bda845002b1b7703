//! Problems written by hand, as heuristics see them: for values that are worked out on paper beside the code.

use std::sync::Arc;

use typelift_model::testing::Tiny;
use typelift_model::{ActionModel, Budget, Symbol, Task};

use crate::Restrictions;
use crate::fact::FactId;
use crate::fdr::{ActionIndex, Fdr};
use crate::ground::{GroundTask, TieOrder, ground};
use crate::heuristic::{Heuristic, Reached, Step};
use crate::poll::Poll;
use crate::relaxation::{Negatives, Relaxation};

/// A problem in [the text](Tiny::written) that a person worked on.
pub(crate) struct Worked {
    tiny: Tiny,
    pub(crate) ground: GroundTask,
    pub(crate) fdr: Fdr,
    pub(crate) relaxation: Arc<Relaxation>,
}

impl Worked {
    pub(crate) fn new(text: &str) -> Self {
        let (tiny, no_limit) = (Tiny::written(text), Budget::unlimited());
        let ground = ground(&tiny.model, &tiny.task, &Restrictions::default(), TieOrder::Name, &no_limit);
        let ground = ground.expect("no limits");
        let fdr = Fdr::new(&ground, &no_limit).expect("no limits");
        let relaxation = Relaxation::new(&fdr, Negatives::Propositions, &mut Poll::new(&no_limit)).expect("no limits");
        Self { tiny, ground, fdr, relaxation: Arc::new(relaxation) }
    }

    pub(crate) fn model(&self) -> &ActionModel {
        &self.tiny.model
    }

    pub(crate) fn task(&self) -> &Task {
        &self.tiny.task
    }

    /// Some atoms as facts.
    pub(crate) fn facts_of(&self, atoms: &str) -> Vec<FactId> {
        let fact = |atom| self.ground.facts().find(atom).unwrap_or_else(|| panic!("{atom} is never reached"));
        self.tiny.state(atoms).atoms.iter().map(fact).collect()
    }

    /// The values of the state in which these atoms hold and no others.
    pub(crate) fn values_of(&self, atoms: &str) -> Vec<u32> {
        let mut values: Vec<u32> = self.fdr.domains.iter().map(|size| size - 1).collect();
        for at in self.facts_of(atoms).into_iter().filter_map(|fact| self.fdr.assignment(fact)) {
            values[at.variable as usize] = at.value;
        }
        values
    }

    /// What a heuristic says of the state in which these atoms hold and no others.
    pub(crate) fn estimate(&self, heuristic: &mut dyn Heuristic, atoms: &str) -> Option<u32> {
        let values = self.values_of(atoms);
        let mut memory = vec![0; heuristic.memory_len()];
        heuristic.estimate(&self.fdr, Reached { values: &values, by: None }, &mut memory)
    }

    /// What a heuristic says of the initial state and of those after each of these actions, by `name(object,…)`.
    pub(crate) fn estimates(&self, heuristic: &mut dyn Heuristic, path: &[&str]) -> Vec<Option<u32>> {
        let mut memory = vec![0; heuristic.memory_len()];
        let mut values = self.fdr.init.clone();
        let mut estimates = vec![heuristic.estimate(&self.fdr, Reached { values: &values, by: None }, &mut memory)];
        for name in path {
            let action = self.action(name);
            let mut after = values.clone();
            self.fdr.apply(action, &values, &mut after);
            let mut memory_after = vec![0; heuristic.memory_len()];
            let by = Some(Step { action, values: &values, memory: &memory });
            estimates.push(heuristic.estimate(&self.fdr, Reached { values: &after, by }, &mut memory_after));
            (values, memory) = (after, memory_after);
        }
        estimates
    }

    fn action(&self, name: &str) -> ActionIndex {
        let all = 0..self.fdr.action_count() as u32;
        all.into_iter().find(|&action| self.name(action) == name).unwrap_or_else(|| panic!("no {name}"))
    }

    fn name(&self, action: ActionIndex) -> String {
        let step = self.ground.step(self.fdr.actions.ids[action as usize]);
        let objects: Vec<&str> = step.objects.iter().map(Symbol::as_str).collect();
        if objects.is_empty() { step.action.to_string() } else { format!("{}({})", step.action, objects.join(",")) }
    }

    /// The names of actions, sorted, each once.
    pub(crate) fn names(&self, actions: &[ActionIndex]) -> Vec<String> {
        let mut names: Vec<String> = actions.iter().map(|&action| self.name(action)).collect();
        names.sort();
        names.dedup();
        names
    }
}
