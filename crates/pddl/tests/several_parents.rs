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
