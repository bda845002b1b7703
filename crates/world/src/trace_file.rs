//! Trace files: demonstrations, one a file, one state or action a line.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use typelift_model::{GroundAtom, HashMap, State, Symbol, SymbolPool, TypeId, check_name, did_you_mean};

use crate::entity_line::UnreadKeys;
use crate::line_reader::{LINE_LIMIT, Line, LineReader};
use crate::trace_line::{BodyLine, HeaderLine, TRACE_FORMAT};
use crate::{FileError, Parser, Scene, Trace, TraceAction, json};

/// The first line of a trace.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TraceHeader {
    /// What is done, in words.
    pub task: String,
    /// What holds in the end, if it is said.
    pub goal: Vec<GroundAtom>,
}

/// A line of a trace after the header.
#[derive(Debug, Clone, PartialEq)]
pub enum TraceItem {
    /// What is observed.
    State(Scene),
    /// What is done then.
    Action(TraceAction),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Last {
    Header,
    State,
    Action,
}

/// Reads a trace line by line, holding one line at a time. States and actions come in turn, beginning and ending with
/// a state; anything else is an error. After an error, or the end, nothing more comes.
#[derive(Debug)]
pub struct TraceReader<R> {
    lines: LineReader<R>,
    header: TraceHeader,
    last: Last,
    done: bool,
    unread: UnreadKeys,
}

impl TraceReader<BufReader<File>> {
    /// Opens a file and reads its header.
    ///
    /// # Errors
    /// [`FileError`] if that fails.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        let file = File::open(path).map_err(|e| FileError::from_io(path, &e))?;
        Self::new(path, BufReader::new(file))
    }
}

impl<R: BufRead> TraceReader<R> {
    /// Reads the header of a trace; `path` is what errors name.
    ///
    /// # Errors
    /// [`FileError`] if there is none, or one of another version.
    pub fn new(path: &Path, input: R) -> Result<Self, FileError> {
        let mut lines = LineReader::new(path, input, LINE_LIMIT);
        let no_header = || {
            let hint = format!(r#"It is {{"format":"{TRACE_FORMAT}","task":"…","goal":["…"]}}."#);
            FileError::at_line(path, 1, "the first line is not a header").with_hint(hint)
        };
        let Some(line) = lines.next_line()? else {
            return Err(FileError::new(path, "the file is empty"));
        };
        if !line.text.trim_start().starts_with('{') {
            return Err(no_header());
        }
        match json::format(line.text) {
            Err(error) if error.is_eof() => return Err(no_header()),
            Err(error) => return Err(malformed(path, &line, &error)),
            Ok(None) => return Err(no_header()),
            Ok(Some(found)) => json::check_format(&found, TRACE_FORMAT)
                .map_err(|(what, hint)| FileError::at_line(path, 1, what).with_hint(hint))?,
        }
        let HeaderLine { task, goal } = parse(path, &line)?;
        Ok(Self {
            lines,
            header: TraceHeader { task, goal },
            last: Last::Header,
            done: false,
            unread: UnreadKeys::default(),
        })
    }

    /// The header.
    pub fn header(&self) -> &TraceHeader {
        &self.header
    }

    /// The number of the line read last, from 1.
    pub fn line(&self) -> usize {
        self.lines.line()
    }

    fn next_item(&mut self) -> Result<Option<TraceItem>, FileError> {
        let path = self.lines.path().to_owned();
        let Some(line) = self.lines.next_line()? else {
            let (missing, hint) = match self.last {
                Last::State => return Ok(None),
                Last::Header => ("there is no state after the header", "A trace has at least one state."),
                Last::Action => ("there is no state after the last action", AFTER_EVERY_ACTION),
            };
            return Err(FileError::at_line(&path, self.lines.line(), missing).with_hint(hint.to_owned()));
        };
        if line.text.trim().is_empty() {
            let number = line.number;
            while let Some(next) = self.lines.next_line()? {
                if !next.text.trim().is_empty() {
                    return Err(FileError::at_line(&path, number, "this line is empty"));
                }
            }
            return self.next_item();
        }
        let number = line.number;
        let error = |what: &str| FileError::at_line(&path, number, what);
        if !line.text.trim_start().starts_with('{') {
            let hint = r#"A line is {"state":…} or {"action":…}."#;
            return Err(error("this line is not a JSON object").with_hint(hint.to_owned()));
        }
        let body: BodyLine = parse(&path, &line)?;
        let item = match (body.state, body.action) {
            (Some(state), None) => {
                self.unread.note(&path, Some(number), &state);
                TraceItem::State(state.scene().map_err(error)?)
            }
            (None, Some(call)) => {
                let BodyLine { executed, reason, t: time, expected, verdict, .. } = body;
                TraceItem::Action(TraceAction { call, executed, reason, time, expected, verdict })
            }
            (None, None) => return Err(error("this line has neither a `state` nor an `action`")),
            (Some(_), Some(_)) => return Err(error("this line has both a `state` and an `action`")),
        };
        self.last = match (self.last, &item) {
            (Last::Header | Last::Action, TraceItem::State(_)) => Last::State,
            (Last::State, TraceItem::Action(_)) => Last::Action,
            (Last::Header, TraceItem::Action(_)) => {
                let hint = "Record the state before the first action too.";
                return Err(error("there is no state before the first action").with_hint(hint.to_owned()));
            }
            (Last::Action, TraceItem::Action(_)) => {
                let what = "there is no state between this action and the one before";
                return Err(error(what).with_hint(AFTER_EVERY_ACTION.to_owned()));
            }
            (Last::State, TraceItem::State(_)) => {
                let hint = "Record the action between them, or leave out one of the states.";
                let what = "there is no action between this state and the one before";
                return Err(error(what).with_hint(hint.to_owned()));
            }
        };
        Ok(Some(item))
    }
}

impl<R: BufRead> Iterator for TraceReader<R> {
    type Item = Result<TraceItem, FileError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.done {
            return None;
        }
        let item = self.next_item().transpose();
        self.done = !matches!(item, Some(Ok(_)));
        item
    }
}

