//! Files that are not as they were written, and what of them is saved.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{act, bytes, empty, header, learned, record, remember, reopened};
use rusqlite::Connection;
use typelift_memory::{Access, Memory, MemoryErrorKind, Rescued, check, rescue};

/// SQLite's pages are of this size.
const PAGE: usize = 4096;

/// What was saved of a file, which must be whole; and that the file stayed as it is.
fn rescued(file: &Path) -> Option<(Memory, Rescued)> {
    let (before, into) = (fs::read(file).expect("there"), file.with_extension("saved"));
    let _ = fs::remove_file(&into);
    let found = rescue(file, &into);
    assert!(fs::read(file).expect("there") == before, "the damaged file stays as it is");
    match found {
        Ok(found) => {
            let memory = Memory::open(&into, Access::Write).expect("what is saved is whole");
            assert_eq!(check(&into).expect("it can be read").problems, Vec::<String>::new());
            Some((memory, found))
        }
        Err(error) => {
            assert!(!into.exists(), "{error}");
            assert!(matches!(error.kind, MemoryErrorKind::Damaged(_) | MemoryErrorKind::NotAMemory), "{error}");
            None
        }
    }
}

/// A memory of twelve episodes, as bytes.
fn whole(folder: &Path) -> (PathBuf, Vec<u8>) {
    let mut memory = empty(folder, "m");
    memory.add_model(&learned(&[record(folder, "shown", "lamp", 9)]), "m").expect("added");
    for episode in 0..12 {
        remember(&mut memory, &format!("task {episode}"), if episode % 2 == 0 { "lamp" } else { "candle" }, 4);
    }
    drop(memory);
    let file = folder.join("m");
    let bytes = fs::read(&file).expect("there");
    (file, bytes)
}

#[test]
fn whatever_page_is_lost_the_rest_is_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, whole) = whole(folder.path());
    let memory = reopened(&Memory::open(&file, Access::Read).expect("a memory"));
    let (entries, expected) = (memory.entries().expect("entries").len(), bytes(&memory));
    let mut nothing_saved = 0;
    for page in 0..whole.len() / PAGE {
        let mut damaged = whole.clone();
        damaged[page * PAGE..(page + 1) * PAGE].fill(0);
        fs::write(&file, damaged).expect("written");
        match rescued(&file) {
            Some((memory, found)) => {
                let kept = memory.entries().expect("entries").len();
                assert_eq!(kept, found.entries);
                assert!(kept == entries || !found.lost.is_empty(), "page {page}: what is lost is said");
                let harmless = Memory::open(&file, Access::Read).is_ok_and(|memory| bytes(&memory) == expected);
                let said = check(&file).is_ok_and(|said| !said.problems.is_empty());
                assert!(said || harmless, "page {page}");
            }
            None => nothing_saved += 1,
        }
    }
    // The first page, and that from which all entries are found.
    assert!(nothing_saved <= 3, "{nothing_saved}");
}

#[test]
fn of_a_file_that_was_cut_off_the_beginning_is_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, whole) = whole(folder.path());
    let mut kept = Vec::new();
    for part in [1, 4, 6, 7, 8, 9] {
        fs::write(&file, &whole[..whole.len() * part / 10 + 7]).expect("written");
        let error = Memory::open(&file, Access::Read).expect_err("damaged").kind;
        assert!(matches!(error, MemoryErrorKind::Damaged(_)), "{error:?}");
        kept.push(rescued(&file).map_or(0, |(_, found)| found.entries));
    }
    assert!(kept.is_sorted() && kept[5] > 10, "{kept:?}");
}

/// Changes an entry's content.
fn change(file: &Path, number: i64, from: &str, to: &str) {
    let database = Connection::open(file).expect("a database");
    let change = format!(
        "DROP TRIGGER log_stays; DELETE FROM fold; \
         UPDATE log SET content = replace(content, '{from}', '{to}') WHERE number = {number}"
    );
    database.execute_batch(&change).expect("changed");
}

#[test]
fn an_episode_counts_up_to_what_cannot_be_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "a", "candle", 2);
    remember(&mut memory, "b", "lamp", 1);
    act(&mut memory.episode(header("c")), "lamp", 1);
    let file = memory.file().to_owned();
    drop(memory);
    change(&file, 4, "\"action\"", "\"aktion");
    let refused = Memory::open(&file, Access::Read).expect_err("damaged").to_string();
    assert!(refused.contains("it is damaged: entry 4: "), "{refused}");
    let found = check(&file).expect("it can be read in part");
    assert_eq!(found.entries, 12);
    assert!(found.problems[0].starts_with("entry 4 cannot be read: "), "{:?}", found.problems);
    let (saved, found) = rescued(&file).expect("something is saved");
    assert_eq!(found.lost[1..], ["the episode of entry 1 is kept up to entry 3"]);
    let numbers: Vec<i64> = saved.entries().expect("entries").iter().map(|entry| entry.number).collect();
    assert_eq!(numbers, [1, 2, 3, 7, 8, 9, 10, 11, 12, 13]);
    let kept = [("a", "candle"), ("b", "lamp"), ("c", "lamp")].map(|(task, ty)| record(folder.path(), task, ty, 1));
    assert_eq!(bytes(&saved), learned(&kept).to_json().expect("a model"));
}

#[test]
fn an_episode_of_which_something_is_wrong_is_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "a", "candle", 1);
    remember(&mut memory, "b", "lamp", 1);
    let file = memory.file().to_owned();
    drop(memory);
    change(&file, 3, "put_out", "put_off");
    let (saved, found) = rescued(&file).expect("something is saved");
    assert_eq!(found.lost, ["the episode of entry 1 is lost: its trace is not as it was written"]);
    assert_eq!(bytes(&saved), learned(&[record(folder.path(), "b", "lamp", 1)]).to_json().expect("a model"));
}

#[test]
fn how_scenes_are_read_is_in_every_models_evidence() {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, _) = whole(folder.path());
    let expected = bytes(&Memory::open(&file, Access::Read).expect("a memory"));
    let database = Connection::open(&file).expect("a database");
    database.execute_batch("DROP TRIGGER basis_stays; UPDATE basis SET model = '{'").expect("changed");
    drop(database);
    let (saved, found) = rescued(&file).expect("all is saved");
    assert!(found.lost[0].starts_with("how scenes are read cannot be read where it stands"), "{:?}", found.lost);
    assert_eq!(bytes(&saved), expected);
}

#[test]
fn what_was_written_last_is_saved_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut memory = empty(folder.path(), "m");
    remember(&mut memory, "a", "candle", 1);
    // As after the program was killed, all of it lies beside the file still.
    let copy = folder.path().join("killed");
    for end in ["", "-wal"] {
        fs::copy(folder.path().join(format!("m{end}")), folder.path().join(format!("killed{end}"))).expect("copied");
    }
    let expected = bytes(&memory);
    let (saved, found) = rescued(&copy).expect("all is saved");
    assert_eq!((bytes(&saved), found.lost), (expected, Vec::new()));
}
