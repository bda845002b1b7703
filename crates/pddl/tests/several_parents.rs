//! Types with several parents: other planners, which know one parent a type, get a tree and static predicates.

use typelift_pddl::{ExportOptions, Level, compile_domain, compile_problem, export, read_domain, read_problem};

const DOMAIN: &str = "(define (domain kitchen) (:requirements :adl)
 (:types tool weapon - object knife - (either tool weapon) sword - weapon hammer - tool)
 (:predicates (clean ?t - tool) (sharp ?w - weapon) (ready ?x))
 (:action wash :parameters (?t - tool) :effect (clean ?t))
 (:action whet :parameters (?w - weapon) :effect (and (sharp ?w)
   (forall (?other - weapon) (when (not (= ?other ?w)) (ready ?other))))))";

const PROBLEM: &str = "(define (problem two) (:domain kitchen)
 (:objects k - knife s - sword h - hammer) (:init) (:goal (and (clean k) (sharp k) (ready s))))";

#[test]
fn other_planners_get_a_tree_and_static_predicates() {
    let domain = read_domain(DOMAIN).expect("a domain");
    let problem = read_problem(PROBLEM, &domain).expect("a problem");
    let mut model = compile_domain(&domain).expect("a model");
    let task = compile_problem(&problem, &mut model).expect("a task");
    let options = ExportOptions { domain: "d".into(), problem: "p".into(), level: Level::Adl };
    let exported = export(&model, Some(&task), &options).expect("in PDDL");
    let (domain, problem) = (exported.domain.to_string(), exported.problem.expect("a problem").to_string());
    for line in [
        "(:types tool weapon - object knife hammer - tool sword - weapon)",
        "(is-weapon ?a0 - object)",
        "(:action wash",
        ":parameters (?t - tool)",
        ":parameters (?w - object)",
        "(is-weapon ?w)",
        "(forall (?other)",
        "(is-weapon ?other)",
    ] {
        let squeezed: Vec<&str> = domain.split_whitespace().collect();
        assert!(squeezed.join(" ").contains(line), "{line}:\n{domain}");
    }
    assert!(problem.contains("(is-weapon k)") && problem.contains("(is-weapon s)"), "{problem}");
    assert!(!problem.contains("(is-weapon h)") && !domain.contains("is-tool"), "{problem}{domain}");
    // What is written reads as the same: the knife is both, the sword is no tool.
    let again = read_domain(&domain).expect("a domain");
    let mut model = compile_domain(&again).expect("a model");
    assert!(model.hierarchy.is_tree());
    compile_problem(&read_problem(&problem, &again).expect("a problem"), &mut model).expect("a task");
}

/// As [`DOMAIN`], where the knife is the only kind of both, with an action more.
fn with_action(action: &str) -> Result<typelift_pddl::Domain, String> {
    let end = DOMAIN.rfind(')').expect("a domain");
    read_domain(&format!("{} {action})", &DOMAIN[..end])).map_err(|error| error.to_string())
}

#[test]
fn what_may_be_of_both_kinds_may_stand_for_either() {
    let both = "(:action hone :parameters (?t - tool) :precondition (clean ?t) :effect (sharp ?t))";
    let domain = with_action(both).expect("a knife is a tool and a weapon");
    let problem = read_problem(PROBLEM, &domain).expect("a problem");
    let mut model = compile_domain(&domain).expect("a model");
    compile_problem(&problem, &mut model).expect("a task");
    let neither = with_action("(:action hone :parameters (?t - hammer) :precondition (sharp ?t) :effect (clean ?t))");
    assert!(neither.is_err_and(|error| error.contains("`?t` is of type `hammer`, predicate `sharp` takes `weapon`")));
}

#[test]
fn a_tool_and_a_weapon_may_be_one_and_the_same() {
    let equal = "(:action use :parameters (?t - tool ?w - weapon) :precondition (= ?t ?w) :effect (ready ?w))";
    let model = compile_domain(&with_action(equal).expect("a domain")).expect("a model");
    assert!(model.actions.iter().any(|action| action.call.name == *"use"), "the knife is both");
    let never = equal.replace("?t - tool", "?t - hammer");
    let model = compile_domain(&with_action(&never).expect("a domain")).expect("a model");
    assert!(!model.actions.iter().any(|action| action.call.name == *"use"), "no hammer is a weapon");
}

#[test]
fn types_in_any_order_and_spelling_mean_the_same() {
    let parents = |types: &str| {
        let domain = read_domain(&format!("(define (domain d) (:types {types}))")).expect(types);
        let mut edges: Vec<String> =
            domain.types.iter().map(|(child, parent)| format!("{child}<{parent}").to_lowercase()).collect();
        edges.sort();
        edges
    };
    let both = parents("tool weapon - object knife - tool knife - weapon dagger - knife");
    for types in [
        "dagger - knife knife - weapon knife - tool weapon tool - object",
        "tool weapon - object knife - (either weapon tool) dagger - knife",
        "tool weapon - OBJECT Knife - (EITHER tool Weapon) KNIFE - tool dagger - knife",
        "knife - (either tool weapon) tool weapon - object dagger - knife dagger - knife",
    ] {
        let found: Vec<String> = parents(types);
        assert_eq!(found, both, "{types}");
    }
}
