//! Limits of time, expansions and memory.

use std::fmt::Write as _;
use std::time::Instant;

use crate::common::{Folder, Transcript};

#[test]
fn each_limit_ends_planning_with_its_code() {
    let folder = Folder::kitchen();
    let mut transcript = Transcript::default();
    for (code, limit) in [
        (23, "--time-limit 0"),
        (23, "--time-limit 0ms --imagine"),
        (12, "--max-expansions 0"),
        (12, "--max-expansions 1"),
        (22, "--memory-limit 0"),
    ] {
        for json in ["", " --json"] {
            let command = format!("plan kitchen.json K/tasks/T1.4.json {limit}{json} -o t.plan");
            let ended = folder.run(&command);
            assert_eq!(ended.code, code, "{command}: {ended}");
            transcript.add(&command, &ended);
        }
    }
    assert_eq!(folder.names(), ["K", "kitchen.json"], "there is no plan to write");
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn a_limit_that_is_met_after_the_first_plan_keeps_it() {
    let folder = Folder::kitchen();
    let ended = folder.run("plan kitchen.json K/tasks/T1.1.json --plans 100 --max-expansions 6 -o t");
    ended.succeeds();
    let advice = "hint: --max-expansions allows more of them; another --search may need fewer\n";
    assert_eq!(ended.err, format!("no further plan: gave up at the limit of 6 expansions\n{advice}"));
    assert!(ended.out.starts_with("plan 1: 5 steps, ") && folder.names().len() == 3, "{ended}");
}

#[test]
fn each_limit_ends_a_run() {
    let folder = Folder::kitchen();
    let mut transcript = Transcript::default();
    for limit in ["--time-limit 0", "--max-expansions 1", "--memory-limit 0", "--max-proposals 0"] {
        let command = format!("run kitchen.json K/tasks/T1.4.json --kitchen {limit}");
        let ended = folder.run(&command);
        assert_eq!(ended.code, 12, "{command}: {ended}");
        transcript.add(&command, &ended);
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn each_command_that_may_take_long_has_limits() {
    let folder = Folder::kitchen();
    folder.run("plan kitchen.json K/tasks/T1.1.json -o lettuce.plan").succeeds();
    for command in [
        "learn K/demos --types K/types.pddl -o m.json",
        "export kitchen.json K/tasks/T1.1.json -o out",
        "validate kitchen.json K/tasks/T1.1.json lettuce.plan",
    ] {
        let late = folder.refuses(23, &format!("{command} --time-limit 0"));
        assert_eq!(late.err, "error: out of time\n", "{command}");
        let large = folder.refuses(22, &format!("{command} --memory-limit 64K"));
        assert_eq!(large.err, "error: out of memory\n", "{command}");
        folder.run(&format!("{command} --time-limit 1m --memory-limit 2GB")).succeeds();
    }
}

/// A model with thirty parameters that nothing restricts: grounding alone would take for ever.
fn widen(folder: &Folder) {
    folder.changed("kitchen.json", "wide.json", |model| {
        let parameters = model["actions"][0]["parameters"].as_array_mut().expect("a list");
        parameters.extend((0..30).map(|i| serde_json::json!([format!("y{i}"), "item"])));
    });
}

#[test]
fn limits_cover_grounding() {
    let folder = Folder::kitchen();
    widen(&folder);
    let ended = folder.run("plan wide.json K/tasks/T1.1.json --time-limit 200ms");
    assert_eq!((ended.code, ended.err.as_str()), (23, "no plan: out of time before the search\n"), "{ended}");
    // So does a limit of memory.
    let ended = folder.run("plan wide.json K/tasks/T1.1.json --memory-limit 60M");
    assert_eq!((ended.code, ended.err.as_str()), (22, "no plan: out of memory before the search\n"), "{ended}");
}

#[test]
fn limits_cover_reading() {
    let folder = Folder::new();
    folder.write(
        "domain.pddl",
        "(define (domain roads) (:types place) (:predicates (at ?p - place) (road ?a ?b - place))
           (:action go :parameters (?a ?b - place) :precondition (and (at ?a) (road ?a ?b)) :effect (at ?b)))",
    );
    let mut problem = String::from("(define (problem far) (:domain roads) (:objects");
    let places = 200_000;
    (0..places).for_each(|i| write!(problem, " p{i}").expect("written"));
    problem.push_str(" - place) (:init (at p0)");
    (1..places).for_each(|i| writeln!(problem, " (road p{} p{i})", i - 1).expect("written"));
    problem.push_str(") (:goal (at p9)))");
    folder.write("problem.pddl", problem);
    let ended = folder.run("plan domain.pddl problem.pddl -o p --memory-limit 20");
    assert_eq!((ended.code, ended.err.as_str()), (22, "no plan: out of memory before the search\n"), "{ended}");
    let took = |command: &str, code: i32| {
        let begun = Instant::now();
        let ended = folder.run(command);
        assert_eq!(ended.code, code, "{command}: {ended}");
        begun.elapsed()
    };
    let read = took("pddl check domain.pddl problem.pddl", 0);
    for json in ["", " --json"] {
        let command = format!("plan domain.pddl problem.pddl -o p --time-limit {}ms{json}", read.as_millis() / 10);
        let stopped = took(&command, 23);
        assert!(stopped < read, "{stopped:?} with a tenth of {read:?} that reading takes");
    }
    assert!(!folder.names().contains(&"p".to_owned()));
}

/// Lamps of which an action turns two over: of 24, all even subsets can be lit, but never a single one, and nothing but the
/// search finds that out.
#[cfg(target_os = "linux")]
fn lamps(folder: &Folder) {
    folder.write(
        "domain.pddl",
        "(define (domain lamps) (:requirements :negative-preconditions :conditional-effects) (:predicates (lit ?l))
           (:action turn :parameters (?a ?b) :precondition (not (= ?a ?b))
            :effect (and (when (lit ?a) (not (lit ?a))) (when (not (lit ?a)) (lit ?a))
                         (when (lit ?b) (not (lit ?b))) (when (not (lit ?b)) (lit ?b)))))",
    );
    let all: String = (0..24).fold(String::new(), |text, i| text + &format!(" l{i}"));
    let dark: String = (1..24).fold(String::new(), |text, i| text + &format!(" (not (lit l{i}))"));
    folder.write(
        "problem.pddl",
        format!("(define (problem one) (:domain lamps) (:objects{all}) (:init) (:goal (and (lit l0){dark})))"),
    );
}

/// The most resident memory that a command held, in megabytes, as Linux tells while it runs; and its exit code.
#[cfg(target_os = "linux")]
fn peak(folder: &Folder, command: &str) -> (u64, Option<i32>) {
    use std::process::Stdio;

    let mut program = crate::common::program(command);
    program.current_dir(folder.path("")).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = program.spawn().expect("the program starts");
    let status = format!("/proc/{}/status", child.id());
    let mut kilobytes = 0;
    loop {
        let told = std::fs::read_to_string(&status).unwrap_or_default();
        let line = told.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let number = line.and_then(|line| line.trim().strip_suffix(" kB")?.trim().parse().ok());
        kilobytes = number.unwrap_or(kilobytes);
        if let Some(status) = child.try_wait().expect("it is ours") {
            return (kilobytes >> 10, status.code());
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
}

/// That a limit is used, and held: grounding, and a search, that would grow for ever end near it.
#[cfg(target_os = "linux")]
#[test]
fn memory_stays_at_its_limit() {
    let folder = Folder::kitchen();
    widen(&folder);
    lamps(&folder);
    let (at_rest, _) = peak(&folder, "plan kitchen.json K/tasks/T1.1.json");
    for (command, limit) in [("plan wide.json K/tasks/T1.1.json", 100), ("plan domain.pddl problem.pddl -o p", 40)] {
        let (peak, code) = peak(&folder, &format!("{command} --memory-limit {limit}M"));
        assert_eq!(code, Some(22), "{command}");
        let held = limit - limit / 10..=limit + limit / 10 + at_rest;
        assert!(held.contains(&peak), "{command}: {peak} MB, and {at_rest} MB at rest, where {limit} MB are allowed");
    }
}

/// However much a child writes without an end of line, and however long a plan is.
#[cfg(target_os = "linux")]
#[test]
fn what_children_write_is_not_held_whole() {
    let folder = Folder::kitchen();
    let flood = "head -c 150000000 /dev/zero | tr '\\0' x";
    folder.write("environment.sh", format!("{flood} >&2; exit 3"));
    folder.write("talks.sh", format!("{flood} >&2; exit 7"));
    folder.write("long.sh", "yes '(pick-station-food agent_1 lettuce_1 counter_1)' | head -c 40000000 > $3");
    folder.write("short.sh", "yes '(pick-station-food agent_1 lettuce_1 counter_1)' | head -c 9999990 > $3");
    let planner = |name: &str| {
        format!(
            "plan kitchen.json K/tasks/T1.1.json --planner 'sh {} {{domain}} {{problem}} {{plan}}'",
            path(&folder, name)
        )
    };
    let (at_rest, _) = peak(&folder, "plan kitchen.json K/tasks/T1.1.json");
    for (command, expected) in [
        ("run kitchen.json K/tasks/T1.1.json --env 'sh environment.sh'".to_owned(), 35),
        (planner("talks.sh"), 38),
        (planner("long.sh"), 39),
        (planner("short.sh") + " --memory-limit 100", 22),
    ] {
        let (peak, code) = peak(&folder, &command);
        assert_eq!(code, Some(expected), "{command}");
        assert!(peak < at_rest + 60, "{command}: {peak} MB, and {at_rest} MB at rest");
    }
}

#[cfg(target_os = "linux")]
fn path(folder: &Folder, name: &str) -> String {
    folder.path(name).display().to_string()
}

/// An environment in which all lamps are dark until something is done, and two are lit from then on.
#[cfg(target_os = "linux")]
fn two_lamps(folder: &Folder) {
    let objects = (0..24).map(|i| format!(r#""l{i}":"object""#)).collect::<Vec<_>>().join(",");
    let state = |atoms: &str| format!(r#""ok":true,"state":{{"objects":{{{objects}}},"atoms":[{atoms}]}}"#);
    let script = format!(
        r#"n=0
while read -r request; do
  n=$((n+1))
  case "$request" in
    *'"hello"'*) echo "{{\"id\":$n,\"ok\":true,\"name\":\"lamps\",\"reset\":true}}";;
    *'"act"'*) echo '{{"id":'$n',"executed":true,{}}}';;
    *'"close"'*) echo "{{\"id\":$n,\"ok\":true}}";;
    *) echo '{{"id":'$n',{}}}';;
  esac
done
"#,
        state(r#""lit(l0)","lit(l1)""#),
        state("")
    );
    folder.write("lamps.sh", script);
}

/// That each task of a run has the whole limit: what the process came to hold in the tasks before does not count.
#[cfg(target_os = "linux")]
#[test]
fn each_task_of_a_run_has_the_whole_limit() {
    let folder = Folder::new();
    lamps(&folder);
    two_lamps(&folder);
    // Two lamps are within reach, unlike a single one.
    folder.write("near.pddl", folder.read("problem.pddl").replace(" (not (lit l1))", " (lit l1)"));
    let limits = "--max-expansions 100000000 --memory-limit 20M";
    let tasks = "problem.pddl near.pddl problem.pddl";
    let ended = folder.run(&format!("run domain.pddl {tasks} --env 'sh lamps.sh' -q --json {limits}"));
    assert_eq!(ended.code, 12, "{ended}");
    let endings: Vec<&str> =
        ended.out.lines().filter_map(|line| line.split_once(r#""ending":""#)?.1.split('"').next()).collect();
    assert_eq!(endings, ["out_of_memory", "solved", "out_of_memory"], "{ended}");
}
