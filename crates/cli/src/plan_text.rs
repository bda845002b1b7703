//! Plans as text: for people, and as the plan files of the planning competitions.

use std::collections::BTreeMap;
use std::fmt::Write;

use typelift::model::{
    ActionModel, GroundCall, Hierarchy, NameCollision, PddlNames, Plan, State, Step, Symbol, describe_replacements,
};
use typelift::pddl::PlanLine;

use crate::style::{IMAGINED, count};

/// What a step rests on, if it is imagined: `imagined: cuttingtool for cutboard, from USE-cutboard-food, 5 observations`.
pub(crate) fn imagined_note(step: &Step, hierarchy: &Hierarchy) -> Option<String> {
    let imagined = step.imagined.as_ref()?;
    Some(format!(
        "imagined: {}, from {}, {}",
        describe_replacements(&imagined.replaced, hierarchy),
        imagined.from,
        count(imagined.observations, "observation")
    ))
}

/// The steps, numbered, a line each, with what an imagined one rests on at its end.
pub(crate) fn numbered_steps(plan: &Plan, hierarchy: &Hierarchy) -> String {
    let mut text = String::new();
    for (i, step) in plan.steps.iter().enumerate() {
        let note = imagined_note(step, hierarchy).map(|note| format!("  {IMAGINED}{note}{IMAGINED:#}"));
        let _ = writeln!(text, "{:>3}  {}{}", i + 1, step.call, note.unwrap_or_default());
    }
    text
}

/// `5 steps, 1 imagined`; `4 steps, cost 16` where steps have costs of their own.
pub(crate) fn plan_size(plan: &Plan) -> String {
    let imagined = plan.steps.iter().filter(|step| step.imagined.is_some()).count();
    let mut size = count(plan.len() as u64, "step");
    if !has_unit_costs(plan) {
        let _ = write!(size, ", cost {}", plan.cost());
    }
    if imagined > 0 {
        let _ = write!(size, ", {imagined} imagined");
    }
    size
}

fn has_unit_costs(plan: &Plan) -> bool {
    plan.steps.iter().all(|step| step.cost == 1)
}

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
    let unit = if has_unit_costs(plan) { "unit cost" } else { "general cost" };
    let _ = writeln!(text, "; cost = {} ({unit})", plan.cost());
    Ok(text)
}

/// What the lines of a plan file say in the model's names. A name that the model does not have stands for itself:
/// whoever replays the plan says so.
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
