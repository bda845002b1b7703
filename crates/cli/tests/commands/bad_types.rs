//! Hierarchies that are wrong.

use crate::common::{Folder, Transcript};

const TRACE: &str = r#"{"format":"trace/1"}
{"state":{"objects":{"a":"box"},"atoms":["shut(a)"]}}
{"action":{"name":"OPEN","args":["a"]}}
{"state":{"objects":{"a":"box"},"atoms":["open(a)"]}}
"#;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("trace.jsonl", TRACE);
    folder.write("model.json", "an earlier model");
    folder
}

#[test]
fn hierarchies_that_are_wrong() {
    let folder = folder();
    let mut transcript = Transcript::default();
    for (title, text) in [
        ("a cycle", "(:types box - thing\n  thing - item\n  item - box)"),
        ("a cycle in JSON", "{\"box\": \"thing\",\n \"thing\": \"box\"}"),
        ("a type below itself", "(:types box - box)"),
        ("a list that covers its own parent", "(:types thing box - thing)"),
        ("a key that stands twice", "{\"box\": \"thing\",\n \"box\": \"item\"}"),
        ("a parent for the root", "(:types box object - thing)"),
        ("never closed", "(:types box"),
        ("another block", "(:typs box)"),
        ("a list instead of a name", "(:types (box))"),
        ("neither PDDL nor JSON", "box - thing"),
        ("a JSON list", "[\"box\"]"),
        ("a number in JSON", "{\"box\": 1}"),
        ("JSON that is cut off", "{\"box\": \"thing\""),
        ("a name with a space", "{\"box\": \"some thing\"}"),
        ("an empty name", "{\"\": \"thing\"}"),
        ("an empty file", ""),
        ("names that PDDL does not tell apart", "{\"box\": \"thing\", \"Box\": \"thing\"}"),
        ("a type that is not there", "(:types ball)"),
    ] {
        folder.write("types", text);
        transcript.add(title, &folder.refuses(31, "learn trace.jsonl --types types -o model.json"));
    }
    folder.write("types", b"(:types box\n \xe9)");
    transcript.add("not UTF-8", &folder.refuses(31, "learn trace.jsonl --types types -o model.json"));
    transcript.add("a folder", &folder.refuses(31, "learn trace.jsonl --types . -o model.json"));
    transcript.add("no such file", &folder.refuses(31, "learn trace.jsonl --types none -o model.json"));
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn very_deep_texts_do_no_harm() {
    let folder = folder();
    folder.write("types", "(".repeat(1_000_000));
    let ended = folder.refuses(31, "learn trace.jsonl --types types -o model.json");
    assert!(ended.err.contains("this `(` is never closed"), "{}", &ended.err[..200.min(ended.err.len())]);
    let chain: Vec<String> = (0..3000).map(|i| format!("t{i} - t{}", i + 1)).collect();
    folder.write("types", format!("(:types {} box)", chain.join(" ")));
    folder.run("learn trace.jsonl --types types -o model.json").succeeds();
}

#[test]
fn types_that_contradict_the_model() {
    let folder = Folder::kitchen();
    folder.write("more.pddl", "(:types\n  durian - food\n  lettuce - tool)");
    let mut transcript = Transcript::default();
    let commands = [
        "plan kitchen.json K/tasks/T1.1.json --types more.pddl -o t.plan",
        "run kitchen.json K/tasks/T1.1.json --types more.pddl --kitchen --events e.jsonl",
        "plan kitchen.json K/tasks/T1.1.json --types none.pddl",
    ];
    for command in commands {
        transcript.add(command, &folder.refuses(31, command));
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn an_unknown_actor() {
    let folder = folder();
    folder.write("types", "(:types box crate - thing)");
    let mut transcript = Transcript::default();
    for name in ["crat", "nobody"] {
        let command = format!("learn trace.jsonl --types types --actor {name} -o model.json");
        transcript.add(&command, &folder.refuses(31, &command));
    }
    insta::assert_snapshot!(transcript.0);
    folder.run("learn trace.jsonl --types types --actor none -o model.json").succeeds();
}
