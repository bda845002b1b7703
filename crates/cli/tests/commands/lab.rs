//! The laboratory: small versions of the experiments, what they write, and what they refuse.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use serde_json::Value;

use crate::common::{Folder, Transcript, names, program};

const TABLE: &str = "lab table --quick --no-times";

fn rows(csv: &str) -> Vec<Vec<&str>> {
    csv.lines().skip(1).map(|line| line.split(',').collect()).collect()
}

#[test]
fn a_quick_table() {
    let folder = Folder::new();
    let ended = folder.run(&format!("{TABLE} -o T"));
    ended.succeeds();
    insta::assert_snapshot!("lab-table", ended.out);
    assert_eq!(ended.err, "20 runs\nwrote table.csv, table.json and table.md to T in N s.\n");
    assert_eq!(names(&folder.path("T")), ["runs.jsonl", "table.csv", "table.json", "table.md"]);
    let csv = folder.read("T/table.csv");
    assert_eq!(
        csv.lines().next(),
        Some(
            "task,variant,runs,solved,proposals,plan_length,seconds_mean,seconds_sd,ground_actions,paper_solved,\
             paper_proposals,paper_plan_length,paper_seconds"
        )
    );
    let rows = rows(&csv);
    assert_eq!(rows.len(), 5 * 4);
    for row in &rows {
        assert_eq!((row[4], row[5]), (row[10], row[11]), "{row:?}: as published");
    }
    assert!(rows.iter().any(|row| row[4] == "2"), "several proposals");
    assert!(rows.iter().any(|row| row[3] == "0"), "unsolved");
    let json = folder.json("T/table.json");
    let imagined = json["cells"].as_array().expect("cells").iter().filter(|cell| cell["imagined_steps"] != 0);
    assert!(imagined.filter(|cell| cell["solved"] == 1).count() > 0, "imagined");
    let printed: Value =
        serde_json::from_str(&folder.run(&format!("{TABLE} -o T --json -q")).out.replace(": N", ": 120.0"))
            .expect("JSON");
    assert_eq!(printed, json);
    // With times, each run says how long it took.
    folder.run("lab table --quick -o M -q").succeeds();
    let measured = folder.read("M/runs.jsonl");
    assert!(measured.lines().skip(1).all(|line| line.contains("\"seconds\":")), "{measured}");
}

