//! What Ctrl-C, and a request to terminate, do to a program that waits for somebody.
#![cfg(unix)]

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Folder, program, without_measurements};

/// A name in the system that a program may wait to open.
fn pipe(folder: &Folder, name: &str) {
    let made = Command::new("mkfifo").arg(folder.path(name)).status();
    assert!(made.expect("there is mkfifo").success());
}

fn start(folder: &Folder, command: &str) -> Child {
    let mut command = program(command);
    command.current_dir(folder.path("")).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().expect("the program starts")
}

/// Signals a program once; how it ends, and what it says. It is to end soon.
fn signalled(mut child: Child, signal: &str) -> (Option<i32>, String) {
    // Held open, so that an answer may come yet.
    let _input = child.stdin.take();
    let killed = Command::new("kill").arg(signal).arg(child.id().to_string()).status();
    assert!(killed.expect("there is kill").success());
    let begun = Instant::now();
    let ended = child.wait_with_output().expect("it ends");
    assert!(begun.elapsed() < Duration::from_secs(5), "it took {:?}", begun.elapsed());
    (ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned())
}

fn interrupted(folder: &Folder, command: &str) -> (Option<i32>, String) {
    let child = start(folder, command);
    std::thread::sleep(Duration::from_secs(1));
    signalled(child, "-INT")
}

fn wait_for(file: &Path) {
    let begun = Instant::now();
    while !file.exists() {
        assert!(begun.elapsed() < Duration::from_secs(20), "{} does not come", file.display());
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// An environment that does something instead of answering the request of this number.
fn environment(folder: &Folder, number: usize, instead: &str) {
    let state = folder.json("K/tasks/T1.1.json")["state"].to_string();
    folder.write("state.json", state);
    folder.write(
        "environment.sh",
        format!(
            r#"n=0
while read -r request; do
  n=$((n+1))
  if [ $n = {number} ]; then {instead}; fi
  case "$request" in
    *'"hello"'*) echo "{{\"id\":$n,\"ok\":true,\"name\":\"slow\",\"reset\":true}}";;
    *'"close"'*) echo "{{\"id\":$n,\"ok\":true}}";;
    *) echo "{{\"id\":$n,\"ok\":true,\"executed\":true,\"state\":$(cat state.json)}}";;
  esac
done
"#
        ),
    );
}

/// Whichever request an environment is at, and whether it heeds a request to terminate or not.
#[test]
fn an_interrupted_run_is_no_failure_of_its_environment() {
    let folder = Folder::kitchen();
    folder.changed("K/tasks/T1.1.json", "done.json", |task| task["goal"] = serde_json::json!([]));
    let waits = "touch here; while :; do sleep 0.05; done";
    let ignores = "trap '' TERM; touch here; while :; do sleep 0.05; done";
    for (task, number) in
        [("K/tasks/T1.1.json", 1), ("K/tasks/T1.1.json", 2), ("K/tasks/T1.1.json", 3), ("done.json", 3)]
    {
        for instead in [waits, ignores] {
            for signal in ["-INT", "-TERM"] {
                environment(&folder, number, instead);
                let child = start(&folder, &format!("run kitchen.json {task} --env 'sh environment.sh' -q"));
                wait_for(&folder.path("here"));
                let (code, said) = signalled(child, signal);
                assert!(
                    code == Some(130) && !said.contains("failed"),
                    "{signal} at {number} of {task}: {code:?} {said}"
                );
                std::fs::remove_file(folder.path("here")).expect("it was there");
            }
        }
    }
}

