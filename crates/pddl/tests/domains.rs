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

/// Message, marked text, and hint.
#[track_caller]
fn told(text: &str) -> [String; 3] {
    let error = refused(text);
    [error.message, text[error.span.start..error.span.end].to_owned(), error.hint.unwrap_or_default()]
}

#[test]
fn odd_domains_are_read() {
    for text in [
        "(define (domain d))",
        "(define (domain d) (:requirements))",
        "(define (domain d) (:types) (:constants) (:predicates) (:functions))",
        "(define (domain d) (:types object a b - object))",
        "(define (domain d) (:types a - b) (:constants x - a y - b))",
        "(define (domain d) (:types a - b a - b))",
        "(define (domain d) (:types aircraft) (:predicates (p ?x ?x)) (:action p :parameters (?a - aircraft?b)))",
        "(define (domain d) (:predicates (= ?x ?y) (p)) (:action a :parameters () :precondition () :effect ()))",
        "(define (domain d) (:requirements :fluents) (:functions (total-cost)) (:action a :effect (increase (total-cost) 1)))",
        "(define (domain d) (:predicates (at ?x)) (:action a :parameters (?x) :precondition (at ?x) :effect (at ?x)))",
        "(define (domain d) (:predicates (p ?x)) (:action a :parameters (?x) :precondition (exists (?x) (p ?x))))",
    ] {
        read(text);
    }
    let domain = read("(define (domain d) (:types A - b B) (:predicates (p ?x - (either a B))))");
    assert_eq!(domain.to_string().lines().nth(1), Some("  (:types"));
    assert!(domain.to_string().contains("A - B\n    B - object)"), "{domain}");
    assert!(domain.to_string().contains("(p ?x - (either A B))"), "{domain}");
    // What a variable stands for may be of the right type.
    read(&action(":precondition (and (far ?x) (any ?o ?t) (on ?o ?o) (on ?x floor))"));
}

#[test]
fn conditions_that_are_wrong() {
    for (condition, message) in [
        ("(onn ?x ?y)", "predicate `onn` is not declared"),
        ("(on ?x)", "predicate `on` takes 2 arguments, here it has 1"),
        ("(on ?x ?y ?t)", "predicate `on` takes 2 arguments, here it has 3"),
        ("(far)", "predicate `far` takes 1 argument, here it has 0"),
        ("(held ?x)", "`?x` is of type `block`, predicate `held` takes `ball` here"),
        ("(on floor ?x)", "`floor` is of type `table`, predicate `on` takes `block` here"),
        ("(any ?z ?x)", "variable `?z` is not declared"),
        ("(any flor ?x)", "object `flor` is not declared"),
        ("(and (or (exists (?z) (dark)) (any ?z ?z)))", "variable `?z` is not declared"),
        ("(exists (?z - blok) (dark))", "type `blok` is not declared"),
        ("(exists (?z ?z) (dark))", "variable `?z` is declared twice"),
        ("(exists (z) (dark))", "a variable is expected here, not `z`"),
        ("(exists ?z (dark))", "a list of variables is expected here"),
        ("(exists (?z))", "`exists` takes a list of variables and one condition"),
        ("(forall (?z) (dark) (dark))", "`forall` takes a list of variables and one condition"),
        ("(not)", "`not` takes one condition"),
        ("(imply (dark))", "`imply` takes two conditions"),
        ("(= ?x)", "`=` takes two objects"),
        ("dark", "a condition is expected here, not `dark`"),
        ("(and dark)", "a condition is expected here, not `dark`"),
        ("((dark))", "a condition begins with a word, not with a list"),
        ("(and ())", "a condition is expected in here"),
        ("nil", "a condition is expected here, not `nil`"),
        ("(and) :precondition (and)", "there is a second `:precondition`"),
        ("(and) :effects (and)", "`:parameters`, `:precondition` or `:effect` is expected here"),
        ("(and) :effect", "nothing follows after `:effect`"),
    ] {
        assert_eq!(bad_condition(condition), message);
    }
}

