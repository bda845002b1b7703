//! The documents' `console` blocks are run, and their output compared.
//!
//! In a block, a line `$ typelift …` is a command, the lines below it are what it prints. A line `…` stands for any lines. All blocks of a document are run in one folder that is empty at the start, but for
//! a link to the project's `examples`. Times are not compared. With `UPDATE_DOCS=1` the documents are rewritten
//! instead; outputs with a `…` are left as they are. A document that needs Python is skipped without it.

use std::fmt::Write;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs a command line of the form `typelift …`, without a shell: words in single quotes hold together, and `*` in the
/// last part of a path is expanded.
fn run(command: &str, folder: &Path) -> String {
    let mut words: Vec<String> = Vec::new();
    for (i, part) in command.split('\'').enumerate() {
        if i % 2 == 1 {
            words.push(part.to_owned());
            continue;
        }
        for word in part.split_whitespace() {
            match word.split_once('*') {
                Some((before, after)) => words.extend(matching(folder, before, after)),
                None => words.push(word.to_owned()),
            }
        }
    }
    assert_eq!(words.first().map(String::as_str), Some("typelift"), "{command}");
    // One pipe for both, so that lines come in the order in which a person sees them.
    let (mut reader, writer) = std::io::pipe().expect("a pipe");
    let mut program = Command::new(env!("CARGO_BIN_EXE_typelift"));
    program.args(&words[1..]).current_dir(folder).stdin(Stdio::null());
    let mut child =
        program.stdout(writer.try_clone().expect("a second end")).stderr(writer).spawn().expect("the program starts");
    drop(program);
    let mut text = String::new();
    reader.read_to_string(&mut text).expect("UTF-8");
    child.wait().expect("it ends");
    text
}

fn matching(folder: &Path, before: &str, after: &str) -> Vec<String> {
    let (directory, start) = before.rsplit_once('/').unwrap_or((".", before));
    let mut names: Vec<String> = fs::read_dir(folder.join(directory))
        .expect("the folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.starts_with(start) && name.ends_with(after))
        .map(|name| format!("{directory}/{name}"))
        .collect();
    names.sort();
    names
}

/// The text with every `12 ms` and `0.3 s` made alike.
fn without_times(text: &str) -> String {
    let mut kept: Vec<String> = Vec::new();
    let mut words = text.split(' ').peekable();
    while let Some(word) = words.next() {
        let unit = words.peek().is_some_and(|next| next.starts_with("ms") || next.starts_with("s.") || *next == "s");
        let number = !word.is_empty() && word.chars().all(|c| c.is_ascii_digit() || c == '.');
        kept.push(if unit && number { "N".to_owned() } else { word.to_owned() });
    }
    kept.join(" ")
}

/// Whether the lines are as expected, `…` standing for any lines.
fn agrees(expected: &str, found: &str) -> bool {
    let (expected, found) = (without_times(expected), without_times(found));
    let mut pieces = expected.split("…\n");
    let first = pieces.next().unwrap_or_default();
    let Some(mut rest) = found.strip_prefix(first) else { return false };
    let mut open = false;
    for piece in pieces {
        open = piece.is_empty();
        match rest.find(piece) {
            Some(at) => rest = &rest[at + piece.len()..],
            None => return false,
        }
    }
    open || rest.is_empty()
}

/// Runs the blocks of a document.
fn tour(document: &str) {
    let path = root().join(document);
    let text = fs::read_to_string(&path).expect("the document");
    let folder = tempfile::tempdir().expect("a folder");
    #[cfg(unix)]
    {
        let examples = root().join("examples").canonicalize().expect("the examples");
        std::os::unix::fs::symlink(examples, folder.path().join("examples")).expect("a link");
    }
    let update = std::env::var_os("UPDATE_DOCS").is_some();
    let (mut written, mut in_block, mut commands) = (String::new(), false, 0);
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let _ = writeln!(written, "{line}");
        if line.starts_with("```") {
            in_block = !in_block && line == "```console";
        }
        let Some(command) = line.strip_prefix("$ ").filter(|_| in_block) else { continue };
        let mut expected = String::new();
        while let Some(next) = lines.next_if(|next| !next.starts_with("$ ") && !next.starts_with("```")) {
            let _ = writeln!(expected, "{next}");
        }
        let found = run(command, folder.path());
        commands += 1;
        if update && !expected.contains("…\n") {
            written.push_str(&found);
        } else {
            assert!(agrees(&expected, &found), "{document}: {command}\nexpected:\n{expected}\nfound:\n{found}");
            written.push_str(&expected);
        }
    }
    assert!(commands > 0, "{document} has no commands");
    if update && written != text {
        fs::write(&path, written).expect("the document is written");
    }
}

fn python_is_here() -> bool {
    let here = Command::new("python3").arg("--version").output().is_ok_and(|output| output.status.success());
    if !here {
        println!("skipped: there is no python3");
    }
    here
}

#[test]
fn readme() {
    tour("README.md");
}

#[test]
fn reproduction() {
    tour("docs/reproduction.md");
}

#[test]
fn workshop() {
    if python_is_here() {
        tour("examples/workshop/README.md");
    }
}

#[test]
fn elision_and_times() {
    assert!(agrees("a\n…\nd\n", "a\nb\nc\nd\n"));
    assert!(agrees("a\n…\n", "a\nb\n"));
    assert!(!agrees("a\n…\nd\n", "a\nb\n"));
    assert!(!agrees("a\n", "a\nb\n"));
    assert!(agrees("in 12 ms, fine\n", "in 7 ms, fine\n"));
    assert!(!agrees("12 steps\n", "7 steps\n"));
}
