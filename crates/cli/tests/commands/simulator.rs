//! `demo` and `kitchen`.

use crate::common::{Folder, names};

#[test]
fn the_demo_in_a_pipe() {
    let demo = Folder::new().run("demo");
    demo.succeeds();
    for line in demo.out.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    insta::assert_snapshot!("demo", demo);
}

#[test]
fn other_rooms() {
    let folder = Folder::new();
    for seed in [1, 7, u64::MAX] {
        folder.run(&format!("demo --seed {seed}")).succeeds();
    }
    folder.run("kitchen export A --seed 3 -q").succeeds();
    folder.run("kitchen export B --seed 3 -q").succeeds();
    folder.run("kitchen export C --seed 4 -q").succeeds();
    let task = |name: &str| folder.read(&format!("{name}/tasks/T1.1.json"));
    assert!(task("A") == task("B") && task("A") != task("C"), "the seed decides, and nothing else");
}

#[test]
fn exporting_leaves_the_files_and_nothing_else() {
    let folder = Folder::new();
    folder.run("kitchen export some/deep/K -q").succeeds();
    let root = folder.path("some/deep/K");
    insta::assert_snapshot!(
        "exported",
        ["", "demos", "tasks", "faults"].map(|name| names(&root.join(name)).join("\n")).join("\n\n")
    );
    folder.write("file", "x");
    for (command, message) in [
        ("kitchen export file", "file/demos: a part of this path is a file, not a folder"),
        ("kitchen export file/K", "file/K/demos: a part of this path is a file, not a folder"),
    ] {
        assert_eq!(folder.refuses(31, command).err, format!("error: {message}\n"));
    }
}

#[test]
fn replaying_recordings() {
    let folder = Folder::kitchen();
    let same = folder.run("kitchen replay K/demos/cut_lettuce.jsonl K/demos/toast_two_breads.jsonl");
    insta::assert_snapshot!("replay", same);
    let flipped = |name: &str, line: usize, from: &str, to: &str| {
        let text = folder.read("K/demos/cut_lettuce.jsonl");
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        assert_eq!(lines[line].matches(from).count(), 1, "{from}");
        lines[line] = lines[line].replace(from, to);
        folder.write(name, lines.join("\n") + "\n");
        folder.run(&format!("kitchen replay K/demos/cut_banana.jsonl {name}"))
    };
    let atom = flipped("atom.jsonl", 7, "\"chop_state\":\"Chopped\"", "\"chop_state\":\"Fresh\"");
    assert_eq!(atom.code, 12);
    insta::assert_snapshot!("replay-atom", atom);
    let action = flipped("action.jsonl", 2, "\"PICK\"", "\"JUMP\"");
    assert_eq!(action.code, 12);
    insta::assert_snapshot!("replay-action", action);
    let data = folder.run("kitchen replay K/demos/cut_banana.jsonl atom.jsonl --json");
    assert_eq!(data.code, 12);
    insta::assert_snapshot!("replay-json", data);
    folder.write(
        "symbolic.jsonl",
        "{\"format\":\"trace/1\"}\n{\"state\":{\"objects\":{\"a\":\"agent\"},\"atoms\":[]}}\n",
    );
    insta::assert_snapshot!("replay-symbolic", folder.refuses(31, "kitchen replay symbolic.jsonl"));
    folder.write(
        "elsewhere.jsonl",
        "{\"format\":\"trace/1\"}\n{\"state\":{\"entities\":[{\"id\":\"b\",\"type\":\"box\"}]}}\n",
    );
    insta::assert_snapshot!("replay-elsewhere", folder.refuses(31, "kitchen replay elsewhere.jsonl"));
}

#[test]
fn being_somebody_elses_kitchen() {
    let requests = [
        r#"{"id":1,"op":"hello","protocol":"env/1"}"#,
        r#"{"id":2,"op":"observe"}"#,
        "this is no request",
        r#"{"id":3,"op":"dance"}"#,
        r#"{"id":4,"op":"reset","seed":0,"scenario":{"items":"all of them"}}"#,
        r#"{"id":5,"op":"reset","seed":0}"#,
        r#"{"id":6,"op":"act","action":{"name":"PICK","args":["agent_1","nothing"]}}"#,
        r#"{"id":7,"op":"close"}"#,
    ];
    let served = Folder::new().run_with_input("kitchen serve", &requests.join("\n"));
    served.succeeds();
    // States are long: their beginning will do.
    let short = served.out.lines().map(|line| match line.split_once("\"state\":") {
        None => line.to_owned(),
        Some((before, state)) => {
            let end = state.rsplit_once("}]}").map_or("", |(_, end)| end);
            format!("{before}\"state\":…{end}")
        }
    });
    insta::assert_snapshot!("serve", short.collect::<Vec<_>>().join("\n"));
}

#[test]
fn drawing_rooms() {
    let folder = Folder::new();
    insta::assert_snapshot!("draw", folder.run("kitchen draw"));
    insta::assert_snapshot!("draw-task", folder.run("kitchen draw T5.4 --seed 3"));
    folder.run("kitchen export K -q").succeeds();
    let state: serde_json::Value = serde_json::from_str(&folder.run("kitchen draw T5.4 --json").out).expect("JSON");
    assert_eq!(state, folder.json("K/tasks/T5.4.json")["state"], "the same room");
    let wrong = folder.refuses(31, "kitchen draw T5.44");
    assert!(wrong.err.contains("hint: Did you mean `T5.4`?"), "{wrong}");
}
