//! What the field's benchmarks consist of, a domain, trajectories and problems, with models that are learned from them.

use std::process::Command;

use crate::common::{Folder, Transcript};

const DOMAIN: &str = "(define (domain Night-Shift) (:requirements :typing)
 (:types Tram Bus - Line stop - object) (:constants Depot - Stop)
 (:predicates (at ?l - line ?s - stop) (dirty ?l - line) (clean ?l - line)))
";

/// Two nights: a tram is washed and leaves the depot, a bus comes to the depot and is washed.
const NIGHTS: [&str; 2] = [
    "(:trajectory (:state (at t1 depot) (dirty t1)) (:action (wash t1 depot))
 (:state (at t1 depot) (clean t1)) (:action (drive T1 Depot market)) (:state (at t1 market) (clean t1)))",
    "(:trajectory (:state (at b1 market) (dirty b1)) (:action (drive b1 market depot))
 (:state (at b1 depot) (dirty b1)) (:action (wash b1 depot)) (:state (at b1 depot) (clean b1)))",
];

const TASK: &str = "(define (problem Late) (:domain night-shift)
 (:objects Bus-7 - bus Tram_2 - TRAM Market Old-Square - stop)
 (:init (at bus-7 market) (DIRTY bus-7) (at tram_2 old-square) (dirty Tram_2))
 (:goal (and (at BUS-7 depot) (forall (?l - Line) (clean ?l)))))
";

/// A model of the two nights, in `shift.json`, and a task for it.
fn shift() -> Folder {
    let folder = Folder::new();
    folder.write("domain.pddl", DOMAIN);
    folder.write("late.pddl", TASK);
    std::fs::create_dir(folder.path("P")).expect("a folder");
    folder.write("P/1.pddl", "(define (problem one) (:domain night-shift) (:objects T1 - tram market - stop))");
    folder.write("P/2.pddl", "(define (problem two) (:domain night-shift) (:objects b1 - bus market - stop))");
    for (number, night) in (1..).zip(NIGHTS) {
        folder.write(&format!("{number}.trajectory"), night);
    }
    let learned = "learn 1.trajectory 2.trajectory --types domain.pddl --problems P --actor none -o shift.json";
    folder.run(learned).succeeds();
    folder
}

