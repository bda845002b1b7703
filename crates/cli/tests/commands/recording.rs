//! `run --record`: what an agent did, as traces to learn from.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use typelift::world::{TraceReader, Verdict};

use crate::common::{Folder, names};

const FAULT: &str = "run kitchen.json K/faults/broken_cutboard_lettuce.json --kitchen --imagine";

/// The names of the individual actions that are learned from a folder, and how many transitions it holds.
fn learned(folder: &Folder, records: &str) -> (BTreeSet<String>, String) {
    let ended = folder.run(&format!("learn {records} --types K/types.pddl --individual -o {records}.json"));
    ended.succeeds();
    let model = folder.json(&format!("{records}.json"));
    let actions = model["actions"].as_array().expect("a list").iter();
    let names = actions.map(|action| action["name"].as_str().expect("a name").to_owned()).collect();
    (names, ended.out.lines().next().unwrap_or_default().to_owned())
}

#[test]
fn what_was_done_is_learned_from_and_failures_count() {
    let folder = Folder::kitchen();
    let ended = folder.run(&format!("{FAULT} --record R"));
    ended.succeeds();
    assert!(ended.err.ends_with("recorded R/broken_cutboard_lettuce.jsonl\n"), "{ended}");
    let text = folder.read("R/broken_cutboard_lettuce.jsonl");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 2 + 2 * 9);
    let refused: Vec<usize> = (0..lines.len()).filter(|&at| lines[at].contains(r#""verdict":"refused""#)).collect();
    insta::assert_snapshot!("recorded-action", lines[refused[0]]);
    // The same without the two steps that were refused.
    let kept: Vec<&str> = (0..lines.len())
        .filter(|at| !refused.contains(at) && !refused.contains(&at.wrapping_sub(1)))
        .map(|at| lines[at])
        .collect();
    fs::create_dir(folder.path("without")).expect("made");
    folder.write("without/worked.jsonl", kept.join("\n"));
    let (with_failures, without) = (learned(&folder, "R"), learned(&folder, "without"));
    assert_eq!(with_failures.0, without.0, "what failed teaches no action");
    assert_eq!(with_failures.1, "9 transitions, from 1 demonstration");
    assert_eq!(without.1, "7 transitions, from 1 demonstration");
}

#[test]
fn no_record_is_written_over() {
    let folder = Folder::kitchen();
    folder.run(&format!("{FAULT} --record R -q")).succeeds();
    let first = folder.read("R/broken_cutboard_lettuce.jsonl");
    let ended = folder.run(&format!("{FAULT} --record R --restart"));
    ended.succeeds();
    assert_eq!(folder.read("R/broken_cutboard_lettuce.jsonl"), first);
    let expected =
        ["broken_cutboard_lettuce-2.jsonl", "broken_cutboard_lettuce-3.jsonl", "broken_cutboard_lettuce.jsonl"];
    assert_eq!(names(&folder.path("R")), expected, "a reset begins a file of its own");
    assert!(folder.run(&format!("{FAULT} --record R -q")).err.is_empty());
    folder.write("file", "");
    let refused = folder.run(&format!("{FAULT} --record file"));
    assert_eq!((refused.code, refused.out.as_str()), (31, ""), "{refused}");
}

/// How many steps a folder's traces hold; each must be whole.
fn steps(folder: &Path) -> usize {
    let files = names(folder).into_iter().filter(|name| name.ends_with(".jsonl"));
    let count = |name: String| {
        let mut reader = TraceReader::open(&folder.join(&name)).unwrap_or_else(|error| panic!("{error}"));
        let recording = reader.recording().unwrap_or_else(|error| panic!("{error}"));
        let judged =
            recording.steps.iter().filter(|(action, _)| action.verdict.is_some_and(|v| v <= Verdict::TimedOut));
        assert_eq!(judged.count(), recording.steps.len(), "{name}");
        recording.steps.len()
    };
    files.map(count).sum()
}

/// Whatever moment the program is killed at, what it had told of is recorded. `TYPELIFT_KILLS` says how often to try.
#[cfg(unix)]
#[test]
fn a_killed_run_leaves_every_step_that_it_told_of() {
    use std::process::Stdio;
    use std::thread::sleep;
    use std::time::Instant;

    let folder = Folder::kitchen();
    let kills: u32 = std::env::var("TYPELIFT_KILLS").map_or(6, |number| number.parse().expect("a number"));
    let start = |number: u32| {
        let tasks = (1..=6).map(|task| format!("K/tasks/T{task}.1.json")).collect::<Vec<_>>().join(" ");
        let command = format!("run kitchen.json {tasks} --kitchen --imagine -q --record R{number} --events E{number}");
        let mut program = crate::common::program(&command);
        program.current_dir(folder.path("")).stdout(Stdio::null()).stderr(Stdio::null());
        program.spawn().expect("the program starts")
    };
    let started = Instant::now();
    start(0).wait().expect("it ends");
    let whole = started.elapsed();
    let all = steps(&folder.path("R0"));
    assert!(all > 30, "{all}");
    for number in 1..=kills {
        let mut running = start(number);
        sleep(whole * number / (kills + 1));
        running.kill().expect("killed");
        running.wait().expect("it ends");
        let (records, events) = (folder.path(&format!("R{number}")), folder.path(&format!("E{number}")));
        let events = fs::read_to_string(events).unwrap_or_default();
        let told =
            events.split_inclusive('\n').filter(|line| line.contains(r#""event":"stepped""#) && line.ends_with('\n'));
        let (told, recorded) = (told.count(), if records.exists() { steps(&records) } else { 0 });
        assert!(recorded == told || recorded == told + 1, "kill {number}: told of {told}, recorded {recorded}");
    }
}

#[test]
fn a_record_goes_to_a_folder() {
    let folder = Folder::kitchen();
    let refused = folder.refuses(31, "run kitchen.json K/tasks/T1.1.json --kitchen --record kitchen.json");
    assert_eq!(refused.err, "error: kitchen.json: this is a file, not a folder\n");
}