#[test]
fn quick_demonstrations() {
    let folder = Folder::new();
    let command = "lab demonstrations --quick --variant generalized+imagined --variant individual -o D";
    let ended = folder.run(command);
    ended.succeeds();
    insta::assert_snapshot!("lab-demonstrations", ended.out);
    let files =
        ["demonstrations.csv", "demonstrations.json", "demonstrations.md", "gains.csv", "runs.jsonl", "sizes.csv"];
    assert_eq!(names(&folder.path("D")), [&files[..], &["violins.svg"]].concat());
    let json = folder.json("D/demonstrations.json");
    let sizes = json["variants"][0]["sizes"].as_array().expect("sizes");
    assert_eq!(sizes[1]["solved"], serde_json::json!([24]), "everything shown, everything solved");
    assert!(folder.read("D/runs.jsonl").contains(r#""T4.1":1"#), "imagined");
}

#[test]
fn quick_faults() {
    let folder = Folder::new();
    let ended = folder.run("lab faults --quick -o F");
    ended.succeeds();
    insta::assert_snapshot!("lab-faults", ended.out);
    assert_eq!(names(&folder.path("F")), ["faults.csv", "faults.json", "faults.md", "runs.jsonl"]);
    let json = folder.json("F/faults.json");
    let scenarios = json["scenarios"].as_array().expect("scenarios");
    assert_eq!(scenarios.len(), 4 * 2);
    for row in scenarios {
        assert_eq!(row["repeated_mistakes"], 0, "{row}");
        assert_eq!(row["solved"] == 1, row["possible"] == true, "{row}");
    }
    let proposals: Vec<f64> = scenarios.iter().filter_map(|row| row["proposals"].as_f64()).collect();
    assert!(proposals.iter().any(|n| *n >= 3.0), "{proposals:?}");
}

#[test]
fn a_short_life() {
    let folder = Folder::new();
    let command = "lab lifelong --quick --seed 4 --tasks 4 --explain -o L";
    let ended = folder.run(command);
    ended.succeeds();
    insta::assert_snapshot!("lab-lifelong", ended.out);
    let files = ["failed.csv", "lifelong.csv", "lifelong.json", "lifelong.md", "runs.jsonl"];
    assert_eq!(names(&folder.path("L")), files);
    let csv = folder.read("L/lifelong.csv");
    let rows = rows(&csv);
    assert_eq!(rows.len(), 4 * 4);
    let failed: usize = rows.iter().filter_map(|row| row.last()?.parse::<usize>().ok()).sum();
    assert_eq!(folder.read("L/failed.csv").lines().count(), 1 + failed, "a row a failed step");
    let again = folder.run(command);
    assert!(again.err.starts_with("0 runs, 4 were finished before\n"), "{again}");
    assert_eq!(again.out, ended.out);
    folder.refuses(36, "lab lifelong --agent nobody -o N");
}

#[test]
fn runs_that_are_finished_are_kept_and_extended() {
    let folder = Folder::new();
    folder.run(&format!("{TABLE} -o T")).succeeds();
    let one = folder.read("T/runs.jsonl");
    let again = folder.run(&format!("{TABLE} -o T"));
    assert!(again.err.starts_with("0 runs, 20 were finished before\n"), "{again}");
    let two = folder.run(&format!("{TABLE} --runs 2 -o T"));
    assert!(two.err.starts_with("20 runs, 20 were finished before\n"), "{two}");
    let both = folder.read("T/runs.jsonl");
    assert!(one.lines().all(|line| both.contains(line)) && both.lines().count() == 1 + 40);
    // As if done at once, by another number of threads.
    folder.run(&format!("{TABLE} --runs 2 --jobs 7 -o U -q")).succeeds();
    assert_same(&folder.path("T"), &folder.path("U"));
    let fresh = folder.run(&format!("{TABLE} --fresh -o T"));
    assert!(fresh.err.starts_with("20 runs\n"), "{fresh}");
    assert_eq!(folder.read("T/runs.jsonl"), one);
}

/// Holds two folders to the same files with the same bytes.
fn assert_same(a: &Path, b: &Path) {
    assert_eq!(names(a), names(b));
    for name in names(a) {
        let [a, b] = [a, b].map(|folder| fs::read(folder.join(&name)).expect("a file"));
        assert!(a == b, "{name} differs");
    }
}

/// `TYPELIFT_KILLS` has it killed another number of times.
#[test]
fn killed_again_and_again_it_is_as_if_undisturbed() {
    let kills: usize = std::env::var("TYPELIFT_KILLS").map_or(10, |kills| kills.parse().expect("a number"));
    let folder = Folder::new();
    let command = format!("{TABLE} --runs 4 --jobs 2 -q -o");
    folder.run(&format!("{command} undisturbed")).succeeds();
    let mut killed = 0;
    while killed < kills {
        // By progress, not by the clock: how fast the machine is does not matter.
        let more_lines = killed % 5;
        if killed_after(&folder, &format!("{command} killed"), "killed/runs.jsonl", more_lines) {
            killed += 1;
        } else {
            assert_same(&folder.path("undisturbed"), &folder.path("killed"));
            fs::remove_dir_all(folder.path("killed")).expect("it can be removed");
        }
    }
    folder.run(&format!("{command} killed")).succeeds();
    assert_same(&folder.path("undisturbed"), &folder.path("killed"));
}

/// Whether the command was killed before it ended, which it is once its log has so many more lines than at the start.
fn killed_after(folder: &Folder, command: &str, log: &str, more_lines: usize) -> bool {
    let lines = || fs::read_to_string(folder.path(log)).map(|text| text.lines().count()).unwrap_or_default();
    let until = lines() + more_lines;
    let mut child = program(command);
    child.current_dir(folder.path("")).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = child.spawn().expect("the program starts");
    while lines() < until && child.try_wait().expect("a child").is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    // What has ended by itself cannot be killed, and need not be.
    let _ = child.kill();
    let ended = child.wait_with_output().expect("it ends");
    let text = String::from_utf8_lossy(&ended.stderr);
    assert!(matches!(ended.status.code(), None | Some(0)), "{text}");
    !ended.status.success()
}

#[cfg(unix)]
#[test]
fn interrupted_it_says_how_to_go_on() {
    let folder = Folder::new();
    let mut command = program("lab demonstrations --jobs 1 -o D");
    command.current_dir(folder.path("")).stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = command.spawn().expect("the program starts");
    let log = folder.path("D/runs.jsonl");
    let lines = || fs::read_to_string(&log).map(|text| text.lines().count()).unwrap_or_default();
    while lines() < 3 {
        std::thread::sleep(Duration::from_millis(20));
    }
    let killed = std::process::Command::new("kill").arg("-INT").arg(child.id().to_string()).status();
    assert!(killed.expect("there is kill").success());
    let ended = child.wait_with_output().expect("it ends");
    let text = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(130), "{text}");
    let finished = fs::read_to_string(&log).expect("a log");
    let finished = finished.lines().skip(1).inspect(|line| assert!(serde_json::from_str::<Value>(line).is_ok()));
    let message = format!("stopped: {} of 988 runs are finished\n", finished.count());
    assert!(text.contains(&message) && text.ends_with("hint: The same command goes on from there.\n"), "{text}");
    assert!(ended.stdout.is_empty());
}

#[test]
fn what_is_wrong_is_said_and_nothing_is_lost() {
    let folder = Folder::new();
    folder.run(&format!("{TABLE} -q -o T")).succeeds();
    let good = folder.read("T/runs.jsonl");
    folder.write("file", "something");
    let mut transcript = Transcript::default();
    let mut refused = |title: &str, command: &str| {
        let before = fs::read(folder.path("T/runs.jsonl")).expect("a log");
        transcript.add(title, &folder.refuses(31, command));
        assert_eq!(fs::read(folder.path("T/runs.jsonl")).expect("a log"), before, "{title}: nothing is lost");
    };
    refused("a file for a folder", &format!("{TABLE} -o file"));
    refused("a folder in a file", &format!("{TABLE} -o file/T"));
    refused("other settings", &format!("{TABLE} --max-proposals 3 -o T"));
    refused("another experiment", "lab faults --quick -o T");
    folder.write("T/runs.jsonl", good.replace("\"typelift\":\"", "\"typelift\":\"0."));
    refused("another version", &format!("{TABLE} -o T"));
    folder.write("T/runs.jsonl", good.replacen("\"proposals\":", "\"proposals\"", 1));
    refused("a corrupted line", &format!("{TABLE} -o T"));
    let second = good.lines().nth(1).expect("a run");
    folder.write("T/runs.jsonl", format!("{good}{second}\n"));
    refused("a run twice", &format!("{TABLE} -o T"));
    folder.write("T/runs.jsonl", "not a log\n");
    refused("something else", &format!("{TABLE} -o T"));
    insta::assert_snapshot!(transcript.0);

    // What is only unfinished is finished.
    folder.write("T/runs.jsonl", &good[..good.len() - 9]);
    let ended = folder.run(&format!("{TABLE} -o T"));
    ended.succeeds();
    assert!(
        ended.err.starts_with("note: the last line of the run log was not finished; its run is repeated\n1 run, 19")
    );
    assert_eq!(folder.read("T/runs.jsonl"), good);
    fs::remove_file(folder.path("T/table.md")).expect("removed");
    folder.run(&format!("{TABLE} -q -o T")).succeeds();
    assert_eq!(names(&folder.path("T")).len(), 4);
}

#[test]
fn limits_in_which_nothing_can_be_done() {
    let folder = Folder::new();
    for (index, limit) in ["--max-expansions 0", "--max-proposals 0", "--time-limit 0s"].into_iter().enumerate() {
        for experiment in ["table --no-times", "demonstrations --variant generalized", "faults"] {
            let name = format!("{}{index}", experiment.split(' ').next().unwrap_or_default());
            let ended = folder.run(&format!("lab {experiment} --quick {limit} -o {name}"));
            ended.succeeds();
            let expected = "warning: nothing was solved within these limits\n";
            assert!(ended.err.ends_with(expected), "{experiment} {limit}: {ended}");
            assert_eq!(ended.err.contains("--time-limit ended"), limit.starts_with("--time"), "{ended}");
            let quiet = folder.run(&format!("lab {experiment} --quick {limit} -q -o {name}"));
            assert_eq!((quiet.code, quiet.err.as_str()), (0, ""), "{experiment} {limit}");
        }
    }
}
