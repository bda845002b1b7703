//! What can go wrong with an environment in another program, with what was sent and what came back.

use std::io;
use std::process::ExitStatus;
use std::time::Duration;

use thiserror::Error;
use typelift_world::{LINE_LIMIT, PROTOCOL, WorldError};

use crate::shell::shell_hint;

/// Characters of a message that are shown.
const SHOWN: usize = 200;

/// What went wrong.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Failure {
    /// The command line is empty, or a quote in it is not closed.
    #[error("the command line `{command}` {problem}")]
    CommandLine {
        /// The command line.
        command: String,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// The program could not be started.
    #[error("`{program}` could not be started: {message}")]
    NotStarted {
        /// The program.
        program: String,
        /// The system's reason.
        message: String,
        /// The kind of reason.
        kind: io::ErrorKind,
        /// The command line.
        command: String,
    },
    /// It ended.
    #[error("it ended by itself ({}) when it was to answer `{op}`", shown_status(*.status))]
    Died {
        /// What was asked.
        op: &'static str,
        /// Its exit status, or the signal that ended it, if that is known.
        status: Option<ExitStatus>,
    },
    /// It closed its output, or stopped reading its input, and did not end.
    #[error("it {} when it was to answer `{op}`, and went on running", if *.output { "closed its output" } else { "closed its input" })]
    Closed {
        /// What was asked.
        op: &'static str,
        /// Whether it was the output.
        output: bool,
    },
    /// It did not answer in time.
    #[error("it did not answer `{op}` within {} s", .limit.as_secs_f64())]
    TimedOut {
        /// What was asked.
        op: &'static str,
        /// The time that it had.
        limit: Duration,
    },
    /// It sent a line that is longer than any answer may be.
    #[error("it sent a line that is longer than {} MB", LINE_LIMIT >> 20)]
    TooLong,
    /// It sent something that is not JSON.
    #[error("it answered `{op}` with something that is not JSON ({what})")]
    NotJson {
        /// What was asked.
        op: &'static str,
        /// Why not, and where.
        what: String,
    },
    /// It sent what would be JSON, were it not for what stands for a number that is none.
    #[error("its answer to `{op}` is not JSON: {what}")]
    NoNumber {
        /// What was asked.
        op: &'static str,
        /// What it wrote, and where.
        what: String,
    },
    /// It sent JSON that is not an answer.
    #[error("its answer to `{op}` is malformed: {what}")]
    Malformed {
        /// What was asked.
        op: &'static str,
        /// What is wrong with it, and where.
        what: String,
    },
    /// It answered a request that was not sent.
    #[error("it answered `{op}` with id {found} instead of {expected}")]
    WrongId {
        /// What was asked.
        op: &'static str,
        /// The request's id.
        expected: u64,
        /// The answer's.
        found: u64,
    },
    /// Its answer lacks something.
    #[error("its answer to `{op}` has no `{field}`")]
    Missing {
        /// What was asked.
        op: &'static str,
        /// What is missing.
        field: &'static str,
    },
    /// It says that it speaks another protocol.
    #[error("it speaks `{0}`, not `{PROTOCOL}`")]
    Protocol(String),
    /// It could not do what was asked.
    #[error("it failed at `{op}`: {error}")]
    Refused {
        /// What was asked.
        op: &'static str,
        /// Its reason.
        error: String,
    },
    /// It is to be reset, but said that it cannot be.
    #[error("it said that it cannot be reset")]
    NoReset,
    /// Nothing can be asked of it any more.
    #[error("nothing can be asked of it any more: {0}")]
    Over(String),
}

/// An environment in another program failed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("environment {environment}: {failure}{}", self.details())]
pub struct BridgeError {
    /// The environment's name; until it has said it, its command line.
    pub environment: String,
    /// What went wrong.
    pub failure: Box<Failure>,
    /// What was sent to it, shortened.
    pub sent: Option<String>,
    /// What came back, shortened.
    pub came_back: Option<String>,
    /// The last lines that it wrote to its standard error, if it ended or hung. The text of the error leaves them out: who
    /// started it was told each line as it came.
    pub stderr: Vec<String>,
}

impl BridgeError {
    pub(crate) fn new(environment: &str, failure: Failure) -> Self {
        Self {
            environment: environment.to_owned(),
            failure: Box::new(failure),
            sent: None,
            came_back: None,
            stderr: Vec::new(),
        }
    }

