//! The compiler's rules, one by one.

use typelift_model::{ActionModel, Literal, Parameter, Symbol, Task};

use super::limits::Limits;
use super::{CompileError, compile_domain, compile_problem, domain_within};
use crate::{Action, Amount, Derived, Domain, Formula, PddlAtom, PddlEffect, PddlTerm, Problem, Signature, Typed};

/// `x y - truck z - place|depot`: names with their types.
fn typed(text: &str) -> Vec<Typed> {
    let mut list: Vec<Typed> = Vec::new();
    let mut words = text.split_whitespace();
    while let Some(word) = words.next() {
        if word == "-" {
            let types: Vec<Symbol> = words.next().expect("a type").split('|').map(Symbol::new).collect();
            list.iter_mut().filter(|typed| typed.types.is_empty()).for_each(|typed| typed.types.clone_from(&types));
        } else {
            list.push(Typed { name: Symbol::new(word), types: Vec::new() });
        }
    }
    list.iter_mut().filter(|typed| typed.types.is_empty()).for_each(|typed| typed.types.push(Symbol::new("object")));
    list
}

fn term(word: &str) -> PddlTerm {
    match word.strip_prefix('?') {
        Some(name) => PddlTerm::Variable(Symbol::new(name)),
        None => PddlTerm::Object(Symbol::new(word)),
    }
}

/// `at ?x depot`.
fn atom(text: &str) -> PddlAtom {
    let mut words = text.split_whitespace();
    PddlAtom::new(words.next().expect("a predicate"), words.map(term).collect())
}

fn is(text: &str) -> Formula {
    Formula::Atom(atom(text))
}

fn equal(a: &str, b: &str) -> Formula {
    Formula::Equal(term(a), term(b))
}

fn not(formula: Formula) -> Formula {
    Formula::Not(Box::new(formula))
}

fn and<const N: usize>(parts: [Formula; N]) -> Formula {
    Formula::And(parts.into())
}

fn or<const N: usize>(parts: [Formula; N]) -> Formula {
    Formula::Or(parts.into())
}

fn exists(variables: &str, body: Formula) -> Formula {
    Formula::Exists(typed(variables), Box::new(body))
}

fn forall(variables: &str, body: Formula) -> Formula {
    Formula::Forall(typed(variables), Box::new(body))
}

fn add(text: &str) -> PddlEffect {
    PddlEffect::Add(atom(text))
}

fn delete(text: &str) -> PddlEffect {
    PddlEffect::Delete(atom(text))
}

fn when(condition: Formula, effect: PddlEffect) -> PddlEffect {
    PddlEffect::When(condition, Box::new(effect))
}

fn each(variables: &str, effect: PddlEffect) -> PddlEffect {
    PddlEffect::Forall(typed(variables), Box::new(effect))
}

fn both(a: PddlEffect, b: PddlEffect) -> PddlEffect {
    PddlEffect::And(vec![a, b])
}

fn signature(text: &str) -> Signature {
    let (name, parameters) = text.split_once(' ').unwrap_or((text, ""));
    Signature { name: Symbol::new(name), parameters: typed(parameters) }
}

fn action(name: &str, parameters: &str, precondition: Formula, effect: PddlEffect) -> Action {
    Action { name: Symbol::new(name), parameters: typed(parameters), precondition, effect, comment: Vec::new() }
}

fn derived(head: &str, condition: Formula) -> Derived {
    Derived { head: signature(head), condition, comment: Vec::new() }
}

/// Trucks and boats, which are vehicles, and places.
fn domain(actions: Vec<Action>) -> Domain {
    let types = [("vehicle", "object"), ("truck", "vehicle"), ("boat", "vehicle"), ("place", "object")];
    let predicates =
        ["at v - vehicle p - place", "road p q - place", "clean v - vehicle", "wet", "reach p - place", "ok"];
    Domain {
        types: types.map(|(child, parent)| (Symbol::new(child), Symbol::new(parent))).into(),
        constants: typed("depot - place van - truck"),
        predicates: predicates.map(signature).into(),
        functions: ["total-cost", "length p q - place"].map(signature).into(),
        actions,
        ..Domain::default()
    }
}

fn with_derived(actions: Vec<Action>, derived: Vec<Derived>) -> Domain {
    Domain { derived, ..domain(actions) }
}

