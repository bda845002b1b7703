//! `typelift why`: what speaks for and against a call.

use crate::common::Folder;

const TYPES: &str = r#"{"tool": "object", "saw": "tool", "axe": "tool", "stuff": "object", "wood": "stuff",
  "oak": "wood", "pine": "wood", "birch": "wood", "bone": "stuff"}"#;

/// The trace of this number of one call of `cut`, and whether it was done. `dry` says whether that held of what was to be
/// cut.
fn trace(number: usize, tool: &str, stuff: &str, dry: bool, done: bool) -> String {
    let piece = format!("piece_{number}");
    let objects = format!(r#"{{"tool_1":"{tool}","{piece}":"{stuff}"}}"#);
    let dry = if dry { format!(r#","dry({piece})""#) } else { String::new() };
    let state = |what: &str| format!(r#"{{"state":{{"objects":{objects},"atoms":["{what}({piece})"{dry}]}}}}"#);
    let flag = if done { "" } else { r#","executed":false"# };
    let action = format!(r#"{{"action":{{"name":"cut","args":["tool_1","{piece}"]{flag}}}}}"#);
    let after = state(if done { "short" } else { "long" });
    format!("{{\"format\":\"trace/1\"}}\n{}\n{action}\n{after}\n", state("long"))
}

/// A model of these traces: tool, stuff, whether it was dry, whether it was done.
fn model(traces: &[(&str, &str, bool, bool)]) -> Folder {
    let folder = Folder::new();
    folder.write("types.json", TYPES);
    std::fs::create_dir(folder.path("demos")).expect("a folder");
    for (i, (tool, stuff, dry, done)) in traces.iter().enumerate() {
        folder.write(&format!("demos/{i}.jsonl"), trace(i, tool, stuff, *dry, *done));
    }
    folder.run("learn demos --types types.json -o model.json -q").succeeds();
    folder
}

fn why(folder: &Folder, call: &str) -> serde_json::Value {
    let ended = folder.run(&format!("why model.json '{call}' --json"));
    ended.succeeds();
    serde_json::from_str(&ended.out).expect("JSON")
}

/// How likely a call works, in hundredths, and what is suspected first.
fn asked(folder: &Folder, call: &str) -> (u64, String) {
    let said = why(folder, call);
    let first = &said["suspects"][0];
    let first = format!("{} {}", first["kind"].as_str().unwrap_or("none"), first["what"].as_str().unwrap_or(""));
    ((100.0 * said["p"].as_f64().expect("a chance")).round() as u64, first)
}

const WORKED: [(&str, &str, bool, bool); 3] =
    [("saw", "oak", true, true), ("saw", "pine", true, true), ("axe", "oak", true, true)];

#[test]
fn what_never_failed_works_as_far_as_it_was_generalized() {
    let folder = model(&WORKED);
    assert_eq!(asked(&folder, "cut(saw, oak)"), (100, "none ".to_owned()));
    // Birch is wood, as oak and pine are.
    assert_eq!(asked(&folder, "cut(saw, birch)").0, 100);
    // Bone is no wood: less likely, since imagined.
    let (chance, first) = asked(&folder, "cut(saw, bone)");
    assert!(chance < 50, "{chance}");
    assert_eq!(first, "type bone");
}

#[test]
fn the_type_that_never_worked_is_blamed_and_its_kin_is_not() {
    let folder = model(&[&WORKED[..], &[("saw", "bone", true, false)]].concat());
    let (chance, first) = asked(&folder, "cut(saw, bone)");
    assert!(chance < 30, "{chance}");
    assert_eq!(first, "type bone");
    assert!(asked(&folder, "cut(saw, birch)").0 > 60);
    assert!(asked(&folder, "cut(saw, oak)").0 > 90);
}

#[test]
fn a_type_that_works_with_another_tool_is_cleared_and_the_pair_is_left() {
    let bone = [("saw", "bone", true, false), ("axe", "bone", true, true)];
    let folder = model(&[&WORKED[..], &bone].concat());
    let (once, first) = asked(&folder, "cut(saw, bone)");
    // It may have been chance, which is about a third as likely as an exception.
    assert!((15..35).contains(&once), "{once}");
    assert_eq!(first, "pair saw with bone");
    assert!(asked(&folder, "cut(axe, bone)").0 > 80);
    let folder = model(&[&WORKED[..], &bone, &bone[..1]].concat());
    let (twice, first) = asked(&folder, "cut(saw, bone)");
    assert!(twice < 5, "{twice}");
    assert_eq!(first, "pair saw with bone");
    assert!(asked(&folder, "cut(saw, oak)").0 > 90);
}

#[test]
fn what_was_seen_very_often_is_no_less_certain() {
    let refused = vec![("saw", "bone", true, false); 40];
    let worked = vec![("saw", "oak", true, true); 40];
    let folder = model(&[&WORKED[..], &worked, &refused, &[("saw", "oak", true, false)]].concat());
    let (bone, first) = asked(&folder, "cut(saw, bone)");
    assert!(bone < 5, "{bone}");
    assert_eq!(first, "type bone");
    // Once in forty times it failed.
    assert!(asked(&folder, "cut(saw, oak)").0 > 90);
}

#[test]
fn a_literal_that_no_success_did_without_is_blamed_where_the_types_are_cleared() {
    let folder = model(&[&WORKED[..], &[("saw", "oak", false, false), ("saw", "pine", false, false)]].concat());
    folder.write(
        "wet.json",
        r#"{"format":"task/1","goal":["short(piece_1)"],
            "state":{"objects":{"tool_1":"saw","piece_1":"oak"},"atoms":["long(piece_1)"]}}"#,
    );
    let wet = why(&folder, "cut(tool_1, piece_1)' --task 'wet.json");
    assert!(wet["p"].as_f64().expect("a chance") < 0.1, "{wet}");
    assert_eq!((&wet["suspects"][0]["kind"], &wet["suspects"][0]["what"]), (&"literal".into(), &"dry(piece_1)".into()));
    assert!(asked(&folder, "cut(saw, oak)").0 > 90, "dry oak is cut");
}

#[test]
fn calls_of_a_file_are_answered_line_for_line() {
    let folder = model(&WORKED);
    folder.write(
        "calls.jsonl",
        concat!(
            r#"{"call":{"name":"cut","args":["a","b"]},"types":{"a":"saw","b":"oak"}}"#,
            "\n",
            r#"{"call":{"name":"cut","args":["a","b"]},"state":{"objects":{"a":"saw","b":"oak"},"atoms":[]}}"#,
            "\n",
            r#"{"call":{"name":"paint","args":["a"]},"types":{"a":"saw"}}"#,
        ),
    );
    let ended = folder.run("why model.json --calls calls.jsonl --json");
    assert_eq!(ended.code, 12, "{ended}");
    let lines: Vec<serde_json::Value> =
        ended.out.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.len(), 3);
    assert_eq!((lines[0]["p"].as_f64(), lines[0]["unknown"].as_bool()), (Some(1.0), Some(false)));
    assert!(lines[1]["p"].as_f64() < Some(0.5), "nothing that always held holds there: {}", lines[1]);
    assert_eq!(lines[2]["unknown"].as_bool(), Some(true));
}

#[test]
fn what_is_refused() {
    let folder = model(&WORKED);
    folder.write("calls.jsonl", "{\"call\":{\"name\":\"cut\",\"args\":[]}}\n{\"cal\":1}\n");
    let refused = folder.refuses(31, "why model.json --calls calls.jsonl");
    assert!(refused.err.contains("calls.jsonl:2"), "{refused}");
    folder.write("domain.pddl", "(define (domain d) (:predicates (p)) (:action a :effect (p)))");
    assert!(folder.refuses(31, "why domain.pddl 'a()'").err.contains("only what was learned"));
    assert!(folder.refuses(36, "why model.json 'cut(saw'").err.contains("PICK("));
    assert_eq!(folder.run("why model.json").code, 36);
}

#[test]
fn what_is_unknown_is_said() {
    let folder = model(&WORKED);
    let said = |call: &str| {
        let ended = folder.run(&format!("why model.json '{call}'"));
        assert_eq!(ended.code, 12, "{ended}");
        ended.err
    };
    assert!(said("cutt(saw, oak)").contains("Did you mean `cut`?"));
    assert!(said("cut(saw)").contains("cut takes 2 arguments"));
    let robot = said("cut(robot_1, oak)");
    assert!(robot.contains("of which type `robot_1` is") && robot.contains("--task"), "{robot}");
}

/// Tools and stuff are things, and nothing more: neither may take the place of the other, whatever failed elsewhere.
#[test]
fn what_the_types_keep_apart_is_next_to_nothing() {
    for traces in [&WORKED[..], &[&WORKED[..], &[("saw", "bone", true, false)]].concat()] {
        let folder = model(traces);
        for swapped in ["cut(oak, saw)", "cut(saw, axe)", "cut(pine, oak)"] {
            assert!(asked(&folder, swapped).0 <= 2, "{swapped}: {}", why(&folder, swapped));
        }
        assert!(asked(&folder, "cut(tool, oak)").0 > 30, "a saw is a tool");
    }
    // It worked after all.
    let folder = model(&[&WORKED[..], &[("oak", "pine", true, true)]].concat());
    assert!(asked(&folder, "cut(oak, pine)").0 > 90);
}

#[test]
fn what_the_percentages_are_of_is_said() {
    let folder = model(&[&WORKED[..], &[("saw", "bone", true, false)]].concat());
    let said = folder.run("why model.json 'cut(saw, bone)'");
    let lines: Vec<&str> = said.out.lines().collect();
    assert!(lines[0].starts_with("cut(saw, bone): works with "), "{said}");
    assert_eq!(lines[1], "  not as the model is: bone is no wood");
    assert_eq!(lines[2], "  of what speaks against it:");
    assert!(lines[3].ends_with(" %  bone may not be accepted in its place"), "{said}");
    let settled = model(&WORKED).run("why model.json 'cut(saw, oak)'");
    assert_eq!(settled.out.lines().count(), 1, "nothing does: {settled}");
}

#[test]
fn a_trace_is_asked_in_its_last_state() {
    let folder = model(&WORKED);
    // It was long before, and is short now.
    let ended = folder.run("why model.json 'cut(tool_1, piece_0)' --task demos/0.jsonl --json");
    ended.succeeds();
    let first = serde_json::from_str::<serde_json::Value>(&ended.out).expect("JSON")["suspects"][0]["what"].clone();
    assert_eq!(first, "long(piece_0)", "{ended}");
}

#[test]
fn of_what_is_not_in_the_state_nothing_is_known() {
    let folder = model(&WORKED);
    let ended = folder.run("why model.json 'cut(saw, oak)' --task demos/0.jsonl");
    ended.succeeds();
    assert!(ended.out.contains("works with 1.00"), "no literal is held against it: {ended}");
    assert_eq!(
        ended.err,
        "hint: `saw` is not in the state, so nothing that holds of it is known; of type saw there: tool_1\n\
         hint: `oak` is not in the state, so nothing that holds of it is known; of type oak there: piece_0\n"
    );
    let none = folder.run("why model.json 'cut(tool_1, pine)' --task demos/0.jsonl");
    assert!(none.err.ends_with("; of type pine there: none\n"), "{none}");
}

#[test]
fn what_the_model_alone_does_not_allow_is_said_beside_how_likely_it_works() {
    let folder = model(&WORKED);
    let unmet = |command: &str| why_json(&folder, command)["unmet"].clone();
    assert_eq!(unmet("why model.json 'cut(saw, bone)'"), serde_json::json!(["bone is no wood"]));
    assert!(unmet("why model.json 'cut(saw, birch)'").is_null());
    let task = |dry: &str| {
        format!(
            r#"{{"format":"task/1","goal":["short(piece_1)"],"state":{{"objects":{{"tool_1":"saw","piece_1":"oak"}},"atoms":["long(piece_1)"{dry}]}}}}"#
        )
    };
    folder.write("wet.json", task(""));
    folder.write("dry.json", task(r#","dry(piece_1)""#));
    let cut = |task: &str| format!("why model.json 'cut(tool_1, piece_1)' --task {task}");
    assert_eq!(unmet(&cut("wet.json")), serde_json::json!(["dry(piece_1) does not hold"]));
    assert!(unmet(&cut("dry.json")).is_null());
    let said = folder.run(&cut("wet.json"));
    assert!(said.out.contains("\n  not as the model is: dry(piece_1) does not hold\n"), "{said}");
    assert!(folder.run(&cut("dry.json")).out.starts_with("cut(tool_1, piece_1): works with 1.00, by "));
}

/// What a crane drops is what it holds; the call does not say it.
#[test]
fn what_a_call_does_not_name_must_be_there() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"crane": "object", "crate": "object"}"#);
    let state = |atoms: &str| format!(r#"{{"objects":{{"k":"crane","c":"crate"}},"atoms":[{atoms}]}}"#);
    let (held, dropped) = (state(r#""holds(k,c)""#), state(r#""down(c)""#));
    let drop = r#"{"action":{"name":"drop","args":["k"]}}"#;
    folder.write(
        "drop.jsonl",
        format!("{{\"format\":\"trace/1\"}}\n{{\"state\":{held}}}\n{drop}\n{{\"state\":{dropped}}}\n"),
    );
    folder.run("learn drop.jsonl --types types.json -o model.json -q").succeeds();
    for (state, unmet) in
        [(held, serde_json::Value::Null), (dropped, serde_json::json!(["nothing there is such that holds(k,a crate)"]))]
    {
        folder.write("task.json", format!(r#"{{"format":"task/1","goal":["down(c)"],"state":{state}}}"#));
        assert_eq!(why_json(&folder, "why model.json 'drop(k)' --task task.json")["unmet"], unmet);
    }
}

fn why_json(folder: &Folder, command: &str) -> serde_json::Value {
    let ended = folder.run(&format!("{command} --json"));
    ended.succeeds();
    serde_json::from_str(&ended.out).expect("JSON")
}
