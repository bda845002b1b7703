//! The names of objects in tasks of PDDL, which does not tell upper from lower case: its readers write all in lower case,
//! and the world may not.

use std::collections::BTreeMap;
use std::sync::Arc;

use typelift_model::{State, Symbol};

use crate::episode::Episode;

impl Episode {
    /// From now on the objects that goal, model and values mention are called as in this state, where it has another that
    /// differs in case alone, and just one. That is looked for only where the task is of PDDL.
    pub(crate) fn name_objects_as_in(&mut self, state: &State) {
        if !self.options.ignores_case {
            return;
        }
        let mut known: BTreeMap<String, Option<&Symbol>> = BTreeMap::new();
        for name in state.objects.keys() {
            let alone = |other: &mut Option<&Symbol>| *other = None;
            known.entry(name.as_str().to_ascii_lowercase()).and_modify(alone).or_insert(Some(name));
        }
        let (in_model, in_goal) = (self.model.objects(), self.goal.objects());
        let in_values = self.values.keys().flat_map(|function| &function.args);
        let mentioned = in_model.iter().chain(in_goal).chain(in_values);
        let called = |name: &Symbol| known.get(&name.as_str().to_ascii_lowercase()).copied().flatten().cloned();
        let unknown = mentioned.filter(|name| !state.objects.contains_key(*name));
        let names: BTreeMap<Symbol, Symbol> = unknown.filter_map(|name| Some((name.clone(), called(name)?))).collect();
        if names.is_empty() {
            return;
        }
        self.goal = self.goal.with_objects_renamed(&names);
        self.model = Arc::new(self.model.as_ref().clone().with_objects_renamed(&names));
        let values = std::mem::take(&mut self.values).into_iter();
        self.values = values.map(|(function, value)| (function.with_objects_renamed(&names), value)).collect();
    }
}
