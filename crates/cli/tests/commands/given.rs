//! PDDL domains and problems where models and tasks are read.

use crate::common::Folder;

/// Roads with lengths, and a tour of them.
pub(crate) const ROADS: &str = include_str!("../../../../examples/roads/domain.pddl");

pub(crate) const TOUR: &str = include_str!("../../../../examples/roads/tour.pddl");

pub(crate) fn roads() -> Folder {
    let folder = Folder::new();
    folder.write("domain.pddl", ROADS);
    folder.write("tour.pddl", TOUR);
    folder
}

#[test]
fn a_problem_is_planned_and_the_plan_is_valid() {
    let folder = roads();
    insta::assert_snapshot!("pddl-plan", folder.run("plan domain.pddl tour.pddl"));
    insta::assert_snapshot!("pddl-plan-file", folder.read("sas_plan"));
    insta::assert_snapshot!("pddl-validate", folder.run("validate domain.pddl tour.pddl sas_plan"));
    folder.run("plan domain.pddl tour.pddl --better -o best").succeeds();
    assert_eq!(folder.names(), ["best", "best.1", "domain.pddl", "sas_plan", "tour.pddl"]);
}

#[test]
fn a_domain_is_shown_as_a_model() {
    let folder = roads();
    insta::assert_snapshot!("pddl-show", folder.run("show domain.pddl"));
    insta::assert_snapshot!("pddl-show-pddl", folder.run("show domain.pddl --pddl"));
}

#[test]
fn a_domain_serves_a_task_file_too() {
    let folder = roads();
    let state =
        r#"{"objects":{"v":"van","home":"garage","inn":"place"},"atoms":["at(v,home)","road(home,inn)","fuel(v)"]}"#;
    folder.write("task.json", format!(r#"{{"format":"task/1","goal":["fuel(v)"],"state":{state}}}"#));
    let plan = folder.run("plan domain.pddl task.json -o p");
    plan.succeeds();
    assert_eq!(plan.out, "");
    assert!(plan.err.contains("the goal holds already: nothing is to be done\n"), "{plan}");
}

#[test]
fn what_cannot_be_planned_says_why() {
    let folder = roads();
    let cases = [
        ("lasting", TOUR.replace("(not (fuel v))", "(not (road home inn))")),
        ("unreachable", TOUR.replace("(not (fuel v))", "(at v mill) (friend mill)")),
        ("never", TOUR.replace("(not (fuel v))", "(and (fuel v) (not (fuel v)))")),
    ];
    for (name, problem) in cases {
        folder.write("none.pddl", problem);
        insta::assert_snapshot!(format!("pddl-no-plan-{name}"), folder.run("plan domain.pddl none.pddl"));
    }
    assert_eq!(folder.names(), ["domain.pddl", "none.pddl", "tour.pddl"]);
}

#[test]
fn files_that_do_not_fit_together_are_refused() {
    let folder = Folder::kitchen();
    folder.write("domain.pddl", ROADS);
    folder.write("tour.pddl", TOUR);
    folder.write("other.pddl", TOUR.replace("(:domain roads)", "(:domain rails)"));
    folder.write("timed.pddl", ROADS.replace(":action fill-up", ":durative-action fill-up"));
    let mut all = String::new();
    for (code, command) in [
        (31, "plan kitchen.json tour.pddl"),
        (31, "plan domain.pddl other.pddl"),
        (31, "plan tour.pddl domain.pddl"),
        (31, "plan domain.pddl domain.pddl"),
        (31, "plan domain.pddl K/tasks/T1.1.json"),
        (31, "plan domain.pddl tour.pddl --types K/types.pddl"),
        (34, "plan timed.pddl tour.pddl"),
    ] {
        all.push_str(&format!("$ typelift {command}\n{}\n", folder.refuses(code, command).err));
    }
    insta::assert_snapshot!("pddl-misfits", all);
}

#[test]
fn a_rule_that_contradicts_itself_is_shown_never_to_hold() {
    let folder = Folder::new();
    let rules = "(:derived (odd ?c - cup) (and (full ?c) (not (full ?c)))) (:derived (even ?c - cup) (full ?c))";
    let domain = format!(
        "(define (domain cups) (:types cup) (:predicates (full ?c - cup) (odd ?c - cup) (even ?c - cup)) {rules})"
    );
    folder.write("cups.pddl", domain);
    let shown = folder.run("show cups.pddl").out;
    assert!(shown.contains("if          odd(?c) (which is itself: this never makes it hold)\n"), "{shown}");
    assert!(shown.contains("if          full(?c)\n"), "{shown}");
}
