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

const WARDS: &str =
    "(define (domain d) (:types ward bed) (:predicates (in ?b - bed ?w - ward) (made ?b - bed) (open ?w - ward))
    (:action make :parameters (?b - bed) :effect (made ?b))
    (:action unlock :parameters (?w - ward)
      :precondition (forall (?b - bed) (imply (in ?b ?w) (made ?b))) :effect (open ?w)))";

fn in_wards(goal: &str, plan: &str) -> Result<(), String> {
    let objects = "(:objects w - ward b c - bed) (:init (in b w) (in c w))";
    verdict(WARDS, &format!("(define (problem p) (:domain d) {objects} (:goal {goal}))"), plan)
}

#[test]
fn what_is_missing_is_said_as_the_files_state_it() {
    assert_eq!(
        in_wards("(open w)", "(make b) (unlock w)"),
        Err("step 2: unlock needs (forall (?b - bed) (imply (in ?b ?w) (made ?b))) where ?w is w".to_owned())
    );
    let goal = "(or (open w) (forall (?b - bed) (made ?b)))";
    assert_eq!(in_wards(goal, "(make b)"), Err(format!("the goal {goal} does not hold in the end")));
    assert_eq!(in_wards(goal, "(make b) (make c)"), Ok(()));
}

#[test]
fn the_times_of_a_plan_give_its_order() {
    assert_eq!(in_wards("(open w)", "2: (unlock w) 0: (make b) [1] 1.5: (make c)"), Ok(()));
}
