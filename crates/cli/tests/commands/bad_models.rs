//! Model files that are wrong.

use serde_json::{Value, json};

use crate::common::{Folder, Transcript};

#[test]
fn models_that_are_none() {
    let folder = Folder::kitchen();
    let mut transcript = Transcript::default();
    let text = folder.read("kitchen.json");
    for (title, text) in [
        ("an empty file", String::new()),
        ("cut off", text[..text.len() / 3].to_owned()),
        ("another version", text.replacen("model/2", "model/3", 1)),
        ("no version", text.replacen("\"format\"", "\"form\"", 1)),
        ("a number as version", text.replacen("\"model/2\"", "1", 1)),
        ("not JSON", "hello".to_owned()),
        ("a JSON list", "[]".to_owned()),
        ("something after the end", format!("{text}\n{{}}")),
    ] {
        folder.write("model.json", text);
        for command in ["show model.json", "plan model.json K/tasks/T1.1.json -o t.plan"] {
            let ended = folder.refuses(31, command);
            assert!(ended.err.starts_with("error: model.json:"), "{title}: {ended}");
            if command.starts_with("plan") {
                transcript.add(title, &ended);
            }
        }
    }
    for (title, code, command) in [
        ("a task first", 31, "plan K/tasks/T1.1.json kitchen.json"),
        ("a trace", 31, "show K/demos/cut_lettuce.jsonl"),
        ("PDDL", 31, "plan K/types.pddl K/tasks/T1.1.json"),
        ("a folder", 31, "plan K K/tasks/T1.1.json"),
        ("no such file", 31, "plan none.json K/tasks/T1.1.json"),
    ] {
        transcript.add(title, &folder.refuses(code, command));
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn models_that_contradict_themselves() {
    type Change = fn(&mut Value);
    let changes: [(&str, Change); 29] = [
        ("a cycle of types", |m| m["types"] = json!([["a", "b"], ["b", "a"]])),
        ("half a pair of types", |m| push(&mut m["types"], json!(["alone"]))),
        ("a type with a space", |m| push(&mut m["types"], json!(["two words", "food"]))),
        ("an unknown type", |m| m["actions"][0]["parameters"][0][1] = json!("fork")),
        ("an unknown actor", |m| m["actor"] = json!("nobody")),
        ("a parameter out of range", |m| m["actions"][0]["preconditions"][0] = json!("content_holds(?9,?1)")),
        ("an argument out of range", |m| m["actions"][0]["call"]["args"][0] = json!("?3")),
        ("an argument that is none", |m| m["actions"][0]["call"]["args"][0] = json!("?99999999999")),
        ("an inequality out of range", |m| m["actions"][0]["distinct"] = json!([[7, 0]])),
        ("an inequality with itself", |m| m["actions"][0]["distinct"] = json!([[0, 0]])),
        ("an unknown predicate", |m| m["actions"][0]["preconditions"][0] = json!("asleep(?1)")),
        ("a wrong arity", |m| m["actions"][0]["preconditions"][0] = json!("free(?1,?0)")),
        ("a huge arity", |m| m["predicates"]["huge"] = json!(vec!["object"; 300])),
        ("names that PDDL does not tell apart", |m| m["predicates"]["FREE"] = json!(["object"])),
        ("an action twice", |m| m["actions"][0]["name"] = m["actions"][1]["name"].clone()),
        ("an action without a name", |m| m["actions"][0]["name"] = json!("")),
        ("a name that is none", |m| m["actions"][0]["call"]["name"] = json!("USE (it)")),
        ("a parameter twice", |m| m["actions"][0]["parameters"][1][0] = json!("x0")),
        ("too many parameters", |m| {
            m["actions"][0]["parameters"] = (0..300_000).map(|i| json!([format!("x{i}"), "food"])).collect();
        }),
        ("too many preconditions", |m| m["actions"][0]["preconditions"] = vec![json!("free(?1)"); 50_000].into()),
        ("a negative cost", |m| m["actions"][0]["cost"] = json!(-1)),
        ("no call", |m| drop(m["actions"][0].as_object_mut().and_then(|action| action.remove("call")))),
        ("evidence that is not there", |m| m["actions"][0]["provenance"]["generalized"][0]["cluster"] = json!(999)),
        ("evidence about more", |m| m["evidence"]["clusters"][0]["adds"] = json!(["free(?99)"])),
        ("evidence beyond counting", |m| m["evidence"]["clusters"][0]["seen"][0]["count"] = json!(u64::MAX)),
        ("a source that is not there", |m| m["evidence"]["clusters"][0]["seen"][0]["source"] = json!(99)),
        ("no source", |m| m["evidence"]["clusters"][0]["seen"][0]["source"] = json!(null)),
        ("one source twice", |m| m["evidence"]["sources"][1] = m["evidence"]["sources"][0].clone()),
        ("an id that is none", |m| m["evidence"]["sources"][0]["id"] = json!("abc")),
    ];
    let folder = Folder::kitchen();
    let mut transcript = Transcript::default();
    for (title, change) in changes {
        folder.changed("kitchen.json", "model.json", change);
        for command in ["show model.json", "show model.json --pddl", "plan model.json K/tasks/T1.1.json -o t.plan"] {
            let ended = folder.refuses(31, command);
            assert!(ended.err.starts_with("error: model.json:") && ended.err.contains("\nhint: "), "{title}: {ended}");
            if command.starts_with("plan") {
                transcript.add(title, &ended);
            }
        }
    }
    insta::assert_snapshot!(transcript.0);
}

fn push(list: &mut Value, value: Value) {
    list.as_array_mut().expect("a list").push(value);
}

#[test]
fn models_that_are_odd_but_right() {
    let folder = Folder::kitchen();
    folder.changed("kitchen.json", "model.json", |m| m["actions"] = json!([]));
    folder.run("show model.json").succeeds();
    let none = folder.run("plan model.json K/tasks/T1.1.json --imagine");
    assert!(none.code == 11 && none.err.contains("no action can add it"), "{none}");
    folder.changed("kitchen.json", "model.json", |m| {
        for action in m["actions"].as_array_mut().expect("a list") {
            action["cost"] = json!(u32::MAX);
        }
    });
    let costly = folder.run("plan model.json K/tasks/T1.1.json -o t.plan");
    costly.succeeds();
    assert!(folder.read("t.plan").ends_with(&format!("; cost = {} (general cost)\n", 5 * u64::from(u32::MAX))));
    folder.changed("kitchen.json", "model.json", |m| m["invented_later"] = json!({"by": "a newer version"}));
    folder.run("plan model.json K/tasks/T1.1.json").succeeds();
}
