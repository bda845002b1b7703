//! Trace files: what is read, what is refused and with which words, and that writing and reading are inverse.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proptest::prelude::*;
use typelift_model::testing::cases;
use typelift_model::{Goal, GroundAtom, GroundCall, Hierarchy, ParseConfig, Pattern, Slot, Symbol};
use typelift_world::{
    Entity, Expected, FileError, Parser, Recording, Relation, Scene, Snapshot, Trace, TraceAction, TraceHeader,
    TraceReader, Value, Verdict, read_trace,
};

const HEADER: &str = r#"{"format":"trace/1","task":"t","goal":["free(a)"],"recorder":"x"}"#;
const STATE: &str = r#"{"state":{"objects":{"a":"block"},"atoms":["free(a)"]}}"#;
const ACTION: &str = r#"{"action":{"name":"GO","args":["a"]},"executed":false,"reason":"stuck","t":1.5,"extra":{}}"#;
const MEANT: &str = r#"{"action":{"name":"GO","args":[]},"expected":{"action":"GO-block","args":["a"],"adds":["on(a)"]},"verdict":"timed-out"}"#;

fn parser() -> Parser {
    let hierarchy = Hierarchy::from_edges([("block", "object"), ("arm", "object")]).expect("a tree");
    Parser::new(hierarchy, ParseConfig::default())
}

fn read_bytes(bytes: &[u8]) -> Result<Trace, FileError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.jsonl");
    typelift_world::write_file(&path, bytes).expect("written");
    read_trace(&path, &mut parser()).map_err(|e| FileError { file: "a.jsonl".to_owned(), ..e })
}

fn read(lines: &[&str]) -> Result<Trace, FileError> {
    read_bytes(format!("{}\n", lines.join("\n")).as_bytes())
}

fn refused(lines: &[&str]) -> String {
    read(lines).expect_err(&lines.join("\n")).to_string()
}

#[test]
fn a_trace_is_read() {
    let trace = read(&[HEADER, STATE, ACTION, STATE, "", "  "]).expect("a trace");
    assert_eq!((trace.file, trace.task.as_str()), (Some(Symbol::new("a.jsonl")), "t"));
    assert_eq!(trace.goal.required[0].to_string(), "free(a)");
    assert_eq!((trace.states.len(), trace.actions.len()), (2, 1));
    let TraceAction { call, executed, reason, time, expected, verdict } = &trace.actions[0];
    assert_eq!((call.to_string().as_str(), *executed), ("GO(a)", Some(false)));
    assert_eq!((reason.as_deref(), *time), (Some("stuck"), Some(1.5)));
    assert_eq!((expected, verdict), (&None, &None));
}

#[test]
fn what_an_agent_meant_and_how_it_judged_is_read() {
    let trace = read(&[HEADER, STATE, MEANT, STATE]).expect("a trace");
    let expected = Expected {
        action: Symbol::new("GO-block"),
        args: vec![Symbol::new("a")],
        adds: vec![GroundAtom::parse("on(a)").expect("an atom")],
        deletes: Vec::new(),
    };
    assert_eq!(trace.actions[0].expected, Some(expected));
    assert_eq!(trace.actions[0].verdict, Some(Verdict::TimedOut));
    let error = refused(&[HEADER, STATE, &MEANT.replace("\"a\"", "\"b\""), STATE]);
    assert_eq!(error, "a.jsonl:3: the action GO() mentions `b`, which is not in the state before it (line 2)");
    let error = refused(&[HEADER, STATE, &MEANT.replace("timed-out", "late"), STATE]);
    assert_eq!(
        error,
        "a.jsonl:3:113: in `verdict`: expected one of `as-expected`, `nothing`, `partly`, `otherwise`, \
         `refused`, `timed-out`, found the unknown word `late`"
    );
}

