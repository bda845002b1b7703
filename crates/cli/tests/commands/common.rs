//! Running the program in a folder of its own.

use std::fmt::{self, Write as _};
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// A folder that is removed when the test ends.
pub(crate) struct Folder(tempfile::TempDir);

/// How a command ended.
#[derive(Debug)]
pub(crate) struct Ended {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// The program with the words of a command; what stands between single quotes holds together.
pub(crate) fn program(command: &str) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_typelift"));
    for (i, part) in command.split('\'').enumerate() {
        if i % 2 == 1 {
            program.arg(part);
        } else {
            program.args(part.split_whitespace());
        }
    }
    for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "RUST_BACKTRACE"] {
        program.env_remove(name);
    }
    program.stdin(Stdio::null());
    program
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    /// With the kitchen's files in `K`, and in `kitchen.json` the model learned from them.
    pub(crate) fn kitchen() -> Self {
        let folder = Self::new();
        folder.run("kitchen export K -q").succeeds();
        folder.run("learn K/demos --types K/types.pddl -o kitchen.json -q").succeeds();
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).expect("written");
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub(crate) fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.read(name)).expect("JSON")
    }

    /// Writes a JSON file that is another one, changed.
    pub(crate) fn changed(&self, from: &str, to: &str, change: impl FnOnce(&mut Value)) {
        let mut value = self.json(from);
        change(&mut value);
        self.write(to, format!("{value:#}\n"));
    }

    /// What is in the folder, hidden files included, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        names(self.0.path())
    }

    pub(crate) fn run(&self, command: &str) -> Ended {
        self.run_with_input(command, "")
    }

    /// Runs a command to which somebody, or another program, says this on standard input.
    pub(crate) fn run_with_input(&self, command: &str, input: &str) -> Ended {
        let mut program = program(command);
        program.current_dir(self.0.path()).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = program.spawn().expect("the program starts");
        // It may end before it has read everything.
        let _ = child.stdin.take().expect("piped").write_all(input.as_bytes());
        let output = child.wait_with_output().expect("it ends");
        let text = |bytes: &[u8]| without_measurements(&String::from_utf8_lossy(bytes));
        let ended = Ended {
            code: output.status.code().unwrap_or_else(|| panic!("{command}: {}", output.status)),
            out: text(&output.stdout),
            err: text(&output.stderr),
        };
        assert!(!ended.err.contains("panicked"), "{command}: {ended}");
        assert!(!ended.out.contains('\x1b') && !ended.err.contains('\x1b'), "{command}: escape codes in a pipe");
        ended
    }

    /// Runs a command that is to fail: with this code, saying why, printing nothing as data, and leaving the folder
    /// as it is.
    pub(crate) fn refuses(&self, code: i32, command: &str) -> Ended {
        let before = self.contents();
        let ended = self.run(command);
        assert_eq!(ended.code, code, "{command}: {ended}");
        assert!(ended.err.starts_with("error: "), "{command}: {ended}");
        assert_eq!(ended.out, "", "{command}: {ended}");
        assert!(before == self.contents(), "{command} leaves something behind: {:?}", self.names());
        ended
    }

    fn contents(&self) -> Vec<(String, Option<Vec<u8>>)> {
        self.names().into_iter().map(|name| (name.clone(), fs::read(self.path(&name)).ok())).collect()
    }
}

pub(crate) fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

impl Ended {
    #[track_caller]
    pub(crate) fn succeeds(&self) {
        assert_eq!(self.code, 0, "{self}");
    }
}

impl fmt::Display for Ended {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "exit {}", self.code)?;
        for (label, text) in [("standard output", &self.out), ("standard error", &self.err)] {
            if !text.is_empty() {
                write!(f, "-- {label}\n{text}")?;
            }
        }
        Ok(())
    }
}

/// Many commands and how they ended, for one snapshot.
#[derive(Default)]
pub(crate) struct Transcript(pub(crate) String);

impl Transcript {
    pub(crate) fn add(&mut self, title: &str, ended: &Ended) {
        let _ = writeln!(self.0, "# {title}\n{ended}");
    }
}

/// The text with every time and every count of bytes as `N`: `12 ms`, `0.3 s`, `"seconds": 0.01`, `"bytes": 4096`.
pub(crate) fn without_measurements(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, number) = rest.split_at(start);
        kept.push_str(before);
        let end = number.find(|c: char| !c.is_ascii_digit() && !".e-".contains(c)).unwrap_or(number.len());
        let (number, after) = number.split_at(end);
        let is_measured = [" ms", " s."].iter().any(|unit| after.starts_with(unit))
            || ["seconds\":", "seconds\": ", "\"bytes\": "].iter().any(|key| before.ends_with(key));
        kept.push_str(if is_measured { "N" } else { number });
        rest = after;
    }
    kept + rest
}