const AFTER_EVERY_ACTION: &str = "Record the state after every action.";

fn parse<'a, T: serde::Deserialize<'a>>(path: &Path, line: &Line<'a>) -> Result<T, FileError> {
    serde_json::from_str(line.text).map_err(|error| malformed(path, line, &error))
}

fn malformed(path: &Path, line: &Line<'_>, error: &serde_json::Error) -> FileError {
    let (what, hint) = match (error.is_eof(), line.complete) {
        (true, false) => {
            let hint = "The recording was cut off: remove this line, and an action that has no state after it.";
            ("the last line is incomplete".to_owned(), Some(hint.to_owned()))
        }
        (true, true) => ("this line ends too early".to_owned(), None),
        (false, _) => (json::message(error), json::hint(error, line.text)),
    };
    FileError { what, hint, ..FileError::from_json(path, line.number, error) }
}

/// Reads a trace file.
///
/// # Errors
/// [`FileError`] at the first line that is malformed, out of turn, or shows something impossible: an unknown type, an
/// entity whose type changes, an action on an entity that is not there.
pub fn read_trace(path: &Path, parser: &mut Parser) -> Result<Trace, FileError> {
    trace_from(path, TraceReader::open(path)?, parser)
}

/// The file's name without its folders.
pub(crate) fn file_name(path: &Path) -> Option<Symbol> {
    path.file_name().map(|name| Symbol::from(name.to_string_lossy().into_owned()))
}

pub(crate) fn trace_from<R: BufRead>(
    path: &Path,
    mut reader: TraceReader<R>,
    parser: &mut Parser,
) -> Result<Trace, FileError> {
    let TraceHeader { task, goal } = reader.header().clone();
    let mut trace = Trace { file: file_name(path), task, goal, ..Trace::default() };
    let mut names = SymbolPool::new();
    let mut types: HashMap<Symbol, (TypeId, usize)> = HashMap::default();
    let mut state_line = 0;
    while let Some(item) = reader.next() {
        let line = reader.line();
        match item? {
            TraceItem::State(scene) => {
                let state = parser
                    .parse(&scene)
                    .map_err(|e| FileError::from_parse(path, Some(line), &e, parser.hierarchy()))?;
                for (name, &ty) in &state.objects {
                    let &mut (first, at) = types.entry(name.clone()).or_insert((ty, line));
                    if first != ty {
                        let (now, before) = (parser.hierarchy().name(ty), parser.hierarchy().name(first));
                        let what = format!("entity {name} is of type `{now}` here and of type `{before}` in line {at}");
                        let hint = "An entity is of one type; what becomes another thing needs another name.";
                        return Err(FileError::at_line(path, line, what).with_hint(hint.to_owned()));
                    }
                }
                state_line = line;
                trace.states.push(share(&state, &mut names));
            }
            TraceItem::Action(action) => {
                check_name(action.call.name.as_str()).map_err(|error| {
                    let hint = "An action is named by a word without white space and ( ) , ; \".";
                    FileError::at_line(path, line, format!("the action's name: {error}")).with_hint(hint.to_owned())
                })?;
                let state = trace.states.last().map(|state| &state.objects);
                let expected = action.expected.iter().flat_map(|expected| &expected.args);
                let mut mentioned = action.call.args.iter().chain(expected);
                if let Some(missing) = mentioned.find(|arg| !state.is_some_and(|s| s.contains_key(*arg))) {
                    let what = format!(
                        "the action {} mentions `{missing}`, which is not in the state before it (line {state_line})",
                        action.call
                    );
                    let hint = did_you_mean(missing.as_str(), state.into_iter().flat_map(|s| s.keys()));
                    return Err(FileError::at_line(path, line, what).with_hint(hint));
                }
                trace.actions.push(action);
            }
        }
    }
    trace.warnings = reader.unread.warnings;
    Ok(trace)
}

/// The same state, its names shared with those of the states before.
fn share(state: &State, names: &mut SymbolPool) -> State {
    let mut shared = |name: &Symbol| names.symbol(name.as_str());
    let mut atoms = |set: &BTreeSet<GroundAtom>| -> BTreeSet<GroundAtom> {
        let atom = |a: &GroundAtom| GroundAtom {
            predicate: shared(&a.predicate),
            args: a.args.iter().map(&mut shared).collect(),
        };
        set.iter().map(atom).collect()
    };
    let held = atoms(&state.atoms);
    let objects = state.objects.iter().map(|(name, ty)| (names.symbol(name.as_str()), *ty)).collect();
    State { objects, atoms: held, unknown: state.unknown.clone() }
}
