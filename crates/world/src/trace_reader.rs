//! Reading a trace step by step.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use typelift_model::SourceId;

use crate::entity_line::UnreadKeys;
use crate::line_reader::{LINE_LIMIT, Line, LineReader};
use crate::trace_line::{BodyLine, HeaderLine, TRACE_FORMAT};
use crate::{FileError, Recording, Scene, TraceAction, TraceHeader, json};

/// A part of a trace after the header.
#[derive(Debug, Clone, PartialEq)]
pub enum TraceItem {
    /// What is observed before the first action.
    Start(Scene),
    /// What is done then, and what is observed after it.
    Step(TraceAction, Scene),
}

/// A line after the header.
enum Body {
    State(Scene),
    Action(TraceAction),
}

/// Reads a trace step by step, holding one step at a time. States and actions come in turn, beginning and ending with a
/// state; anything else is an error. After an error, or the end, nothing more comes.
///
/// A recording may have been cut off: the last line is incomplete, or an action that has no state after it. What is whole
/// is read, and a [warning](Self::warnings) says what is not.
#[derive(Debug)]
pub struct TraceReader<R> {
    lines: LineReader<R>,
    header: TraceHeader,
    started: bool,
    done: bool,
    unread: UnreadKeys,
    /// What is lost where the recording was cut off.
    cut_off: Option<FileError>,
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
        let HeaderLine { task, goal } =
            serde_json::from_str(line.text).map_err(|error| malformed(path, &line, &error))?;
        Ok(Self {
            lines,
            header: TraceHeader { task, goal },
            started: false,
            done: false,
            unread: UnreadKeys::default(),
            cut_off: None,
        })
    }

    /// The header.
    pub fn header(&self) -> &TraceHeader {
        &self.header
    }

    /// The number of the line read last, from 1: that of a state.
    pub fn line(&self) -> usize {
        self.lines.line()
    }

    /// Which source it is: the SHA-256 of what was read so far, so of the whole file at its end.
    pub fn source(&self) -> SourceId {
        self.lines.source()
    }

    /// What is probably not meant, in what was read so far.
    pub fn warnings(&self) -> Vec<FileError> {
        self.unread.warnings.iter().chain(&self.cut_off).cloned().collect()
    }

    /// Reads to the end.
    ///
    /// # Errors
    /// [`FileError`] at the first line that is malformed or out of turn.
    pub fn recording(&mut self) -> Result<Recording, FileError> {
        let mut first = None;
        let mut steps = Vec::new();
        for item in &mut *self {
            match item? {
                TraceItem::Start(scene) => first = Some(scene),
                TraceItem::Step(action, after) => steps.push((action, after)),
            }
        }
        let first = first.ok_or_else(|| self.error("nothing is left to read"))?;
        Ok(Recording { header: self.header.clone(), first, steps })
    }

    /// An error about the line read last.
    fn error(&self, what: &str) -> FileError {
        FileError::at_line(self.lines.path(), self.line(), what)
    }

    fn next_item(&mut self) -> Result<Option<TraceItem>, FileError> {
        if !self.started {
            return match self.next_body()? {
                Some(Body::State(scene)) => {
                    self.started = true;
                    Ok(Some(TraceItem::Start(scene)))
                }
                Some(Body::Action(_)) => {
                    let hint = "Record the state before the first action too.";
                    Err(self.error("there is no state before the first action").with_hint(hint.to_owned()))
                }
                None => {
                    let hint = "A trace has at least one state.";
                    Err(self.error("there is no state after the header").with_hint(hint.to_owned()))
                }
            };
        }
        let action = match self.next_body()? {
            Some(Body::Action(action)) => action,
            Some(Body::State(_)) => {
                let hint = "Record the action between them, or leave out one of the states.";
                let what = "there is no action between this state and the one before";
                return Err(self.error(what).with_hint(hint.to_owned()));
            }
            None => return Ok(None),
        };
        let number = self.line();
        match self.next_body()? {
            Some(Body::State(after)) => Ok(Some(TraceItem::Step(action, after))),
            Some(Body::Action(_)) => {
                let what = "there is no state between this action and the one before";
                Err(self.error(what).with_hint(AFTER_EVERY_ACTION.to_owned()))
            }
            None => {
                let warning = match self.cut_off.take() {
                    Some(cut_off) => {
                        let what = format!("{}, and so is {} before it", cut_off.what, action.call);
                        FileError { what, ..cut_off }
                    }
                    None => {
                        let what = format!("there is no state after {}: it is left out", action.call);
                        FileError::at_line(self.lines.path(), number, what).with_hint(AFTER_EVERY_ACTION.to_owned())
                    }
                };
                self.cut_off = Some(warning);
                Ok(None)
            }
        }
    }

    /// The next line after the header, if there is one. One in which the recording was cut off is none; but the first
    /// state is needed.
    fn next_body(&mut self) -> Result<Option<Body>, FileError> {
        let path = self.lines.path().to_owned();
        let Some(line) = self.lines.next_line()? else { return Ok(None) };
        let number = line.number;
        let error = |what: &str| FileError::at_line(&path, number, what);
        if line.text.trim().is_empty() {
            while let Some(next) = self.lines.next_line()? {
                if !next.text.trim().is_empty() {
                    return Err(error("this line is empty"));
                }
            }
            return Ok(None);
        }
        if !line.text.trim_start().starts_with('{') {
            let hint = r#"A line is {"state":…} or {"action":…}."#;
            return Err(error("this line is not a JSON object").with_hint(hint.to_owned()));
        }
        let mut body: BodyLine = match serde_json::from_str(line.text) {
            Ok(body) => body,
            Err(eof) if eof.is_eof() && !line.complete && self.started => {
                self.cut_off = Some(error("the recording was cut off in this line: it is left out"));
                return Ok(None);
            }
            Err(error) => return Err(malformed(&path, &line, &error)),
        };
        match (body.state.take(), body.action()) {
            (Some(state), None) => {
                self.unread.note(&path, Some(number), state.entities());
                let hint = || json::near_key_of("state", line.text, "entities");
                Ok(Some(Body::State(state.scene().map_err(|what| error(what).with_hint(hint()))?)))
            }
            (None, Some(action)) => {
                let keys = json::keys(line.text).unwrap_or_default();
                self.unread.note_keys(&path, number, &keys, &ACTION_KEYS);
                Ok(Some(Body::Action(action)))
            }
            (None, None) => Err(error("this line has neither a `state` nor an `action`")),
            (Some(_), Some(_)) => Err(error("this line has both a `state` and an `action`")),
        }
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

/// The keys of a line with an action.
const ACTION_KEYS: [&str; 6] = ["action", "executed", "reason", "t", "expected", "verdict"];

const AFTER_EVERY_ACTION: &str = "Record the state after every action.";

fn malformed(path: &Path, line: &Line<'_>, error: &serde_json::Error) -> FileError {
    let (what, hint) = match (error.is_eof(), line.complete) {
        (true, false) => {
            let hint = "The recording was cut off before anything was done: there is nothing to learn from it.";
            ("the last line is incomplete".to_owned(), Some(hint.to_owned()))
        }
        (true, true) => ("this line ends too early".to_owned(), None),
        (false, _) => {
            let told = FileError::from_json(path, line.number, line.text, error);
            return told.with_hint(json::hint(error, line.text));
        }
    };
    FileError { what, hint, ..FileError::from_json(path, line.number, line.text, error) }
}