#[test]
fn a_problem_is_a_task_for_a_learned_model() {
    let folder = shift();
    let mut transcript = Transcript::default();
    let planned = folder.run("plan shift.json late.pddl -o late.plan");
    let steps: Vec<&str> = planned.out.lines().skip(1).collect();
    assert_eq!(planned.code, 0, "{planned}");
    assert_eq!(
        steps.len(),
        3,
        "both are washed, and the bus drives to a place that only the domain declares: {planned}"
    );
    transcript.add("validate", &folder.run("validate shift.json late.pddl late.plan"));
    transcript.add("export", &folder.run("export shift.json late.pddl -o E"));
    // What is exported is a domain of this name, with these constants, for every planner and every problem.
    transcript.add("validate the benchmark's problem", &folder.run("validate E/domain.pddl late.pddl late.plan"));
    let as_domain = folder.run("plan E/domain.pddl late.pddl");
    assert!(as_domain.out.starts_with("3 steps"), "{as_domain}");
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn constants_and_the_domains_name_stay_with_the_model() {
    let folder = shift();
    let model = folder.json("shift.json");
    assert_eq!((&model["domain"], &model["constants"]["depot"]), (&"night-shift".into(), &"stop".into()));
    folder.run("learn 1.trajectory --types domain.pddl --problems P --actor none -o part.json -q").succeeds();
    folder.run("learn --into part.json 2.trajectory --problems P -q").succeeds();
    assert!(folder.read("part.json") == folder.read("shift.json"), "as learned at once");
    // Types alone declare neither; a list may.
    folder.write("types.pddl", "(:types Tram Bus - Line stop - object)");
    let untyped = folder.refuses(31, "learn 1.trajectory --types types.pddl --problems P -o no.json");
    assert!(untyped.err.contains("the type of object `depot` is not given"), "{untyped}");
    folder.write("objects.json", r#"{"t1": "tram", "b1": "bus", "market": "stop", "depot": "stop"}"#);
    let listed =
        "learn 1.trajectory 2.trajectory --types types.pddl --objects objects.json --actor none -o listed.json";
    folder.run(listed).succeeds();
    assert_eq!(folder.json("listed.json")["domain"], serde_json::Value::Null);
    let unknown = TASK.replace("(:domain night-shift)", "(:domain day-shift)").replace("Market ", "Market Depot ");
    folder.write("late.pddl", &unknown);
    folder.run("plan listed.json late.pddl").succeeds();
    folder.write("domain.pddl", DOMAIN.replace("Depot - Stop", "Depot - shed"));
    let shed = folder.refuses(31, "learn 1.trajectory --types domain.pddl --problems P -o no.json");
    assert!(shed.err.contains("constant `depot`: unknown type `shed`"), "{shed}");
}

/// As [`shift`], with predicates that no demonstration shows.
fn shift_of_a_larger_domain() -> Folder {
    let folder = shift();
    let domain =
        DOMAIN.replace("(clean ?l - line)", "(clean ?l - line) (broken ?l - Line) (Next ?a ?b - (either stop line))");
    folder.write("domain.pddl", domain);
    let learned = "learn 1.trajectory 2.trajectory --types domain.pddl --problems P --actor none -o shift.json";
    folder.run(learned).succeeds();
    folder
}

/// An environment that washes, and calls things as it likes: `Tram_2` where PDDL has `tram_2`.
const DEPOT: &str = r#"import json, sys
for line in sys.stdin:
    asked = json.loads(line)
    answer = {"id": asked["id"], "ok": True}
    if asked["op"] == "hello":
        answer.update(name="depot", reset=True, protocol="env/1")
    elif asked["op"] == "reset":
        how = {"Tram_2": "dirty", "BUS_7": "dirty"}
    elif asked["op"] == "act":
        how[asked["action"]["args"][0]] = "clean"
        answer.update(executed=True)
    if asked["op"] in ("reset", "act", "observe"):
        objects = {"Tram_2": "Tram", "BUS_7": "Bus", "Depot": "stop"}
        atoms = [f"{said}({line})" for line, said in how.items()] + [f"at({line},Depot)" for line in how]
        answer.update(state={"objects": objects, "atoms": atoms})
    print(json.dumps(answer), flush=True)
"#;

#[test]
fn an_environment_may_tell_upper_from_lower_case() {
    if !Command::new("python3").arg("--version").output().is_ok_and(|output| output.status.success()) {
        println!("skipped: there is no python3");
        return;
    }
    let folder = shift();
    folder.write("depot.py", DEPOT);
    let mut transcript = Transcript::default();
    for (title, tram, goal) in [
        ("an atom", "tram_2", "(clean tram_2)"),
        ("a formula over objects and a constant", "TRAM_2", "(or (clean tram_2) (not (at bus_7 depot)))"),
        ("all of them", "Tram_2", "(forall (?l - Line) (and (clean ?l) (at ?l depot)))"),
        ("of another name", "tram-2", "(clean tram-2)"),
    ] {
        let objects = format!("(:objects Bus_7 - bus {tram} - tram)");
        let text = format!("(define (problem Late) (:domain night-shift) {objects} (:init) (:goal {goal}))");
        folder.write("late.pddl", text);
        transcript.add(title, &folder.run("run shift.json late.pddl --env 'python3 depot.py'"));
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn what_only_the_domain_declares_may_hold() {
    let folder = shift_of_a_larger_domain();
    assert!(
        folder.run("show shift.json --predicates").out.contains("broken(Line)  no action changes it\n"),
        "it is the model's"
    );
    let with = |held: &str, goal: &str| {
        let task = TASK.replace("(:init ", &format!("(:init {held} ")).replace("(at BUS-7 depot)", goal);
        folder.write("late.pddl", task);
        folder.run("plan shift.json late.pddl -o late.plan")
    };
    let planned = with("(next market depot) (NEXT bus-7 depot) (broken bus-7)", "(at bus-7 depot) (broken bus-7)");
    assert!(planned.out.starts_with("3 steps"), "{planned}");
    folder.run("validate shift.json late.pddl late.plan").succeeds();
    // The export declares them, too: the benchmark's problem is one of it.
    folder.run("export shift.json -o E -q").succeeds();
    let as_domain = folder.run("plan E/domain.pddl late.pddl");
    assert!(as_domain.out.starts_with("3 steps"), "{as_domain}");
    let mut transcript = Transcript::default();
    transcript.add("asked for", &with("", "(broken bus-7)"));
    transcript.add("asked for among others", &with("", "(or (broken tram_2) (next depot market))"));
    transcript.add("misspelt", &with("(brokn bus-7)", "(at bus-7 depot)"));
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn what_no_demonstration_showed_is_said_where_nothing_is_left_to_try() {
    if !Command::new("python3").arg("--version").output().is_ok_and(|output| output.status.success()) {
        println!("skipped: there is no python3");
        return;
    }
    let folder = shift_of_a_larger_domain();
    folder.write("depot.py", DEPOT);
    for goal in ["(broken tram_2)", "(exists (?l - Line) (and (broken ?l) (clean ?l)))"] {
        let objects = "(:objects Bus_7 - bus tram_2 - tram)";
        let text = format!("(define (problem Late) (:domain night-shift) {objects} (:init) (:goal {goal}))");
        folder.write("late.pddl", text);
        let run = folder.run("run shift.json late.pddl --env 'python3 depot.py'");
        let note = "note: no demonstration showed `broken`: the domain declares it, and no learned action changes it\n";
        assert!(run.code == 12 && run.err.ends_with(note), "{goal}: {run}");
    }
}

#[test]
fn what_the_domain_declares_stays_with_the_model_whatever_is_shown() {
    let folder = shift_of_a_larger_domain();
    folder.write(
        "3.trajectory",
        "(:trajectory (:state (at t1 depot) (dirty t1) (broken t1)) (:action (wash t1 depot))
 (:state (at t1 depot) (clean t1) (broken t1)))",
    );
    folder.write("P/3.pddl", folder.read("P/1.pddl"));
    let types = |model: &str, predicate: &str| folder.json(model)["predicates"][predicate].clone();
    folder.run("learn --into shift.json 3.trajectory --problems P -o more.json -q").succeeds();
    assert_eq!(types("shift.json", "broken"), serde_json::json!(["Line"]), "as the domain has it");
    assert_eq!(types("more.json", "broken"), serde_json::json!(["Tram"]), "as it was seen");
    assert_eq!(types("more.json", "next"), serde_json::json!(["object", "object"]));
    folder.run("learn --into more.json --forget 3.trajectory -o less.json -q").succeeds();
    assert!(folder.read("less.json") == folder.read("shift.json"), "as if it had never been there");
}

#[test]
fn what_the_model_does_not_know_is_said_with_its_place() {
    let folder = shift();
    let mut transcript = Transcript::default();
    for (title, from, to) in [
        ("predicate", "(:init ", "(:init (broken bus-7) "),
        ("nearly a predicate", "(DIRTY bus-7)", "(dirrty bus-7)"),
        ("type", "Tram_2 - TRAM", "Tram_2 - ferry"),
        ("object", "(at BUS-7 depot)", "(at BUS-7 harbour)"),
        ("arguments", "(at BUS-7 depot)", "(at BUS-7)"),
        ("domain", "night-shift", "day-shift"),
        ("constant", "Market Old-Square - stop", "Market Old-Square - stop Depot - bus"),
        ("function", "(:init ", "(:init (= (distance depot market) 5) "),
    ] {
        assert!(TASK.contains(from), "{from}");
        folder.write("late.pddl", TASK.replace(from, to));
        transcript.add(title, &folder.refuses(31, "plan shift.json late.pddl"));
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn names_that_pddl_spells_otherwise_are_found() {
    let folder = Folder::kitchen();
    folder.run("export kitchen.json K/tasks/T1.1.json -o E -q").succeeds();
    let steps = |task: &str| {
        let planned = folder.run(&format!("plan kitchen.json {task}"));
        planned.out.lines().skip(1).map(str::to_ascii_lowercase).collect::<Vec<_>>()
    };
    let own = steps("K/tasks/T1.1.json");
    assert_eq!(own.len(), 5);
    assert_eq!(steps("E/problem.pddl"), own, "but for the spelling of objects, which PDDL has in lower case");
}
