//! Replays a plan by the plainest semantics: the judge of every test and of every plan that is printed or executed.
//!
//! States are sets of atoms, steps are instantiated one by one, nothing is grounded, packed or cached, and no code is
//! shared with the planner.
//!
//! ```
//! use typelift_check::check;
//! use typelift_model::{ActionModel, Plan, Task};
//!
//! // Nothing to do, nothing done: valid.
//! assert!(check(&ActionModel::default(), &Task::default(), &Plan::default()).is_ok());
//! ```
#![deny(missing_docs)]

mod stated;
mod validate;

pub use stated::validate_stated;
pub use validate::{Valid, validate};

use thiserror::Error;
use typelift_model::{ActionModel, GroundAction, InstantiateError, Plan, State, Step, Symbol, Task, Unknown};

/// Why a plan is not valid. Steps are counted from 1.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Invalid {
    /// A step names an action that the model does not have.
    #[error("step {step}: there is no action `{action}`")]
    UnknownAction {
        /// The step.
        step: usize,
        /// The name.
        action: Symbol,
    },
    /// A step's objects do not fit its action.
    #[error("step {step}: {error}")]
    Objects {
        /// The step.
        step: usize,
        /// Why not.
        error: InstantiateError,
    },
    /// A step tells the environment something else than its action says.
    #[error("step {step}: {action} is executed as {expected}, not as {found}")]
    Call {
        /// The step.
        step: usize,
        /// The action.
        action: Symbol,
        /// What the action says.
        expected: String,
        /// What the step says.
        found: String,
    },
    /// A step is said to cost something else than its action does.
    #[error("step {step}: {action} costs {expected} there, not {found}")]
    Cost {
        /// The step.
        step: usize,
        /// The action.
        action: Symbol,
        /// What it costs.
        expected: u32,
        /// What the step says.
        found: u32,
    },
    /// A precondition does not hold.
    #[error("step {step}: {action} needs {needs}")]
    Precondition {
        /// The step.
        step: usize,
        /// The action.
        action: Symbol,
        /// What does not hold, in the words of the text that the model was made from.
        needs: String,
    },
    /// An action that can be used in several ways can be used in none.
    #[error("step {step}: {action} needs {}", .reasons.join("; or "))]
    NoCase {
        /// The step.
        step: usize,
        /// The action, as the plan names it.
        action: Symbol,
        /// For each way, what is missing.
        reasons: Vec<String>,
    },
    /// The goal does not hold in the end.
    #[error("the goal {part} does not hold in the end")]
    Goal {
        /// The first part of it that does not, in the words of the text that the model was made from.
        part: String,
    },
}

/// Replays the plan from the task's initial state and returns the final state, in which the goal holds. What is unknown
/// is taken for false.
///
/// # Errors
/// [`Invalid`] names the first step that cannot be taken, or the first part of the goal that is missed.
pub fn check(model: &ActionModel, task: &Task, plan: &Plan) -> Result<State, Invalid> {
    let mut state = State { unknown: Unknown::default(), ..model.with_derived(&task.init) };
    for (i, step) in plan.steps.iter().enumerate() {
        let action = resolve(model, task, &state, i + 1, step)?;
        if let Some((atom, positive)) = action.unmet(&state).next() {
            let (step, action) = (i + 1, action.schema.clone());
            return Err(Invalid::Precondition { step, action, needs: model.in_words(atom, *positive) });
        }
        advance(model, &action, &mut state);
    }
    match task.goal.literals().find(|&(atom, positive)| state.holds(atom) != positive) {
        Some((atom, positive)) => Err(Invalid::Goal { part: model.in_words(atom, positive) }),
        None => Ok(state),
    }
}

fn resolve(
    model: &ActionModel,
    task: &Task,
    state: &State,
    step: usize,
    taken: &Step,
) -> Result<GroundAction, Invalid> {
    let schema = model
        .action(taken.action.as_str())
        .ok_or_else(|| Invalid::UnknownAction { step, action: taken.action.clone() })?;
    let action = schema
        .instantiate(&taken.objects, state, &model.hierarchy)
        .map_err(|error| Invalid::Objects { step, error })?;
    if action.call != taken.call {
        return Err(Invalid::Call {
            step,
            action: taken.action.clone(),
            expected: action.call.to_string(),
            found: taken.call.to_string(),
        });
    }
    let no_cost = || Invalid::Objects { step, error: InstantiateError::NoCost { action: taken.action.clone() } };
    let cost = schema.cost.of(&taken.objects, &task.values).ok_or_else(no_cost)?;
    if cost != taken.cost {
        return Err(Invalid::Cost { step, action: taken.action.clone(), expected: cost, found: taken.cost });
    }
    Ok(action)
}

