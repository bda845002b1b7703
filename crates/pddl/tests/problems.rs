//! Problems: what is read, and what is refused where.

use typelift_pddl::{Domain, PddlError, Problem, misfits, read_domain, read_problem};

fn domain() -> Domain {
    read_domain(
        "(define (domain d) (:types block table - thing)
            (:constants floor - table)
            (:predicates (on ?x - block ?y - thing) (dark) (any ?x ?y) (above ?x ?y))
            (:functions (total-cost) (way ?x ?y - thing) - number)
            (:derived (above ?x ?y) (on ?x ?y)))",
    )
    .expect("a domain")
}

/// A problem with these blocks.
fn with(blocks: &str) -> String {
    format!("(define (problem P1) (:domain D)\n{blocks})")
}

/// A problem with objects, this in `:init`, and a goal.
fn init(items: &str) -> String {
    with(&format!("(:objects a B - block t - table)\n(:init {items})\n(:goal (dark))"))
}

fn goal(goal: &str) -> String {
    with(&format!("(:objects a b - block t - table) (:init)\n{goal}"))
}

#[track_caller]
fn read(text: &str) -> Problem {
    read_problem(text, &domain()).unwrap_or_else(|error| panic!("{}", error.render("p.pddl", text)))
}

#[track_caller]
fn refused(text: &str) -> PddlError {
    match read_problem(text, &domain()) {
        Err(error) => error,
        Ok(problem) => panic!("this was read: {text}\nas\n{problem}"),
    }
}

/// Message, marked text, and hint.
#[track_caller]
fn told(text: &str) -> [String; 3] {
    let error = refused(text);
    [error.message, text[error.span.start..error.span.end].to_owned(), error.hint.unwrap_or_default()]
}

#[test]
fn a_problem_in_any_order_and_case() {
    let text = "(DEFINE (Problem P1)\r\n\t(:METRIC Minimize (TOTAL-COST))
  (:goal (and (above a b) (not (on b FLOOR))))
  (:init (on A b) (on b t) (not (on b a)) (on a b) (= (total-cost) 0) (= (way a t) 3) (= (way a t) 3))
  (:objects a B - Block t - table) (:length (:serial 3)) (:domain D) (:requirements :strips))";
    let shown = "\
(define (problem p1)
  (:domain d)
  (:requirements :strips)
  (:objects
    a b - block
    t - table)
  (:init
    (on a b)
    (on b t)
    (= (total-cost) 0)
    (= (way a t) 3))
  (:goal (and
    (above a b)
    (not (on b floor))))
  (:metric minimize (total-cost))
)
";
    assert_eq!(read(text).to_string(), shown);
    assert_eq!(read(shown), read(text));
}

#[test]
fn odd_problems_are_read() {
    for text in [
        with("(:init) (:goal (and))"),
        with("(:objects) (:init) (:goal (or))"),
        // A constant of the domain, again.
        with("(:objects floor - table a) (:init (any floor a)) (:goal (exists (?x - block) (on ?x floor)))"),
    ] {
        read(&text);
    }
    let again = read(&with("(:objects floor - table a) (:init) (:goal (and))"));
    assert_eq!(again.objects.len(), 1);
}

