//! Two memories as one.

mod common;

use std::path::{Path, PathBuf};

use common::{act, bytes, empty, header, learned, record, remember, reopened};
use typelift_memory::{Access, Memory, MemoryErrorKind, Merged, merge};
use typelift_model::Hierarchy;

fn merged(folder: &Path, files: &[&Memory]) -> (Memory, Merged) {
    let into = tempfile::Builder::new().tempfile_in(folder).expect("a name").into_temp_path().to_path_buf();
    let files: Vec<&Path> = files.iter().map(|memory| memory.file()).collect();
    let found = merge(&files, &into).expect("one");
    (Memory::open(&into, Access::Write).expect("a memory"), found)
}

/// Another file that says the same.
fn copy(memory: &Memory, name: &str) -> Memory {
    let to: PathBuf = memory.file().with_file_name(name);
    merge(&[memory.file()], &to).expect("a copy");
    Memory::open(&to, Access::Write).expect("a memory")
}

#[test]
fn the_model_is_that_of_all_that_was_seen_in_any_order() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let shown = record(folder, "shown", "lamp", 3);
    let (mut one, mut other, mut third) = (empty(folder, "one"), empty(folder, "other"), empty(folder, "third"));
    one.add_model(&learned(std::slice::from_ref(&shown)), "m").expect("added");
    remember(&mut one, "a", "candle", 1);
    remember(&mut other, "b", "lamp", 2);
    other.add_model(&learned(std::slice::from_ref(&shown)), "m").expect("added");
    remember(&mut third, "c", "candle", 2);
    let traces =
        [shown, record(folder, "a", "candle", 1), record(folder, "b", "lamp", 2), record(folder, "c", "candle", 2)];
    let expected = learned(&traces).to_json().expect("a model");
    for order in [[&one, &other, &third], [&third, &other, &one], [&other, &one, &third]] {
        assert_eq!(bytes(&merged(folder, &order).0), expected);
    }
    let (both, _) = merged(folder, &[&one, &other]);
    assert_eq!(bytes(&reopened(&merged(folder, &[&third, &both]).0)), expected);
}

#[test]
fn copies_that_went_on_apart_have_what_they_share_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let mut first = empty(folder, "first");
    remember(&mut first, "a", "lamp", 1);
    act(&mut first.episode(header("broken off")), "candle", 1);
    let again = copy(&first, "same");
    let entries = first.entries().expect("entries").len();
    let (both, found) = merged(folder, &[&first, &again]);
    assert_eq!(found, Merged { entries, shared: entries });
    assert_eq!(both.entries().expect("entries"), first.entries().expect("entries"));
    let mut second = copy(&first, "second");
    remember(&mut first, "b", "candle", 2);
    remember(&mut second, "c", "lamp", 2);
    let source = *second.learned().evidence.sources().iter().find(|(_, one)| one.name == *"a.jsonl").expect("a").0;
    second.forget(source).expect("known");
    for order in [[&first, &second], [&second, &first]] {
        let (both, found) = merged(folder, &order);
        assert_eq!(found.shared, entries);
        let begin = &both.entries().expect("entries")[..entries];
        assert_eq!(begin, &first.entries().expect("entries")[..entries], "what came first comes first");
        let names: Vec<String> =
            both.learned().evidence.sources().values().map(|source| source.name.to_string()).collect();
        assert!(!names.contains(&"a.jsonl".to_owned()), "what one took back is taken back in both: {names:?}");
        assert_eq!(names.len(), 3, "{names:?}");
        assert_eq!(both.unread(), []);
    }
}

#[test]
fn an_episode_that_goes_on_in_one_copy_is_there_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let mut whole = empty(folder, "whole");
    let mut episode = whole.episode(header("a"));
    act(&mut episode, "candle", 1);
    let file = folder.join("whole");
    let early = Memory::open(&file, Access::Read).expect("a memory");
    let early = copy(&early, "early");
    for lit in [true, false] {
        let name = if lit { "light" } else { "put_out" };
        typelift_world::RecordSink::step(&mut episode, &common::action(name), &common::scene("candle", lit))
            .expect("kept");
    }
    episode.end("solved").expect("kept");
    whole.refresh().expect("learned");
    let expected = learned(&[record(folder, "a", "candle", 2)]).to_json().expect("a model");
    for order in [[&whole, &early], [&early, &whole]] {
        let (both, _) = merged(folder, &order);
        assert_eq!(bytes(&both), expected);
        assert_eq!(both.entries().expect("entries"), whole.entries().expect("entries"));
    }
}

#[test]
fn memories_of_another_kind_do_not_become_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    empty(folder.path(), "one");
    let mut other = learned(&[]);
    other.model.hierarchy =
        Hierarchy::from_edges([("lamp", "object"), ("candle", "thing"), ("thing", "object")]).expect("a hierarchy");
    Memory::open_or_create(&path("other"), &other).expect("a memory");
    let error = merge(&[&path("one"), &path("other")], &path("both")).expect_err("of another kind").to_string();
    assert!(
        error.contains("other is of another kind: the type `lamp` lies below")
            || error.contains("one is of another kind"),
        "{error}"
    );
    assert!(!path("both").exists());
    let error = merge(&[&path("one"), &path("one")], &path("other")).expect_err("it is there");
    assert_eq!(error.kind, MemoryErrorKind::Exists);
    let error = merge(&[&path("one"), &path("none")], &path("both")).expect_err("it is not there");
    assert_eq!((error.file, error.kind), (path("none"), MemoryErrorKind::Missing));
}