#[test]
fn line_ends_and_a_missing_last_one_do_not_matter() {
    let trace = read(&[HEADER, STATE]);
    let other = read_bytes(format!("\u{FEFF}{HEADER}\r\n{STATE}").as_bytes()).expect("a trace");
    let trace = trace.expect("a trace");
    // To another file of the same content, but for its id.
    assert_ne!(other.source, trace.source);
    assert_eq!(Trace { source: trace.source, ..other }, trace);
}

#[test]
fn the_header_comes_first_and_names_the_version() {
    assert_eq!(read_bytes(b"").expect_err("empty").to_string(), "a.jsonl: the file is empty");
    for first in [STATE, "", "hello", "[]", r#"{"task":"t"}"#] {
        assert_eq!(refused(&[first, STATE]), "a.jsonl:1: the first line is not a header");
    }
    assert_eq!(
        refused(&[r#"{"format":"trace/2","goal":7}"#]),
        "a.jsonl:1: this is a file of format `trace/2`; this version of typelift reads `trace/1`"
    );
    assert_eq!(
        refused(&[r#"{"format":"trace/1","goal":["free(a"]}"#]),
        "a.jsonl:1:37: in `goal`: `free(a` is not an atom of the form predicate(entity,entity)"
    );
    assert_eq!(
        refused(&[r#"{"format":"trace/1","goal":["free(a)","not free(a)"]}"#]),
        "a.jsonl:1:52: in `goal`: the goal contradicts itself: it has `free(a)` and `not free(a)`"
    );
    let negated = read(&[&HEADER.replace("free(a)", "not free(a)"), STATE]).expect("a trace");
    assert_eq!(negated.goal.forbidden, [GroundAtom::new("free", vec!["a".into()])]);
    let hint = read(&[STATE]).expect_err("no header").hint;
    assert_eq!(hint.as_deref(), Some(r#"It is {"format":"trace/1","task":"…","goal":["…"]}."#));
}

#[test]
fn states_and_actions_come_in_turn() {
    assert_eq!(refused(&[HEADER]), "a.jsonl:1: there is no state after the header");
    assert_eq!(refused(&[HEADER, ACTION]), "a.jsonl:2: there is no state before the first action");
    assert_eq!(
        refused(&[HEADER, STATE, ACTION, ACTION, STATE]),
        "a.jsonl:4: there is no state between this action and the one before"
    );
    assert_eq!(refused(&[HEADER, STATE, STATE]), "a.jsonl:3: there is no action between this state and the one before");
    assert_eq!(refused(&[HEADER, STATE, HEADER]), "a.jsonl:3: this line has neither a `state` nor an `action`");
    assert_eq!(
        refused(&[HEADER, r#"{"state":{"entities":[]},"action":{"name":"GO","args":[]}}"#]),
        "a.jsonl:2: this line has both a `state` and an `action`"
    );
    assert_eq!(refused(&[HEADER, STATE, "", ACTION, STATE]), "a.jsonl:3: this line is empty");
}

#[test]
fn malformed_lines_are_refused_with_their_place() {
    let broken = format!("{HEADER}\n{STATE}\n{}", &ACTION[..20]);
    assert_eq!(
        read_bytes(format!("{broken}\n").as_bytes()).expect_err("cut").to_string(),
        "a.jsonl:3:20: this line ends too early"
    );
    let mut other = format!("{HEADER}\n{{\"state\":").into_bytes();
    other.push(0xFF);
    assert_eq!(
        read_bytes(&other).expect_err("not UTF-8").to_string(),
        "a.jsonl:2:10: this is not UTF-8 text from byte 10 of the line on"
    );
    for (line, message) in [
        ("{\"state\":{}}", "a.jsonl:2: this state has neither `entities` nor `objects`"),
        ("{\"state\":{\"entities\":[],\"objects\":{}}}", "a.jsonl:2: this state has both `entities` and `objects`"),
        ("{\"state\":7}", "a.jsonl:2:10: in `state`: expected a state, found the number 7"),
        ("{\"state\" 7}", "a.jsonl:2:10: this is not JSON: expected `:`"),
        ("{\"state\":{\"entities\":[]}} x", "a.jsonl:2:27: nothing may follow after the end of the JSON text"),
        (
            "{\"state\":{\"entities\":[{\"id\":\"a\",\"type\":\"block\",\"attributes\":{\"x\":{}}}]}}",
            "a.jsonl:2:67: in `state.entities[0].attributes.x`: an attribute is true, false, a word, a number or a list of numbers",
        ),
        (
            "{\"state\":{\"entities\":[{\"id\":\"a\",\"type\":\"block\",\"relations\":{\"x\":1}}]}}",
            "a.jsonl:2:65: in `state.entities[0].relations.x`: a relation is to an entity's name, null or a list of names",
        ),
        (
            "{\"state\":{\"objects\":{\"a\":\"block\",\"a\":\"arm\"}}}",
            "a.jsonl:2:36: in `state.objects`: `a` stands here twice",
        ),
        ("{\"state\":{\"entities\":[{\"id\":\"a\"}]}}", "a.jsonl:2:32: in `state.entities[0]`: `type` is missing"),
        ("{\"action\":{\"name\":\"GO\"}}", "a.jsonl:2:23: in `action`: `args` is missing"),
    ] {
        assert_eq!(refused(&[HEADER, line]), message, "{line}");
    }
}

#[test]
fn what_is_impossible_is_refused() {
    let unknown = read(&[HEADER, r#"{"state":{"objects":{"a":"blocc"}}}"#]).expect_err("unknown type");
    assert_eq!(unknown.to_string(), "a.jsonl:2: entity a: unknown type `blocc`");
    assert_eq!(unknown.hint.as_deref(), Some("Did you mean `block`? Otherwise add it to the hierarchy."));
    let unknown = read(&[HEADER, r#"{"state":{"objects":{"a":"pyramid"}}}"#]).expect_err("unknown type");
    assert_eq!(unknown.hint.as_deref(), Some("Add it to the hierarchy."));
    assert_eq!(
        refused(&[HEADER, STATE, ACTION, r#"{"state":{"objects":{"a":"arm"}}}"#]),
        "a.jsonl:4: entity a is of type `arm` here and of type `block` in line 2"
    );
    let missing = r#"{"action":{"name":"GO","args":["a","A"]}}"#;
    let error = read(&[HEADER, STATE, missing, STATE]).expect_err("no such entity");
    assert_eq!(
        error.to_string(),
        "a.jsonl:3: the action GO(a, A) mentions `A`, which is not in the state before it (line 2)"
    );
    assert_eq!(error.hint.as_deref(), Some("Did you mean `a`?"));
    let hint = |of: &str| {
        let made = missing.replace("\"A\"", of);
        let state = STATE.replace("\"a\"", "\"block_1\"").replace("free(a)", "free(block_1)");
        read(&[HEADER, &state, &made.replace("\"a\"", "\"block_1\""), &state]).expect_err("no such entity").hint
    };
    let (numbered, unlike) = (hint("\"block_2\"").expect("a hint"), hint("\"pyramid\"").expect("a hint"));
    assert!(numbered.starts_with("Did you mean `block_1`? ") && numbered.ends_with(&unlike), "{numbered}");
    assert!(unlike.contains("a pool of ids from the start"), "{unlike}");
    let two = r#"{"state":{"entities":[{"id":"a","type":"block","attributes":{"x":"y","x_y":true}}]}}"#;
    let error = read(&[HEADER, two]).expect_err("two sources");
    assert!(error.to_string().starts_with("a.jsonl:2: entity a: the predicate `x_y` has two sources: "), "{error}");
}

#[test]
fn a_key_that_nothing_reads_is_noted_if_it_is_nearly_one_that_is_read() {
    let state =
        |key: &str| format!("{{\"state\":{{\"entities\":[{{\"id\":\"a\",\"type\":\"block\",\"{key}\":{{}}}}]}}}}");
    let warnings = |key: &str| {
        let (first, second) = (state(key), state(key));
        read(&[HEADER, &first, ACTION, &second]).expect("a trace").warnings
    };
    for key in ["attributes", "relations", "pose", "name", "idx", "types", "confidence"] {
        assert_eq!(warnings(key), [], "{key}");
    }
    for (key, known) in [("relation", "relations"), ("atributes", "attributes"), ("Attributes", "attributes")] {
        let [warning] = &warnings(key)[..] else { panic!("{key}: it is noted once") };
        assert!(warning.to_string().ends_with(&format!(":2: entity a: `{key}` is not read")), "{warning}");
        assert_eq!(warning.hint, Some(format!("Did you mean `{known}`?")));
    }
}

#[test]
fn nothing_comes_after_an_error() {
    let text = format!("{HEADER}\n{ACTION}\n{STATE}\n");
    let mut reader = TraceReader::new(Path::new("a"), text.as_bytes()).expect("a header");
    assert!(reader.next().is_some_and(|item| item.is_err()));
    assert!(reader.next().is_none());
}

/// A trace, and in words what is lost of it.
fn read_cut(bytes: &[u8]) -> (usize, Option<String>) {
    let trace = read_bytes(bytes).unwrap_or_else(|error| panic!("{error}: {}", String::from_utf8_lossy(bytes)));
    assert_eq!(trace.states.len(), trace.actions.len() + 1);
    let warnings = trace.warnings.iter().map(|warning| FileError { file: "a.jsonl".to_owned(), ..warning.clone() });
    let mut warnings = warnings.map(|warning| warning.to_string());
    (trace.actions.len(), warnings.next())
}

#[test]
fn what_is_whole_of_a_recording_that_was_cut_off_is_read() {
    let whole = [HEADER, STATE, ACTION, STATE].join("\n");
    let cut = |then: &str| read_cut(format!("{whole}\n{then}").as_bytes());
    let warning = |text: &str| (1, Some(text.to_owned()));
    assert_eq!(cut(&ACTION[..20]), warning("a.jsonl:5: the recording was cut off in this line: it is left out"));
    let both = format!("{ACTION}\n{}", &STATE[..20]);
    assert_eq!(
        cut(&both),
        warning("a.jsonl:6: the recording was cut off in this line: it is left out, and so is GO(a) before it")
    );
    assert_eq!(cut(ACTION), warning("a.jsonl:5: there is no state after GO(a): it is left out"));
    assert_eq!(cut(&format!("{ACTION}\n\n")), cut(ACTION));
    assert_eq!(cut(""), (1, None));
    assert_eq!(read_cut(format!("{whole}\n{ACTION}\n{STATE}").as_bytes()), (2, None), "only the end of the line lacks");
    let first = format!("{HEADER}\n{}", &STATE[..20]);
    let error = read_bytes(first.as_bytes()).expect_err("no state at all").to_string();
    assert_eq!(error, "a.jsonl:2:20: the last line is incomplete");
}

#[test]
fn wherever_a_recording_is_cut_off_the_steps_before_are_read() {
    let named = ACTION.replace("stuck", "schön");
    let steps = [format!("{named}\n{STATE}\n"), format!("{MEANT}\n{STATE}\n")];
    let begin = format!("{HEADER}\n{STATE}\n");
    let bytes = format!("{begin}{}{}", steps[0], steps[1]).into_bytes();
    let ends = [begin.len() - 1, begin.len() + steps[0].len() - 1, bytes.len() - 1];
    for length in ends[0]..=bytes.len() {
        let (steps, warning) = read_cut(&bytes[..length]);
        let whole = ends.iter().filter(|end| length >= **end).count() - 1;
        let between = ends.iter().any(|end| length == *end || length == end + 1);
        assert_eq!((steps, warning.is_none()), (whole, between), "{length}: {warning:?}");
    }
}

fn name() -> impl Strategy<Value = Symbol> {
    "[a-zA-Zé☃\\\\\"][a-z0-9_\\-]{0,3}".prop_map(Symbol::from)
}

fn atom() -> impl Strategy<Value = GroundAtom> {
    let word = "[a-z]{1,3}".prop_map(Symbol::from);
    (word.clone(), prop::collection::vec(word, 0..3)).prop_map(|(predicate, args)| GroundAtom { predicate, args })
}

fn pattern() -> impl Strategy<Value = Pattern<Symbol>> {
    let word = "[a-z]{1,3}".prop_map(Symbol::from);
    let slot = prop_oneof![1 => Just(Slot::Any), 2 => word.clone().prop_map(Slot::Is)];
    (word, prop::collection::vec(slot, 0..3)).prop_map(|(predicate, args)| Pattern { predicate, args })
}

fn scene() -> impl Strategy<Value = Scene> {
    let value = prop_oneof![
        any::<bool>().prop_map(Value::Bool),
        (-1e6..1e6).prop_map(Value::Number),
        name().prop_map(Value::Text),
        prop::collection::vec(-1e6..1e6, 0..3).prop_map(Value::Vector),
    ];
    let relation = prop_oneof![
        prop::option::of(name()).prop_map(Relation::One),
        prop::collection::vec(name(), 0..3).prop_map(Relation::Many),
    ];
    let map = |s| prop::collection::btree_map(name(), s, 0..3);
    let entity = (name(), name(), map(value.boxed()), prop::collection::btree_map(name(), relation, 0..3))
        .prop_map(|(id, ty, attributes, relations)| Entity { id, ty, attributes, relations });
    let symbolic = (
        prop::collection::btree_map(name(), name(), 0..3),
        prop::collection::btree_set(atom(), 0..3),
        prop::collection::btree_set(pattern(), 0..3),
    );
    prop_oneof![
        prop::collection::vec(entity, 0..3).prop_map(|entities| Scene::Snapshot(Snapshot { entities })),
        symbolic.prop_map(|(objects, atoms, unknown): (BTreeMap<_, _>, BTreeSet<_>, BTreeSet<_>)| Scene::Symbolic {
            objects,
            atoms,
            unknown
        }),
    ]
}

const VERDICTS: [Verdict; 6] =
    [Verdict::AsExpected, Verdict::Nothing, Verdict::Partly, Verdict::Otherwise, Verdict::Refused, Verdict::TimedOut];

prop_compose! {
    fn action()(
        name in name(),
        args in prop::collection::vec(name(), 0..3),
        executed in prop::option::of(any::<bool>()),
        reason in prop::option::of("\\PC{0,8}"),
        time in prop::option::of(0.0..1e6),
        expected in prop::option::of((name(), prop::collection::vec(name(), 0..3))),
        verdict in prop::option::of(prop::sample::select(VERDICTS.to_vec())),
    ) -> TraceAction {
        let expected = expected.map(|(action, args)| Expected { action, args, adds: Vec::new(), deletes: Vec::new() });
        TraceAction { call: GroundCall { name, args }, executed, reason, time, expected, verdict }
    }
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn reading_what_was_written_gives_it_back(
        task in "\\PC{0,12}",
        required in prop::collection::vec(atom(), 0..3),
        mut forbidden in prop::collection::vec(atom(), 0..3),
        first in scene(),
        steps in prop::collection::vec((action(), scene()), 0..4),
    ) {
        forbidden.retain(|atom| !required.contains(atom));
        let header = TraceHeader { task, goal: Goal { required, forbidden } };
        let recording = Recording { header, first, steps };
        let mut bytes = Vec::new();
        recording.write(&mut bytes).expect("written");
        let mut reader = TraceReader::new(Path::new("a"), bytes.as_slice()).expect("a header");
        prop_assert_eq!(reader.header(), &recording.header);
        prop_assert_eq!(reader.recording().expect("all lines"), recording);
        prop_assert_eq!(reader.warnings(), []);
    }

    #[test]
    fn any_line_is_read_or_refused(line in "\\PC{0,40}") {
        let _ = read(&[HEADER, STATE, &line]);
        let _ = read(&[&line]);
    }
}