#[test]
fn effects_that_are_wrong() {
    for (effect, message) in [
        ("(or (dark))", "`or` cannot be an effect here"),
        ("(not (not (dark)))", "`not` cannot be an effect here"),
        ("(= ?x ?y)", "`=` cannot be an effect here"),
        ("(and (drak))", "predicate `drak` is not declared"),
        ("(when (dark))", "`when` takes a condition and one effect"),
        ("(increase (total-cost) (wy ?x ?y))", "function `wy` is not declared"),
        ("(increase (total-cost) (way ?x ?t))", "`?t` is of type `table`, function `way` takes `block` here"),
        ("(increase (total-cost) much)", "a number is expected here, not `much`"),
        ("(increase (total-cost))", "`increase` takes `(total-cost)` and an amount"),
    ] {
        let error = bad_effect(effect);
        assert_eq!((error.message.as_str(), error.unsupported), (message, false));
    }
    let derived = with("(:derived (dark) (and))\n(:action a :effect (and (far floor) (not (dark))))");
    let derived = derived.replace("(far floor)", "(any floor floor)");
    assert_eq!(refused(&derived).message, "`dark` is a derived predicate, no action changes it");
}

#[test]
fn what_is_not_supported_is_named() {
    const NUMBERS: &str = "changes of numbers other than `(increase (total-cost) …)` are not supported";
    for (effect, message) in [
        ("(increase (gas ?x) 1)", NUMBERS),
        ("(decrease (gas ?x) 1)", NUMBERS),
        ("(assign (gas ?x) 1)", NUMBERS),
        ("(when (dark) (increase (total-cost) 1))", "costs that depend on a condition are not supported"),
        ("(forall (?z) (increase (total-cost) 1))", "costs that depend on a condition are not supported"),
        (
            "(and (increase (total-cost) 1) (increase (total-cost) 1))",
            "a second increase of the total cost is not supported",
        ),
        ("(increase (total-cost) 1.5)", "numbers that are not whole are not supported"),
        ("(increase (total-cost) -1)", "negative numbers are not supported"),
        ("(increase (total-cost) 99999999999)", "numbers above 4294967295 are not supported"),
        ("(increase (total-cost) (* 2 (gas ?x)))", "arithmetic with `*` is not supported"),
        ("(probabilistic 0.5 (dark))", "effects that happen with some probability are not supported"),
    ] {
        let error = bad_effect(effect);
        assert_eq!((error.message.as_str(), error.unsupported), (message, true), "{effect}");
    }
    for (text, message) in [
        (action(":precondition (> (gas ?x) 1)"), "comparisons of numbers are not supported"),
        (action(":precondition (= (gas ?x) 1)"), "comparisons of numbers are not supported"),
        (action(":precondition (preference p (dark))"), "preferences are not supported"),
        (action(":precondition (at start (dark))"), "conditions at a time are not supported"),
        (action(":duration (= ?duration 1)"), "`:duration` of an action is not supported"),
        (with("(:durative-action a)"), "`:durative-action` is not supported"),
        (
            format!("(define (domain d) (:predicates (p{})))", " ?x".repeat(257)),
            "a predicate with more than 256 arguments is not supported",
        ),
        (with("(:constraints (and))"), "`:constraints` is not supported"),
        (with("(:requirements :durative-actions)"), "requirement `:durative-actions` is not supported"),
        (with("(:requirements :strips :Preferences)"), "requirement `:preferences` is not supported"),
        (
            "(define (domain d) (:types t) (:functions (owner) - t))".to_owned(),
            "functions whose value is not a number are not supported",
        ),
        (
            "(define (domain d) (:constants a - (either b c)))".to_owned(),
            "an object has one type, not `either` of several",
        ),
    ] {
        let error = refused(&text);
        assert_eq!((error.message.as_str(), error.unsupported), (message, true), "{text}");
    }
}

