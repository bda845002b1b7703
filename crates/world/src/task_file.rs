//! Task files, format `task/1`: a goal with the state to start from, or with what an environment is to set up.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use thiserror::Error;
use typelift_model::{GroundAtom, State, Symbol, Task, nearest};

use crate::entity_line::UnreadKeys;
use crate::trace_line::SceneLine;
use crate::{FileError, ParseError, Parser, Scene, json, read_text, write_file};

/// The format that this version reads and writes.
pub const TASK_FORMAT: &str = "task/1";

/// What is to be achieved, and from where.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TaskFile {
    /// The atoms that must hold in the end.
    pub goal: Vec<GroundAtom>,
    /// The state to start from.
    pub state: Option<Scene>,
    /// What the environment is to set up, in its own terms.
    pub scenario: Option<serde_json::Value>,
    /// The seed of whatever the environment leaves to chance.
    pub seed: Option<u64>,
    /// What is probably not meant in the file.
    pub warnings: Vec<FileError>,
}

/// Why a goal is not one for this model and state.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum TaskError {
    /// There is no state.
    #[error("the task has no `state` to plan from")]
    NoState,
    /// The state is not one.
    #[error("in the state: {0}")]
    State(ParseError),
    /// A predicate that the model does not know.
    #[error("in the goal {atom}: the model has no predicate `{}`", .atom.predicate)]
    UnknownPredicate {
        /// The goal atom.
        atom: GroundAtom,
        /// The predicate that may have been meant.
        near: Option<Symbol>,
    },
    /// A predicate with another number of arguments.
    #[error("in the goal {atom}: `{}` takes {expected} argument{}, not {}", .atom.predicate, if *.expected == 1 { "" } else { "s" }, .atom.arity())]
    Arity {
        /// The goal atom.
        atom: GroundAtom,
        /// The predicate's number of arguments.
        expected: usize,
    },
    /// An object that the state does not have.
    #[error("in the goal {atom}: there is no `{object}` in the state")]
    UnknownObject {
        /// The goal atom.
        atom: GroundAtom,
        /// The object.
        object: Symbol,
        /// The object that may have been meant.
        near: Option<Symbol>,
    },
}

impl TaskError {
    /// What to do about it, if that is known.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::UnknownPredicate { near, .. } | Self::UnknownObject { near, .. } => {
                near.as_ref().map(|name| format!("Did you mean `{name}`?"))
            }
            Self::NoState => Some("Give it a `state`, or run it in an environment (typelift run).".to_owned()),
            Self::Arity { atom, expected } => {
                let args: Vec<String> = (1..=*expected).map(|i| format!("x{i}")).collect();
                Some(format!("Write `{}({})`, with the names of entities.", atom.predicate, args.join(",")))
            }
            Self::State(_) => None,
        }
    }

    /// The error as one about a file.
    pub fn in_file(&self, path: &Path, parser: &Parser) -> FileError {
        let error = FileError::new(path, self.to_string());
        match self {
            Self::State(cause) => {
                FileError { hint: FileError::from_parse(path, None, cause, parser.hierarchy()).hint, ..error }
            }
            _ => error.with_hint(self.hint()),
        }
    }
}

/// Checks that every goal atom is over known predicates and over objects of the state.
///
/// # Errors
/// [`TaskError`] for the first that is not.
pub fn check_goal(goal: &[GroundAtom], state: &State, predicates: &BTreeMap<Symbol, usize>) -> Result<(), TaskError> {
    for atom in goal {
        match predicates.get(&atom.predicate) {
            Some(&expected) if expected != atom.arity() => {
                return Err(TaskError::Arity { atom: atom.clone(), expected });
            }
            Some(_) => {}
            None => {
                let near = nearest(atom.predicate.as_str(), predicates.keys()).cloned();
                return Err(TaskError::UnknownPredicate { atom: atom.clone(), near });
            }
        }
        if let Some(object) = atom.args.iter().find(|arg| !state.objects.contains_key(*arg)) {
            let near = nearest(object.as_str(), state.objects.keys()).cloned();
            return Err(TaskError::UnknownObject { atom: atom.clone(), object: object.clone(), near });
        }
    }
    Ok(())
}

