//! What a call does in a state by one action: its instances, whatever stands for the parameters that the call does not name.

use crate::choices::Choices;
use crate::{ActionSchema, GroundAction, GroundCall, Hierarchy, State, Symbol, Term};

impl ActionSchema {
    /// The instances of this action that have this call and can be used in the state, in order. What is unknown counts as
    /// false.
    ///
    /// The cost is that of joining the preconditions with the state.
    pub fn instances(&self, call: &GroundCall, state: &State, hierarchy: &Hierarchy) -> Vec<GroundAction> {
        let mut binding: Vec<Option<&Symbol>> = vec![None; self.parameters.len()];
        if self.call.name != call.name || self.call.args.len() != call.args.len() {
            return Vec::new();
        }
        for (term, object) in self.call.args.iter().zip(&call.args) {
            let fits = match term {
                Term::Const(name) => name == object,
                Term::Param(parameter) => binding[*parameter as usize].replace(object).is_none_or(|old| old == object),
            };
            if !fits {
                return Vec::new();
            }
        }
        let choices = Choices { parameters: &self.parameters, condition: &self.preconditions, state, hierarchy };
        let mut instances = Vec::new();
        choices.for_each_with(&mut binding, &mut |objects| {
            instances.extend(self.instantiate(objects, state, hierarchy));
        });
        instances.sort_by(|a, b| a.objects.cmp(&b.objects));
        instances
    }
}