/// Makes the state that after an action: deletes, then adds, then what follows.
fn advance(model: &ActionModel, action: &GroundAction, state: &mut State) {
    for atom in &action.deletes {
        state.atoms.remove(atom);
    }
    for atom in &action.adds {
        state.atoms.insert(atom.clone());
    }
    if !model.axioms.is_empty() {
        *state = model.with_derived(state);
    }
}

#[cfg(test)]
mod tests {
    use typelift_model::{
        ActionSchema, Cost, Effect, GroundAtom, GroundCall, Hierarchy, LiftedAtom, LiftedCall, Literal, Parameter,
        Provenance, Term,
    };

    use super::*;

    fn lifted(text: &str) -> LiftedAtom {
        LiftedAtom::parse(text).expect("an atom")
    }

    fn ground(text: &str) -> GroundAtom {
        GroundAtom::parse(text).expect("an atom")
    }

    /// `go(?0, ?1)`: from one room to a different one that is not locked; where the light was on, it goes out.
    fn model() -> ActionModel {
        let hierarchy = Hierarchy::from_edges([("room", "place"), ("lamp", "object")]).expect("a tree");
        let room = hierarchy.id("place").expect("declared");
        let parameter = |name: &str| Parameter { name: name.into(), ty: room };
        let go = ActionSchema {
            name: "go".into(),
            call: LiftedCall { name: "GO".into(), args: vec![Term::Param(1)] },
            parameters: vec![parameter("from"), parameter("to")],
            preconditions: vec![Literal::positive(lifted("in(?0)")), Literal::negative(lifted("locked(?1)"))],
            distinct: vec![(0, 1)],
            effects: vec![
                Effect::always(Literal::positive(lifted("in(?1)"))),
                Effect::always(Literal::negative(lifted("in(?0)"))),
                Effect::when(vec![Literal::positive(lifted("lit(?0)"))], Literal::negative(lifted("lit(?0)"))),
            ],
            cost: Cost::UNIT,
            strict: false,
            named_by_call: true,
            provenance: Provenance::Given,
        };
        ActionModel { hierarchy, actions: vec![go], ..ActionModel::default() }
    }

    fn task(goal: &str) -> Task {
        let model = model();
        let id = |name| model.hierarchy.id(name).expect("declared");
        let mut task = Task { goal: vec![ground(goal)].into(), ..Task::default() };
        for (object, ty) in [("hall", "room"), ("attic", "room"), ("cellar", "room"), ("bulb", "lamp")] {
            task.init.objects.insert(object.into(), id(ty));
        }
        task.init.atoms.extend(["in(hall)", "lit(hall)", "lit(attic)", "locked(cellar)"].map(ground));
        task
    }

    fn go(from: &str, to: &str) -> Step {
        model().actions[0].step(vec![from.into(), to.into()], 1)
    }

    fn verdict(steps: Vec<Step>, goal: &str) -> Result<State, String> {
        check(&model(), &task(goal), &Plan { steps }).map_err(|invalid| invalid.to_string())
    }

    #[test]
    fn a_valid_plan_gives_its_final_state() {
        let state = verdict(vec![go("hall", "attic")], "in(attic)").expect("valid");
        let atoms: Vec<String> = state.atoms.iter().map(ToString::to_string).collect();
        assert_eq!(atoms, ["in(attic)", "lit(attic)", "locked(cellar)"], "where it leaves, the light goes out");
    }

    #[test]
    fn each_way_to_be_invalid_is_named() {
        let wrong = |steps, message: &str| assert_eq!(verdict(steps, "in(attic)"), Err(message.to_owned()));
        wrong(vec![], "the goal in(attic) does not hold in the end");
        wrong(vec![go("attic", "hall")], "step 1: go needs in(attic)");
        wrong(vec![go("hall", "cellar")], "step 1: go needs not locked(cellar)");
        wrong(vec![go("hall", "attic"), go("hall", "attic")], "step 2: go needs in(hall)");
        wrong(vec![go("hall", "hall")], "step 1: go takes different objects where both are hall");
        wrong(vec![go("hall", "moon")], "step 1: there is no object `moon`");
        wrong(vec![go("hall", "bulb")], "step 1: bulb is of type lamp, where go takes one of type place");
        let unknown = Step { action: "fly".into(), ..go("hall", "attic") };
        wrong(vec![unknown], "step 1: there is no action `fly`");
        let call = GroundCall { name: "GO".into(), args: vec!["hall".into()] };
        wrong(vec![Step { call, ..go("hall", "attic") }], "step 1: go is executed as GO(attic), not as GO(hall)");
        let short = Step { objects: vec!["hall".into()], ..go("hall", "attic") };
        wrong(vec![short], "step 1: go takes 2 objects, not 1");
    }
}
