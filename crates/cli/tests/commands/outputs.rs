//! Where output goes, and what happens if it cannot go there.
#![cfg(unix)]

use std::os::unix::fs::symlink;
use std::process::Stdio;

use crate::common::{Folder, Transcript, program};

#[test]
fn outputs_that_cannot_be_written() {
    let folder = Folder::kitchen();
    std::fs::create_dir(folder.path("folder")).expect("made");
    let mut transcript = Transcript::default();
    for command in [
        "learn K/demos --types K/types.pddl -o none/m.json",
        "learn K/demos --types K/types.pddl -o folder",
        "learn K/demos --types K/types.pddl -o kitchen.json/m.json",
        "learn K/demos --types K/types.pddl -o /proc/m.json",
        "run kitchen.json K/tasks/T1.1.json --kitchen --events none/e.jsonl",
        "kitchen export /proc/K",
    ] {
        transcript.add(command, &folder.refuses(31, command));
    }
    let planned = folder.run("plan kitchen.json K/tasks/T1.1.json -o none/t.plan");
    assert_eq!(planned.code, 31);
    transcript.add("a plan is printed all the same", &planned);
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn a_folder_that_may_not_be_written_to() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::kitchen();
    let locked = folder.path("locked");
    std::fs::create_dir(&locked).expect("made");
    folder.write("locked/m.json", "an earlier model");
    std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o555)).expect("locked");
    let may_anyway = std::fs::write(locked.join("probe"), "").is_ok();
    if may_anyway {
        println!("skipped: whoever runs this may write anywhere");
        return;
    }
    let ended = folder.refuses(31, "learn K/demos --types K/types.pddl -o locked/m.json");
    assert_eq!(ended.err, "error: locked/m.json: access is not permitted\n");
    assert_eq!(folder.read("locked/m.json"), "an earlier model");
}

#[test]
fn links_stay_links_and_permissions_stay() {
    let folder = Folder::kitchen();
    folder.write("real.json", "an earlier model");
    symlink("real.json", folder.path("link.json")).expect("linked");
    symlink("later.json", folder.path("dangling.json")).expect("linked");
    for (link, real) in [("link.json", "real.json"), ("dangling.json", "later.json")] {
        folder.run(&format!("learn K/demos --types K/types.pddl -o {link}")).succeeds();
        assert!(folder.path(link).symlink_metadata().expect("there").is_symlink(), "{link}");
        assert!(folder.read(real) == folder.read("kitchen.json"));
    }
    assert_eq!(folder.names(), ["K", "dangling.json", "kitchen.json", "later.json", "link.json", "real.json"]);
}

#[test]
fn a_plan_for_the_terminal() {
    let folder = Folder::kitchen();
    let ended = folder.run("plan kitchen.json K/tasks/T1.1.json -o /dev/stdout");
    ended.succeeds();
    assert!(ended.out.contains("(place-plate-food agent_1 plate_1 lettuce_1)\n; cost = 5"), "{ended}");
}

/// What a command does whose output nobody reads.
#[test]
fn nobody_reads_on() {
    let folder = Folder::kitchen();
    for command in [
        "demo",
        "learn K/demos --types K/types.pddl -o m.json -q",
        "learn K/demos --types K/types.pddl --dry-run -q",
        "show kitchen.json",
        "show kitchen.json --pddl",
        "plan kitchen.json K/tasks/T1.1.json --plans 3 -o t -q",
        "plan kitchen.json K/tasks/T1.1.json --json",
        "run kitchen.json K/tasks/T1.1.json --kitchen -q",
        "kitchen draw",
        "kitchen replay K/demos/cut_lettuce.jsonl",
        "--help",
    ] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let mut program = program(command);
        let child = program.current_dir(folder.path("")).stdout(writer).stderr(Stdio::piped()).spawn();
        let output = child.expect("it starts").wait_with_output().expect("it ends");
        let err = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), err.as_ref()), (Some(0), ""), "{command}");
    }
    assert!(folder.read("m.json") == folder.read("kitchen.json"), "the model is written all the same");
    assert!(folder.names().iter().any(|name| name.starts_with('t')), "so is the plan");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let folder = Folder::kitchen();
    let full = std::fs::File::options().write(true).open("/dev/full").expect("Linux has it");
    let child = program("show kitchen.json").current_dir(folder.path("")).stdout(full).stderr(Stdio::piped()).spawn();
    let output = child.expect("it starts").wait_with_output().expect("it ends");
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(31), "{err}");
    assert!(err.starts_with("error: cannot write to standard output: "), "{err}");
}

