//! Checking PDDL files and laying them out.

use crate::common::{Folder, Transcript};

const DOMAIN: &str = "(define (domain blocks)
  (:requirements :strips :typing)
  (:types block)
  (:predicates (on ?x ?y - block) (clear ?x - block))
  (:action move
    :parameters (?x ?y ?z - block)
    :precondition (and (clear ?x) (clear ?z) (on ?x ?y) (not (= ?y ?z)))
    :effect (and (on ?x ?z) (not (on ?x ?y)) (not (clear ?z)) (clear ?y)))
)
";

const PROBLEM: &str = "(define (problem two)
  (:domain blocks)
  (:objects a b c - block)
  (:init (on a b) (clear a) (clear c))
  (:goal (on a c))
)
";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("domain.pddl", DOMAIN);
    folder.write("p.pddl", PROBLEM);
    folder
}

#[test]
fn files_that_are_right() {
    let folder = folder();
    folder.write("walk.trajectory", "(:trajectory (:state (on a b)) (:action (move a b c)) (:state (on a c)))");
    folder.write("walk.plan", "(move a b c)\n; cost = 1 (unit cost)\n");
    let mut transcript = Transcript::default();
    for command in [
        "pddl check domain.pddl p.pddl walk.trajectory walk.plan",
        "pddl check p.pddl -q",
        "pddl check p.pddl domain.pddl --json",
    ] {
        let ended = folder.run(command);
        ended.succeeds();
        transcript.add(command, &ended);
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn files_that_are_wrong() {
    let folder = folder();
    let mut transcript = Transcript::default();
    for (title, domain, problem) in [
        ("a predicate that is not declared", DOMAIN.replace("(clear ?x)", "(claer ?x)"), PROBLEM.to_owned()),
        ("the wrong number of arguments", DOMAIN.replace("(on ?x ?z)", "(on ?x)"), PROBLEM.to_owned()),
        ("a parameter that is missing", DOMAIN.replace("(?x ?y ?z", "(?x ?y"), PROBLEM.to_owned()),
        ("an unknown type", DOMAIN.replace("?z - block", "?z - blok"), PROBLEM.to_owned()),
        ("never closed", DOMAIN.trim_end().trim_end_matches(')').to_owned(), PROBLEM.to_owned()),
        ("an object that is not declared", DOMAIN.to_owned(), PROBLEM.replace("a b c", "a b")),
        ("another domain", DOMAIN.to_owned(), PROBLEM.replace("blocks", "ferry")),
        ("an empty goal", DOMAIN.to_owned(), PROBLEM.replace("(on a c)", "")),
        ("two files", DOMAIN.replace("(on ?x ?z)", "(on ?z)"), PROBLEM.replace("(clear c)", "(clear (c)")),
        ("neither of the two", DOMAIN.to_owned(), "(:objects a b)".to_owned()),
    ] {
        folder.write("domain.pddl", domain);
        folder.write("p.pddl", problem);
        let ended = folder.run("pddl check domain.pddl p.pddl -q");
        assert_eq!(ended.code, 31, "{title}: {ended}");
        transcript.add(title, &ended);
    }
    transcript.add("no such file", &folder.run("pddl check none.pddl"));
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn files_that_are_not_supported() {
    let folder = folder();
    folder.write("time.pddl", DOMAIN.replace(":typing)", ":typing\n    :durative-actions)").replace("blocks", "time"));
    folder.write("q.pddl", PROBLEM.replace("blocks", "time"));
    let mut transcript = Transcript::default();
    let ended = folder.run("pddl check domain.pddl p.pddl time.pddl q.pddl -q");
    assert_eq!(ended.code, 34, "{ended}");
    transcript.add("only that", &ended);
    folder.write("p.pddl", PROBLEM.replace("blocks", "blocks blocks"));
    let ended = folder.run("pddl check domain.pddl p.pddl time.pddl --json");
    assert_eq!(ended.code, 31, "{ended}");
    transcript.add("and something wrong", &ended);
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn what_planning_refuses_is_refused() {
    let folder = Folder::new();
    let domain = |rules: &str| {
        format!(
            "(define (domain lamps) (:types lamp) (:predicates (on ?l - lamp) (off ?l - lamp) (wired ?a ?b - lamp)) {rules})"
        )
    };
    let through = "(:derived (on ?l - lamp) (not (off ?l)))\n(:derived (off ?l - lamp) (not (on ?l)))";
    let inside = "(:derived (on ?l - lamp) (forall (?m - lamp) (imply (wired ?m ?l) (on ?m))))";
    folder.write("p.pddl", "(define (problem p) (:domain lamps) (:objects a - lamp) (:init) (:goal (on a)))");
    for (rules, code, message) in [
        (through, 31, "`off` depends on its own negation, through `on`"),
        (inside, 34, "`on` depends on itself inside of a universal quantification"),
    ] {
        folder.write("domain.pddl", domain(rules));
        for command in ["pddl check domain.pddl", "pddl check domain.pddl p.pddl", "plan domain.pddl p.pddl"] {
            let ended = folder.run(command);
            assert!(ended.code == code && ended.err.contains(message), "{command}: {ended}");
        }
    }
}

/// An action for anything meets what is said of a thing that its predicate is not declared for.
#[test]
fn what_is_said_of_things_of_other_types() {
    let folder = Folder::new();
    let domain = "(define (domain shop) (:types cup lid - thing) (:predicates (wet ?c - cup) (dry ?c - cup))
 (:action wipe :parameters (?x - thing) :precondition (wet ?x) :effect (and (dry ?x) (not (wet ?x)))))";
    folder.write("domain.pddl", domain);
    let problem = |goal: &str| {
        format!("(define (problem p) (:domain shop) (:objects c - cup l m - lid) (:init (wet l)) (:goal ({goal})))")
    };
    folder.write("p.pddl", problem("dry l"));
    let checked = folder.run("pddl check domain.pddl p.pddl");
    checked.succeeds();
    assert_eq!(
        checked.err,
        "warning: domain.pddl: used, but not required: :typing\n\
         warning: p.pddl: 2 atoms not of the types that the predicate declares: wet(l)\n"
    );
    assert!(folder.run("pddl check domain.pddl p.pddl --json").out.contains(r#""misfits":["wet(l)","dry(l)"]"#));
    let planned = folder.run("plan domain.pddl p.pddl -o plan");
    planned.succeeds();
    let warning = "warning: p.pddl: 2 atoms not of the types that the predicate declares: wet(l)\n";
    assert!(planned.err.starts_with(warning), "{planned}");
    assert!(!folder.run("plan domain.pddl p.pddl -o plan -q").err.contains("warning"));
    folder.run("validate domain.pddl p.pddl plan").succeeds();
    folder.write("p.pddl", problem("dry m"));
    let none = folder.run("plan domain.pddl p.pddl");
    assert!(none.code == 11 && none.err.contains("it needs wet(m)"), "{none}");
}

#[test]
fn where_the_domain_is_found() {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("problems")).expect("made");
    folder.write("problems/p.pddl", PROBLEM);
    let mut transcript = Transcript::default();
    let command = "pddl check problems/p.pddl -q";
    transcript.add("nowhere", &folder.run(command));
    folder.write("above.pddl", DOMAIN);
    folder.write("ferry.pddl", DOMAIN.replace("blocks", "ferry"));
    transcript.add("in the folder above", &folder.run(command));
    folder.write("again.pddl", DOMAIN);
    transcript.add("twice in the folder above", &folder.run(command));
    folder.write("problems/domain.pddl", DOMAIN.replace("clear", "free"));
    transcript.add("beside it, but another one", &folder.run(command));
    transcript.add("among the files", &folder.run("pddl check problems/p.pddl again.pddl ferry.pddl -q"));
    let command = "pddl check above.pddl problems/domain.pddl again.pddl problems/p.pddl -q";
    transcript.add("several among the files: the nearest", &folder.run(command));
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn laying_out() {
    let folder = folder();
    let laid_out = folder.run("pddl format domain.pddl");
    laid_out.succeeds();
    insta::assert_snapshot!(laid_out.out);
    let ended = folder.run("pddl format domain.pddl --check");
    assert_eq!((ended.code, ended.out.as_str()), (12, ""), "{ended}");
    assert_eq!(ended.err, "domain.pddl would be laid out differently\n");
    folder.run("pddl format domain.pddl -o domain.pddl").succeeds();
    assert_eq!(folder.read("domain.pddl"), laid_out.out);
    folder.run("pddl format domain.pddl --check").succeeds();
    folder.run("pddl check domain.pddl p.pddl").succeeds();
    folder.write("bad.pddl", "(define (domain d)");
    folder.refuses(31, "pddl format bad.pddl -o out.pddl");
    folder.refuses(31, "pddl format none.pddl");
}
