//! What is kept, and that the model is a function of it.

mod common;

use common::{act, bytes, empty, header, learned, record, remember, reopened};
use typelift_memory::{Access, Memory, MemoryErrorKind};
use typelift_world::{RecordSink, source_of_file};

#[test]
fn an_episode_is_the_source_that_its_recording_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let trace = record(folder.path(), "go", "candle", 2);
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "go", "candle", 2);
    let sources: Vec<_> = memory.learned().evidence.sources().keys().copied().collect();
    assert_eq!(sources, [source_of_file(&trace).expect("a trace")]);
    assert_eq!(bytes(&memory), learned(&[trace]).to_json().expect("a model"));
    assert_eq!(bytes(&reopened(&memory)), bytes(&memory));
}

#[test]
fn the_same_trace_counts_once_however_it_came() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = learned(&[record(folder.path(), "go", "candle", 1), record(folder.path(), "other", "lamp", 1)]);
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "go", "candle", 1);
    assert_eq!(memory.add_model(&model, "model.json").expect("added"), 2);
    assert_eq!(bytes(&memory), model.to_json().expect("a model"));
    assert_eq!(memory.add_model(&model, "model.json").expect("known"), 0, "it is added once");
    remember(&mut memory, "go", "candle", 1);
    assert_eq!(bytes(&reopened(&memory)), model.to_json().expect("a model"));
}

#[test]
fn the_order_of_the_log_does_not_matter() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = learned(&[record(folder.path(), "shown", "lamp", 3)]);
    let episodes = [("a", "candle", 1), ("b", "lamp", 2), ("c", "candle", 2)];
    let orders = [[0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1]];
    let found = orders.map(|order| {
        let mut memory = empty(folder.path(), &format!("{order:?}"));
        for next in order {
            match episodes.get(next) {
                Some((task, ty, times)) => remember(&mut memory, task, ty, *times),
                None => assert_eq!(memory.add_model(&model, "m").expect("added"), 1),
            }
        }
        bytes(&memory)
    });
    assert_eq!(found[0], found[1]);
    assert_eq!(found[0], found[2]);
}

#[test]
fn what_is_forgotten_has_never_been() {
    let folder = tempfile::tempdir().expect("a folder");
    let trace = record(folder.path(), "shown", "lamp", 3);
    let shown = source_of_file(&trace).expect("a trace");
    let mut memory = Memory::open_or_create(&folder.path().join("m"), &learned(&[])).expect("a memory");
    let nothing = bytes(&memory);
    memory.add_model(&learned(std::slice::from_ref(&trace)), "m").expect("added");
    let before = bytes(&memory);
    remember(&mut memory, "go", "candle", 2);
    let with_it = bytes(&memory);
    let ids = memory.learned().evidence.sources().keys().copied();
    let episode = ids.into_iter().find(|id| *id != shown).expect("the episode");
    memory.forget(episode).expect("known");
    assert_eq!((bytes(&memory), bytes(&reopened(&memory))), (before.clone(), before));
    let twice = memory.forget(episode).expect_err("it is gone");
    assert_eq!(twice.kind, MemoryErrorKind::NotKnown(episode));
    // What happens again counts again; a model's demonstration does not come back with the model.
    remember(&mut memory, "go", "candle", 2);
    assert_eq!(bytes(&memory), with_it);
    memory.forget(episode).expect("known");
    memory.forget(shown).expect("known");
    memory.add_model(&learned(std::slice::from_ref(&trace)), "m").expect("nothing to add");
    assert_eq!((bytes(&memory), bytes(&reopened(&memory))), (nothing.clone(), nothing));
    // One that is shown again does.
    let again = learned(&[trace]);
    assert_eq!(memory.add_demonstrations(&again, "shown").expect("added"), 1);
    assert_eq!(memory.add_demonstrations(&again, "shown").expect("known"), 0);
    assert_eq!(bytes(&reopened(&memory)), again.to_json().expect("a model"));
}

