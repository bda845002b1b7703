//! Plan files.

use typelift::check::{check, validate};
use typelift::pddl::{format, read_plan};

use super::errors::{assert_located, assert_printable};
use super::planning::{as_calls, is_replayable, written};
use super::problem::problem_of;
use super::{last_part, sample, text_of};

/// What is read can be replayed; if it is valid, so is the plan as it was understood. The parts before the plan are a
/// domain and a problem.
pub fn plan(bytes: &[u8]) {
    let text = text_of(bytes);
    let (given, plan) = last_part(&text);
    let lines = match read_plan(plan) {
        Ok(lines) => lines,
        Err(error) => return assert_located(&error, plan),
    };
    let laid_out = read_plan(&format(plan).expect("its parentheses match")).expect("it reads as before");
    let calls = as_calls(lines);
    assert_eq!(as_calls(laid_out), calls);
    let found = match given {
        Some([domain, problem]) => problem_of(domain, problem),
        None => Some(sample::problem().clone()),
    };
    let Some((model, task)) = &found else { return };
    if !is_replayable(model, task) {
        return;
    }
    match validate(model, task, &calls) {
        Ok(valid) => {
            assert_eq!(valid.plan.len(), calls.len());
            assert_eq!(check(model, task, &valid.plan).as_ref(), Ok(&valid.state));
            let again = read_plan(&written(model, &valid.plan)).expect("it is written as it is read");
            assert_eq!(as_calls(again), calls);
        }
        Err((taken, invalid)) => {
            assert!(taken.len() <= calls.len());
            assert_printable(&invalid.to_string());
        }
    }
}
