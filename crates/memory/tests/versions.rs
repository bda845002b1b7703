//! Files of earlier versions.

mod common;

use std::path::Path;

use common::{bytes, empty, learned, record, remember, reopened};
use rusqlite::{Connection, params};
use typelift_memory::{Access, Memory, VERSION};
use typelift_world::source_of_file;

/// The tables of version 1.
const FIRST: &str = "
CREATE TABLE basis (model TEXT NOT NULL) STRICT;
CREATE TABLE log (
    number INTEGER PRIMARY KEY,
    written TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
    kind TEXT NOT NULL,
    episode INTEGER REFERENCES log (number),
    content TEXT NOT NULL
) STRICT;
CREATE INDEX log_by_kind ON log (kind);
CREATE INDEX log_by_episode ON log (episode) WHERE episode IS NOT NULL;
CREATE TRIGGER basis_stays BEFORE UPDATE ON basis BEGIN SELECT RAISE (ABORT, 'the basis of a memory never changes'); END;
CREATE TRIGGER log_stays BEFORE UPDATE ON log BEGIN SELECT RAISE (ABORT, 'entries never change'); END;
CREATE TRIGGER log_keeps BEFORE DELETE ON log BEGIN SELECT RAISE (ABORT, 'entries are never removed'); END;
CREATE TABLE fold (up_to INTEGER NOT NULL, program TEXT NOT NULL, model TEXT NOT NULL) STRICT;
PRAGMA application_id = 0x746c6d79;
PRAGMA user_version = 1;
PRAGMA journal_mode = wal;
";

/// A memory as version 1 wrote it: an episode `a` in which a candle is lit and put out, and one that was taken back.
fn first(file: &Path, folder: &Path) {
    let database = Connection::open(file).expect("a database");
    database.execute_batch(FIRST).expect("made");
    let basis = learned(&[]).to_json().expect("a model");
    database.execute("INSERT INTO basis (model) VALUES (?1)", [basis]).expect("made");
    let thing = |ty: &str, lit: bool| {
        format!(r#"{{"id":"one","type":"{ty}","attributes":{{"heat":0.25,"lit":{lit}}},"relations":{{}}}}"#)
    };
    let other = r#"{"id":"other","type":"lamp","attributes":{"lit":false},"relations":{}}"#;
    let mut number = 0;
    for (task, ty) in [("a", "candle"), ("b", "lamp")] {
        let source = source_of_file(&record(folder, task, ty, 1)).expect("a trace");
        let begun = number + 1;
        let header = format!(r#"{{"format":"trace/1","task":"{task}","goal":[]}}"#);
        let scene = format!(r#"{{"entities":[{},{other}]}}"#, thing(ty, false));
        let step = |name: &str, lit: bool| {
            let action =
                format!(r#"{{"action":{{"name":"{name}","args":["one"]}},"executed":true,"verdict":"as-expected"}}"#);
            format!(r#"{{"action":{action},"change":{{"entities":[{}]}}}}"#, thing(ty, lit))
        };
        let entries = [
            ("begun", format!(r#"{{"environment":"a room","instance":"here","header":{header},"scene":{scene}}}"#)),
            ("stepped", step("light", true)),
            ("stepped", step("put_out", false)),
            ("ended", format!(r#"{{"how":"solved","source":"{source}"}}"#)),
            ("forgotten", format!(r#"{{"source":"{source}","entries":[{begun}]}}"#)),
        ];
        // What is `a` stays known.
        for (kind, content) in entries.iter().take(if task == "a" { 4 } else { 5 }) {
            let episode = Some(begun).filter(|_| !matches!(*kind, "begun" | "forgotten"));
            let insert = "INSERT INTO log (kind, episode, content) VALUES (?1, ?2, ?3)";
            database.execute(insert, params![kind, episode, content]).expect("written");
            number += 1;
        }
    }
}

fn version(file: &Path) -> i64 {
    let database = Connection::open(file).expect("a database");
    database.pragma_query_value(None, "user_version", |row| row.get(0)).expect("a number")
}

#[test]
fn a_file_of_version_1_is_read_and_becomes_one_of_this() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("m");
    first(&file, folder.path());
    let expected = learned(&[folder.path().join("a.jsonl")]).to_json().expect("a model");
    let read = Memory::open(&file, Access::Read).expect("it is readable");
    assert_eq!((bytes(&read), read.unread().len(), version(&file)), (expected.clone(), 0, 1));
    let entries = read.entries().expect("entries");
    drop(read);
    let mut memory = Memory::open(&file, Access::Write).expect("it is writable");
    assert_eq!((bytes(&memory), version(&file)), (expected, VERSION));
    assert_eq!(memory.entries().expect("entries"), entries, "nothing is lost");
    remember(&mut memory, "c", "lamp", 1);
    assert_eq!(version(empty(folder.path(), "new").file()), VERSION, "nothing is to be done to a new one");
    let both = [folder.path().join("a.jsonl"), record(folder.path(), "c", "lamp", 1)];
    assert_eq!(bytes(&reopened(&memory)), learned(&both).to_json().expect("a model"));
}
