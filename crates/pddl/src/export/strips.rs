//! The rewrite of a model and a task into STRIPS: positive preconditions only, and nothing that must differ.
//!
//! What may not hold becomes a predicate of its own that holds where the other does not (see [`complement`]), unless
//! something else that must hold implies it (see [`exclusive`]): heuristics count what is written. Costs
//! of a fixed amount are left out, which changes no plan but which of them is best. What would take more than that is
//! refused by name: learned models have none of it.
//!
//! [`complement`]: super::complement
//! [`exclusive`]: super::exclusive

use typelift_model::{ActionModel, Cost, LiftedAtom, Literal, Symbol, Task, Term};

use super::complement::Complements;
use super::exclusive::without_implied;
use super::{Compiled, ExportError};

pub(super) fn compile(model: &ActionModel, task: Option<&Task>) -> Result<Compiled, ExportError> {
    refuse_beyond(model)?;
    let mut model = model.clone();
    let mut notes = Vec::new();
    distinct_as_literals(&mut model);
    if model.actions.iter().any(|action| action.cost != Cost::UNIT) {
        notes.push("costs are left out".to_owned());
        for action in &mut model.actions {
            action.cost = Cost::UNIT;
        }
    }
    let lean = task.map_or_else(|| model.clone(), |task| without_implied(&model, task));
    if lean.actions != model.actions {
        notes.push("what may not hold is left out where, in this problem, what must hold implies it".to_owned());
    }
    let complements = Complements::of(&lean, task);
    let task = task.map(|task| complements.in_task(&model, task)).transpose()?;
    complements.in_model(&mut model, &lean)?;
    notes.extend(complements.notes());
    Ok(Compiled { model, task, notes })
}

fn refuse_beyond(model: &ActionModel) -> Result<(), ExportError> {
    let refused = |subject: &Symbol, feature| Err(ExportError::Unsupported { subject: subject.clone(), feature });
    if let Some(axiom) = model.axioms.first() {
        // No file has the name of a predicate that stands for a formula.
        return match model.wordings.get(&axiom.head.predicate) {
            Some(wording) => refused(&Symbol::new(&wording.formula), "is more than a conjunction"),
            None => refused(&axiom.head.predicate, "is a derived predicate"),
        };
    }
    for action in &model.actions {
        if action.effects.iter().any(|effect| !effect.parameters.is_empty()) {
            return refused(&action.name, "has an effect for every choice of objects");
        }
        if action.effects.iter().any(|effect| !effect.condition.is_empty()) {
            return refused(&action.name, "has an effect with a condition");
        }
        if !action.cost.functions.is_empty() {
            return refused(&action.name, "has a cost that depends on its objects");
        }
    }
    Ok(())
}

/// Writes the pairs of parameters that must differ, and that their types do not keep apart, as negated equalities.
fn distinct_as_literals(model: &mut ActionModel) {
    for action in &mut model.actions {
        for (i, j) in std::mem::take(&mut action.distinct) {
            let [left, right] = [i, j].map(|index| action.parameters[index as usize].ty);
            if !model.hierarchy.disjoint(left, right) {
                let equal = LiftedAtom::new(typelift_model::EQUALS, vec![Term::Param(i), Term::Param(j)]);
                action.preconditions.push(Literal::negative(equal));
            }
        }
    }
}
