//! Goals and tasks.

use super::*;

#[test]
fn goals_keep_their_order() {
    let literals = and([is("wet"), not(is("clean t")), is("at t home"), is("wet")]);
    assert_eq!(goal(literals), ("wet() & at(t,home) & not clean(t)".to_owned(), Vec::new()));
}

#[test]
fn goals_are_written_out_for_the_objects() {
    assert_eq!(
        goal(forall("v - truck p - place", or([not(is("road ?p home")), is("at ?v ?p")]))).0,
        "at(t,depot) & at(van,depot)"
    );
    assert_eq!(goal(exists("p - place", and([is("road depot ?p"), is("at t ?p")]))).0, "at(t,home)");
    assert_eq!(goal(forall("v - truck|boat", not(equal("?v", "depot")))).0, "");
    assert_eq!(goal(is("road depot home")), (String::new(), Vec::new()));
    assert_eq!(goal(or([is("road home depot"), is("wet")])).0, "wet()");
}

#[test]
fn disjunctions_in_goals_become_derived_predicates() {
    let either = || or([and([is("wet"), not(is("clean t"))]), is("at t home")]);
    let (literals, axioms) = goal(and([either(), is("at b home"), either()]));
    assert_eq!(literals, "goal-1() & at(b,home)");
    assert_eq!(axioms, ["0 goal-1() [] not clean(t) & wet()", "0 goal-1() [] at(t,home)"]);
}

#[test]
fn a_goal_that_can_never_hold_is_an_atom_that_never_does() {
    for never in [
        or([]),
        and([is("wet"), not(is("wet"))]),
        and([is("wet"), or([is("road home home"), is("road depot depot")])]),
        exists("p - place", is("road ?p ?p")),
    ] {
        assert_eq!(goal(never), ("unsatisfiable-goal-1()".to_owned(), Vec::new()));
    }
}

#[test]
fn a_literal_that_never_changes_and_does_not_hold_stays() {
    assert_eq!(goal(and([is("road home home"), is("wet")])).0, "road(home,home) & wet()");
    assert_eq!(goal(not(is("road depot home"))).0, "not road(depot,home)");
}

#[test]
fn large_quantifications_of_a_goal_stay_quantified() {
    let mut model = compiled(&domain(vec![action("go", "v - vehicle p - place", and([]), add("at ?v ?p"))]));
    let mut large = problem(forall("p q r - place", or([is("at van ?p"), is("at van ?q"), is("at van ?r")])));
    large.objects = (0..60).map(|i| typed(&format!("p{i} - place")).remove(0)).collect();
    let task = compile_problem(&large, &mut model).expect("it compiles");
    assert_eq!(shown_goal(&task), "not forall-goal-1()");
    assert_eq!(
        axioms(&model),
        ["0 forall-goal-1() [p:place q:place r:place] not at(van,?0) & not at(van,?1) & not at(van,?2)"]
    );
    large.goal =
        forall("p q r - place", exists("s - place", or([is("at van ?p"), is("road ?q ?s"), equal("?q", "?r")])));
    let mut model = compiled(&domain(vec![action("go", "v - vehicle p - place", and([]), add("at ?v ?p"))]));
    compile_problem(&large, &mut model).expect("it compiles");
    assert_eq!(model.axioms.len(), 4);
}

#[test]
fn a_task_has_the_constants_and_the_objects() {
    let mut model = compiled(&domain(Vec::new()));
    let task = compile_problem(&problem(and([])), &mut model).expect("it compiles");
    let objects: Vec<&str> = task.init.objects.keys().map(Symbol::as_str).collect();
    assert_eq!(objects, ["b", "depot", "home", "t", "van"]);
    assert_eq!(task.init.atoms.len(), 1);
    let mut other = problem(and([]));
    other.objects = typed("van - boat");
    let error = compile_problem(&other, &mut model).expect_err("it is refused");
    assert_eq!(error.to_string(), "the objects: `van` is of the types `truck` and `boat`");
}