/// Whoever stops a run is told how far it had come.
#[test]
fn an_interrupted_run_accounts_for_what_was_done() {
    let folder = Folder::kitchen();
    // Requests: hello, reset, act.
    environment(&folder, 3, "touch here; while :; do sleep 0.05; done");
    for (options, said) in [
        (
            "-q",
            "T1.1  not solved: 1 proposal, 0 actions executed, planned in N ms\n  \
             stopped during step 1 of 5 of proposal 1, PICK(agent_1, counter_14, lettuce_1): \
             what came of it was not observed\n",
        ),
        ("--json", "\"ending\":\"stopped\""),
    ] {
        let run = format!("run kitchen.json K/tasks/T1.1.json --env 'sh environment.sh' {options}");
        let mut program = program(&run);
        program.current_dir(folder.path("")).stdout(Stdio::piped()).stderr(Stdio::piped());
        let child = program.spawn().expect("the program starts");
        wait_for(&folder.path("here"));
        let killed = Command::new("kill").arg("-INT").arg(child.id().to_string()).status();
        assert!(killed.expect("there is kill").success());
        let ended = child.wait_with_output().expect("it ends");
        let out = without_measurements(&String::from_utf8_lossy(&ended.stdout));
        assert!(ended.status.code() == Some(130) && out.contains(said), "{options}: {ended:?}");
        std::fs::remove_file(folder.path("here")).expect("it was there");
    }
}

/// A signal to a group, or to everything that runs in a container, may reach the child first.
#[test]
fn a_child_that_dies_first_of_the_same_signal_has_not_failed() {
    let folder = Folder::kitchen();
    let here = folder.path("here");
    let dies = format!("touch {}; kill -TERM $$", here.display());
    environment(&folder, 2, &dies);
    folder.write("planner.sh", &dies);
    for command in [
        "run kitchen.json K/tasks/T1.1.json --env 'sh environment.sh' -q",
        "plan kitchen.json K/tasks/T1.1.json --planner 'sh ./planner.sh {domain} {problem}'",
    ] {
        let child = start(&folder, command);
        wait_for(&here);
        let (code, said) = signalled(child, "-TERM");
        assert!(code == Some(130) && !said.contains("failed"), "{command}: {code:?} {said}");
        std::fs::remove_file(&here).expect("it was there");
    }
    // Without a signal to the program it has.
    assert_eq!(folder.run("run kitchen.json K/tasks/T1.1.json --env 'sh environment.sh' -q").code, 35);
    assert_eq!(
        folder.run("plan kitchen.json K/tasks/T1.1.json --planner 'sh ./planner.sh {domain} {problem}'").code,
        38
    );
}

#[test]
fn interrupted_while_a_file_is_waited_for() {
    let folder = Folder::kitchen();
    for name in ["in", "out"] {
        pipe(&folder, name);
    }
    for command in [
        "plan kitchen.json in",
        "plan in K/tasks/T1.1.json",
        "plan kitchen.json K/tasks/T1.1.json -o out",
        "run kitchen.json in --kitchen",
        "run kitchen.json K/tasks/T1.1.json --kitchen --events out",
    ] {
        assert_eq!(interrupted(&folder, command), (Some(130), String::new()), "{command}");
    }
}

#[test]
fn interrupted_before_it_has_said_who_it_is() {
    let folder = Folder::kitchen();
    let ended = interrupted(&folder, "run kitchen.json K/tasks/T1.1.json --env 'sleep 30'");
    assert_eq!(ended, (Some(130), "error: stopped\n".to_owned()));
}

#[test]
fn interrupted_while_somebody_is_asked() {
    let folder = Folder::kitchen();
    let (code, said) = interrupted(&folder, "run kitchen.json K/tasks/T1.1.json --kitchen --confirm=all");
    assert_eq!(code, Some(130), "{said}");
    assert!(said.ends_with("[s]top: no answer: stopped\n"), "{said}");
}

/// What was found is told and written, and that it was stopped is not passed over.
#[test]
fn interrupted_while_further_plans_are_looked_for() {
    let folder = Folder::kitchen();
    let mut program = program("plan kitchen.json K/tasks/T1.1.json --plans 1000 -o found");
    program.current_dir(folder.path("")).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = program.spawn().expect("the program starts");
    let mut told = BufReader::new(child.stdout.take().expect("it is a pipe")).lines();
    let first = told.next().expect("a line").expect("text");
    assert!(first.starts_with("plan 1: "), "{first}");
    let killed = Command::new("kill").arg("-INT").arg(child.id().to_string()).status();
    assert!(killed.expect("there is kill").success());
    told.for_each(drop);
    let ended = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.code() == Some(130) && said.contains("no further plan: stopped"), "{ended:?}");
    assert!(folder.path("found").exists() || folder.path("found.1").exists(), "{said}");
}
