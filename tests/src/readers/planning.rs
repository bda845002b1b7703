//! Plans that are found for what was read, within narrow limits.

use std::fmt::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use typelift::check::{check, validate};
use typelift::model::{ActionModel, Budget, GroundCall, Hierarchy, Parameter, Plan, State, Stop, Task};
use typelift::pddl::{PlanLine, read_plan};
use typelift::plan::{Options, Outcome, Planner, Restrictions};

use super::errors::assert_printable;

/// Choices of objects that the plain semantics may have to go through at each step.
const MOST_CHOICES: u64 = 5_000;
/// Plans that are looked for.
const PLANS: usize = 3;

/// What planning may spend: expansions, and how often it may ask whether to stop.
fn narrow() -> Budget {
    let asked = AtomicU64::new(0);
    let stop = move || (asked.fetch_add(1, Ordering::Relaxed) > 50).then_some(Stop::Cancelled);
    Budget { expansions: Some(200), memory: None, stop: Some(Arc::new(stop)) }
}

/// The first plans; each is valid by the plainest semantics.
pub(super) fn valid_plans(model: &ActionModel, task: &Task) -> Vec<(Plan, State)> {
    let mut plans = Vec::new();
    let Ok(mut planner) = Planner::new(model, task, &Restrictions::default(), &Options::default(), &narrow()) else {
        return plans;
    };
    while let Outcome::Solved(plan) = planner.next_plan(&narrow()) {
        if plans.len() == PLANS || !is_replayable(model, task) {
            break;
        }
        let state = check(model, task, &plan).unwrap_or_else(|invalid| panic!("{invalid}: {plan:?}"));
        plans.push((plan, state));
    }
    assert_printable(&planner.explain().to_string().replace('\n', " "));
    plans
}

/// That a plan is valid as well when it is written as a file and read again, and leads to this state.
pub(super) fn assert_written_holds(model: &ActionModel, task: &Task, plan: &Plan, state: &State) {
    let text = written(model, plan);
    let lines = read_plan(&text).unwrap_or_else(|error| panic!("{}", error.render("plan", &text)));
    match validate(model, task, &as_calls(lines)) {
        Ok(valid) => {
            assert_eq!((valid.plan.len(), valid.plan.cost()), (plan.len(), plan.cost()), "{text}");
            assert_eq!(valid.state, *state, "{text}");
        }
        Err((_, invalid)) => panic!("{invalid}:\n{text}"),
    }
}

/// The lines of a plan file as calls.
pub(super) fn as_calls(lines: Vec<PlanLine>) -> Vec<GroundCall> {
    lines.into_iter().map(|line| GroundCall { name: line.name, args: line.args }).collect()
}

/// A plan as a file has it.
pub(super) fn written(model: &ActionModel, plan: &Plan) -> String {
    let mut text = String::new();
    for step in &plan.steps {
        let signature = model.action(step.action.as_str()).expect("an action of the model").signature();
        write!(text, "({}", signature.name).expect("memory");
        for term in &signature.args {
            write!(text, " {}", term.object(&step.objects)).expect("memory");
        }
        text.push_str(")\n");
    }
    text
}

/// Whether replaying a step, which tries out every choice of objects for what is quantified, is done soon.
pub(super) fn is_replayable(model: &ActionModel, task: &Task) -> bool {
    let choices = |parameters: &[Parameter]| {
        let fitting = |parameter: &Parameter| objects_of(&model.hierarchy, task, parameter);
        parameters.iter().map(fitting).fold(1, u64::saturating_mul)
    };
    let axioms = model.axioms.iter().map(|axiom| choices(&axiom.parameters));
    let actions = model.actions.iter().map(|action| {
        let effects = action.effects.iter().map(|effect| choices(&effect.parameters));
        choices(&action.parameters).saturating_add(effects.fold(0, u64::saturating_add))
    });
    axioms.chain(actions).fold(0, u64::saturating_add) <= MOST_CHOICES
}

fn objects_of(hierarchy: &Hierarchy, task: &Task, parameter: &Parameter) -> u64 {
    task.init.objects.values().filter(|ty| hierarchy.is_a(**ty, parameter.ty)).count() as u64
}
