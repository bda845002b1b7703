//! A room with lamps, and what an agent does to them.

use std::path::{Path, PathBuf};

use typelift_learn::{Options, evidence_of, learn_dataset};
use typelift_memory::{Access, Memory};
use typelift_model::{Goal, GroundCall, Hierarchy, LearnedModel, ParseConfig};
use typelift_world::{
    Beginning, Dataset, Parser, RecordSink, Recorder, Scene, TraceAction, TraceHeader, Verdict, read_dataset,
};

/// Two kinds of lamp.
pub(crate) fn hierarchy() -> Hierarchy {
    Hierarchy::from_edges([("lamp", "thing"), ("candle", "thing"), ("thing", "object")]).expect("a hierarchy")
}

/// A lamp or a candle, lit or not, and another one that stands by.
pub(crate) fn scene(ty: &str, lit: bool) -> Scene {
    let text = format!(
        r#"{{"entities":[{{"id":"one","type":"{ty}","attributes":{{"lit":{lit},"heat":0.25}}}},
        {{"id":"other","type":"lamp","attributes":{{"lit":false}}}}]}}"#
    );
    serde_json::from_str(&text).expect("a scene")
}

pub(crate) fn action(name: &str) -> TraceAction {
    let call = GroundCall { name: name.into(), args: vec!["one".into()] };
    TraceAction { executed: Some(true), verdict: Some(Verdict::AsExpected), ..TraceAction::from(call) }
}

pub(crate) fn header(task: &str) -> TraceHeader {
    TraceHeader { task: task.to_owned(), goal: Goal::default() }
}

/// What happens in an episode: one thing is lit, then put out, so many times.
pub(crate) fn act(sink: &mut dyn RecordSink, ty: &str, times: usize) {
    let first = scene(ty, false);
    let beginning = Beginning { first: &first, environment: "a room".to_owned(), instance: "here".into() };
    sink.begin(&beginning).expect("begun");
    for _ in 0..times {
        sink.step(&action("light"), &scene(ty, true)).expect("kept");
        sink.step(&action("put_out"), &scene(ty, false)).expect("kept");
    }
}

/// Acts, and remembers it.
pub(crate) fn remember(memory: &mut Memory, task: &str, ty: &str, times: usize) {
    let mut episode = memory.episode(header(task));
    act(&mut episode, ty, times);
    episode.end("solved").expect("kept");
    memory.refresh().expect("learned");
}

/// Acts, and records it as a trace.
pub(crate) fn record(folder: &Path, task: &str, ty: &str, times: usize) -> PathBuf {
    let mut recorder = Recorder::new(folder, task, header(task));
    act(&mut recorder, ty, times);
    recorder.files()[0].clone()
}

pub(crate) fn dataset(traces: &[PathBuf]) -> Dataset {
    match traces {
        [] => Dataset::new(&Parser::new(hierarchy(), ParseConfig::default()), Vec::new()),
        traces => read_dataset(traces, hierarchy(), ParseConfig::default(), &Default::default()).expect("a dataset"),
    }
}

/// A model learned from these traces.
pub(crate) fn learned(traces: &[PathBuf]) -> LearnedModel {
    let (model, _) = learn_dataset(&dataset(traces), &Options::default()).expect("a model");
    assert_eq!(model.evidence, evidence_of(&dataset(traces)));
    model
}

/// A memory that knows nothing yet but the types.
pub(crate) fn empty(folder: &Path, name: &str) -> Memory {
    Memory::open_or_create(&folder.join(name), &learned(&[])).expect("a memory")
}

pub(crate) fn reopened(memory: &Memory) -> Memory {
    Memory::open(memory.file(), Access::Read).expect("a memory")
}

pub(crate) fn bytes(memory: &Memory) -> String {
    memory.learned().to_json().expect("a model")
}
