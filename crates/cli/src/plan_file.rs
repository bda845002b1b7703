//! Plans as the plan files of the planning competitions.

use std::collections::BTreeMap;
use std::fmt::Write;

use typelift::model::{ActionModel, GroundCall, NameCollision, PddlNames, Plan, State, Symbol};
use typelift::pddl::PlanLine;
use typelift::words::imagined_note;

/// The plan file: one `(name arg …)` a line in PDDL names, then the cost.
pub(crate) fn plan_file(plan: &Plan, model: &ActionModel, state: &State) -> Result<String, NameCollision> {
    let names = model.pddl_names()?;
    let objects = PddlNames::fold("object", state.objects.keys())?;
    let mut text = String::new();
    for step in &plan.steps {
        let Some(schema) = model.action(step.action.as_str()) else { continue };
        let _ = write!(text, "({}", names.in_plans(schema));
        for object in schema.signature().args.iter().map(|term| term.object(&step.objects)) {
            let _ = write!(text, " {}", objects.pddl(object.as_str()).unwrap_or(&object));
        }
        let _ = write!(text, ")");
        if let Some(note) = imagined_note(step, &model.hierarchy) {
            let _ = write!(text, " ; {note}");
        }
        text.push('\n');
    }
    let unit = if plan.has_unit_costs() { "unit cost" } else { "general cost" };
    let _ = writeln!(text, "; cost = {} ({unit})", plan.cost());
    Ok(text)
}

/// What the lines of a plan file say in the model's names. A name that the model does not have stands for itself:
/// replaying the plan reports it.
pub(crate) fn calls_of_plan(
    lines: &[PlanLine],
    model: &ActionModel,
    state: &State,
) -> Result<Vec<GroundCall>, NameCollision> {
    let names = model.pddl_names()?;
    let objects = PddlNames::fold("object", state.objects.keys())?;
    let mut actions: BTreeMap<&Symbol, Symbol> = BTreeMap::new();
    for schema in &model.actions {
        actions.entry(names.in_plans(schema)).or_insert_with(|| schema.signature().name);
    }
    let call = |line: &PlanLine| GroundCall {
        name: actions.get(&line.name).unwrap_or(&line.name).clone(),
        args: line.args.iter().map(|arg| objects.name(arg.as_str()).unwrap_or(arg).clone()).collect(),
    };
    Ok(lines.iter().map(call).collect())
}
