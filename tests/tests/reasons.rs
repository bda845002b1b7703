//! Why there is no plan, in the words of the domain and the problem.

use typelift::agent::{Options, propose};
use typelift::model::{ActionModel, Budget, Task};
use typelift::plan::{Outcome, Restrictions};
use typelift::world::DomainFile;

/// A domain and a problem, to plan with.
fn compiled(domain: &str, problem: &str) -> (ActionModel, Task) {
    let domain = DomainFile::from_text("domain".as_ref(), format!("(define (domain d) {domain})")).expect("a domain");
    let problem = format!("(define (problem p) (:domain d) {problem})");
    domain.problem_from_text("problem".as_ref(), &problem).expect("a problem")
}

/// What is said of a problem without a plan.
fn reason(domain: &str, problem: &str) -> String {
    let (model, task) = compiled(domain, problem);
    let budget = Budget::with_expansions(10_000);
    let proposal = propose(&model, &task, &Restrictions::default(), &Options::default(), &budget).expect("an answer");
    assert_eq!(proposal.outcome, Outcome::Unsolvable);
    proposal.explain().to_string()
}

const HARBOUR: &str = "(:types ship crate) (:constants s t - ship c d - crate)
    (:predicates (on ?c - crate ?s - ship) (sealed ?c - crate) (tested ?s - ship) (ready ?s - ship) (sailed ?s - ship))";

fn in_harbour(blocks: &str, init: &str, goal: &str) -> String {
    let problem = format!("(:init {init}) (:goal {goal})");
    reason(&format!("{HARBOUR} {blocks}"), &problem)
}

#[test]
fn an_effect_for_every_choice_of_objects_says_what_it_is_conditional_on() {
    let press = |parameters: &str, effect: &str| {
        let action = format!("(:action press :parameters ({parameters}) :effect {effect})");
        in_harbour(&action, "(sealed c)", "(and (tested s) (tested t))")
    };
    assert_eq!(
        press("", "(forall (?s - ship ?c - crate) (when (on ?c ?s) (tested ?s)))"),
        "tested(s) cannot be reached: the nearest action is press, but it does that only with on(any crate,s), which \
         cannot be reached\ntested(t) cannot be reached: the nearest action is press, but it does that only with \
         on(any crate,t), which cannot be reached"
    );
    // The effect's own variables are numbered after the action's.
    assert_eq!(
        press("?c - crate", "(and (tested s) (forall (?t - ship) (when (on ?c ?t) (tested ?t))))"),
        "tested(t) cannot be reached: the nearest action is press, but it does that only with on(any crate,t), which \
         cannot be reached"
    );
}

#[test]
fn what_only_another_case_needs_is_not_said_to_be_needed() {
    let sail = "(:action sail :parameters (?s - ship) :precondition (or (ready ?s) (tested ?s)) :effect (sailed ?s))";
    assert_eq!(
        in_harbour(sail, "", "(sailed s)"),
        "sailed(s) cannot be reached: the nearest action is sail, but in the nearest of its cases it needs ready(s), which \
         cannot be reached"
    );
}