#[test]
fn problems_that_are_wrong() {
    for (text, told_of) in [
        (
            "(define (problem p))",
            [
                "this problem does not say to which domain it belongs",
                "(problem p)",
                "Write `(:domain NAME)`, with the name of its domain.",
            ],
        ),
        (
            "(define (problem p) (:domain))",
            ["exactly one name is expected here", "(:domain)", "Write `(:domain NAME)`, with the name of its domain."],
        ),
        (
            "(define (problem p) (:domain e))",
            [
                "this problem belongs to the domain `e`, not to `d`",
                "e",
                "Read it with its own domain, or correct the name.",
            ],
        ),
        (
            "(define (domain d))",
            ["this is a domain, not a problem", "(domain d)", "A problem begins with `(define (problem NAME)`."],
        ),
        ("", ["there is nothing in this text", "", ""]),
        ("(define (problem p)", ["this `(` is never closed", "(", ""]),
        (
            "(define (problem p) (:domain d) (:goal (and)))",
            ["this problem has no `:init`", "(problem p)", "Write `(:init)` if nothing holds initially."],
        ),
        (
            "(define (problem p) (:domain d) (:init))",
            ["this problem has no `:goal`", "(problem p)", "Write `(:goal (and))` for a goal that always holds."],
        ),
        (
            "(define (problem p) (:domain d) (:objets a))",
            ["a problem has no block `:objets`", "(:objets a)", "Did you mean `:objects`?"],
        ),
        ("(define (problem p) (:domain d) (:objects a b A))", ["object `a` is declared twice", "A", ""]),
        (
            "(define (problem p) (:domain d) (:objects a - blok))",
            ["type `blok` is not declared", "blok", "Did you mean `block`?"],
        ),
        (
            "(define (problem p) (:domain d) (:objects floor - block))",
            [
                "`floor` is a constant of the domain, of type `table`",
                "floor",
                "Take it out of the objects, or give it another name.",
            ],
        ),
    ] {
        assert_eq!(told(text), told_of.map(str::to_owned), "{text}");
    }
}

#[test]
fn what_a_problem_says_of_objects_of_other_types_is_read() {
    let problem = read(
        "(define (problem p) (:domain d) (:objects a b - block t - table) (:init (on t a) (on a t))
         (:goal (and (above a b) (forall (?x - block) (imply (on ?x b) (not (on t b)))))))",
    );
    let found: Vec<String> = misfits(&problem, &domain()).iter().map(ToString::to_string).collect();
    assert_eq!(found, ["on(t,a)", "on(t,b)"]);
    let variable = told("(define (problem p) (:domain d) (:init) (:goal (exists (?x - table ?y - block) (on ?x ?y))))");
    assert_eq!(variable[0], "`?x` is of type `table`, predicate `on` takes `block` here", "it can never be");
}

#[test]
fn initial_states_that_are_wrong() {
    for (items, told_of) in [
        ("(onn a b)", ["predicate `onn` is not declared", "onn", "Did you mean `on`?"]),
        (
            "(on a)",
            [
                "predicate `on` takes 2 arguments, here it has 1",
                "(on a)",
                "It is declared as `(on ?x - block ?y - thing)`.",
            ],
        ),
        (
            "(on a c)",
            [
                "object `c` is not declared",
                "c",
                "Declare it in `(:objects …)` of the problem or in `(:constants …)` of the domain.",
            ],
        ),
        ("(on a ?b)", ["variable `?b` stands where only objects may", "?b", ""]),
        (
            "(and (dark))",
            ["`and` cannot stand in `:init`", "(and (dark))", "List each atom that holds, without `and`."],
        ),
        (
            "dark",
            ["an atom `(predicate object …)` is expected here, not `dark`", "dark", "Each atom stands in parentheses."],
        ),
        ("()", ["a predicate in parentheses is expected here", "()", ""]),
        ("(not (dark)) (dark)", ["`dark()` is said both to hold and not to hold", "(dark)", ""]),
        (
            "(above a b)",
            [
                "`above` is a derived predicate, it cannot stand in `:init`",
                "(above a b)",
                "List what it is derived from.",
            ],
        ),
        ("(= (way a t) 3) (= (way a t) 4)", ["`way(a,t)` has two values, 3 and 4", "(= (way a t) 4)", ""]),
        ("(= (wy a t) 3)", ["function `wy` is not declared", "wy", "Did you mean `way`?"]),
        ("(= total-cost 0)", ["a function in parentheses is expected here", "total-cost", ""]),
        ("(= (total-cost) x)", ["a number is expected here, not `x`", "x", ""]),
    ] {
        assert_eq!(told(&init(items)), told_of.map(str::to_owned), "{items}");
    }
    let twice = refused(&init("(dark) (not (dark))"));
    assert!(twice.related.is_some());
}