    /// What to do about it, if that is known.
    pub fn hint(&self) -> Option<String> {
        match &*self.failure {
            Failure::NotStarted { program, kind, command, .. } => {
                shell_hint(command).or_else(|| not_started_hint(program, *kind))
            }
            Failure::NotJson { .. } => Some(
                "Its standard output is for answers only, one a line; what it wants to tell goes to standard error."
                    .to_owned(),
            ),
            Failure::NoNumber { .. } => Some(
                "JSON has no such number, though Python's json module writes it: leave out an attribute that is not known, or \
                 give it a word."
                    .to_owned(),
            ),
            Failure::WrongId { .. } => Some("An answer repeats the `id` of its request.".to_owned()),
            Failure::TimedOut { op: "hello", .. } => {
                Some("Does it read requests from its standard input, and flush its standard output?".to_owned())
            }
            _ => None,
        }
    }

    fn details(&self) -> String {
        let mut text = String::new();
        let mut line = |name: &str, content: &str| {
            text.push_str("\n  ");
            text.push_str(name);
            text.push_str(content);
        };
        if let Some(sent) = &self.sent {
            line("sent: ", sent);
        }
        if let Some(came_back) = &self.came_back {
            line("came back: ", came_back);
        }
        text
    }
}

impl From<BridgeError> for WorldError {
    fn from(error: BridgeError) -> Self {
        let account = match error.hint() {
            Some(hint) => format!("{error}\n  {hint}"),
            None => error.to_string(),
        };
        match *error.failure {
            Failure::CommandLine { .. }
            | Failure::NotStarted { .. }
            | Failure::Died { .. }
            | Failure::Closed { .. }
            | Failure::Over(_) => Self::Gone { account },
            Failure::TimedOut { .. } => Self::TimedOut { account },
            Failure::TooLong
            | Failure::NotJson { .. }
            | Failure::NoNumber { .. }
            | Failure::Malformed { .. }
            | Failure::WrongId { .. }
            | Failure::Missing { .. }
            | Failure::Protocol(_) => Self::Misspoke { account },
            Failure::NoReset | Failure::Refused { op: "reset", .. } => Self::CannotSetUp { account },
            Failure::Refused { .. } => Self::Failed { account },
        }
    }
}

fn shown_status(status: Option<ExitStatus>) -> String {
    status.map_or_else(|| "nobody knows how".to_owned(), |status| status.to_string())
}

fn not_started_hint(program: &str, kind: io::ErrorKind) -> Option<String> {
    match kind {
        io::ErrorKind::NotFound if program.contains('=') => {
            Some("No shell reads the command line: to set a variable, write `env NAME=VALUE program`.".to_owned())
        }
        io::ErrorKind::NotFound if program.contains(['/', '\\']) => {
            let folder = std::env::current_dir().map(|folder| folder.display().to_string());
            Some(format!("Is it there, seen from {}?", folder.as_deref().unwrap_or("the working directory")))
        }
        io::ErrorKind::NotFound => Some(format!("Is `{program}` installed, and in a folder of the PATH?")),
        io::ErrorKind::PermissionDenied => {
            Some("Is it executable? A script may need its interpreter before it, as in `python3 FILE`.".to_owned())
        }
        _ => None,
    }
}

/// A text in one line of at most [`SHOWN`] characters.
pub(crate) fn shorten(text: &str) -> String {
    let text = text.trim_end();
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    match text.char_indices().nth(SHOWN) {
        None => text.chars().map(plain).collect(),
        Some((end, _)) => {
            let shown: String = text[..end].chars().map(plain).collect();
            format!("{shown}… ({} bytes)", text.len())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_are_shortened_at_a_character() {
        assert_eq!(shorten("a\tb\r\n"), "a b");
        let long = "ä".repeat(SHOWN + 1);
        assert_eq!(shorten(&long), format!("{}… ({} bytes)", "ä".repeat(SHOWN), long.len()));
        assert_eq!(shorten(&"ä".repeat(SHOWN)), "ä".repeat(SHOWN));
    }

    #[test]
    fn an_error_says_all_that_is_known() {
        let failure = Failure::TimedOut { op: "hello", limit: Duration::from_millis(2500) };
        let error = BridgeError {
            sent: Some("{}".to_owned()),
            came_back: Some("x".to_owned()),
            stderr: vec!["Traceback".to_owned()],
            ..BridgeError::new("shop", failure)
        };
        assert_eq!(
            WorldError::from(error).to_string(),
            "environment shop: it did not answer `hello` within 2.5 s\n  sent: {}\n  came back: x\n  \
             Does it read requests from its standard input, and flush its standard output?"
        );
    }
}
