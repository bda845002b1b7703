//! What is wrong with a file, and where: one error for all readers.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::{fs, io};

use thiserror::Error;
use typelift_model::{Hierarchy, Symbol, did_you_mean, nearest, printable};
use typelift_pddl::PddlError;

use crate::{ParseError, ParseErrorKind, json};

/// Why a file could not be read or written. Shown as `demos/a.jsonl:14: …`.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}{what}", self.place())]
pub struct FileError {
    /// What is wrong.
    pub what: String,
    /// The file, as it was named; empty if there is none.
    pub file: String,
    /// The line, from 1, where it is known.
    pub line: Option<u32>,
    /// The column, from 1, where it is known.
    pub column: Option<u32>,
    /// What to do about it.
    pub hint: Option<String>,
    /// The lines concerned, marked, where that helps.
    pub excerpt: Option<String>,
    /// Whether the file is right, but uses something that is not supported.
    pub unsupported: bool,
}

/// The most names of a folder that are compared with one that is not there.
const MOST_NAMES: usize = 10_000;

/// ``Did you mean `demos/a.jsonl`?``, if the folder of a file that is not there has one that differs a little in its name or
/// in its ending.
fn file_nearby(file: &Path) -> Option<String> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let listed = fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?.take(MOST_NAMES);
    let mut names: Vec<PathBuf> = listed.filter_map(|entry| Some(entry.ok()?.file_name().into())).collect();
    // A folder is listed in no order.
    names.sort_unstable();
    type Part = fn(&Path) -> Option<&OsStr>;
    let differing_in = |part: Part, other: Part| {
        let alike = names.iter().filter(|name| other(name) == other(file));
        let parts: Vec<(Symbol, &PathBuf)> =
            alike.filter_map(|name| Some((Symbol::new(part(name)?.to_str()?), name))).collect();
        let near = nearest(part(file)?.to_str()?, parts.iter().map(|(part, _)| part))?;
        parts.iter().find(|(part, _)| part == near).map(|(_, name)| *name)
    };
    let near = differing_in(Path::file_stem, Path::extension);
    let near = near.or_else(|| differing_in(Path::extension, Path::file_stem))?;
    Some(format!("Did you mean `{}`?", file.with_file_name(near).display()))
}

fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

impl FileError {
    /// An error about a file as a whole.
    pub fn new(file: &Path, what: impl Into<String>) -> Self {
        Self {
            what: printable(what),
            file: file.display().to_string(),
            line: None,
            column: None,
            hint: None,
            excerpt: None,
            unsupported: false,
        }
    }

    /// An error about a line of a file.
    pub fn at_line(file: &Path, line: usize, what: impl Into<String>) -> Self {
        Self { line: Some(number(line)), ..Self::new(file, what) }
    }

    /// With the column in its line.
    #[must_use]
    pub fn with_column(mut self, column: usize) -> Self {
        self.column = Some(number(column));
        self
    }

    /// With advice, if there is any.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<Option<String>>) -> Self {
        self.hint = hint.into().map(printable);
        self
    }

    /// An error of the operating system.
    pub fn from_io(file: &Path, error: &io::Error) -> Self {
        let what = match error.kind() {
            io::ErrorKind::NotFound => {
                return Self::new(file, "there is no such file").with_hint(file_nearby(file));
            }
            io::ErrorKind::IsADirectory => "this is a folder, not a file".to_owned(),
            io::ErrorKind::PermissionDenied => "access is not permitted".to_owned(),
            _ => error.to_string(),
        };
        Self::new(file, what)
    }

    /// An error of the operating system in writing.
    pub fn from_write(file: &Path, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound => Self::new(file, "there is no such folder to write to"),
            io::ErrorKind::AlreadyExists => Self::new(file, "this is a file, not a folder"),
            io::ErrorKind::NotADirectory => Self::new(file, "a part of this path is a file, not a folder"),
            _ => Self::from_io(file, error),
        }
    }

    /// An error of PDDL text, with its lines.
    pub fn from_pddl(file: &Path, text: &str, error: PddlError) -> Self {
        Self {
            excerpt: Some(error.excerpt(text)),
            unsupported: error.unsupported,
            ..Self::at_line(file, error.position.line, error.message)
                .with_column(error.position.column)
                .with_hint(error.hint)
        }
    }

    /// An error of the JSON `text`, whose first line is line `first` of the file: with the keys that lead to its place.
    pub fn from_json(file: &Path, first: usize, text: &str, error: &serde_json::Error) -> Self {
        let line = first + error.line().max(1) - 1;
        let what = match json::place(text, error) {
            Some(place) => format!("in `{place}`: {}", json::message(error)),
            None => json::message(error),
        };
        let at = Self::at_line(file, line, what);
        if error.column() > 0 { at.with_column(error.column()) } else { at }
    }

    /// An error of the scene that starts in `line`.
    pub fn from_parse(file: &Path, line: Option<usize>, error: &ParseError, hierarchy: &Hierarchy) -> Self {
        let hint = match &error.kind {
            ParseErrorKind::UnknownType { ty, .. } => {
                let names = hierarchy.types().map(|t| hierarchy.name(t));
                Some(match did_you_mean(ty.as_str(), names) {
                    Some(question) => format!("{question} Otherwise add it to the hierarchy."),
                    None => "Add it to the hierarchy.".to_owned(),
                })
            }
            kind => kind.hint().map(str::to_owned),
        };
        Self { line: line.map(number), ..Self::new(file, error.to_string()) }.with_hint(hint)
    }

    /// `file:line:column: `, as far as they are known.
    pub fn place(&self) -> String {
        if self.file.is_empty() {
            return String::new();
        }
        let numbers = [self.line, self.column].into_iter().flatten().map(|n| format!(":{n}"));
        format!("{}{}: ", self.file, numbers.collect::<String>())
    }

    /// The error with the lines concerned, without the hint.
    pub fn render(&self) -> String {
        match &self.excerpt {
            Some(excerpt) => format!("{self}\n{excerpt}"),
            None => self.to_string(),
        }
    }
}
