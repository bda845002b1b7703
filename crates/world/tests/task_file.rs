//! Task files: what is read, what is refused and with which words, and that writing and reading are inverse.

use std::path::Path;

use proptest::prelude::*;
use serde_json::json;
use typelift_model::testing::cases;
use typelift_model::{ArgumentTypes, Goal, GroundAtom, Hierarchy, ParseConfig, Symbol, Task};
use typelift_world::{FileError, Parser, Scene, TaskFile, read_task, write_file, write_task};

fn read(text: &str) -> Result<TaskFile, FileError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("task.json");
    write_file(&path, text.as_bytes()).expect("written");
    read_task(&path).map_err(|e| FileError { file: "task.json".to_owned(), ..e })
}

fn parser() -> Parser {
    let hierarchy = Hierarchy::from_edges([("block", "object")]).expect("a tree");
    Parser::new(hierarchy, ParseConfig::default())
}

fn predicates() -> ArgumentTypes {
    let block = parser().hierarchy().id("block").expect("a type");
    [("on_top", 2), ("free", 1)].map(|(name, arity)| (Symbol::new(name), vec![block; arity])).into()
}

fn task(goal: &str) -> Result<String, (String, Option<String>)> {
    let text = format!(
        r#"{{"format":"task/1","goal":["{goal}"],"state":{{"objects":{{"block_1":"block"}},"atoms":["free(block_1)"]}}}}"#
    );
    let mut parser = parser();
    match read(&text).expect("a file").task(&mut parser, &predicates()) {
        Ok(Task { goal, init, .. }) => {
            Ok(format!("{:?} without {:?} from {:?}", goal.required, goal.forbidden, init.atoms))
        }
        Err(error) => {
            let error = error.in_file(Path::new("task.json"), &parser);
            Err((error.to_string(), error.hint))
        }
    }
}

