//! Costs of several parts as one function, whose value for a choice of objects is the sum of the parts' values.
//!
//! Planners disagree on a second `increase` of one action: ours refuses it, Fast Downward's translator keeps the last
//! alone. So each action whose cost has several parts gets a function of its own over the parameters that they mention.
//! It has a value where each part has one: what cannot be used for want of a value still cannot.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionModel, ActionSchema, Atom, Cost, GroundAtom, LiftedAtom, Symbol, Task, Term};

use super::complement::{Place, choices, for_each_tuple};
use super::names::{folded, functions, predicates, unused};
use super::{Compiled, ExportError, MOST_FACTS};

/// Whether the cost of some action has several parts.
pub(super) fn has_sums(model: &ActionModel) -> bool {
    model.actions.iter().any(|action| is_sum(&action.cost))
}

fn is_sum(cost: &Cost) -> bool {
    usize::from(cost.fixed > 0) + cost.functions.len() > 1
}

/// Puts a function in place of each sum, and its values into the task.
pub(super) fn compile(model: &ActionModel, task: Option<&Task>) -> Result<Compiled, ExportError> {
    let mut used = used_names(model, task);
    let mut compiled = Compiled { model: model.clone(), task: task.cloned(), notes: Vec::new() };
    let mut room = MOST_FACTS;
    for action in compiled.model.actions.iter_mut().filter(|action| is_sum(&action.cost)) {
        let sum = Sum::of(action, unused(&format!("cost-of-{}", action.name), &mut used));
        if let Some(task) = &mut compiled.task {
            let values = sum.values(action, task, model, &mut room)?;
            task.values.extend(values);
        }
        compiled.notes.push(sum.note(action));
        let parameters = sum.parameters.into_iter().map(Term::Param).collect();
        action.cost = Cost { fixed: 0, functions: vec![Atom::new(sum.name, parameters)] };
    }
    Ok(compiled)
}

/// The names that mean something already, as PDDL spells them.
fn used_names(model: &ActionModel, task: Option<&Task>) -> BTreeSet<Symbol> {
    let stated = task.iter().flat_map(|task| task.values.keys()).map(|function| &function.predicate);
    predicates(model, task).into_keys().chain(functions(model).into_keys()).chain(stated).map(folded).collect()
}

/// What an action costs.
struct Sum {
    /// The function's name.
    name: Symbol,
    /// The action's parameters that the parts mention.
    parameters: Vec<u32>,
    /// The parts, over these parameters.
    cost: Cost,
}

impl Sum {
    fn of(action: &ActionSchema, name: Symbol) -> Self {
        let parameters: BTreeSet<u32> = action.cost.functions.iter().flat_map(LiftedAtom::params).collect();
        let places: BTreeMap<u32, u32> = parameters.iter().copied().zip(0..).collect();
        let place = |term: &Term| match term {
            Term::Param(index) => Term::Param(places[index]),
            object @ Term::Const(_) => object.clone(),
        };
        let functions = action.cost.functions.iter().map(|function| function.map(place)).collect();
        Self { name, parameters: parameters.into_iter().collect(), cost: Cost { fixed: action.cost.fixed, functions } }
    }

    /// Its value for each choice of objects of the parameters' types for which it has one.
    fn values(
        &self,
        action: &ActionSchema,
        task: &Task,
        model: &ActionModel,
        room: &mut u64,
    ) -> Result<Vec<(GroundAtom, u32)>, ExportError> {
        let mut objects = model.constants.clone();
        objects.extend(task.init.objects.clone());
        let of_type = |parameter: &u32| Place::Of(action.parameters[*parameter as usize].ty);
        let places: Vec<Place> = self.parameters.iter().map(of_type).collect();
        let choices = choices(&places, &objects, &model.hierarchy);
        let number = choices.iter().map(|fitting| fitting.len() as u64).fold(1, u64::saturating_mul);
        *room = room
            .checked_sub(number)
            .ok_or_else(|| ExportError::TooManyValues { action: action.name.clone(), values: number })?;
        let mut values = Vec::new();
        for_each_tuple(&places, &choices, &mut Vec::new(), &mut |args| {
            let value = self.cost.of(args, &task.values);
            values.extend(value.map(|value| (Atom::new(self.name.clone(), args.to_vec()), value)));
        });
        Ok(values)
    }

    /// `cost-of-go is what go costs: 2 + length + toll`.
    fn note(&self, action: &ActionSchema) -> String {
        let fixed = (self.cost.fixed > 0).then(|| self.cost.fixed.to_string());
        let functions = self.cost.functions.iter().map(|function| function.predicate.to_string());
        let parts: Vec<String> = fixed.into_iter().chain(functions).collect();
        format!("{} is what {} costs: {}", self.name, action.name, parts.join(" + "))
    }
}
