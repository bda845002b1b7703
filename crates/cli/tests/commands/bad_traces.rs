//! Traces that are wrong: where, what is wrong, what to do; and an earlier model is kept.

use crate::common::{Ended, Folder, Transcript};

const HEADER: &str = r#"{"format":"trace/1","task":"open a box","goal":["open(box_1)"]}"#;
const SHUT: &str = r#"{"state":{"entities":[{"id":"robot_1","type":"robot","relations":{"holding":null}},{"id":"box_1","type":"box","attributes":{"shut":true}}]}}"#;
const OPEN: &str = r#"{"state":{"entities":[{"id":"robot_1","type":"robot","relations":{"holding":null}},{"id":"box_1","type":"box","attributes":{"open":true}}]}}"#;
const ACT: &str = r#"{"action":{"name":"OPEN","args":["robot_1","box_1"]}}"#;

const LEARN: &str = "learn trace.jsonl --types types.pddl -o model.json";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("types.pddl", "(:types box ball - thing robot)");
    folder.write("model.json", "an earlier model");
    folder
}

fn refused(folder: &Folder, trace: impl AsRef<[u8]>) -> Ended {
    folder.write("trace.jsonl", trace);
    folder.refuses(31, LEARN)
}

fn state(entities: &str) -> String {
    format!("{{\"state\":{{\"entities\":[{entities}]}}}}")
}