fn problem(goal: Formula) -> Problem {
    Problem {
        name: Symbol::new("p"),
        domain: Symbol::new("d"),
        requirements: Vec::new(),
        objects: typed("t - truck b - boat home - place"),
        init: vec![typelift_model::Atom::new("road", vec![Symbol::new("depot"), Symbol::new("home")])],
        values: Vec::new(),
        goal,
        minimizes_cost: false,
        comment: Vec::new(),
    }
}

fn shown(parameters: &[Parameter], model: &ActionModel) -> String {
    let one = |p: &Parameter| format!("{}:{}", p.name, model.hierarchy.name(p.ty));
    parameters.iter().map(one).collect::<Vec<_>>().join(" ")
}

fn conjunction(literals: &[Literal]) -> String {
    literals.iter().map(ToString::to_string).collect::<Vec<_>>().join(" & ")
}

/// Each action on a line: `name call(args) [parameters] preconditions; distinct; effects`.
fn actions(model: &ActionModel) -> Vec<String> {
    let shown_action = |a: &typelift_model::ActionSchema| {
        let args = typelift_model::Atom::new(a.call.name.clone(), a.call.args.clone());
        let effects: Vec<String> = a.effects.iter().map(|e| shown_effect(e, model)).collect();
        let distinct: String = a.distinct.iter().map(|(i, j)| format!(" ?{i}!=?{j}")).collect();
        let parameters = shown(&a.parameters, model);
        format!(
            "{} {args} [{parameters}] {}{distinct} => {}",
            a.name,
            conjunction(&a.preconditions),
            effects.join(", ")
        )
    };
    model.actions.iter().map(shown_action).collect()
}

fn shown_effect(effect: &typelift_model::Effect, model: &ActionModel) -> String {
    let parameters = shown(&effect.parameters, model);
    match (parameters.is_empty(), effect.condition.is_empty()) {
        (true, true) => effect.literal.to_string(),
        _ => format!("[{parameters}] {} > {}", conjunction(&effect.condition), effect.literal),
    }
}

/// Each axiom on a line: `stratum head [parameters] body`.
fn axioms(model: &ActionModel) -> Vec<String> {
    let shown_axiom = |a: &typelift_model::Axiom| {
        format!("{} {} [{}] {}", a.stratum, a.head, shown(&a.parameters, model), conjunction(&a.body))
    };
    model.axioms.iter().map(shown_axiom).collect()
}

fn compiled(domain: &Domain) -> ActionModel {
    let model = compile_domain(domain).expect("it compiles");
    let read = ActionModel::from_json(&model.to_json().expect("it is written")).expect("it is read");
    assert_eq!(read, model);
    model
}

/// The actions that come from `go` with this precondition and the effect `wet`.
fn go(parameters: &str, precondition: Formula) -> Vec<String> {
    actions(&compiled(&domain(vec![action("go", parameters, precondition, add("wet"))])))
}

/// The effects of `go` on a vehicle v and a place p.
fn effects(effect: PddlEffect) -> Vec<String> {
    let model = compiled(&domain(vec![action("go", "v - vehicle p - place", and([]), effect)]));
    model.actions[0].effects.iter().map(|effect| shown_effect(effect, &model)).collect()
}

/// The goal's literals and its axioms.
fn goal(formula: Formula) -> (String, Vec<String>) {
    let mut model = compiled(&domain(vec![action(
        "go",
        "v - vehicle p - place",
        and([]),
        both(add("at ?v ?p"), both(delete("clean ?v"), add("wet"))),
    )]));
    let task = compile_problem(&problem(formula), &mut model).expect("it compiles");
    (shown_goal(&task), axioms(&model))
}

fn shown_goal(task: &Task) -> String {
    let one =
        |(atom, positive): (&typelift_model::GroundAtom, bool)| format!("{}{atom}", if positive { "" } else { "not " });
    task.goal_literals().map(one).collect::<Vec<_>>().join(" & ")
}

fn refused(domain: &Domain) -> CompileError {
    compile_domain(domain).expect_err("it is refused")
}

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
    assert_eq!(model.predicates.get("forall-go-1"), Some(&1));
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
    assert_eq!(compiled(&domain(vec![free])).actions[0].cost, typelift_model::Cost::UNIT);

    let conditional = when(is("wet"), increase(Amount::Number(1)));
    let error = refused(&domain(vec![action("go", "", and([]), conditional)]));
    assert_eq!(error.to_string(), "action `go`: its cost depends on the state, or on a choice");
}

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
    for never in [or([]), is("road home home"), and([is("wet"), not(is("wet"))]), exists("p - place", is("road ?p ?p"))]
    {
        assert_eq!(goal(never), ("goal-never-1()".to_owned(), Vec::new()));
    }
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
