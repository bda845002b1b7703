//! Input that is right, but strange.

use serde_json::json;

use crate::common::Folder;

#[test]
fn a_world_without_anything() {
    let folder = Folder::kitchen();
    folder.write("empty.json", r#"{"format":"task/1","goal":[],"state":{"entities":[]}}"#);
    let plan = folder.run("plan kitchen.json empty.json");
    assert_eq!((plan.code, plan.out.as_str()), (0, ""));
}

#[test]
fn a_world_with_very_much() {
    let folder = Folder::kitchen();
    folder.changed("K/tasks/T1.1.json", "many.json", |task| {
        let entities = task["state"]["entities"].as_array_mut().expect("a list");
        let more = (0..3000).map(
            |i| json!({"id": format!("stone_{i}"), "type": "item", "attributes": {"free": true, "movable": true}}),
        );
        entities.extend(more);
    });
    folder.run("plan kitchen.json many.json").succeeds();
}

#[test]
fn names_in_any_script() {
    let folder = Folder::new();
    let text = |open: &str| {
        format!(r#"{{"state":{{"entities":[{{"id":"箱子","type":"Kästchen","attributes":{{"état":"{open}"}}}}]}}}}"#)
    };
    let lines =
        [r#"{"format":"trace/1"}"#, &text("fermé"), r#"{"action":{"name":"ÖFFNE","args":["箱子"]}}"#, &text("ouvert")];
    folder.write("trace.jsonl", lines.join("\n"));
    folder.write("types.json", r#"{"Kästchen": "Ding"}"#);
    folder.run("learn trace.jsonl --types types.json -o m.json -q").succeeds();
    let state = &text("fermé")[r#"{"state":"#.len()..text("fermé").len() - 1];
    folder.write("task.json", format!(r#"{{"format":"task/1","goal":["état_ouvert(箱子)"],"state":{state}}}"#));
    insta::assert_snapshot!("unicode-plan", folder.run("plan m.json task.json -o t.plan"));
    insta::assert_snapshot!("unicode-plan-file", folder.read("t.plan"));
    insta::assert_snapshot!("unicode-show", folder.run("show m.json"));
    insta::assert_snapshot!("unicode-pddl", folder.run("show m.json --pddl"));
}

#[test]
fn a_file_given_twice_counts_once() {
    let folder = Folder::kitchen();
    let twice = folder.run("learn K/demos/cut_lettuce.jsonl K/demos/cut_lettuce.jsonl --types K/types.pddl -o m.json");
    twice.succeeds();
    assert!(twice.out.starts_with("5 transitions, from 1 demonstration\n5 individual actions\n"), "{twice}");
    assert!(twice.err.contains("warning: cut_lettuce.jsonl is the same trace as cut_lettuce.jsonl ("), "{twice}");
}

#[test]
fn what_is_ignored_need_not_be_there() {
    let folder = Folder::kitchen();
    let learn = |ignore: &str| folder.run(&format!("learn K/demos --types K/types.pddl --ignore '{ignore}' -o m.json"));
    for ignore in ["", ",", "location,,location"] {
        let ended = learn(ignore);
        assert!(ended.code == 0 && !ended.err.contains("warning"), "{ended}");
    }
    let unknown = learn("colour");
    assert!(unknown.code == 0 && unknown.err.contains("warning: --ignore colour"), "{unknown}");
}

#[cfg(unix)]
#[test]
fn a_trace_from_a_pipe() {
    let folder = Folder::kitchen();
    let trace = folder.read("K/demos/cut_lettuce.jsonl");
    let command = "learn /dev/stdin --types K/types.pddl -o m.json";
    let learned = folder.run_with_input(command, &trace);
    assert!(learned.code == 0 && learned.out.contains("\n5 individual actions\n"), "{learned}");
    let blank = folder.run_with_input(command, &format!("\n{trace}"));
    assert!(blank.code == 31 && blank.err.starts_with("error: /dev/stdin:1: "), "{blank}");
    folder.write("objects.json", r#"{"a": "plate"}"#);
    let trajectory = "((:init (dirty a))\n(operator: (wash a))\n(:state (clean a)))";
    let learned = folder.run_with_input(&format!("{command} --objects objects.json"), trajectory);
    assert!(learned.code == 0 && learned.out.contains("\n1 individual action\n"), "{learned}");
}