#[test]
fn goals_that_are_wrong() {
    const HINT: &str = "Write `(:goal (and))` for a goal that always holds.";
    for (text, told_of) in [
        ("(:goal)", ["the goal is empty", "(:goal)", HINT]),
        ("(:goal ())", ["the goal is empty", "()", HINT]),
        (
            "(:goal (on a c))",
            [
                "object `c` is not declared",
                "c",
                "Declare it in `(:objects …)` of the problem or in `(:constants …)` of the domain.",
            ],
        ),
        (
            "(:goal (on a b) (dark))",
            ["there is a second condition in this goal", "(dark)", "Join several with `and …`."],
        ),
        (
            "(:goal (on ?x b))",
            ["variable `?x` is not declared", "?x", "Add it to the parameters, or to those of a quantifier."],
        ),
    ] {
        assert_eq!(told(&goal(text)), told_of.map(|part| part.replace("`and …`", "`(and …)`")), "{text}");
    }
}

#[test]
fn what_is_not_supported_is_named() {
    for (text, message) in [
        (init("(at 5 (dark))"), "literals that hold from a time on are not supported"),
        (init("(= (total-cost) 0.5)"), "numbers that are not whole are not supported"),
        (init("(= (total-cost) -2)"), "negative numbers are not supported"),
        (init("(= (way a t) b)"), "values other than numbers are not supported"),
        (with("(:objects a - (either block table))"), "an object has one type, not `either` of several"),
        (with("(:requirements :timed-initial-literals)"), "requirement `:timed-initial-literals` is not supported"),
        (with("(:constraints (and))"), "`:constraints` is not supported"),
        (goal("(:goal (preference p (dark)))"), "preferences are not supported"),
        (goal("(:goal (>= (total-cost) 3))"), "comparisons of numbers are not supported"),
        (
            goal("(:goal (dark)) (:metric minimize (total-time))"),
            "metrics other than `minimize (total-cost)` are not supported",
        ),
        (
            goal("(:goal (dark)) (:metric maximize (total-cost))"),
            "metrics other than `minimize (total-cost)` are not supported",
        ),
    ] {
        let error = refused(&text);
        assert_eq!((error.message.as_str(), error.unsupported), (message, true), "{text}");
    }
}

#[test]
fn the_function_of_a_metric_is_declared() {
    let domain = read_domain("(define (domain d) (:predicates (p)) (:action a :effect (p)))").expect("a domain");
    let text = "(define (problem q) (:domain d) (:init) (:goal (p)) (:metric minimize (total-cost)))";
    let error = read_problem(text, &domain).expect_err("an error");
    assert_eq!(error.to_string(), "line 1, column 71: function `total-cost` is not declared");
}

#[test]
fn a_whole_number_may_have_a_fraction_of_zeros() {
    let domain = "(define (domain d) (:predicates (p)) (:functions (total-cost) (toll)) (:action a :effect (p)))";
    let domain = read_domain(domain).expect("a domain");
    let text = "(define (problem q) (:domain d) (:init (= (toll) 10.0)) (:goal (p)))";
    let values = read_problem(text, &domain).expect("a problem").values;
    assert_eq!(values.iter().map(|(_, value)| *value).collect::<Vec<_>>(), [10]);
}

#[test]
fn deep_nesting_is_refused() {
    let deep = format!("{}(dark){}", "(not ".repeat(100_000), ")".repeat(100_000));
    assert_eq!(refused(&goal(&format!("(:goal {deep})"))).message, "nesting deeper than 250 is not supported");
    assert!(refused(&init(&deep)).message.starts_with("predicate `not`"));
}

/// About ten million characters: a second or less, optimised.
#[test]
fn a_large_problem_is_read() {
    use std::fmt::Write;
    let objects: String = (0..5000).fold(String::new(), |mut text, i| {
        let _ = write!(text, " Object-{i}");
        text
    });
    let atoms: String = (0..400_000).fold(String::new(), |mut text, i| {
        let _ = writeln!(text, "(on object-{} object-{})", i / 80, i * 7 % 5000);
        text
    });
    let text = with(&format!("(:objects{objects} - block)\n(:init {atoms})\n(:goal (and (dark)))"));
    let problem = read(&text);
    assert_eq!((problem.objects.len(), problem.init.len()), (5000, 400_000));
}
