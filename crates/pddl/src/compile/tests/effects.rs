//! Effects and costs.

use super::*;

#[test]
fn effects_are_flattened() {
    let nested = each("q - place", when(is("road ?p ?q"), both(add("at ?v ?q"), when(is("wet"), delete("clean ?v")))));
    assert_eq!(
        effects(both(nested, delete("at ?v ?p"))),
        ["not at(?0,?1)", "[q:place] road(?1,?2) > at(?0,?2)", "[q:place] road(?1,?2) & wet() > not clean(?0)",]
    );
}

#[test]
fn conditions_of_effects_are_brought_into_cases() {
    assert_eq!(
        effects(when(or([is("wet"), exists("u - truck", is("at ?u ?p"))]), add("ok"))),
        ["[u:truck] at(?2,?1) > ok()", "[] wet() > ok()"]
    );
    assert_eq!(effects(when(forall("u - truck", is("at ?u ?p")), add("ok"))), ["[] not forall-go-1(?1) > ok()"]);
    assert_eq!(effects(when(and([is("wet"), not(is("wet"))]), add("ok"))), [""; 0]);
    assert_eq!(effects(when(and([]), add("ok"))), ["ok()"]);
    // Without any boat, nothing happens.
    assert_eq!(effects(each("b - boat", add("ok"))), ["[b:boat]  > ok()"]);
}

#[test]
fn equalities_of_an_effect_are_solved_for_its_own_variables_only() {
    assert_eq!(effects(each("q - place", when(equal("?q", "?p"), add("at ?v ?q")))), ["at(?0,?1)"]);
    assert_eq!(effects(each("q - place", when(equal("depot", "?q"), add("at ?v ?q")))), ["at(?0,depot)"]);
    assert_eq!(
        effects(each("q - place", when(not(equal("?q", "?p")), delete("at ?v ?q")))),
        ["[q:place] not =(?1,?2) > not at(?0,?2)"]
    );
    assert_eq!(effects(when(equal("?p", "depot"), add("ok"))), ["[] =(?1,depot) > ok()"]);
    assert_eq!(effects(when(equal("?v", "depot"), add("ok"))), [""; 0]);
    let both_vans = and([equal("?t", "van"), not(equal("?u", "van")), equal("?t", "?u")]);
    assert_eq!(effects(each("t u - truck", when(both_vans, add("clean ?t")))), [""; 0]);
    // A truck that is the vehicle v: v may be something else.
    assert_eq!(
        effects(each("t - truck", when(equal("?t", "?v"), add("clean ?t")))),
        ["[t:truck] =(?0,?2) > clean(?2)"]
    );
}

#[test]
fn every_case_of_an_action_has_its_effects() {
    let precondition = or([equal("?v", "van"), exists("q - place", is("road ?q ?p"))]);
    let effect = each("r - place", when(not(equal("?v", "van")), add("at ?v ?r")));
    assert_eq!(
        actions(&compiled(&domain(vec![action("go", "v - vehicle p - place", precondition, effect)]))),
        [
            "go go(van,?0) [p:place]  => ",
            "go-2 go(?0,?1) [v:vehicle p:place q:place] road(?2,?1) => [r:place] not =(?0,van) > at(?0,?3)",
        ]
    );
}

#[test]
fn costs_are_sums() {
    let increase = |amount| PddlEffect::Increase(amount);
    let costly = both(
        both(increase(Amount::Number(2)), increase(Amount::Number(3))),
        increase(Amount::Function(atom("length ?p ?q"))),
    );
    let equal_places = or([is("wet"), equal("?p", "?q")]);
    let free = action("free", "", and([]), add("wet"));
    let mut model = compiled(&domain(vec![free.clone(), action("go", "p q - place", equal_places, costly)]));
    let cost = |a: &typelift_model::ActionSchema| format!("{} {:?}", a.cost.fixed, a.cost.functions);
    let costs: Vec<String> = model.actions.iter().map(cost).collect();
    assert_eq!(costs, ["0 []", "5 [length(?0,?1)]", "5 [length(?0,?0)]"]);

    let mut minimized = problem(and([]));
    minimized.minimizes_cost = true;
    let number = |name: &str, args: &[&str], value: u32| {
        (typelift_model::Atom::new(name, args.iter().map(|a| Symbol::new(a)).collect()), value)
    };
    minimized.values = vec![number("total-cost", &[], 0), number("length", &["depot", "home"], 4)];
    let task = compile_problem(&minimized, &mut model).expect("it compiles");
    assert_eq!(task.values, [number("length", &["depot", "home"], 4)].into());
    assert_eq!(model.actions[1].cost.fixed, 5);
    compile_problem(&problem(and([])), &mut model).expect("it compiles");
    assert!(model.actions.iter().all(|a| a.cost == typelift_model::Cost::UNIT));
    // What is declared and never increased is 0; where nothing is declared, steps are counted.
    let mut never_increased = domain(vec![free]);
    assert_eq!(compiled(&never_increased).actions[0].cost, typelift_model::Cost::from(0));
    never_increased.functions.clear();
    assert_eq!(compiled(&never_increased).actions[0].cost, typelift_model::Cost::UNIT);

    let conditional = when(is("wet"), increase(Amount::Number(1)));
    let error = refused(&domain(vec![action("go", "", and([]), conditional)]));
    assert_eq!(error.to_string(), "action `go`: its cost depends on the state, or on a choice");
}

#[test]
fn equalities_that_the_precondition_decides_are_not_asked_again() {
    let differ = not(equal("?p", "?q"));
    let effect = both(when(differ.clone(), add("ok")), when(equal("?q", "?p"), add("wet")));
    assert_eq!(
        actions(&compiled(&domain(vec![action("go", "p q - place", differ, effect)]))),
        ["go go(?0,?1) [p:place q:place]  ?0!=?1 => ok()"]
    );
}