#[test]
fn what_is_missing() {
    let folder = folder();
    let mut transcript = Transcript::default();
    let mut case = |title: &str, lines: &[&str]| {
        transcript.add(title, &refused(&folder, lines.join("\n") + "\n"));
    };
    case("two actions in a row", &[HEADER, SHUT, ACT, ACT, OPEN]);
    case("two states in a row", &[HEADER, SHUT, OPEN]);
    case("an action before the first state", &[HEADER, ACT, OPEN]);
    case("a header alone", &[HEADER]);
    case("no header", &[SHUT, ACT, OPEN]);
    case("an empty line within", &[HEADER, SHUT, "", ACT, OPEN]);
    case("neither state nor action", &[HEADER, SHUT, "{}"]);
    case("no arguments", &[HEADER, SHUT, r#"{"action":{"name":"OPEN"}}"#, OPEN]);
    transcript.add("an empty file", &refused(&folder, ""));
    transcript.add("a blank file", &refused(&folder, " \n\n"));
    transcript.add("a first state that is cut off", &refused(&folder, format!("{HEADER}\n{}", &SHUT[..60])));
    transcript.add("a line that is cut off", &refused(&folder, format!("{HEADER}\n{}\n{ACT}\n{OPEN}\n", &SHUT[..60])));
    transcript.add("a header that is cut off", &refused(&folder, &HEADER[..30]));
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn what_is_no_trace() {
    let folder = folder();
    let mut transcript = Transcript::default();
    transcript.add("not JSON", &refused(&folder, "hello\n"));
    transcript.add("not JSON below the header", &refused(&folder, format!("{HEADER}\nhello\n")));
    transcript.add("a list", &refused(&folder, format!("{HEADER}\n[1, 2]\n")));
    transcript.add("another version", &refused(&folder, HEADER.replace("trace/1", "trace/2")));
    transcript.add("a task", &refused(&folder, "{\n  \"format\": \"task/1\",\n  \"goal\": []\n}\n"));
    transcript.add("a task in one line", &refused(&folder, "{\"format\":\"task/1\",\"goal\":[]}\n"));
    transcript.add("not UTF-8", &refused(&folder, b"\xff\xfe{\0"));
    let mut other = format!("{HEADER}\n{{\"state\":").into_bytes();
    other.extend(b"\xe9\"}");
    transcript.add("not UTF-8 below the header", &refused(&folder, other));
    transcript.add("a goal that is no atom", &refused(&folder, HEADER.replace("(box_1)", "(box_1")));
    let mut read = |title: &str, command: &str| transcript.add(title, &folder.refuses(31, command));
    read("no such file", "learn nothing.jsonl --types types.pddl -o model.json");
    std::fs::create_dir(folder.path("empty")).expect("made");
    read("an empty folder", "learn empty --types types.pddl -o model.json");
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn what_is_impossible() {
    let folder = folder();
    let mut transcript = Transcript::default();
    let mut case = |title: &str, lines: &[&str]| {
        transcript.add(title, &refused(&folder, lines.join("\n") + "\n"));
    };
    case("an unknown type", &[HEADER, &SHUT.replace("\"box\"", "\"boxx\""), ACT, OPEN]);
    case("an unknown type like no other", &[HEADER, &SHUT.replace("\"box\"", "\"fork\""), ACT, OPEN]);
    case("an entity of another type than before", &[HEADER, SHUT, ACT, &OPEN.replace("\"box\"", "\"ball\"")]);
    case("an action on nothing", &[HEADER, SHUT, &ACT.replace("box_1", "box_2"), OPEN]);
    case("an action without a name", &[HEADER, SHUT, &ACT.replace("OPEN", ""), OPEN]);
    case("an action whose name has a space", &[HEADER, SHUT, &ACT.replace("OPEN", "open it"), OPEN]);
    case("an entity twice", &[HEADER, &state(r#"{"id":"a","type":"box"},{"id":"a","type":"box"}"#)]);
    case("an entity without a name", &[HEADER, &state(r#"{"id":"","type":"box"}"#)]);
    case("an entity whose name has a space", &[HEADER, &state(r#"{"id":"the box","type":"box"}"#)]);
    case("an entity without a type", &[HEADER, &state(r#"{"id":"a"}"#)]);
    case("an entity whose name is a number", &[HEADER, &state(r#"{"id":1,"type":"box"}"#)]);
    case("a relation to nothing", &[HEADER, &state(r#"{"id":"a","type":"box","relations":{"on":"b"}}"#)]);
    let two = r#"{"id":"a","type":"box","attributes":{"lid":"open","lid_open":true}}"#;
    case("two sources of one atom", &[HEADER, &state(two)]);
    case("an attribute twice", &[HEADER, &state(r#"{"id":"a","type":"box","attributes":{"x":true,"x":false}}"#)]);
    case("a relation twice", &[HEADER, &state(r#"{"id":"a","type":"box","relations":{"x":null,"x":[]}}"#)]);
    case("a list of entities twice", &[HEADER, r#"{"state":{"entities":[],"entities":[]}}"#]);
    case("a value that has a space", &[HEADER, &state(r#"{"id":"a","type":"box","attributes":{"lid":"half open"}}"#)]);
    case("a nested value", &[HEADER, &state(r#"{"id":"a","type":"box","attributes":{"at":{"x":1}}}"#)]);
    case("NaN", &[HEADER, &state(r#"{"id":"a","type":"box","attributes":{"at":NaN}}"#)]);
    case("a NaN in a vector", &[HEADER, &state(r#"{"id":"a","type":"box","attributes":{"at":[0.5, -Infinity]}}"#)]);
    case("a number out of range", &[HEADER, &state(r#"{"id":"a","type":"box","attributes":{"at":1e999}}"#)]);
    let symbolic = |atoms: &str| format!("{{\"state\":{{\"objects\":{{\"a\":\"box\"}},\"atoms\":[{atoms}]}}}}");
    case("an atom that is none", &[HEADER, &symbolic(r#""open(a""#)]);
    case("an atom over nothing", &[HEADER, &symbolic(r#""open(b)""#)]);
    case("entities and objects", &[HEADER, r#"{"state":{"entities":[],"objects":{}}}"#]);
    case(
        "names that PDDL does not tell apart",
        &[
            HEADER,
            &symbolic(r#""Ready(a)""#),
            r#"{"action":{"name":"CHANGE","args":["a"]}}"#,
            &symbolic(r#""ready(a)""#),
        ],
    );
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn deep_nesting_is_refused() {
    let deep = format!("{HEADER}\n{}", state(&"[".repeat(100_000)));
    let ended = refused(&folder(), deep);
    assert!(ended.err.starts_with("error: trace.jsonl:2:"), "{ended}");
}

#[test]
fn a_line_over_the_limit_is_refused() {
    use std::io::Write;
    let folder = folder();
    let file = std::fs::File::create(folder.path("trace.jsonl")).expect("made");
    let mut out = std::io::BufWriter::new(file);
    write!(out, "{HEADER}\n{{\"state\":{{\"entities\":[{{\"id\":\"").expect("written");
    let chunk = [b'x'; 1 << 16];
    for _ in 0..(64 << 20) / chunk.len() {
        out.write_all(&chunk).expect("written");
    }
    out.flush().expect("written");
    let ended = folder.run(LEARN);
    assert_eq!(
        ended.err,
        "error: trace.jsonl:2: this line is longer than 64 MB\n\
         hint: Leave out of the states what gives no atoms, such as images.\n"
    );
    assert_eq!((ended.code, folder.read("model.json").as_str()), (31, "an earlier model"));
}

#[test]
fn one_bad_trace_among_good_ones() {
    let folder = folder();
    folder.write("a.jsonl", [HEADER, SHUT, ACT, OPEN].join("\n"));
    folder.write("b.jsonl", [HEADER, SHUT, ACT, SHUT, ACT, ACT].join("\n"));
    let ended = folder.refuses(31, "learn a.jsonl b.jsonl --types types.pddl -o model.json");
    let what = "error: b.jsonl:6: there is no state between this action and the one before\nhint: ";
    assert!(ended.err.starts_with(what), "{ended}");
}

#[test]
fn what_is_whole_of_a_recording_that_was_cut_off_is_learned_from() {
    let folder = folder();
    let whole = [HEADER, SHUT, ACT, OPEN].join("\n");
    let mut transcript = Transcript::default();
    let mut case = |title: &str, then: &str| {
        folder.write("trace.jsonl", format!("{whole}\n{then}"));
        transcript.add(title, &folder.run(LEARN));
    };
    case("in an action", &ACT[..20]);
    case("after an action", &format!("{ACT}\n"));
    case("in the state after it", &format!("{ACT}\n{}", &SHUT[..60]));
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn what_is_unusual_but_right() {
    let folder = folder();
    let good = [HEADER, SHUT, ACT, OPEN];
    let learns = |title: &str, trace: String| {
        folder.write("trace.jsonl", trace);
        let ended = folder.run(LEARN);
        assert!(ended.code == 0 && ended.out.contains("1 individual action"), "{title}: {ended}");
        // But for the source's id, the SHA-256 of the file's bytes.
        let model = folder.read("model.json");
        model.lines().filter(|line| !line.trim_start().starts_with("\"id\": ")).collect::<Vec<_>>().join("\n")
    };
    let expected = learns("as it is", good.join("\n") + "\n");
    assert!(learns("no end of the last line", good.join("\n")) == expected);
    assert!(learns("line ends of another system", good.join("\r\n") + "\r\n") == expected);
    assert!(learns("a byte order mark", format!("\u{FEFF}{}\n", good.join("\n"))) == expected);
    assert!(learns("empty lines at the end", format!("{}\n\n\n", good.join("\n"))) == expected);
    let more = good.map(|line| line.replacen('{', "{\"note\": [1, {\"x\": null}], ", 1));
    assert!(learns("fields that nobody knows", more.join("\n") + "\n") == expected);
    let numbers = good.map(|line| line.replace("\"shut\":true", "\"shut\":true,\"n\":123456789012345678901234567890"));
    assert!(learns("a large number", numbers.join("\n") + "\n") == expected);
    learns("names in other scripts", good.map(|line| line.replace("box_1", "кутия_1")).join("\n"));
}

#[test]
fn keys_that_are_nearly_known() {
    let folder = folder();
    let mut transcript = Transcript::default();
    let misspelled = [HEADER, SHUT, ACT, OPEN].join("\n").replace("relations", "relation");
    folder.write("trace.jsonl", misspelled.replace(r#""attributes":{"open""#, r#""atributes":{"open""#));
    transcript.add("misspelled", &folder.run(LEARN));
    transcript.add("misspelled, quiet", &folder.run(&format!("{LEARN} -q")));
    let pose = r#""type":"box","pose":[0,1],"#;
    folder.write("trace.jsonl", [HEADER, SHUT, ACT, OPEN].join("\n").replace(r#""type":"box","#, pose));
    transcript.add("not known at all", &folder.run(LEARN));
    let state = &SHUT[..SHUT.len() - 1].replace("attributes", "Attributes")[1..];
    folder.write("task.json", format!(r#"{{"format":"task/1","goal":["open(box_1)"],{state}}}"#));
    transcript.add("in a task", &folder.run("plan model.json task.json"));
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn many_warnings_are_not_all_said() {
    let folder = folder();
    let misspelled = [HEADER, SHUT, ACT, OPEN].join("\n").replace("relations", "relation");
    std::fs::create_dir(folder.path("shown")).expect("made");
    for number in 0..7 {
        // Empty lines at the end say nothing, and make another file.
        folder.write(&format!("shown/{number}.jsonl"), format!("{misspelled}{}", "\n".repeat(number)));
    }
    insta::assert_snapshot!(folder.run("learn shown --types types.pddl -o model.json").err);
}