#[test]
fn what_was_done_with_an_object_that_is_forgotten_has_never_been() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    let trace = record(folder.path(), "shown", "lamp", 3);
    memory.add_model(&learned(std::slice::from_ref(&trace)), "m").expect("added");
    let before = bytes(&memory);
    remember(&mut memory, "go", "candle", 2);
    let other = Memory::open(memory.file(), Access::Read).expect("a memory");
    act(&mut memory.episode(header("broken off")), "lamp", 1);
    let found = memory.forget_object(&"one".into(), None).expect("known");
    assert_eq!((found.episodes, found.words), (2, 0));
    assert_eq!((bytes(&memory), bytes(&reopened(&memory))), (before.clone(), before.clone()));
    let mut other = other;
    other.refresh().expect("learned");
    assert_eq!(bytes(&other), before, "another program sees it, too");
    for (object, instance) in [("one", None), ("other", None), ("one", Some("there"))] {
        let error =
            memory.forget_object(&object.into(), instance.map(Into::into).as_ref()).expect_err("nothing is left");
        assert_eq!(error.kind, MemoryErrorKind::NoSuchObject(object.into()));
    }
    // Of an episode that is known from elsewhere, too, that is known still.
    let again = record(folder.path(), "again", "candle", 1);
    memory.add_demonstrations(&learned(std::slice::from_ref(&again)), "shown").expect("added");
    remember(&mut memory, "again", "candle", 1);
    memory.forget_object(&"one".into(), Some(&"here".into())).expect("known");
    let both = learned(&[trace, again]).to_json().expect("a model");
    assert_eq!((bytes(&memory), bytes(&reopened(&memory))), (both.clone(), both));
}

#[test]
fn an_episode_that_never_ended_counts_as_far_as_it_went() {
    let folder = tempfile::tempdir().expect("a folder");
    let trace = record(folder.path(), "go", "candle", 2);
    let mut memory = empty(folder.path(), "m");
    act(&mut memory.episode(header("go")), "candle", 2);
    drop(memory);
    let mut memory = Memory::open(&folder.path().join("m"), Access::Write).expect("it opens");
    assert_eq!(bytes(&memory), learned(std::slice::from_ref(&trace)).to_json().expect("a model"));
    remember(&mut memory, "again", "lamp", 1);
    let both = [trace.clone(), record(folder.path(), "again", "lamp", 1)];
    assert_eq!(bytes(&reopened(&memory)), learned(&both).to_json().expect("a model"));
    memory.forget(source_of_file(&trace).expect("a trace")).expect("known");
    assert_eq!(bytes(&reopened(&memory)), learned(&both[1..]).to_json().expect("a model"));
}

#[test]
fn a_world_that_was_set_back_begins_another_trace() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    let mut episode = memory.episode(header("go"));
    act(&mut episode, "candle", 1);
    act(&mut episode, "lamp", 1);
    episode.end("solved").expect("kept");
    memory.refresh().expect("learned");
    let traces = [record(folder.path(), "go", "candle", 1), record(folder.path(), "go", "lamp", 1)];
    let ids = traces.map(|trace| source_of_file(&trace).expect("a trace"));
    assert!(memory.learned().evidence.sources().keys().all(|id| ids.contains(id)));
    assert_eq!(memory.learned().evidence.sources().len(), 2);
}

#[test]
fn what_two_programs_write_at_once_is_all_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut one = empty(folder.path(), "m");
    let mut other = Memory::open(one.file(), Access::Write).expect("a memory");
    let (mut first, mut second) = (one.episode(header("first")), other.episode(header("second")));
    act(&mut first, "lamp", 1);
    act(&mut second, "candle", 1);
    act(&mut first, "lamp", 2);
    first.end("solved").expect("kept");
    one.refresh().expect("learned");
    second.end("solved").expect("kept");
    one.refresh().expect("learned");
    other.refresh().expect("learned");
    assert_eq!(one.learned().evidence.sources().len(), 3);
    assert_eq!(bytes(&one), bytes(&other));
    assert_eq!(bytes(&reopened(&one)), bytes(&other));
}

#[test]
fn a_step_needs_a_beginning() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    let error = memory.episode(header("go")).step(&common::action("light"), &common::scene("lamp", true));
    let message = error.expect_err("nothing was observed").to_string();
    assert!(message.ends_with("m: nothing was observed before the first action"), "{message}");
    memory.episode(header("go")).end("solved").expect("nothing was done");
    memory.refresh().expect("learned");
    assert!(memory.learned().evidence.sources().is_empty());
}
