//! Tasks that are wrong.

use serde_json::{Value, json};

use crate::common::{Folder, Transcript};

#[test]
fn goals_that_are_wrong() {
    let folder = Folder::kitchen();
    let mut transcript = Transcript::default();
    for (title, goal) in [
        ("a predicate that is nearly right", "chop_state_Choped(lettuce_1)"),
        ("an unknown predicate", "happy(lettuce_1)"),
        ("a relation by its name in a snapshot", "holding(agent_1,lettuce_1)"),
        ("a wrong arity", "chop_state_Chopped(lettuce_1,plate_1)"),
        ("another wrong arity", "content_holds(plate_1)"),
        ("an object that is nearly right", "chop_state_Chopped(letuce_1)"),
        ("an unknown object", "chop_state_Chopped(excalibur)"),
        ("an unknown predicate that must not hold", "not happy(lettuce_1)"),
        ("no atom", "chopped lettuce_1"),
        ("a negated formula", "not (chop_state_Chopped(lettuce_1))"),
        ("a contradiction", "not content_holds(plate_1,lettuce_1)"),
    ] {
        // The task has a goal of its own, which the last one contradicts.
        let kept = if title == "a contradiction" { 2 } else { 0 };
        folder.changed("K/tasks/T1.1.json", "task.json", |task| {
            let goals = task["goal"].as_array_mut().expect("a list");
            goals.truncate(kept);
            goals.push(json!(goal));
        });
        transcript.add(title, &folder.refuses(31, "plan kitchen.json task.json -o t.plan"));
        let run = folder.run("run kitchen.json task.json --kitchen -q");
        assert_eq!((run.code, run.out.as_str()), (31, ""), "{run}");
        assert!(run.err.starts_with("error: task.json:"), "{run}");
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn tasks_that_are_wrong() {
    type Change = fn(&mut Value);
    let changes: [(&str, Change); 18] = [
        ("another version", |t| t["format"] = json!("task/2")),
        ("another kind", |t| t["format"] = json!("trace/1")),
        ("no version", |t| drop(t.as_object_mut().and_then(|t| t.remove("format")))),
        ("no goal", |t| drop(t.as_object_mut().and_then(|t| t.remove("goal")))),
        ("a goal that is no list", |t| t["goal"] = json!("free(lettuce_1)")),
        ("a goal of numbers", |t| t["goal"] = json!([1])),
        ("a negative seed", |t| t["seed"] = json!(-1)),
        ("a huge seed", |t| t["seed"] = json!(1e30)),
        ("no state", |t| drop(t.as_object_mut().and_then(|t| t.remove("state")))),
        ("an empty state", |t| t["state"] = json!({})),
        ("a state of both kinds", |t| t["state"]["objects"] = json!({})),
        ("a state that is a list", |t| t["state"] = json!([])),
        ("an unknown type", |t| t["state"]["entities"][0]["type"] = json!("agnet")),
        ("an entity twice", |t| {
            let entities = t["state"]["entities"].as_array_mut().expect("a list");
            entities.push(entities[0].clone());
        }),
        ("a relation to nothing", |t| t["state"]["entities"][0]["relations"]["holding"] = json!("nothing")),
        ("an entity without a name", |t| t["state"]["entities"][0]["id"] = json!("")),
        ("a nested attribute", |t| t["state"]["entities"][0]["attributes"]["at"] = json!([[1]])),
        ("a relation to a number", |t| t["state"]["entities"][0]["relations"]["holding"] = json!(1)),
    ];
    let folder = Folder::kitchen();
    let mut transcript = Transcript::default();
    for (title, change) in changes {
        folder.changed("K/tasks/T1.1.json", "task.json", change);
        transcript.add(title, &folder.refuses(31, "plan kitchen.json task.json -o t.plan"));
    }
    insta::assert_snapshot!(transcript.0);
}

/// A goal of nothing is reached by nothing, which is seldom what was meant.
#[test]
fn tasks_in_which_something_is_probably_not_meant() {
    let folder = Folder::kitchen();
    let with = |key: &str| {
        folder.changed("K/tasks/T1.1.json", "task.json", |task| task[key] = json!([]));
        folder.run("plan kitchen.json task.json").err
    };
    let empty = "warning: task.json: the goal is empty: it holds in every state\n";
    assert!(with("goal").contains(empty), "{}", with("goal"));
    for (key, hint) in [
        ("goals", "Did you mean `goal`?"),
        ("gaol", "Did you mean `goal`?"),
        ("aim", "A task may have format, goal, state, scenario, seed."),
    ] {
        let said = with(key);
        assert!(said.contains(&format!("warning: task.json: `{key}` is not read\nhint: {hint}\n")), "{said}");
    }
    folder.changed("K/tasks/T1.1.json", "task.json", |task| task["goal"] = json!([]));
    assert_eq!(folder.run("run kitchen.json task.json --kitchen -q").err, "");
    assert!(folder.run("run kitchen.json task.json --kitchen").err.contains(empty));
    folder.write("task.json", r#"{"format":"task/1","gaol":["free(a)"]}"#);
    let ended = folder.refuses(31, "plan kitchen.json task.json");
    assert!(
        ended.err.contains("the task has no `goal`\nhint: `gaol` is not read: is it meant to be `goal`?"),
        "{ended}"
    );
}

#[test]
fn files_that_are_no_tasks() {
    let folder = Folder::kitchen();
    let mut transcript = Transcript::default();
    for (title, text) in [
        ("an empty file", ""),
        ("cut off", "{\"format\": \"task/1\",\n \"goal\": [\"free(a)\""),
        ("not JSON", "hello"),
        ("NaN", "{\"format\": \"task/1\",\n \"goal\": [NaN]}"),
    ] {
        folder.write("task.json", text);
        transcript.add(title, &folder.refuses(31, "plan kitchen.json task.json"));
    }
    for (title, code, command) in [
        ("a trace", 31, "plan kitchen.json K/demos/cut_lettuce.jsonl"),
        ("a model", 31, "plan kitchen.json kitchen.json"),
        ("PDDL", 31, "plan kitchen.json K/types.pddl"),
        ("a folder", 31, "run kitchen.json K/tasks --kitchen"),
        ("no such file", 31, "run kitchen.json K/tasks/T1.1.json none.json --kitchen"),
    ] {
        transcript.add(title, &folder.refuses(code, command));
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn scenarios_that_the_kitchen_does_not_understand() {
    let folder = Folder::kitchen();
    let mut transcript = Transcript::default();
    for (title, scenario) in [
        ("an unknown field", json!({"colour": "red"})),
        ("no object", json!(7)),
        ("an unknown item", json!({"items": ["sofa"]})),
        ("a state that is no kitchen", json!({"state": {"entities": [{"id": "a", "type": "robot"}]}})),
    ] {
        folder.changed("K/tasks/T1.1.json", "task.json", |task| task["scenario"] = scenario);
        let ended = folder.run("run kitchen.json task.json --kitchen -q");
        assert_eq!(ended.code, 35, "{ended}");
        transcript.add(title, &ended);
    }
    insta::assert_snapshot!(transcript.0);
}
