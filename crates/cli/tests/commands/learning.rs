//! `learn` and `show`.

use crate::common::Folder;

#[test]
fn learning_from_the_kitchen() {
    let folder = Folder::new();
    let exported = folder.run("kitchen export K");
    exported.succeeds();
    assert_eq!(exported.err, "wrote types.pddl, 8 demonstrations, 24 tasks and 12 faults to K\n");
    insta::assert_snapshot!("learn", folder.run("learn K/demos --types K/types.pddl -o kitchen.json"));
    insta::assert_snapshot!("learn-json", folder.run("learn K/demos --types K/types.pddl -o again.json --json -q"));
    assert!(folder.read("kitchen.json") == folder.read("again.json"), "equal evidence gives equal bytes");
    insta::assert_snapshot!("learn-dry-run", folder.run("learn K/demos --types K/types.pddl --dry-run"));
    let individual = folder.run("learn K/demos --types K/types.pddl --individual -o individual.json");
    assert!(individual.out.contains("\n39 individual actions\n"), "{individual}");
    assert_eq!(folder.names(), ["K", "again.json", "individual.json", "kitchen.json"]);
}

#[test]
fn a_dry_run_writes_nothing() {
    let folder = Folder::new();
    folder.run("kitchen export K").succeeds();
    folder.run("learn K/demos --types K/types.pddl --dry-run -o m.json").succeeds();
    assert_eq!(folder.names(), ["K"]);
}

#[test]
fn nothing_to_learn() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"box": "thing"}"#);
    let header = r#"{"format":"trace/1","task":"wait"}"#;
    let state = r#"{"state":{"objects":{"a":"box"},"atoms":["open(a)"]}}"#;
    folder.write("one.jsonl", format!("{header}\n{state}\n"));
    insta::assert_snapshot!("learn-nothing", folder.run("learn one.jsonl --types types.json -o m.json"));
    let action = r#"{"action":{"name":"WAIT","args":["a"]}}"#;
    folder.write("two.jsonl", format!("{header}\n{state}\n{action}\n{state}\n"));
    insta::assert_snapshot!("learn-unchanged", folder.run("learn two.jsonl --types types.json -o m.json"));
}

#[test]
fn failures_speak_against_merging() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"cup": "vessel", "mug": "vessel", "jar": "vessel", "vessel": "thing"}"#);
    let trace = |vessel: &str, executed: bool, after: &str| {
        let state = |atom: &str| format!(r#"{{"state":{{"objects":{{"x":"{vessel}"}},"atoms":["{atom}(x)"]}}}}"#);
        let action = format!(r#"{{"action":{{"name":"WASH","args":["x"]}},"executed":{executed}}}"#);
        format!("{{\"format\":\"trace/1\"}}\n{}\n{action}\n{}\n", state("dirty"), state(after))
    };
    folder.write("cup.jsonl", trace("cup", true, "clean"));
    folder.write("mug.jsonl", trace("mug", true, "clean"));
    folder.write("jar.jsonl", trace("jar", false, "broken"));
    folder.run("learn cup.jsonl mug.jsonl --types types.json -o merged.json -q").succeeds();
    insta::assert_snapshot!(
        "learn-failures",
        folder.run("learn cup.jsonl mug.jsonl jar.jsonl --types types.json -o m.json")
    );
    insta::assert_snapshot!("show-failures", folder.run("show m.json"));
}

#[test]
fn showing_a_model() {
    let folder = Folder::kitchen();
    insta::assert_snapshot!("show", folder.run("show kitchen.json"));
    insta::assert_snapshot!("show-action", folder.run("show kitchen.json --action USE-cutboard-food"));
    insta::assert_snapshot!("show-pddl", folder.run("show kitchen.json --pddl"));
    let wrong = folder.refuses(31, "show kitchen.json --action USE-cutboard-fod");
    assert_eq!(
        wrong.err,
        "error: the model has no action `USE-cutboard-fod`\nhint: Did you mean `USE-cutboard-food`?\n"
    );
    insta::assert_snapshot!("show-wrong-action", folder.refuses(31, "show kitchen.json --action ''"));
}
