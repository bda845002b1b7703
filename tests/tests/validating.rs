//! Plan files against what a domain and a problem state.

use typelift::check::validate_stated;
use typelift::pddl::{Meaning, read_domain, read_plan, read_problem};

/// What is said of a plan, and what it costs.
fn cost(domain: &str, problem: &str, plan: &str) -> Result<u64, String> {
    let domain = read_domain(domain).expect("a domain");
    let problem = read_problem(problem, &domain).expect("a problem");
    let meaning = Meaning::of(&domain, &problem).map_err(|error| error.to_string())?;
    let lines = read_plan(plan).expect("a plan");
    validate_stated(&meaning, &lines).map_err(|(_, invalid)| invalid.to_string())
}

fn verdict(domain: &str, problem: &str, plan: &str) -> Result<(), String> {
    cost(domain, problem, plan).map(|_| ())
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
        Err("step 1: c is of type cat, where keep takes one of type room or lamp".to_owned())
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

/// A domain of numbered cells in a row and a pawn, with these blocks, and a problem with three cells.
fn in_a_row(blocks: &str, init: &str, goal: &str, plan: &str) -> Result<u64, String> {
    let domain = format!(
        "(define (domain d) (:types cell) (:predicates (next ?a ?b - cell) (on ?c - cell) (lit ?c - cell) (left-of ?a ?b - cell)
         (all-lit-from ?c - cell) (dark)) (:functions (total-cost) - number (way ?a ?b - cell) - number) {blocks})"
    );
    let problem = format!(
        "(define (problem p) (:domain d) (:objects a b c - cell) (:init (next a b) (next b c) {init}) (:goal {goal})
         (:metric minimize (total-cost)))"
    );
    cost(&domain, &problem, plan)
}

#[test]
fn the_total_cost_goes_on_from_where_it_begins() {
    let block = "(:action step :parameters (?a ?b - cell) :precondition (and (on ?a) (next ?a ?b))
        :effect (and (not (on ?a)) (on ?b) (increase (total-cost) (way ?a ?b))))";
    let cost = |begins| {
        in_a_row(block, &format!("(on a) {begins} (= (way a b) 3) (= (way b c) 4)"), "(on c)", "(step a b) (step b c)")
    };
    assert_eq!([cost(""), cost("(= (total-cost) 0)"), cost("(= (total-cost) 10)")], [Ok(7), Ok(7), Ok(17)]);
}

#[test]
fn what_is_derived_follows_anew_after_each_step() {
    let blocks = "(:derived (left-of ?a ?b - cell) (or (next ?a ?b) (exists (?c - cell) (and (left-of ?a ?c) (next ?c ?b)))))
        (:derived (dark) (not (exists (?c - cell) (lit ?c))))
        (:action jump :parameters (?a ?b - cell) :precondition (and (on ?a) (left-of ?a ?b) (dark))
          :effect (and (not (on ?a)) (on ?b) (lit ?b) (increase (total-cost) 2)))
        (:action douse :parameters (?c - cell) :precondition (lit ?c) :effect (and (not (lit ?c)) (increase (total-cost) 1)))";
    let jump = |plan| in_a_row(blocks, "(on a)", "(on c)", plan);
    assert_eq!(jump("(jump a c)"), Ok(2));
    assert_eq!(jump("(jump a b) (douse b) (jump b c)"), Ok(5));
    assert_eq!(jump("(jump a b) (jump b c)"), Err("step 2: jump needs dark()".to_owned()));
    assert_eq!(jump("(jump c a)"), Err("step 1: jump needs on(c)".to_owned()));
}

#[test]
fn a_predicate_may_follow_from_itself_for_every_object() {
    let blocks = "(:derived (all-lit-from ?c - cell)
          (and (lit ?c) (forall (?d - cell) (imply (next ?c ?d) (all-lit-from ?d)))))
        (:action light :parameters (?c - cell) :effect (lit ?c))";
    let light = |plan| in_a_row(blocks, "", "(all-lit-from a)", plan);
    assert_eq!(light("(light a) (light b) (light c)"), Ok(0));
    assert_eq!(light("(light a) (light c)"), Err("the goal all-lit-from(a) does not hold in the end".to_owned()));
    let own_negation = "(:derived (dark) (forall (?c - cell) (imply (lit ?c) (not (dark)))))";
    let refused = Err("derived predicate `dark`: `dark` depends on its own negation".to_owned());
    assert_eq!(in_a_row(own_negation, "", "(dark)", ""), refused);
}

#[test]
fn effects_are_conditional_on_the_state_before_and_adding_wins() {
    let blocks = "(:action shift :parameters ()
        :effect (forall (?a - cell) (and (when (on ?a) (not (on ?a)))
          (forall (?b - cell) (when (and (on ?a) (next ?a ?b)) (on ?b))))))
        (:action walk :parameters (?a ?b - cell) :precondition (on ?a)
          :effect (and (not (on ?a)) (on ?b) (increase (total-cost) (way ?a ?b))))";
    let walk = |init, goal, plan| in_a_row(blocks, init, goal, plan);
    assert_eq!(walk("(on a) (on b)", "(and (on b) (on c) (not (on a)))", "(shift)"), Ok(0));
    assert_eq!(walk("(on a) (= (way a a) 3)", "(on a)", "(walk a a)"), Ok(3));
    assert_eq!(walk("(on a)", "(on b)", "(walk a b)"), Err("step 1: what walk costs there is not stated".to_owned()));
}

#[test]
fn of_alternatives_each_is_said() {
    let blocks = "(:action light :parameters (?c - cell)
        :precondition (or (and (on ?c) (dark)) (lit ?c) (exists (?d - cell) (next ?d ?c))) :effect (lit ?c))";
    assert_eq!(
        in_a_row(blocks, "(on a)", "(lit a)", "(light a)"),
        Err("step 1: light needs dark(); or lit(a); or (exists (?d - cell) (next ?d ?c)) where ?c is a".to_owned())
    );
}
