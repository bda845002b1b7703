//! Plans: what each step does, what an imagined one rests on, how long the plan is.

use serde::{Deserialize, Serialize};
use typelift_model::{GroundAtom, Hierarchy, Plan, Step, Symbol, describe_replacements};

use crate::text::{Role, Text, count};

/// A step of a plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StepView {
    /// The name of the action in the model.
    pub action: Symbol,
    /// The name of the call: what the environment is told.
    pub name: Symbol,
    /// Its arguments.
    pub args: Vec<Symbol>,
    /// What the step rests on, if it is imagined.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub imagined: Option<String>,
    /// What does not hold, although it did whenever such a step was seen.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub without: Vec<GroundAtom>,
}

impl StepView {
    /// The view of a step; `hierarchy` is that of the model which the plan was made with.
    pub fn of(step: &Step, hierarchy: &Hierarchy) -> Self {
        Self {
            action: step.action.clone(),
            name: step.call.name.clone(),
            args: step.call.args.clone(),
            imagined: imagined_note(step, hierarchy),
            without: step.imagined.iter().flat_map(|imagined| imagined.without.clone()).collect(),
        }
    }
}

/// A plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlanView {
    /// The sum of the steps' costs; the number of steps where each costs 1.
    pub cost: u64,
    /// The steps, first to last.
    pub steps: Vec<StepView>,
}

impl PlanView {
    /// The view of a plan; `hierarchy` is that of the model which it was made with.
    pub fn of(plan: &Plan, hierarchy: &Hierarchy) -> Self {
        Self { cost: plan.cost(), steps: plan.steps.iter().map(|step| StepView::of(step, hierarchy)).collect() }
    }
}

/// What a step rests on, if it is imagined: `imagined: cuttingtool for saw, from CUT-saw-board, 5 observations`, or
/// `imagined: without clean(pan_1), which always held (5 observations)`.
pub fn imagined_note(step: &Step, hierarchy: &Hierarchy) -> Option<String> {
    let imagined = step.imagined.as_ref()?;
    if !imagined.without.is_empty() {
        let observations = count(imagined.observations, "observation");
        return Some(format!("imagined: without {}, which always held ({observations})", listed(&imagined.without)));
    }
    Some(format!(
        "imagined: {}, from {}, {}",
        describe_replacements(&imagined.replaced, hierarchy),
        imagined.from,
        count(imagined.observations, "observation")
    ))
}

fn listed(atoms: &[GroundAtom]) -> String {
    atoms.iter().map(ToString::to_string).collect::<Vec<_>>().join(" and ")
}

/// What a plan does without, if it does, and how long it is: `without clean(pan_1), needed by bake because it always held
/// (5 observations), there is a plan of 2 steps`.
pub fn without_phrase(plan: &Plan) -> Option<String> {
    let mut parts: Vec<(&Symbol, u64, Vec<GroundAtom>)> = Vec::new();
    for step in &plan.steps {
        let Some(imagined) = step.imagined.as_ref().filter(|imagined| !imagined.without.is_empty()) else { continue };
        let (call, observations) = (&step.call.name, imagined.observations);
        match parts.iter_mut().find(|part| (part.0, part.1) == (call, observations)) {
            Some((_, _, atoms)) => atoms.extend(imagined.without.iter().cloned()),
            None => parts.push((call, observations, imagined.without.clone())),
        }
    }
    let part = |(call, observations, atoms): &(&Symbol, u64, Vec<GroundAtom>)| {
        let observations = count(*observations, "observation");
        format!("{}, needed by {call} because it always held ({observations})", listed(atoms))
    };
    let parts: Vec<String> = parts.iter().map(part).collect();
    let steps = count(plan.len() as u64, "step");
    (!parts.is_empty()).then(|| format!("without {}, there is a plan of {steps}", parts.join(", and ")))
}

/// A line for each step: its number from 1, its call, and what it rests on if it is imagined.
pub fn numbered_steps(plan: &Plan, hierarchy: &Hierarchy) -> Vec<Text> {
    let line = |(step, number): (&Step, usize)| {
        let line = Text::new().plain(format!("{number:>3}  {}", step.call));
        match imagined_note(step, hierarchy) {
            Some(note) => line.plain("  ").with(Role::Imagined, note),
            None => line,
        }
    };
    plan.steps.iter().zip(1..).map(line).collect()
}

/// `5 steps, 1 imagined`; `4 steps, cost 16` where steps have costs of their own.
pub fn plan_size(plan: &Plan) -> String {
    let mut size = count(plan.len() as u64, "step");
    if !plan.has_unit_costs() {
        size += &format!(", cost {}", plan.cost());
    }
    size + &imagined_part(plan.imagined_steps() as u64)
}

/// `, 2 imagined`; nothing for none.
pub(crate) fn imagined_part(steps: u64) -> String {
    if steps == 0 { String::new() } else { format!(", {steps} imagined") }
}
