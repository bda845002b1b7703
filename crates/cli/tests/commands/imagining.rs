//! What imagination refuses, and what a person is told of it.

use crate::common::{Folder, Transcript};

/// Blocks of three kinds and jars are solids; arms and carts move.
const TYPES: &str = r#"{
  "entity": "object",
  "mover": "entity", "arm": "mover", "cart": "mover",
  "solid": "entity", "jar": "solid", "block": "solid", "cube": "block", "cone": "block", "ball": "block",
  "spot": "entity"
}"#;

fn state(objects: &str, atoms: &[&str]) -> String {
    let objects: Vec<String> = objects
        .split(' ')
        .map(|name| format!(r#""{name}":"{}""#, name.trim_end_matches(|c: char| c == '_' || c.is_ascii_digit())))
        .collect();
    let atoms: Vec<String> = atoms.iter().map(|atom| format!("\"{atom}\"")).collect();
    format!(r#"{{"objects":{{{}}},"atoms":[{}]}}"#, objects.join(","), atoms.join(","))
}

/// A trace of calls, each with the atoms that hold after it.
fn trace(objects: &str, first: &[&str], calls: &[(&str, &[&str], &[&str])]) -> String {
    let mut lines = vec![r#"{"format":"trace/1"}"#.to_owned(), format!(r#"{{"state":{}}}"#, state(objects, first))];
    for (name, args, after) in calls {
        let args: Vec<String> = args.iter().map(|arg| format!("\"{arg}\"")).collect();
        lines.push(format!(r#"{{"action":{{"name":"{name}","args":[{}]}}}}"#, args.join(",")));
        lines.push(format!(r#"{{"state":{}}}"#, state(objects, after)));
    }
    lines.join("\n") + "\n"
}

fn task(objects: &str, atoms: &[&str], goal: &str) -> String {
    format!(r#"{{"format":"task/1","goal":["{goal}"],"state":{}}}"#, state(objects, atoms))
}

/// An arm was seen to put a cube on a cone, and to go from spot to spot.
fn blocks() -> Folder {
    let folder = Folder::new();
    folder.write("types.json", TYPES);
    let shown = trace(
        "arm_1 cube_1 cone_1 spot_1 spot_2",
        &["at(arm_1,spot_1)", "lies(cube_1)", "lies(cone_1)"],
        &[
            ("lift", &["arm_1", "cube_1"], &["at(arm_1,spot_1)", "held(arm_1,cube_1)", "lies(cone_1)"]),
            ("stack", &["arm_1", "cube_1", "cone_1"], &["at(arm_1,spot_1)", "on(cube_1,cone_1)", "lies(cone_1)"]),
            ("move", &["arm_1", "spot_2"], &["at(arm_1,spot_2)", "on(cube_1,cone_1)", "lies(cone_1)"]),
        ],
    );
    folder.write("shown.jsonl", shown);
    folder.run("learn shown.jsonl --types types.json -o m.json").succeeds();
    let all = "arm_1 cart_1 ball_1 cube_1 cone_1 jar_1 spot_1 spot_2";
    let lying =
        ["at(arm_1,spot_1)", "at(cart_1,spot_1)", "lies(ball_1)", "lies(cube_1)", "lies(cone_1)", "lies(jar_1)"];
    folder.write("ball-on-cube.json", task(all, &lying, "on(ball_1,cube_1)"));
    folder.write("jar-on-cube.json", task(all, &lying, "on(jar_1,cube_1)"));
    folder.write("cart-elsewhere.json", task(all, &lying, "at(cart_1,spot_2)"));
    folder
}

#[test]
fn two_roles_that_are_alike_may_become_one() {
    let folder = blocks();
    let ended = folder.run("plan m.json ball-on-cube.json --imagine");
    ended.succeeds();
    let steps: Vec<&str> = ended.out.lines().skip(1).collect();
    assert_eq!(
        steps,
        [
            "  1  lift(arm_1, ball_1)  imagined: block for cube, from lift-cube, 1 observation",
            "  2  stack(arm_1, ball_1, cube_1)  imagined: block for cube, block for cone, from stack-cube-cone, 1 observation",
        ]
    );
}

#[test]
fn what_is_refused_is_said_and_an_option_allows_it() {
    let folder = blocks();
    let mut transcript = Transcript::default();
    for (task, exit) in [("jar-on-cube", 11), ("cart-elsewhere", 11), ("jar-on-cube", 0), ("cart-elsewhere", 0)] {
        let option = if exit == 0 { " --guard off" } else { "" };
        let command = format!("plan m.json {task}.json --imagine{option}");
        let ended = folder.run(&command);
        assert_eq!(ended.code, exit, "{command}");
        transcript.add(&command, &ended);
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn programs_are_told_what_is_refused() {
    let folder = blocks();
    let ended = folder.run("plan m.json cart-elsewhere.json --imagine --json");
    let answer: serde_json::Value = serde_json::from_str(&ended.out.replace(": N", ": 0")).expect("an answer");
    assert_eq!(
        answer["given_up"],
        serde_json::json!([
            {"action": "move-spot-spot", "parameter": "x0", "from": "arm", "to": "mover", "because": {"acts_instead": "cart"}}
        ])
    );
    let without = folder.refuses(36, "plan m.json cart-elsewhere.json --guard off");
    assert!(without.err.contains("--imagine"), "{}", without.err);
}

/// Each jar that was sealed had been wiped dry, and a cloth wipes once.
fn jars() -> Folder {
    let folder = Folder::new();
    folder.write("types.json", r#"{"jar": "object", "cloth": "object"}"#);
    let shown = trace(
        "jar_1 cloth_1",
        &[],
        &[
            ("wipe", &["jar_1", "cloth_1"], &["dry(jar_1)", "used(cloth_1)"]),
            ("seal", &["jar_1"], &["dry(jar_1)", "used(cloth_1)", "sealed(jar_1)"]),
        ],
    );
    folder.write("shown.jsonl", shown);
    folder.run("learn shown.jsonl --types types.json -o m.json").succeeds();
    let state = state("jar_1 jar_2 cloth_1", &[]);
    let goal = r#"["sealed(jar_1)","sealed(jar_2)","dry(jar_1)"]"#;
    folder.write("seal.json", format!(r#"{{"format":"task/1","goal":{goal},"state":{state}}}"#));
    folder
}

#[test]
fn a_precondition_that_may_be_an_accident_is_named_and_done_without_last_of_all() {
    let folder = jars();
    let mut transcript = Transcript::default();
    for (command, exit) in [
        ("plan m.json seal.json", 11),
        ("plan m.json seal.json --imagine -o seal.plan", 0),
        ("validate m.json seal.json seal.plan", 12),
        ("validate m.json seal.json seal.plan --imagine", 0),
    ] {
        let ended = folder.run(command);
        assert_eq!(ended.code, exit, "{command}");
        transcript.add(command, &ended);
    }
    insta::assert_snapshot!(transcript.0);
    let ended = folder.run("plan m.json seal.json --imagine --json");
    let answer: serde_json::Value = serde_json::from_str(&ended.out.replace(": N", ": 0")).expect("an answer");
    let steps = answer["plans"][0]["steps"].as_array().expect("steps");
    let without: Vec<_> = steps.iter().filter_map(|step| step.get("without")).collect();
    assert_eq!(without, [&serde_json::json!(["dry(jar_2)"])]);
}
