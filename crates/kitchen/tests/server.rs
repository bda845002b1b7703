//! Conversations in the environment protocol.
#![allow(clippy::unwrap_used)]

use serde_json::{Value, json};
use typelift_kitchen::serve;

/// The answers to these lines.
fn answers(lines: &[&str]) -> Vec<Value> {
    let mut output = Vec::new();
    serve(lines.join("\n").as_bytes(), &mut output).unwrap();
    let text = String::from_utf8(output).unwrap();
    assert!(text.is_empty() || text.ends_with('\n'));
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn a_conversation() {
    let answers = answers(&[
        r#"{"id":1,"op":"hello","protocol":"env/1"}"#,
        r#"{"id":2,"op":"reset","seed":7,"scenario":{"items":["plate","lettuce"]}}"#,
        "",
        r#"{"id":3,"op":"act","action":{"name":"PICK","args":["agent_1","lettuce_1"]}}"#,
        r#"{"id":4,"op":"act","action":{"name":"PICK","args":["agent_1","plate_1"]}}"#,
        r#"{"id":5,"op":"observe"}"#,
        r#"{"id":6,"op":"reset","seed":7}"#,
        r#"{"id":7,"op":"close"}"#,
        r#"{"id":8,"op":"observe"}"#,
    ]);
    assert_eq!(answers.len(), 7, "nothing is answered after close");
    assert_eq!(answers[0], json!({"id": 1, "ok": true, "name": "kitchen", "reset": true}));
    assert_eq!(answers[1]["state"]["entities"].as_array().unwrap().len(), 33);
    assert_eq!((&answers[2]["executed"], &answers[2]["reason"]), (&json!(true), &Value::Null));
    assert_eq!(answers[3]["executed"], false);
    assert_eq!(answers[3]["reason"], "the hand already holds lettuce_1");
    assert_eq!(answers[3]["state"], answers[4]["state"]);
    assert_eq!(answers[5]["ok"], true);
    assert_eq!(answers[6], json!({"id": 7, "ok": true}));
}

#[test]
fn the_end_of_input_ends_it() {
    assert!(answers(&[]).is_empty());
    assert_eq!(answers(&[r#"{"id":1,"op":"observe"}"#]).len(), 1);
}

#[test]
fn what_cannot_be_done_is_said_and_nothing_ends() {
    let deep =
        format!(r#"{{"id":15,"op":"reset","seed":1,"scenario":{}{}}}"#, "[".repeat(100_000), "]".repeat(100_000));
    let lines = [
        ("no JSON at all", 0, "the line is not a request of env/1: this is not JSON: expected ident"),
        ("[]", 0, "the line is not a request of env/1"),
        (deep.as_str(), 15, "the line is not a request of env/1: this is nested too deeply"),
        (r#"{"op":"observe"}"#, 0, "`id` is missing"),
        (r#"{"id":-1,"op":"observe"}"#, 0, "the line is not a request of env/1"),
        (r#"{"id":3,"op":"dance"}"#, 3, "unknown word `dance`"),
        (r#"{"id":4}"#, 4, "`op` is missing"),
        (r#"{"id":5,"op":"hello","protocol":"env/2"}"#, 5, "this environment speaks env/1, not `env/2`"),
        (r#"{"id":6,"op":"observe"}"#, 6, "the kitchen has not been set up: reset comes first"),
        (r#"{"id":7,"op":"act","action":{"name":"PICK","args":[]}}"#, 7, "reset comes first"),
        (r#"{"id":8,"op":"act"}"#, 8, "`action` is missing"),
        (r#"{"id":9,"op":"reset","seed":1,"scenario":{"item":[]}}"#, 9, "unknown field `item`"),
        (r#"{"id":10,"op":"reset","scenario":{}}"#, 10, "`seed` is missing"),
        (r#"{"id":11,"op":"reset","seed":1,"scenario":{"broken":["oven_1"]}}"#, 11, "breaks `oven_1`"),
    ];
    let answers = answers(&lines.map(|(line, ..)| line));
    assert_eq!(answers.len(), lines.len());
    for (answer, (line, id, error)) in answers.iter().zip(lines) {
        assert_eq!((&answer["ok"], &answer["id"]), (&json!(false), &json!(id)));
        assert!(answer["error"].as_str().unwrap().contains(error), "{}: {answer}", &line[..line.len().min(80)]);
    }
}

#[test]
fn bytes_that_are_no_text() {
    let mut output = Vec::new();
    serve(&b"\xff\xfe\n{\"id\":1,\"op\":\"close\"}\n"[..], &mut output).unwrap();
    let text = String::from_utf8(output).unwrap();
    let answers: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((answers.len(), &answers[0]["id"], &answers[1]["ok"]), (2, &json!(0), &json!(true)));
}

#[test]
fn largest_seed() {
    let line = format!(r#"{{"id":{0},"op":"reset","seed":{0}}}"#, u64::MAX);
    let answers = answers(&[&line]);
    assert_eq!((&answers[0]["ok"], &answers[0]["id"]), (&json!(true), &json!(u64::MAX)));
}
