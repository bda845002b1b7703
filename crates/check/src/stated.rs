//! Plans of a PDDL problem, judged by what its files state.
//!
//! The model that the planner plans with is made by a compiler. Where a domain and a problem are given as PDDL, a plan is
//! judged without either.

use typelift_model::{InstantiateError, Symbol};
use typelift_pddl::{Action, Atoms, Meaning, PlanLine};

use crate::Invalid;

/// Replays a plan from the problem's initial state, and returns the total cost in the end: as in VAL, what it is at the
/// beginning counts.
///
/// # Errors
/// How many steps could be taken, and [`Invalid`], which names the first that cannot be, or the first part of the goal that
/// is missed.
pub fn validate_stated(meaning: &Meaning<'_>, lines: &[PlanLine]) -> Result<u64, (usize, Invalid)> {
    let mut atoms = meaning.initial();
    let mut total = meaning.initial_cost();
    for (taken, line) in lines.iter().enumerate() {
        let (after, cost) = take(meaning, &atoms, taken + 1, line).map_err(|invalid| (taken, invalid))?;
        atoms = after;
        total = total.saturating_add(cost);
    }
    match meaning.missed(&atoms) {
        Some(part) => Err((lines.len(), Invalid::Goal { part })),
        None => Ok(total),
    }
}

/// What holds after a step, and its cost.
fn take(meaning: &Meaning<'_>, atoms: &Atoms, step: usize, line: &PlanLine) -> Result<(Atoms, u64), Invalid> {
    let Some(action) = meaning.action(line.name.as_str()) else {
        return Err(Invalid::UnknownAction { step, action: line.name.clone() });
    };
    check_objects(meaning, action, line).map_err(|error| Invalid::Objects { step, error })?;
    if !meaning.can_be_used(action, &line.args, atoms) {
        let mut reasons = meaning.missing(action, &line.args, atoms);
        let action = action.name.clone();
        return Err(match (reasons.len(), reasons.pop()) {
            (1, Some(needs)) => Invalid::Precondition { step, action, needs },
            (_, last) => Invalid::NoCase { step, action, reasons: reasons.into_iter().chain(last).collect() },
        });
    }
    meaning.after(action, &line.args, atoms).map_err(|_| {
        let error = InstantiateError::NoCost { action: action.name.clone() };
        Invalid::Objects { step, error }
    })
}

/// The objects of a line are as many as the action takes, exist, and have the types of their places.
fn check_objects(meaning: &Meaning<'_>, action: &Action, line: &PlanLine) -> Result<(), InstantiateError> {
    let (expected, found) = (action.parameters.len(), line.args.len());
    if expected != found {
        return Err(InstantiateError::Arity { action: action.name.clone(), expected, found });
    }
    for (parameter, object) in action.parameters.iter().zip(&line.args) {
        let Some(found) = meaning.type_of(object) else {
            return Err(InstantiateError::UnknownObject { object: object.clone() });
        };
        if !meaning.fits(object, parameter) {
            let types: Vec<&str> = parameter.types.iter().map(Symbol::as_str).collect();
            return Err(InstantiateError::Type {
                action: action.name.clone(),
                object: object.clone(),
                expected: Symbol::from(types.join(" or ")),
                found: found.clone(),
            });
        }
    }
    Ok(())
}
