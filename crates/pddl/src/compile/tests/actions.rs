//! Preconditions, parameters and names.

use super::*;

#[test]
fn literals_are_sorted_and_each_is_there_once() {
    let conditions = and([is("wet"), not(not(is("at ?v depot"))), and([is("wet"), not(is("clean ?v"))])]);
    assert_eq!(go("v - truck", conditions), ["go go(?0) [v:truck] at(?0,depot) & not clean(?0) & wet() => wet()"]);
}

#[test]
fn a_case_that_contradicts_itself_is_dropped() {
    assert_eq!(go("v - truck", and([is("wet"), not(is("wet"))])), [""; 0]);
    assert_eq!(go("", or([is("ok"), and([is("wet"), not(is("wet"))])])), ["go go() [] ok() => wet()"]);
    assert_eq!(go("", or([])), [""; 0]);
}

#[test]
fn a_disjunction_makes_several_actions_of_one_call() {
    let mut domain = domain(vec![
        action("go", "v - truck", or([is("wet"), not(is("ok")), is("wet")]), add("ok")),
        action("go-2", "", and([]), add("ok")),
    ]);
    domain.actions[0].precondition = Formula::Imply(Box::new(is("ok")), Box::new(is("wet")));
    assert_eq!(
        actions(&compiled(&domain)),
        ["go go(?0) [v:truck] not ok() => ok()", "go-2 go-2() []  => ok()", "go-3 go(?0) [v:truck] wet() => ok()"]
    );
}

#[test]
fn what_exists_becomes_a_parameter_that_the_call_does_not_mention() {
    assert_eq!(
        go("v - truck", exists("p - place", is("at ?v ?p"))),
        ["go go(?0) [v:truck p:place] at(?0,?1) => wet()"]
    );
    // A quantified variable hides another one of its name.
    assert_eq!(
        go("v - truck", and([is("clean ?v"), exists("v - boat", is("clean ?v"))])),
        ["go go(?0) [v:truck v-2:boat] clean(?0) & clean(?1) => wet()"]
    );
}

#[test]
fn what_holds_for_all_becomes_the_negation_of_an_exception() {
    let condition = |place: &str| forall("u - truck", or([not(is(&format!("at ?u {place}"))), is("clean ?u")]));
    let model = compiled(&domain(vec![
        action("go", "q - place", condition("?q"), add("wet")),
        action("same", "p - place", condition("?p"), add("wet")),
    ]));
    assert_eq!(
        actions(&model),
        ["go go(?0) [q:place] not forall-go-1(?0) => wet()", "same same(?0) [p:place] not forall-go-1(?0) => wet()"]
    );
    assert_eq!(axioms(&model), ["0 forall-go-1(?0) [q:place u:truck] at(?1,?0) & not clean(?1)"]);
    assert_eq!(model.predicates.get("forall-go-1"), Some(&vec![model.hierarchy.id("place").expect("a type")]));
    assert_eq!(go("", forall("v - truck", and([]))), ["go go() []  => wet()"]);
    assert_eq!(go("", forall("v - truck", or([]))), ["go go() [] not forall-go-1() => wet()"]);
}

#[test]
fn equal_parameters_become_one_of_the_more_specific_type() {
    assert_eq!(
        go("v - vehicle t - truck", and([equal("?v", "?t"), is("clean ?v")])),
        ["go go(?0,?0) [v:truck] clean(?0) => wet()"]
    );
    assert_eq!(go("b - boat t - truck", equal("?b", "?t")), [""; 0]);
    assert_eq!(go("v - vehicle", and([equal("?v", "van"), is("clean ?v")])), ["go go(van) [] clean(van) => wet()"]);
    assert_eq!(go("b - boat", equal("van", "?b")), [""; 0]);
    assert_eq!(go("", equal("van", "depot")), [""; 0]);
    assert_eq!(
        go("p - place", exists("q - place", and([equal("?q", "?p"), is("road ?q depot")]))),
        ["go go(?0) [p:place] road(?0,depot) => wet()"]
    );
}

#[test]
fn parameters_that_differ_are_listed() {
    let differ = |a: &str, b: &str| not(equal(a, b));
    let three = and([differ("?r", "?p"), differ("?p", "?q"), differ("?q", "?p")]);
    assert_eq!(go("p q r - place", three), ["go go(?0,?1,?2) [p:place q:place r:place]  ?0!=?1 ?0!=?2 => wet()"]);
    assert_eq!(go("p - place", differ("depot", "?p")), ["go go(?0) [p:place] not =(?0,depot) => wet()"]);
    assert_eq!(go("b - boat t - truck", differ("?b", "?t")), ["go go(?0,?1) [b:boat t:truck]  => wet()"]);
    assert_eq!(go("b - boat", differ("?b", "van")), ["go go(?0) [b:boat]  => wet()"]);
    assert_eq!(go("p q - place", and([equal("?p", "?q"), differ("?p", "?q")])), [""; 0]);
}

#[test]
fn alternative_types_make_several_actions() {
    assert_eq!(
        go("v - truck|boat|truck", is("clean ?v")),
        ["go go(?0) [v:truck] clean(?0) => wet()", "go-2 go(?0) [v:boat] clean(?0) => wet()"]
    );
    assert_eq!(go("v - truck|vehicle", is("clean ?v")), ["go go(?0) [v:vehicle] clean(?0) => wet()"]);
    assert_eq!(go("v - truck|boat t - truck", equal("?v", "?t")), ["go go(?0,?0) [v:truck]  => wet()"]);
}