#[test]
fn with_a_state_or_a_scenario() {
    assert_eq!(task("free(block_1)"), Ok("[free(block_1)] without [] from {free(block_1)}".to_owned()));
    assert_eq!(task("not free(block_1)"), Ok("[] without [free(block_1)] from {free(block_1)}".to_owned()));
    let file = read(r#"{"format":"task/1","goal":[],"scenario":{"level":3},"seed":18446744073709551615,"note":""}"#)
        .expect("a file");
    assert_eq!((file.state, file.seed), (None, Some(u64::MAX)));
    assert_eq!(file.scenario, Some(json!({"level": 3})));
}

#[test]
fn goals_are_checked_against_state_and_model() {
    let failed = |goal| task(goal).expect_err(goal);
    let hint = |text: &str| Some(text.to_owned());
    assert_eq!(
        failed("on_to(block_1,block_1)"),
        (
            "task.json: in the goal on_to(block_1,block_1): the model has no predicate `on_to`".to_owned(),
            hint("Did you mean `on_top`?")
        )
    );
    assert_eq!(
        failed("free(block_1,block_1)"),
        (
            "task.json: in the goal free(block_1,block_1): `free` takes 1 argument, not 2".to_owned(),
            hint("Write `free(x1)`, with the names of entities.")
        )
    );
    assert_eq!(
        failed("free(Block_1)"),
        (
            "task.json: in the goal free(Block_1): there is no `Block_1` in the state".to_owned(),
            hint("Did you mean `block_1`?")
        )
    );
}

#[test]
fn states_are_checked() {
    let mut parser = parser();
    let mut failed = |text: &str| {
        let error = read(text).expect("a file").task(&mut parser, &predicates()).expect_err(text);
        let error = error.in_file(Path::new("task.json"), &parser);
        (error.to_string(), error.hint.unwrap_or_default())
    };
    let unknown = r#"{"format":"task/1","goal":[],"state":{"objects":{"a":"blocks"}}}"#;
    assert_eq!(
        failed(unknown),
        (
            "task.json: in the state: entity a: unknown type `blocks`".to_owned(),
            "Did you mean `block`? Otherwise add it to the hierarchy.".to_owned()
        )
    );
    let none = r#"{"format":"task/1","goal":[],"scenario":1}"#;
    assert_eq!(failed(none).0, "task.json: the task has no `state` to plan from");
}

#[test]
fn what_is_refused() {
    for (text, message) in [
        ("", "task.json: the file is empty"),
        ("{}", "task.json: there is no \"format\":\"task/1\": this is not a task file"),
        (
            r#"{"format":"task/2","goal":3}"#,
            "task.json: this is a file of format `task/2`; this version of typelift reads `task/1`",
        ),
        ("{\"format\":\"task/1\"}", "task.json: the task has no `goal`"),
        (
            "{\"format\":\"task/1\",\n \"goal\":[\"free(a)\",\n  \"free(a\"]}",
            "task.json:3:11: in `goal`: `free(a` is not an atom of the form predicate(entity,entity)",
        ),
        (r#"{"format":"task/1","goal":["not (on(a))"]}"#, NOT_AN_ATOM),
        (
            "{\"format\":\"task/1\",\n \"goal\":[\"free(a)\",\n  \"not free(a)\"\n ]}",
            "task.json:4:2: in `goal`: the goal contradicts itself: it has `free(a)` and `not free(a)`",
        ),
        (
            r#"{"format":"task/1","goal":["not free(a)","free( a )"]}"#,
            "task.json:1:53: in `goal`: the goal contradicts itself: it has `free(a)` and `not free(a)`",
        ),
        ("{\"format\":\"task/1\",\n \"goal\":[", "task.json:2:9: the JSON text ends too early"),
        (r#"{"format":"task/1","goal":[],"state":{}}"#, "task.json: this state has neither `entities` nor `objects`"),
    ] {
        assert_eq!(read(text).expect_err(text).to_string(), message);
    }
}

const NOT_AN_ATOM: &str =
    "task.json:1:41: in `goal`: `not (on(a))` is not an atom of the form predicate(entity,entity)";

#[test]
fn a_goal_is_written_as_a_list_of_texts() {
    let goal = Goal {
        required: vec![GroundAtom::new("free", vec!["a".into()])],
        forbidden: vec![GroundAtom::new("on", vec!["a".into(), "b".into()]), GroundAtom::new("dark", vec![])],
    };
    let written = TaskFile { goal, ..TaskFile::default() }.to_json();
    assert_eq!(
        written,
        "{\n  \"format\": \"task/1\",\n  \"goal\": [\n    \"free(a)\",\n    \"not on(a,b)\",\n    \"not dark()\"\n  ]\n}\n"
    );
}

fn name() -> impl Strategy<Value = Symbol> {
    "[a-zA-Zé☃][a-z0-9_\\-]{0,3}".prop_map(Symbol::from)
}

fn goal() -> impl Strategy<Value = Goal> {
    let atom =
        (name(), prop::collection::vec(name(), 0..3)).prop_map(|(predicate, args)| GroundAtom { predicate, args });
    let atoms = prop::collection::vec(atom.boxed(), 0..3);
    (atoms.clone(), atoms).prop_map(|(required, mut forbidden)| {
        forbidden.retain(|atom| !required.contains(atom));
        Goal { required, forbidden }
    })
}

prop_compose! {
    fn any_task()(
        goal in goal(),
        objects in prop::option::of(prop::collection::btree_map(name(), name(), 0..3)),
        scenario in prop::option::of("\\PC{0,8}".prop_map(|text| json!({"text": text, "n": [1, null]}))),
        seed in prop::option::of(any::<u64>()),
    ) -> TaskFile {
        let atoms = goal.required.iter().cloned().collect();
        let state = objects.map(|objects| Scene::Symbolic { objects, atoms, unknown: [].into() });
        TaskFile { goal, state, scenario, seed, ..TaskFile::default() }
    }
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn reading_what_was_written_gives_it_back(task in any_task()) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("task.json");
        write_task(&path, &task).expect("written");
        let read = read_task(&path).expect("a task");
        let warnings: Vec<&str> = read.warnings.iter().map(|warning| warning.what.as_str()).collect();
        let expected: &[&str] = if task.goal == Goal::default() { &["the goal is empty: it holds in every state"] } else { &[] };
        prop_assert_eq!(warnings, expected);
        prop_assert_eq!(TaskFile { warnings: Vec::new(), ..read }, task);
    }
}