#[test]
fn domains_that_are_wrong() {
    for (block, told_of) in [
        ("(:action)", ["this action has no name", "(:action)", ""]),
        ("(:acton a)", ["a domain has no block `:acton`", "(:acton a)", "Did you mean `:action`?"]),
        ("(:predicates (p))", ["there is a second `:predicates` block", "(:predicates (p))", ""]),
        ("(:action a)\n(:action A)", ["action `a` is declared twice", "A", ""]),
        ("(:requirements :stripes)", ["there is no requirement `:stripes`", ":stripes", "Did you mean `:strips`?"]),
        (
            "(:derived (gone) (and))",
            ["predicate `gone` is not declared", "gone", "Declare it in `(:predicates …)` of the domain."],
        ),
        (
            "(:derived (far ?x ?y) (and))",
            ["predicate `far` takes 1 argument, here it has 2", "(far ?x ?y)", "It is declared as `(far ?x - block)`."],
        ),
        ("(:action a :parameters (?x ?X))", ["variable `?x` is declared twice", "?X", ""]),
        (
            "(:action a :parameters (?x -ball))",
            ["a variable is expected here, not `-ball`", "-ball", "Write a space after `-`: `- ball`."],
        ),
        ("(:action a :parameters (? x))", ["there is no name after this `?`", "?", ""]),
        ("stray", ["a block such as `(:requirements …)` is expected here", "stray", ""]),
    ] {
        assert_eq!(told(&with(block)), told_of.map(str::to_owned), "{block}");
    }
    for (text, told_of) in [
        ("", ["there is nothing in this text", "", ""]),
        ("(:types a)", ["this is not a domain", "(:types a)", "A domain begins with `(define (domain NAME)`."]),
        (
            "(define (problem p))",
            ["this is a problem, not a domain", "(problem p)", "A domain begins with `(define (domain NAME)`."],
        ),
        ("(define (domain d) (:predicates (p) (q ?x) (P)))", ["predicate `p` is declared twice", "(P)", ""]),
        ("(define (domain d) (:constants a b A))", ["constant `a` is declared twice", "A", ""]),
        (
            "(define (domain d) (:constants a - t))",
            ["type `t` is not declared", "t", "Declare it in `(:types …)` of the domain."],
        ),
        (
            "(define (domain d) (:predicates p))",
            ["a predicate in parentheses is expected here", "p", "Write `(predicate ?x …)`."],
        ),
        (
            "(define (domain d) (:predicates (and ?x)))",
            ["`and` is a word of PDDL, not the name of a predicate", "(and ?x)", ""],
        ),
        (
            "(define (domain d) (:types a - b b - a))",
            ["the type hierarchy has a cycle: a - b - a", "b", "Take one of the declarations out."],
        ),
        ("(define (domain d) (:types a)", ["this `(` is never closed", "(", ""]),
    ] {
        assert_eq!(told(text), told_of.map(str::to_owned), "{text}");
    }
}

#[test]
fn declarations_are_shown() {
    let text = action(":precondition (and (far ?x)\n(on ?x))");
    let error = refused(&text);
    assert_eq!(
        error.render("d.pddl", &text),
        "d.pddl:7:1: predicate `on` takes 2 arguments, here it has 1\n  |\n3 | (:predicates (on ?x - block ?y - thing) (dark) (any ?x ?y) \
         (far ?x - block) (held ?b - ball))\n  |              -------------------------- declared here\n\
         7 | (on ?x))))\n  | ^^^^^^^\n"
    );
    assert_eq!(error.hint.as_deref(), Some("It is declared as `(on ?x - block ?y - thing)`."));
    let error = refused(&action(":precondition (held ?x)"));
    assert_eq!(error.hint.as_deref(), Some("Not every `block` is a `ball`. It is declared as `(held ?b - ball)`."));
    assert!(error.related.is_some());
}
