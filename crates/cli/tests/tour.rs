//! The documents' `console` blocks are run, and their output compared; their quotations of files are compared too.
//!
//! In a block, a line `$ …` is a command for `sh`, the lines below it are what it prints. A line `…` stands for any
//! lines. All blocks of a document are run in one folder that is empty at the start, but for a link to the project's
//! `examples`. Times are not compared. A code block after `<!-- path -->` is that file; after `<!-- path [name] -->` it is
//! what stands there between the lines `# [name]` and `# [/name]`. With `UPDATE_DOCS=1` the documents are rewritten
//! instead; outputs with a `…` are left as they are. Documents that need Python are skipped without it.
#![cfg(unix)]

use std::fmt::Write;
use std::fs;
use std::io::{Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs a command; whoever is asked for something answers yes.
fn run(command: &str, folder: &Path) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_typelift"));
    let path = std::env::var("PATH").unwrap_or_default();
    // One pipe for both, so that lines come in the order in which a person sees them.
    let (mut reader, writer) = std::io::pipe().expect("a pipe");
    let mut shell = Command::new("sh");
    shell
        .args(["-c", command])
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", program.parent().expect("its folder").display()))
        .stdin(Stdio::piped())
        .stdout(writer.try_clone().expect("a second end"))
        .stderr(writer);
    let mut child = shell.spawn().expect("the program starts");
    drop(shell);
    child.stdin.take().expect("piped").write_all(b"y\n").ok();
    let mut text = String::new();
    reader.read_to_string(&mut text).expect("UTF-8");
    child.wait().expect("it ends");
    text
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

/// The file, or the part of it, that a line `<!-- path [name] -->` announces.
fn quoted(line: &str) -> Option<String> {
    let inner = line.strip_prefix("<!-- ")?.strip_suffix(" -->")?;
    let (path, name) = inner.split_once(' ').map_or((inner, None), |(path, name)| (path, Some(name)));
    let text = fs::read_to_string(root().join(path)).ok()?;
    let Some(name) = name else { return Some(text) };
    let name = name.trim_matches(['[', ']']);
    let (_, rest) = text.split_once(&format!("# [{name}]\n")).expect("the start of the quotation");
    Some(rest.split_once(&format!("# [/{name}]\n")).expect("its end").0.to_owned())
}

/// Runs the blocks of a document and compares its quotations.
fn tour(document: &str) {
    let path = root().join(document);
    let text = fs::read_to_string(&path).expect("the document");
    let folder = tempfile::tempdir().expect("a folder");
    let examples = root().join("examples").canonicalize().expect("the examples");
    std::os::unix::fs::symlink(examples, folder.path().join("examples")).expect("a link");
    let update = std::env::var_os("UPDATE_DOCS").is_some();
    let (mut written, mut in_console, mut commands) = (String::new(), false, 0);
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let _ = writeln!(written, "{line}");
        if let Some(quotation) = quoted(line) {
            let _ = writeln!(written, "{}", lines.next().expect("a code block after a quotation's mark"));
            let mut shown = String::new();
            while let Some(next) = lines.next_if(|next| *next != "```") {
                let _ = writeln!(shown, "{next}");
            }
            assert!(update || shown == quotation, "{document}: not what stands in the file: {line}\n{quotation}");
            written.push_str(&quotation);
            continue;
        }
        if line.starts_with("```") {
            in_console = !in_console && line == "```console";
        }
        let Some(command) = line.strip_prefix("$ ").filter(|_| in_console) else { continue };
        let mut expected = String::new();
        while let Some(next) = lines.next_if(|next| !next.starts_with("$ ") && *next != "```") {
            let _ = writeln!(expected, "{next}");
        }
        let blank_line = if expected.ends_with("\n\n") { "\n" } else { "" };
        let found = run(command, folder.path()) + blank_line;
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
fn pddl() {
    tour("docs/pddl.md");
}

#[test]
fn a_week_in_the_kitchen() {
    tour("docs/a-week-in-the-kitchen.md");
}

#[test]
fn the_document_on_memory() {
    tour("docs/memory.md");
}

#[test]
fn your_robot() {
    if python_is_here() {
        tour("docs/your-robot.md");
    }
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
