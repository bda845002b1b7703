//! Domains: what is read, and what is refused where.

use typelift_pddl::{Domain, MOST_NESTED, PddlError, read_domain};

#[track_caller]
fn read(text: &str) -> Domain {
    read_domain(text).unwrap_or_else(|error| panic!("{}", error.render("domain.pddl", text)))
}

/// A domain with one block more.
fn with(block: &str) -> String {
    format!(
        "(define (domain d) (:types block table - thing ball)\n(:constants floor - table)\n\
         (:predicates (on ?x - block ?y - thing) (dark) (any ?x ?y) (far ?x - block) (held ?b - ball))\n\
         (:functions (total-cost) - number (way ?x ?y - block) - number (gas ?x - block))\n{block})"
    )
}

fn action(rest: &str) -> String {
    with(&format!("(:action a :parameters (?x ?y - block ?t - table ?b - ball ?o)\n{rest})"))
}

#[track_caller]
fn refused(text: &str) -> PddlError {
    match read_domain(text) {
        Err(error) => error,
        Ok(domain) => panic!("this was read: {text}\nas\n{domain}"),
    }
}

/// The error of an action with this precondition.
#[track_caller]
fn bad_condition(condition: &str) -> String {
    let error = refused(&action(&format!(":precondition {condition}")));
    assert!(error.position.line == 6, "{error}");
    error.message
}

#[track_caller]
fn bad_effect(effect: &str) -> PddlError {
    let error = refused(&action(&format!(":effect {effect}")));
    assert!(error.position.line == 6, "{error}");
    error
}

/// The first action of a domain, as it is printed.
fn first_action(text: &str) -> String {
    let shown = read(text).to_string();
    shown[shown.find("  (:action").expect("an action")..].to_owned()
}

#[test]
fn everything_that_is_supported() {
    let text = "; top
(DEFINE (Domain Blocks-World)
  (:action Stack ; before what it mentions
    :effect (and (On ?x ?y) (not (clear ?y)) (increase (Total-Cost) (way ?x ?y))
                 (forall (?z - block) (when (and (on ?x ?z) (not (= ?z ?y))) (not (on ?x ?z)))))
    :parameters (?x ?y - BLOCK)
    :precondition (and (not (= ?x ?y)) (or (clear ?x) (light ?x)) (imply (dark) (exists (?l - (either lamp Block)) (light ?l)))))
  (:action noop)
  (:derived (light ?o) (forall (?y - block) (not (on ?y ?o))))
  (:functions (total-cost) - number (way ?x ?y - block) - number)
  (:predicates (on ?x - block ?y) (clear ?x - block) (light ?o) (dark) (pair ?x ?x - block))
  (:constants Home - place)
  (:types Block - thing lamp)
  (:requirements :ADL :derived-predicates :action-costs))";
    let shown = "\
(define (domain blocks-world)
  (:requirements :adl :derived-predicates :action-costs)
  (:types
    Block - thing
    lamp - object)
  (:constants home - place)
  (:predicates
    (on ?x - Block ?y - object)
    (clear ?x - Block)
    (light ?o - object)
    (dark)
    (pair ?x - Block ?x - Block))
  (:functions
    (total-cost) - number
    (way ?x - Block ?y - Block) - number)

  (:derived (light ?o - object)
    (forall (?y - Block) (not (on ?y ?o))))

  (:action stack
    :parameters (?x - Block ?y - Block)
    :precondition (and
      (not (= ?x ?y))
      (or (clear ?x) (light ?x))
      (imply (dark) (exists (?l - (either lamp Block)) (light ?l))))
    :effect (and
      (on ?x ?y)
      (not (clear ?y))
      (increase (total-cost) (way ?x ?y))
      (forall (?z - Block) (when (and (on ?x ?z) (not (= ?z ?y))) (not (on ?x ?z))))))

  (:action noop
    :parameters ()
    :precondition (and)
    :effect (and))
)
";
    let fixed = text.replace("(:constants Home - place)", "(:constants Home - thing)");
    let shown = shown.replace("home - place", "home - thing");
    assert_eq!(read(&fixed).to_string(), shown);
    assert_eq!(read(&shown), read(&fixed));
    assert_eq!(read(&fixed.replace('\n', "\r\n").replace("  ", "\t")), read(&fixed));
    let unknown = refused(text);
    assert_eq!(unknown.to_string(), "line 12, column 22: type `place` is not declared");
}

#[test]
fn deep_nesting_is_refused() {
    let nested = |depth: usize, inner: &str| format!("{}{inner}{}", "(not ".repeat(depth), ")".repeat(depth));
    read(&action(&format!(":precondition {}", nested(MOST_NESTED - 1, "(dark)"))));
    let deep = "nesting deeper than 250 is not supported";
    assert_eq!(bad_condition(&nested(MOST_NESTED, "(dark)")), deep);
    assert_eq!(bad_condition(&nested(100_000, "(dark)")), deep);
    let effect = format!("{}(dark){}", "(and ".repeat(100_000), ")".repeat(100_000));
    assert_eq!(bad_effect(&effect).message, deep);
}
