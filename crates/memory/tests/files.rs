//! Files that are no memories, or not as they were written.

mod common;

use std::fs;
use std::path::Path;

use common::{act, bytes, empty, header, hierarchy, learned, record, remember, reopened};
use rusqlite::Connection;
use typelift_learn::{Options, learn_dataset};
use typelift_memory::{Access, Logged, Memory, MemoryErrorKind, What, merge};
use typelift_model::Hierarchy;
use typelift_world::{Dataset, RecordSink};

fn kind(path: &Path, access: Access) -> MemoryErrorKind {
    Memory::open(path, access).expect_err("it is none").kind
}

#[test]
fn what_is_no_memory() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    fs::write(
        path("text"),
        "This is a text, and long enough to be taken for the beginning of something else. ".repeat(9),
    )
    .expect("written");
    fs::write(path("empty"), "").expect("written");
    Connection::open(path("other")).and_then(|db| db.execute_batch("CREATE TABLE t (x)")).expect("a database");
    empty(folder.path(), "newer");
    Connection::open(path("newer")).and_then(|db| db.pragma_update(None, "user_version", 9)).expect("changed");
    for access in [Access::Read, Access::Write] {
        assert_eq!(kind(&path("missing"), access), MemoryErrorKind::Missing);
        assert_eq!(kind(&path("empty"), access), MemoryErrorKind::Missing);
        assert_eq!(kind(&path("text"), access), MemoryErrorKind::NotAMemory);
        assert_eq!(kind(&path("other"), access), MemoryErrorKind::NotAMemory);
        assert_eq!(kind(&path("newer"), access), MemoryErrorKind::Version { found: 9 });
        assert!(matches!(kind(folder.path(), access), MemoryErrorKind::CannotOpen(_)));
    }
    assert!(!path("missing").exists(), "nothing is made by looking");
    for name in ["text", "other", "newer"] {
        let before = fs::read(path(name)).expect("there");
        Memory::open_or_create(&path(name), &learned(&[])).expect_err("it is none");
        assert!(fs::read(path(name)).expect("there") == before, "{name}");
    }
    Memory::open_or_create(&path("empty"), &learned(&[])).expect("an empty file is begun");
    let nowhere = Memory::open_or_create(&path("no/where"), &learned(&[])).expect_err("no folder").to_string();
    assert!(nowhere.ends_with("no/where: there is no such folder to write to"), "{nowhere}");
}

#[test]
fn models_of_another_kind_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    let said = |memory: &mut Memory, model| {
        let error = memory.add_model(&model, "other.json").expect_err("of another kind").to_string();
        error.rsplit_once("m: ").expect("the file comes first").1.to_owned()
    };
    let mut other = learned(&[]);
    other.model.hierarchy =
        Hierarchy::from_edges([("lamp", "object"), ("candle", "thing"), ("thing", "object")]).expect("a hierarchy");
    assert_eq!(
        said(&mut memory, other),
        "other.json is of another kind: the type `lamp` lies below `object` in the model and below `thing` in the memory"
    );
    let mut other = learned(&[]);
    other.parse.ignore.insert("heat".into());
    assert_eq!(said(&mut memory, other), "other.json is of another kind: `heat` is ignored by the model");
    let options = Options { individual: true, ..Options::default() };
    let dataset = Dataset { hierarchy: hierarchy(), ..Dataset::default() };
    let (other, _) = learn_dataset(&dataset, &options).expect("a model");
    assert_eq!(said(&mut memory, other), "other.json is of another kind: it was learned with other options");
    let mut other = learned(&[record(folder.path(), "shown", "lamp", 1)]);
    other.evidence.compact();
    assert_eq!(said(&mut memory, other), "other.json keeps totals only, and not what each trace contributed");
    assert!(reopened(&memory).learned().evidence.sources().is_empty());
}

#[test]
fn entries_stay_as_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "go", "candle", 1);
    let database = Connection::open(memory.file()).expect("a database");
    for (statement, why) in [
        ("UPDATE log SET content = '{}'", "entries never change"),
        ("DELETE FROM log", "entries are never removed"),
        ("UPDATE basis SET model = ''", "the basis of a memory never changes"),
    ] {
        let error = database.execute(statement, []).expect_err("refused");
        assert_eq!(error.to_string(), why);
    }
}

#[test]
fn the_kept_sum_is_no_more_than_a_sum() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    for (task, ty) in [("a", "lamp"), ("b", "candle"), ("c", "lamp")] {
        remember(&mut memory, task, ty, 2);
    }
    let database = Connection::open(memory.file()).expect("a database");
    let kept = |database: &Connection| {
        database.query_row("SELECT up_to FROM fold", [], |row| row.get::<_, i64>(0)).expect("a sum")
    };
    assert!(kept(&database) > 0);
    for statement in ["UPDATE fold SET model = '{'", "UPDATE fold SET program = 'another'", "DELETE FROM fold"] {
        database.execute(statement, []).expect("changed");
        assert_eq!(bytes(&reopened(&memory)), bytes(&memory), "{statement}");
    }
    assert_eq!(bytes(&Memory::open(memory.file(), Access::Write).expect("a memory")), bytes(&memory));
    assert!(kept(&database) > 0, "it is kept again");
}

