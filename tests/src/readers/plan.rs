//! Plan files.

use typelift::check::{check, validate};
use typelift::pddl::{format, read_plan};

use super::domain::checked_domain;
use super::errors::{assert_located, assert_printable};
use super::planning::{calls, is_replayable, written};
use super::problem::checked_problem;
use super::{last_part, sample, text_of};

/// What is read can be replayed; if it is valid, so is the plan as it was understood. The parts before the plan are a
/// domain and a problem.
pub fn plan(bytes: &[u8]) {
    let text = text_of(bytes);
    let ([domain_text, problem_text], plan_text) = match last_part(&text) {
        (Some(parts), plan) => (parts, plan),
        (None, plan) => ([sample::DOMAIN, sample::PROBLEM], plan),
    };
    let lines = match read_plan(plan_text) {
        Ok(lines) => lines,
        Err(error) => return assert_located(&error, plan_text),
    };
    let laid_out = read_plan(&format(plan_text).expect("its parentheses match")).expect("it reads as before");
    let calls = calls(lines);
    assert_eq!(super::planning::calls(laid_out), calls);
    let Some((domain, model)) = checked_domain(domain_text) else { return };
    let Some((model, task)) = checked_problem(problem_text, &domain, domain_text, model) else { return };
    if !is_replayable(&model, &task) {
        return;
    }
    match validate(&model, &task, &calls) {
        Ok(valid) => {
            assert_eq!(valid.plan.len(), calls.len());
            assert_eq!(check(&model, &task, &valid.plan).as_ref(), Ok(&valid.state));
            let again = read_plan(&written(&model, &valid.plan)).expect("it is written as it is read");
            assert_eq!(super::planning::calls(again), calls);
        }
        Err((taken, invalid)) => {
            assert!(taken.len() <= calls.len());
            assert_printable(&invalid.to_string());
        }
    }
}
