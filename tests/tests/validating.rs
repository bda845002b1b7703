//! Plan files against the model that a domain was compiled into.

use typelift::check::validate;
use typelift::model::GroundCall;
use typelift::pddl::{compile_domain, compile_problem, read_domain, read_plan, read_problem};

/// What is said of a plan.
fn verdict(domain: &str, problem: &str, plan: &str) -> Result<(), String> {
    let domain = read_domain(domain).expect("a domain");
    let problem = read_problem(problem, &domain).expect("a problem");
    let mut model = compile_domain(&domain).expect("a model");
    let task = compile_problem(&problem, &mut model).expect("a task");
    let lines = read_plan(plan).expect("a plan").into_iter();
    let calls: Vec<GroundCall> = lines.map(|line| GroundCall { name: line.name, args: line.args }).collect();
    validate(&model, &task, &calls).map(|_| ()).map_err(|(_, invalid)| invalid.to_string())
}

#[test]
fn a_parameter_of_either_of_two_types_takes_objects_of_both() {
    let domain = "(define (domain d) (:types room lamp cat) (:predicates (kept ?x) (clean ?x))
        (:action keep :parameters (?x - (either room lamp)) :precondition (clean ?x) :effect (kept ?x)))";
    let problem = "(define (problem p) (:domain d) (:objects r - room l m - lamp c - cat) (:init (clean r) (clean l))
        (:goal (and (kept r) (kept l))))";
    assert_eq!(verdict(domain, problem, "(keep r) (keep l)"), Ok(()));
    assert_eq!(verdict(domain, problem, "(keep m)"), Err("step 1: keep needs clean(m)".to_owned()));
    assert_eq!(
        verdict(domain, problem, "(keep c)"),
        Err("step 1: c is of type cat, where keep takes one of type room".to_owned())
    );
}