impl TaskFile {
    /// Reads the text of a task file; errors call it `name`.
    ///
    /// # Errors
    /// As for [`read_task`].
    pub fn from_text(name: &Path, text: &str) -> Result<Self, FileError> {
        if text.trim().is_empty() {
            return Err(FileError::new(name, "the file is empty"));
        }
        if text.trim_start().starts_with(['(', ';']) {
            let what = "this is a PDDL file; typelift reads tasks as JSON so far";
            return Err(FileError { unsupported: true, ..FileError::new(name, what) });
        }
        let json = |error: serde_json::Error| {
            let hint = json::hint(&error, text);
            FileError::from_json(name, 1, &error).with_hint(hint)
        };
        match json::format(text).map_err(json)? {
            None => {
                let what = format!("there is no \"format\":\"{TASK_FORMAT}\": this is not a task file");
                return Err(FileError::new(name, what));
            }
            Some(found) => {
                json::check_format(&found, TASK_FORMAT)
                    .map_err(|(what, hint)| FileError::new(name, what).with_hint(hint))?;
            }
        }
        let ReadTask { goal, state, scenario, seed } = serde_json::from_str(text).map_err(json)?;
        let mut unread = UnreadKeys::default();
        if let Some(state) = &state {
            unread.note(name, None, state.entities());
        }
        let state = state.map(SceneLine::scene).transpose().map_err(|what| FileError::new(name, what))?;
        Ok(Self { goal, state, scenario, seed, warnings: unread.warnings })
    }

    /// The planning task, if there is a state, checked against the model's predicates.
    ///
    /// # Errors
    /// [`TaskError`] if there is no state, or goal and state do not fit each other or the model.
    pub fn task(&self, parser: &mut Parser, predicates: &BTreeMap<Symbol, usize>) -> Result<Task, TaskError> {
        let scene = self.state.as_ref().ok_or(TaskError::NoState)?;
        let init = parser.parse(scene).map_err(TaskError::State)?;
        check_goal(&self.goal, &init, predicates)?;
        Ok(Task::new(init, self.goal.clone()))
    }

    /// The task as JSON text, ending in a line feed.
    pub fn to_json(&self) -> String {
        let written = WrittenTask {
            format: TASK_FORMAT.to_owned(),
            goal: &self.goal,
            state: self.state.as_ref(),
            scenario: self.scenario.as_ref(),
            seed: self.seed,
        };
        // Every part is made of what JSON can hold.
        let mut text = serde_json::to_string_pretty(&written).unwrap_or_default();
        text.push('\n');
        text
    }
}

#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct WrittenTask<'a> {
    /// The format and its version.
    #[cfg_attr(feature = "schema", schemars(extend("const" = TASK_FORMAT)))]
    format: String,
    /// The atoms that must hold in the end.
    goal: &'a [GroundAtom],
    /// The state to start from.
    #[serde(skip_serializing_if = "Option::is_none")]
    state: Option<&'a Scene>,
    /// What the environment is to set up, in its own terms.
    #[serde(skip_serializing_if = "Option::is_none")]
    scenario: Option<&'a serde_json::Value>,
    /// The seed of whatever the environment leaves to chance.
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for TaskFile {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Task".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        WrittenTask::json_schema(generator)
    }
}

#[derive(Deserialize)]
#[serde(expecting = "a task")]
struct ReadTask {
    goal: Vec<GroundAtom>,
    state: Option<SceneLine>,
    scenario: Option<serde_json::Value>,
    seed: Option<u64>,
}

/// Reads a task file.
///
/// # Errors
/// [`FileError`] if it is not one, or is of another version.
pub fn read_task(path: &Path) -> Result<TaskFile, FileError> {
    TaskFile::from_text(path, &read_text(path)?)
}

/// Writes a task file.
///
/// # Errors
/// [`FileError`] if that fails.
pub fn write_task(path: &Path, task: &TaskFile) -> Result<(), FileError> {
    write_file(path, task.to_json().as_bytes())
}