#[test]
fn what_is_read_is_not_written_over() {
    let folder = Folder::kitchen();
    let names = ["K/demos/cut_lettuce.jsonl", "K/types.pddl", "kitchen.json", "K/tasks/T1.1.json"];
    std::fs::create_dir(folder.path("bells")).expect("made");
    for name in ["1_bell_traj", "2.trajectory", "3.pddl"] {
        folder.write(&format!("bells/{name}"), "((:init (rung a)))");
    }
    folder.write("objects.json", "{}");
    folder.run("export kitchen.json K/tasks/T1.1.json -o P").succeeds();
    for (from, to) in
        [("K/tasks/T1.1.json", "several.2"), ("P/domain.pddl", "sas_plan"), ("P/problem.pddl", "sas_plan.1")]
    {
        folder.write(to, folder.read(from));
    }
    symlink("K/tasks/T1.1.json", folder.path("linked.1")).expect("linked");
    std::fs::hard_link(folder.path("K/tasks/T1.1.json"), folder.path("hard")).expect("linked");
    std::fs::hard_link(folder.path("several.2"), folder.path("hard-too")).expect("linked");
    let before = names.map(|name| folder.read(name));
    for command in [
        "learn K/demos --types K/types.pddl -o K/demos/cut_lettuce.jsonl",
        "learn K/demos/cut_lettuce.jsonl --types K/types.pddl -o K/demos/../demos/cut_lettuce.jsonl",
        "learn K/demos --types K/types.pddl -o K/types.pddl",
        "plan kitchen.json K/tasks/T1.1.json -o kitchen.json",
        "plan kitchen.json K/tasks/T1.1.json -o K/tasks/T1.1.json",
        "run kitchen.json K/tasks/T1.1.json --kitchen --events K/tasks/T1.1.json",
        "learn bells --types K/types.pddl -o bells/1_bell_traj",
        "learn bells --types K/types.pddl -o bells/2.trajectory",
        "learn bells --types K/types.pddl --problems bells -o bells/3.pddl",
        "learn bells --types K/types.pddl --objects objects.json -o objects.json",
        "learn --into kitchen.json --forget K/demos/cut_lettuce.jsonl -o K/demos/cut_lettuce.jsonl",
        "plan kitchen.json several.2 --plans 2 -o several",
        "plan kitchen.json several.2 --better -o several",
        "plan kitchen.json linked.1 --plans 2 -o linked",
        "plan kitchen.json K/tasks/T1.1.json -o hard",
        "plan sas_plan P/problem.pddl",
        "plan P/domain.pddl sas_plan.1 --plans 2",
        "export kitchen.json K/tasks/T1.1.json -o P --types P/names.json",
        "run kitchen.json several.2 --kitchen --events hard-too",
    ] {
        let refused = folder.refuses(31, command);
        assert!(refused.err.contains("is read, and would be written over"), "{command}: {}", refused.err);
    }
    assert_eq!(names.map(|name| folder.read(name)), before);
    // A number that is not written is no danger.
    folder.run("plan kitchen.json several.2 --plans 1 -o several").succeeds();
    folder.write("several.3", folder.read("several.2"));
    folder.run("plan kitchen.json several.3 --plans 2 -o several").succeeds();
    folder.run("learn K/demos --types K/types.pddl -o kitchen.json").succeeds();
}