/// What is missing is followed down, not around: nobody has a ticket since nobody has money, and the hook that is to hold a
/// crate is not free and holds none.
#[test]
fn what_is_missing_at_the_root_is_said() {
    let fair =
        "(:types guest) (:predicates (inside ?g - guest) (ticket ?g - guest) (money ?g - guest) (asked ?g - guest))
        (:action enter :parameters (?g - guest) :precondition (ticket ?g) :effect (inside ?g))
        (:action buy :parameters (?g - guest) :precondition (money ?g) :effect (and (ticket ?g) (not (money ?g))))";
    let inside = "(:objects a - guest) (:init) (:goal (inside a))";
    let needs_ticket = "inside(a) cannot be reached: the nearest action is enter, but it needs ticket(a), which cannot be \
                        reached";
    assert_eq!(
        reason(fair, inside),
        format!("{needs_ticket}; in the end buy needs money(a), which cannot be reached either")
    );
    let asking = "(:action ask :parameters (?g - guest) :precondition (asked ?g) :effect (money ?g))";
    assert_eq!(
        reason(&format!("{fair} {asking}"), inside),
        format!("{needs_ticket}; in the end ask needs asked(a), which cannot be reached either")
    );
    let crane = "(:types hook crate) (:constants h - hook)
        (:predicates (free ?h - hook) (holds ?h - hook ?c - crate) (shipped ?c - crate))
        (:action ship :parameters (?c - crate) :precondition (holds h ?c) :effect (shipped ?c))
        (:action grab :parameters (?h - hook ?c - crate) :precondition (free ?h)
          :effect (and (holds ?h ?c) (not (free ?h))))
        (:action drop :parameters (?h - hook ?c - crate) :precondition (holds ?h ?c)
          :effect (and (free ?h) (not (holds ?h ?c))))";
    assert_eq!(
        reason(crane, "(:objects c d - crate) (:init) (:goal (shipped c))"),
        "shipped(c) cannot be reached: the nearest action is ship, but it needs holds(h,c), which cannot be reached; in the \
         end grab needs free(h), which cannot be reached either"
    );
}

#[test]
fn an_action_that_is_never_used_is_not_said_not_to_be_there() {
    let odd = "(:action odd :parameters (?s - ship) :precondition (or) :effect (sailed ?s))";
    assert_eq!(
        in_harbour(odd, "", "(sailed s)"),
        "sailed(s) cannot be reached: no action can add it: odd, which adds such atoms, can never be used"
    );
    assert_eq!(in_harbour(odd, "", "(tested s)"), "tested(s) cannot be reached: no action can add it");
}

#[test]
fn a_universal_precondition_is_not_taken_for_reachable() {
    let sail = "(:action sail :parameters (?s - ship)
        :precondition (forall (?c - crate) (imply (on ?c ?s) (sealed ?c))) :effect (sailed ?s))";
    assert_eq!(
        in_harbour(sail, "(on c s)", "(sailed s)"),
        "no state that can be reached satisfies the goal; at best this is missing: sailed(s)"
    );
}

#[test]
fn a_part_of_the_goal_is_said_as_it_is_written() {
    let seal = "(:action seal :parameters (?c - crate) :precondition (ready s) :effect (sealed ?c))";
    for (goal, said) in [
        ("(or)", "(or) can never hold"),
        ("(and (sealed c) (or (= c d) (and)) (= c d))", "(= c d) can never hold"),
        ("(and (sealed c) (not (sealed c)))", "(and (sealed c) (not (sealed c))) can never hold"),
        ("(exists (?s - (either ship)) (sailed ?s))", "(exists (?s - ship) (sailed ?s)) can never hold"),
        (
            "(or (sealed c) (and (sealed d) (not (sealed c))))",
            "(or (sealed c) (and (sealed d) (not (sealed c)))) cannot be reached: it follows only from what cannot be \
             reached: sealed(c), sealed(d)",
        ),
        (
            "(forall (?s - ship) (exists (?c - crate) (and (sealed ?c) (not (on ?c ?s)))))",
            "(exists (?c - crate) (and (sealed ?c) (not (on ?c ?s)))) where ?s is s cannot be reached: it follows only from \
             what cannot be reached: sealed(c), sealed(d)",
        ),
    ] {
        assert_eq!(in_harbour(seal, "", goal).lines().next(), Some(said), "{goal}");
    }
}

#[test]
fn what_stands_for_many_alternatives_is_said_as_it_is_written() {
    // Seven times two alternatives are more cases than are multiplied out.
    let ways: Vec<String> = (1..=7).map(|i| format!("(or (sealed c) (on ?c{i} s))")).collect();
    let parameters: String = (1..=7).map(|i| format!("?c{i} ")).collect();
    let condition = format!("(exists ({parameters} - crate) (and {}))", ways.join(" "));
    let sail = format!("(:action sail :parameters () :precondition {condition} :effect (sailed s))");
    let said = in_harbour(&sail, "", "(sailed s)");
    assert!(said.contains("it needs (or (sealed c) (on ?c7 s)) where ?c7 is any crate, which"), "{said}");
}