#[test]
fn too_many_cases_become_derived_predicates() {
    let pair = |i: usize| or([is(&format!("a{i}")), is(&format!("b{i}"))]);
    let mut domain = domain(vec![action("go", "", Formula::And((0..7).map(pair).collect()), add("wet"))]);
    domain.predicates.extend((0..7).flat_map(|i| [signature(&format!("a{i}")), signature(&format!("b{i}"))]));
    let model = compiled(&domain);
    assert_eq!(model.actions.len(), 64);
    assert_eq!(axioms(&model), ["0 or-go-1() [] a6()", "0 or-go-1() [] b6()"]);
    assert_eq!(conjunction(&model.actions[0].preconditions), "a0() & a1() & a2() & a3() & a4() & a5() & or-go-1()");

    domain.actions[0].precondition = Formula::Or((0..7).map(|i| is(&format!("a{i}"))).collect());
    let model = domain_within(&domain, Limits { cases: 6, ..Limits::default() }).expect("it compiles");
    assert_eq!(actions(&model), ["go go() [] or-go-1() => wet()"]);
    assert_eq!(model.axioms.len(), 7);
}

#[test]
fn too_many_combinations_of_types_are_refused() {
    let names: Vec<String> = (0..10).map(|i| format!("v{i}")).collect();
    let error = refused(&domain(vec![action("go", &format!("{} - truck|boat", names.join(" ")), and([]), add("wet"))]));
    assert_eq!(error.to_string(), "action `go`: the types of its variables can be combined in more than 1000 ways");
    assert!(error.unsupported);
}

#[test]
fn a_model_that_would_be_too_large_is_refused() {
    let limits = Limits { literals: 1_000, ..Limits::default() };
    let error = |action| domain_within(&domain(vec![action]), limits).expect_err("too large");
    // Nine schemas of nine ways each to have an effect, for each of fifty effects.
    let typed = "v w - truck|boat|place";
    let effect = PddlEffect::And((0..50).map(|_| each("x y - truck|boat|place", add("wet"))).collect());
    let large = error(action("go", typed, and([]), effect));
    assert_eq!(
        large.to_string(),
        "action `go`: with it, the domain has more than 1000 literals when all cases are written out"
    );
    assert!(large.unsupported);
    // Nine axioms for each of fifty cases.
    let ways = (0..50).map(|_| exists("x y - truck|boat|place", not(is("clean ?x"))));
    let condition = Formula::Or(ways.collect());
    assert!(error(action("go", "", forall("z - truck", condition), add("wet"))).unsupported);
}

#[test]
fn new_names_are_new() {
    let condition = forall("v - truck", is("clean ?v"));
    let mut domain =
        domain(vec![action("go", "", or([condition, is("wet")]), add("wet")), action("go-2", "", and([]), add("wet"))]);
    domain.predicates.push(signature("forall-go-1"));
    domain.functions.push(signature("forall-go-2"));
    let model = compiled(&domain);
    let names: Vec<&str> = model.actions.iter().map(|a| a.name.as_str()).collect();
    assert_eq!(names, ["go", "go-2", "go-3"]);
    assert!(model.predicates.contains_key("forall-go-3"));
}

#[test]
fn what_is_not_declared_is_an_error() {
    let refused_go = |parameters: &str, formula| refused(&domain(vec![action("go", parameters, formula, add("wet"))]));
    for (error, message) in [
        (refused_go("", is("fly")), "action `go`: there is no predicate `fly`"),
        (refused_go("", is("wet van")), "action `go`: wet(van) has 1 arguments, its predicate takes 0"),
        (refused_go("", is("clean ?v")), "action `go`: there is no variable `?v`"),
        (refused_go("", is("clean car")), "action `go`: there is no object `car`"),
        (
            refused(&domain(vec![action("go", "", and([]), add("wet")), action("go", "", and([]), add("ok"))])),
            "action `go`: there is another action of this name",
        ),
        (
            refused(&Domain { constants: typed("a - truck|boat"), ..domain(Vec::new()) }),
            "the constants: `a` is `either` of several types",
        ),
        (refused_go("x - car", is("wet")), "action `go`: there is no type `car`"),
        (
            refused(&Domain { constants: typed("a - car"), ..domain(Vec::new()) }),
            "the constants: there is no type `car`",
        ),
        (
            refused(&Domain { predicates: Vec::new(), ..with_derived(Vec::new(), vec![derived("ok", and([]))]) }),
            "derived predicate `ok`: no predicate of this name and number of arguments is declared",
        ),
        (
            refused(&Domain { types: vec![(Symbol::new("a"), Symbol::new("a"))], ..domain(Vec::new()) }),
            "the types: the type hierarchy has a cycle: a - a",
        ),
    ] {
        assert_eq!(error.to_string(), message);
    }
}

#[test]
fn deep_nesting_costs_neither_stack_nor_blow_up() {
    let part = |i: usize| or([is("ok"), is(if i.is_multiple_of(2) { "wet" } else { "clean van" })]);
    let level = |inner: Formula, i: usize| match i % 4 {
        0 => or([inner, and([part(i), part(i + 1)])]),
        1 => and([inner, part(i)]),
        2 => exists("v - truck", and([is("clean ?v"), not(inner)])),
        _ => forall("p - place", or([is("at van ?p"), inner])),
    };
    let deep = (0..crate::MOST_NESTED / 2).fold(is("wet"), level);
    let effect = (0..crate::MOST_NESTED).fold(add("wet"), |inner, i| match i % 3 {
        0 => when(part(i), inner),
        1 => both(inner, delete("clean van")),
        _ if i < 60 => each("v - truck", inner),
        _ => inner,
    });
    let model = compiled(&domain(vec![action("go", "", deep, effect)]));
    assert!(model.actions.len() < 70 && model.axioms.len() < 2_000, "{} axioms", model.axioms.len());
}
