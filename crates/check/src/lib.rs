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

use thiserror::Error;
use typelift_model::{ActionModel, GroundAction, GroundAtom, InstantiateError, Plan, State, Step, Symbol, Task};

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
    /// A precondition does not hold.
    #[error("step {step}: {action} needs {}{atom}", if *.positive { "" } else { "not " })]
    Precondition {
        /// The step.
        step: usize,
        /// The action.
        action: Symbol,
        /// The atom.
        atom: GroundAtom,
        /// Whether it must hold, or must not.
        positive: bool,
    },
    /// The goal does not hold in the end.
    #[error("the goal {atom} does not hold in the end")]
    Goal {
        /// The first goal atom that does not.
        atom: GroundAtom,
    },
}

/// Replays the plan from the task's initial state and returns the final state, in which the goal holds.
///
/// # Errors
/// [`Invalid`] names the first step that cannot be taken, or the goal atom that is missed.
pub fn check(model: &ActionModel, task: &Task, plan: &Plan) -> Result<State, Invalid> {
    let mut state = task.init.clone();
    for (i, step) in plan.steps.iter().enumerate() {
        let action = resolve(model, &state, i + 1, step)?;
        if let Some((atom, positive)) = action.unmet(&state).next() {
            let (step, action) = (i + 1, action.schema.clone());
            return Err(Invalid::Precondition { step, action, atom: atom.clone(), positive: *positive });
        }
        apply(&action, &mut state);
    }
    match task.goal.iter().find(|atom| !state.holds(atom)) {
        Some(atom) => Err(Invalid::Goal { atom: atom.clone() }),
        None => Ok(state),
    }
}

fn resolve(model: &ActionModel, state: &State, step: usize, taken: &Step) -> Result<GroundAction, Invalid> {
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
    Ok(action)
}

/// Deletes, then adds.
fn apply(action: &GroundAction, state: &mut State) {
    for atom in &action.deletes {
        state.atoms.remove(atom);
        state.unknown.remove(atom);
    }
    for atom in &action.adds {
        state.unknown.remove(atom);
        state.atoms.insert(atom.clone());
    }
}