#[test]
fn one_object_in_two_places_is_not_said_to_be_any_two() {
    let sail = "(:action sail :parameters (?a - ship ?b - crate)
        :precondition (and (ready ?a) (next-to ?b ?b)) :effect (sailed ?a))";
    let domain = format!("{} {sail}", HARBOUR.replace("(:predicates", "(:predicates (next-to ?x ?y - crate)"));
    assert_eq!(
        reason(&domain, "(:init (ready s) (next-to c d)) (:goal (sailed s))"),
        "sailed(s) cannot be reached: the nearest action is sail, but it needs next-to(any crate,the same crate), which \
         cannot be reached"
    );
}

/// What is wrapped stays where it is, and is wrapped at the bench only.
const BENCH: &str = "(:types crate place) (:constants bench dock - place)
    (:predicates (at ?c - crate ?p - place) (bare ?c - crate) (wrapped ?c - crate))
    (:action carry :parameters (?c - crate ?from ?to - place) :precondition (and (at ?c ?from) (bare ?c))
        :effect (and (at ?c ?to) (not (at ?c ?from))))
    (:action wrap :parameters (?c - crate) :precondition (and (at ?c bench) (bare ?c))
        :effect (and (wrapped ?c) (not (bare ?c))))";

const WRAPPED_AND_SHIPPED: &str =
    "(:objects a b c - crate) (:init (at a bench) (bare a) (at b bench) (bare b) (at c dock) (bare c))
     (:goal (and (wrapped a) (at a dock)))";

#[test]
fn goals_that_undo_each_other_are_said_to() {
    assert_eq!(
        reason(BENCH, WRAPPED_AND_SHIPPED),
        "no state that can be reached satisfies the goal; at best this is missing: wrapped(a)\n\
         wrapped(a) and at(a,dock) undo each other: once wrapped(a) is reached, at(a,dock) cannot be any more, since carry \
         needs bare(a); and wrap, which adds wrapped(a), needs at(a,bench), which never holds together with at(a,dock)"
    );
    let emptied = "(:types crate) (:predicates (full ?c - crate) (sealed ?c - crate))
        (:action seal :parameters (?c - crate) :precondition (full ?c) :effect (and (sealed ?c) (not (full ?c))))
        (:action stir :parameters (?c - crate) :effect (and (sealed ?c) (not (full ?c))))";
    let both = "(:objects a - crate) (:init (full a)) (:goal (and (sealed a) (full a)))";
    assert!(reason(emptied, both).starts_with("sealed(a) and full(a) cannot hold together"), "known before any search");
}

/// What can be unwrapped again may be carried after all.
#[test]
fn goals_that_can_be_had_together_are_not_said_to_undo_each_other() {
    let cut = "(:action cut :parameters (?c - crate) :precondition (wrapped ?c) :effect (bare ?c))";
    let (model, task) = compiled(&format!("{BENCH} {cut}"), WRAPPED_AND_SHIPPED);
    let budget = Budget::with_expansions(10_000);
    let proposal = propose(&model, &task, &Restrictions::default(), &Options::default(), &budget).expect("an answer");
    assert!(matches!(proposal.outcome, Outcome::Solved(plan) if plan.len() == 3));
}

/// A search that may not go on for long says no less.
#[test]
fn goals_that_undo_each_other_need_no_search_to_the_end() {
    let (model, task) = compiled(BENCH, WRAPPED_AND_SHIPPED);
    let budget = Budget::with_expansions(2);
    let proposal = propose(&model, &task, &Restrictions::default(), &Options::default(), &budget).expect("an answer");
    assert_eq!(proposal.outcome, Outcome::Unsolvable);
    assert!(proposal.explain().to_string().contains("undo each other"));
}