#[test]
fn what_is_not_as_it_was_written_is_left_out_and_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "a", "lamp", 1);
    let before = bytes(&memory);
    remember(&mut memory, "b", "candle", 1);
    let database = Connection::open(memory.file()).expect("a database");
    let change = "DROP TRIGGER log_stays; DELETE FROM fold; \
                  UPDATE log SET content = replace(content, 'put_out', 'put_off') WHERE episode > 1";
    database.execute_batch(change).expect("changed");
    let found = reopened(&memory);
    assert_eq!(bytes(&found), before);
    let said: Vec<(i64, &str)> = found.unread().iter().map(|unread| (unread.entry, unread.why.as_str())).collect();
    assert_eq!(said, [(5, "its trace is not as it was written")]);
}

#[test]
fn one_that_is_being_written_to_can_be_read_and_not_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "a", "lamp", 1);
    let writer = Connection::open(memory.file()).expect("a database");
    writer.execute_batch("BEGIN IMMEDIATE").expect("it writes");
    assert_eq!(bytes(&reopened(&memory)), bytes(&memory));
    let mut episode = memory.episode(header("b"));
    let first = common::scene("lamp", false);
    let beginning =
        typelift_world::Beginning { first: &first, environment: "a room".to_owned(), instance: "here".into() };
    let error = typelift_world::RecordSink::begin(&mut episode, &beginning).expect_err("it is taken");
    assert!(error.to_string().ends_with("m: another program is writing to it"), "{error}");
    writer.execute_batch("ROLLBACK").expect("it is done");
    act(&mut episode, "lamp", 1);
}

#[test]
fn clocks_that_go_backwards_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    for (task, ty) in [("a", "lamp"), ("b", "candle"), ("c", "lamp")] {
        remember(&mut memory, task, ty, 2);
    }
    let (before, entries) = (bytes(&memory), memory.entries().expect("entries"));
    let database = Connection::open(memory.file()).expect("a database");
    let change = "DROP TRIGGER log_stays; DELETE FROM fold; \
                  UPDATE log SET written = strftime('%Y-%m-%dT%H:%M:%SZ', 1000000000 - number * 1000, 'unixepoch')";
    database.execute_batch(change).expect("changed");
    let found = reopened(&memory);
    assert_eq!(bytes(&found), before);
    let what = |entries: Vec<Logged>| entries.into_iter().map(|entry| (entry.number, entry.what)).collect::<Vec<_>>();
    assert_eq!(what(found.entries().expect("entries")), what(entries.clone()));
    // Together with another one each keeps its order.
    let mut other = empty(folder.path(), "other");
    remember(&mut other, "d", "candle", 1);
    let into = folder.path().join("both");
    merge(&[memory.file(), other.file()], &into).expect("one");
    let both = Memory::open(&into, Access::Read).expect("a memory");
    assert_eq!(both.unread(), []);
    let of_first = both.entries().expect("entries").into_iter().map(|entry| entry.what);
    let of_first: Vec<What> = of_first.filter(|what| entries.iter().any(|entry| entry.what == *what)).collect();
    assert!(entries.iter().map(|entry| &entry.what).eq(of_first.iter().take(entries.len())));
}

#[test]
fn a_thing_may_be_of_another_type_later() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "a", "lamp", 1);
    remember(&mut memory, "b", "candle", 1);
    let mut episode = memory.episode(header("c"));
    act(&mut episode, "lamp", 1);
    // Within an episode what was before that counts.
    RecordSink::step(&mut episode, &common::action("light"), &common::scene("candle", true)).expect("kept");
    episode.end("solved").expect("kept");
    memory.refresh().expect("learned");
    let said: Vec<String> = memory.unread().iter().map(ToString::to_string).collect();
    let expected = "not all is learned from entry 9: episode 9:8: \
                    entity one is of type `candle` here and of type `lamp` in line 2";
    assert_eq!(said, [expected]);
    assert_eq!(bytes(&reopened(&memory)), bytes(&memory));
    let transitions: Vec<u64> = memory.learned().evidence.sources().values().map(|source| source.transitions).collect();
    assert_eq!(transitions, [2, 2, 2]);
}

#[test]
fn what_was_opened_to_read_is_not_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "a", "lamp", 1);
    let source = *memory.learned().evidence.sources().keys().next().expect("a source");
    assert_eq!(reopened(&memory).forget(source).expect_err("it is read").kind, MemoryErrorKind::ReadOnly);
}
