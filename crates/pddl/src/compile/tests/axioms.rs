//! Derived predicates.

use super::*;

#[test]
fn derived_predicates_become_axioms_with_strata() {
    let reach = or([equal("?p", "depot"), exists("q - place", and([is("reach ?q"), is("road ?q ?p")]))]);
    let all = forall("p - place", is("reach ?p"));
    let model = compiled(&with_derived(Vec::new(), vec![derived("ok", all), derived("reach p - place", reach)]));
    assert_eq!(
        axioms(&model),
        [
            "1 forall-ok-1() [p:place] not reach(?0)",
            "2 ok() [] not forall-ok-1()",
            "0 reach(depot) [] ",
            "0 reach(?0) [p:place q:place] reach(?1) & road(?1,?0)",
        ]
    );
}

#[test]
fn only_equal_conditions_share_a_predicate() {
    let all = |other: &str| forall("v - truck", and([is("clean ?v"), is(other)]));
    let conditions = and([all("at ?v depot"), all("wet"), all("clean ?v"), forall("v - boat", is("clean ?v"))]);
    let model = compiled(&domain(vec![action("go", "", conditions, add("wet"))]));
    assert_eq!(
        conjunction(&model.actions[0].preconditions),
        [1, 2, 3, 4].map(|i| format!("not forall-go-{i}()")).join(" & ")
    );
}

#[test]
fn a_derived_predicate_that_never_holds_is_still_derived() {
    let model = compiled(&with_derived(Vec::new(), vec![derived("reach p - place", or([]))]));
    assert_eq!(axioms(&model), ["0 reach(?0) [p:place] reach(?0)"]);
}

#[test]
fn cycles_through_negation_are_refused() {
    let two = vec![derived("ok", not(is("reach depot"))), derived("reach p - place", is("ok"))];
    let error = refused(&with_derived(Vec::new(), two));
    assert_eq!(error.to_string(), "derived predicate `ok`: `ok` depends on its own negation, through `reach`");
    assert!(!error.unsupported);
    let all = vec![derived("reach p - place", forall("q - place", is("reach ?q")))];
    let error = refused(&with_derived(Vec::new(), all));
    assert_eq!(
        error.to_string(),
        "derived predicate `reach`: `reach` depends on itself inside of a universal quantification"
    );
    assert!(error.unsupported);
}

#[test]
fn derived_predicates_are_not_changed_and_not_stated() {
    let ok = || vec![derived("ok", is("wet"))];
    let error = refused(&with_derived(vec![action("go", "", and([]), delete("ok"))], ok()));
    assert_eq!(error.to_string(), "action `go`: it changes `ok`, which is a derived predicate");
    let mut problem = problem(and([]));
    problem.init.push(typelift_model::Atom::new("ok", Vec::new()));
    let mut model = compiled(&with_derived(Vec::new(), ok()));
    let error = compile_problem(&problem, &mut model).expect_err("it is refused");
    assert_eq!(error.to_string(), "the initial state: ok() is stated, but `ok` is derived");
}
