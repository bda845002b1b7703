//! Recording: what is on the disk when, and that nothing is written over.

use std::fs;
use std::path::Path;

use typelift_model::{Goal, GroundAtom, GroundCall};
use typelift_world::{Expected, Recorder, Recording, Scene, TraceAction, TraceHeader, TraceReader, Verdict};

fn scene(atom: &str) -> Scene {
    let text = format!(r#"{{"objects":{{"a":"block"}},"atoms":["{atom}(a)"]}}"#);
    serde_json::from_str(&text).expect("a scene")
}

fn action(verdict: Verdict) -> TraceAction {
    let call = GroundCall { name: "GO".into(), args: vec!["a".into()] };
    let expected = Some(Expected {
        action: "GO-block".into(),
        args: vec!["a".into()],
        adds: vec![GroundAtom::parse("at(a)").expect("an atom")],
        deletes: Vec::new(),
    });
    TraceAction { executed: Some(true), expected, verdict: Some(verdict), ..TraceAction::from(call) }
}

fn header() -> TraceHeader {
    TraceHeader { task: "go".to_owned(), goal: Goal::default() }
}

fn read(path: &Path) -> Recording {
    let mut reader = TraceReader::open(path).expect("a header");
    let recording = reader.recording().expect("a trace");
    assert_eq!(reader.warnings(), [], "it is whole");
    recording
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn each_step_is_on_the_disk_when_it_was_recorded() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut recorder = Recorder::new(folder.path(), "go", header());
    assert_eq!(names(folder.path()), Vec::<String>::new());
    recorder.begin(&scene("here")).expect("begun");
    let path = folder.path().join("go.jsonl");
    let mut expected = Recording { header: header(), first: scene("here"), steps: Vec::new() };
    assert_eq!(read(&path), expected);
    for (verdict, after) in [(Verdict::Nothing, "here"), (Verdict::AsExpected, "there")] {
        let step = (action(verdict), scene(after));
        recorder.step(&step.0, &step.1).expect("recorded");
        expected.steps.push(step);
        assert_eq!(read(&path), expected);
    }
}

#[test]
fn each_beginning_has_a_file_of_its_own_and_none_is_written_over() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    fs::write(path("go-2.jsonl"), "mine").expect("written");
    let mut recorder = Recorder::new(folder.path(), "go", header());
    for _ in 0..2 {
        recorder.begin(&scene("here")).expect("begun");
        recorder.step(&action(Verdict::AsExpected), &scene("there")).expect("recorded");
    }
    Recorder::new(folder.path(), "go", header()).begin(&scene("elsewhere")).expect("begun");
    assert_eq!(names(folder.path()), ["go-2.jsonl", "go-3.jsonl", "go-4.jsonl", "go.jsonl"]);
    assert_eq!(fs::read(path("go-2.jsonl")).expect("there"), b"mine");
    assert_eq!(recorder.files(), [path("go.jsonl"), path("go-3.jsonl")]);
    assert_eq!(read(&path("go.jsonl")), read(&path("go-3.jsonl")));
    assert_eq!(read(&path("go-4.jsonl")).first, scene("elsewhere"));
}

#[test]
fn what_cannot_be_recorded_is_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut recorder = Recorder::new(folder.path(), "go", header());
    let error = recorder.step(&action(Verdict::AsExpected), &scene("there")).expect_err("no state before");
    assert!(error.to_string().ends_with(": nothing was observed before the first action"), "{error}");
    let mut recorder = Recorder::new(&folder.path().join("missing"), "go", header());
    let error = recorder.begin(&scene("here")).expect_err("no folder");
    assert!(error.to_string().ends_with("go.jsonl: there is no such folder to write to"), "{error}");
}