#[test]
fn a_plan_that_nobody_named_replaces_another_with_a_word() {
    let folder = Folder::kitchen();
    folder.run("export kitchen.json K/tasks/T1.1.json -o P").succeeds();
    let plan = "plan P/domain.pddl P/problem.pddl";
    let said = |command: &str| {
        let ended = folder.run(command);
        ended.succeeds();
        ended.err
    };
    assert_eq!(said(plan), "");
    let note = |files: &str| format!("note: {files} was there already, and is replaced; -o writes elsewhere\n");
    assert_eq!(said(plan), note("sas_plan"));
    assert_eq!(said(&format!("{plan} --json")), note("sas_plan"));
    assert_eq!(said(&format!("{plan} -q")), "");
    assert_eq!(said(&format!("{plan} --plans 2")), "");
    folder.write("sas_plan.3", "another's");
    assert_eq!(said(&format!("{plan} --plans 2")), note("sas_plan.1 (and 1 more)"));
    // What is named is to be written.
    assert_eq!(said(&format!("{plan} -o sas_plan")), "");
}

#[test]
fn what_a_killed_program_left_beside_a_file_goes_with_the_next_one() {
    let folder = Folder::kitchen();
    folder.write(".kitchen.json.4000000-0.tmp", "half a model");
    folder.write(".mine.tmp", "somebody's");
    folder.run("learn K/demos --types K/types.pddl -o kitchen.json").succeeds();
    assert_eq!(folder.names(), [".mine.tmp", "K", "kitchen.json"]);
}

#[test]
fn what_is_shown_is_there_for_programs() {
    let folder = Folder::kitchen();
    let shown = |options: &str| -> Vec<serde_json::Value> {
        let ended = folder.run(&format!("show kitchen.json --json {options}"));
        ended.succeeds();
        serde_json::from_str(&ended.out).expect("a list")
    };
    assert_eq!(shown("").len(), 13);
    let one = shown("--action USE-cutboard-food");
    assert_eq!((one.len(), &one[0]["name"]), (1, &"USE-cutboard-food".into()));
    assert!(one[0]["rows"].as_array().is_some_and(|rows| rows.iter().any(|row| row["label"] == "seen")), "{one:?}");
    let sources = shown("--sources");
    assert_eq!(sources.iter().filter_map(|source| source["transitions"].as_u64()).sum::<u64>(), 68);
    assert_eq!(folder.run("show kitchen.json --json --pddl").code, 36);
    let predicates = shown("--predicates");
    assert!(
        predicates.contains(&serde_json::json!({"name": "holding_holds", "types": ["agent", "food"], "fixed": false})),
        "{predicates:?}"
    );
    let types = shown("--types");
    assert!(types.contains(&serde_json::json!({"name": "lettuce", "parents": ["vegetable"]})), "{types:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn nothing_is_done_whose_events_cannot_be_written() {
    let folder = Folder::kitchen();
    std::fs::create_dir(folder.path("runs")).expect("made");
    let command = "run kitchen.json K/tasks/T1.1.json --kitchen --events /dev/full --record runs -q";
    let ended = folder.refuses(31, command);
    assert!(ended.err.starts_with("error: /dev/full: "), "{ended}");
    assert_eq!(std::fs::read_dir(folder.path("runs")).expect("a folder").count(), 0);
}

#[test]
fn who_wants_it_quiet_gets_no_hint() {
    let folder = Folder::kitchen();
    let command = "run kitchen.json K/tasks/T1.1.json --kitchen --max-expansions 0";
    assert!(folder.run(command).err.contains("hint"));
    let quiet = folder.run(&format!("{command} -q"));
    assert_eq!((quiet.code, quiet.err.as_str()), (12, ""), "{quiet}");
}

#[test]
fn a_type_of_several_kinds_is_listed_once() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"bed": "object", "seat": "object", "sofa": ["bed", "seat"], "futon": "sofa"}"#);
    let states = [r#"["made(sofa_1)"]"#, "[]"]
        .map(|atoms| format!(r#"{{"state":{{"objects":{{"sofa_1":"sofa"}},"atoms":{atoms}}}}}"#));
    let action = r#"{"action":{"name":"sleep","args":["sofa_1"]}}"#;
    folder.write("nap.jsonl", format!("{{\"format\":\"trace/1\"}}\n{}\n{action}\n{}\n", states[0], states[1]));
    folder.run("learn nap.jsonl --types types.json -o nap.json -q").succeeds();
    let listed = folder.run("show nap.json --types").out;
    assert_eq!(listed, "object\n  bed\n    sofa (also a kind of seat)\n      futon\n  seat\n");
}
