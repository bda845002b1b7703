//! Task files, format `task/1`: a goal with the state to start from, or with what an environment is to set up.

use std::path::Path;

use serde::{Deserialize, Serialize};
use thiserror::Error;
use typelift_model::{ArgumentTypes, Goal, GoalError, Symbol, Task, did_you_mean};

use crate::entity_line::UnreadKeys;
use crate::trace_line::SceneLine;
use crate::{FileError, ParseError, Parser, Scene, WrittenGoal, goal_literals, json, read_text, write_file};

/// The format that this version reads and writes.
pub const TASK_FORMAT: &str = "task/1";

/// What is to be achieved, and from where.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TaskFile {
    /// What must hold in the end, and what must not.
    pub goal: Goal,
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
    /// The goal is not one for this model and state.
    #[error(transparent)]
    Goal(#[from] GoalError),
}

impl TaskError {
    /// What to do about it, if that is known.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NoState => Some("Give it a `state`, or run it in an environment (typelift run).".to_owned()),
            Self::Goal(error) => error.hint(),
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
            FileError::from_json(name, 1, text, &error).with_hint(hint)
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
        let keys = json::keys(text).map_err(json)?;
        if !keys.iter().any(|key| *key == "goal") {
            let unread = keys.iter().find(|key| !is_read(key));
            let hint = unread.map(|key| format!("`{key}` is not read: is it meant to be `goal`?"));
            return Err(FileError::new(name, "the task has no `goal`").with_hint(hint));
        }
        let ReadTask { goal, state, scenario, seed } = serde_json::from_str(text).map_err(json)?;
        let mut warnings = unread_keys(name, &keys);
        if goal == Goal::default() {
            warnings.push(FileError::new(name, "the goal is empty: it holds in every state"));
        }
        let mut unread = UnreadKeys::default();
        if let Some(state) = &state {
            unread.note(name, None, state.entities());
        }
        warnings.extend(unread.warnings);
        let state = state
            .map(SceneLine::scene)
            .transpose()
            .map_err(|what| FileError::new(name, what).with_hint(json::near_key_of("state", text, "entities")))?;
        Ok(Self { goal, state, scenario, seed, warnings })
    }

    /// The planning task, if there is a state, checked against the model's predicates.
    ///
    /// # Errors
    /// [`TaskError`] if there is no state, or goal and state do not fit each other or the model.
    pub fn task(&self, parser: &mut Parser, predicates: &ArgumentTypes) -> Result<Task, TaskError> {
        let scene = self.state.as_ref().ok_or(TaskError::NoState)?;
        let init = parser.parse(scene).map_err(TaskError::State)?;
        let goal = self.goal.named_as_in(predicates);
        goal.check(&init, predicates, parser.hierarchy())?;
        Ok(Task::new(init, goal))
    }

    /// The task as JSON text, ending in a line feed.
    pub fn to_json(&self) -> String {
        let written = WrittenTask {
            format: TASK_FORMAT.to_owned(),
            goal: WrittenGoal(&self.goal),
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
    /// What must hold in the end, and what must not.
    goal: WrittenGoal<'a>,
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
    #[serde(deserialize_with = "goal_literals::deserialize")]
    goal: Goal,
    state: Option<SceneLine>,
    scenario: Option<serde_json::Value>,
    seed: Option<u64>,
}

/// The keys of a task.
const KEYS: [&str; 5] = ["format", "goal", "state", "scenario", "seed"];

fn is_read(key: &Symbol) -> bool {
    KEYS.contains(&key.as_str())
}

/// Warnings of keys that nothing reads: a goal under another name would be taken for none.
fn unread_keys(name: &Path, keys: &[Symbol]) -> Vec<FileError> {
    let warning = |key: &Symbol| {
        let near = did_you_mean(key.as_str(), &KEYS.map(Symbol::new));
        let hint = near.unwrap_or_else(|| format!("A task may have {}.", KEYS.join(", ")));
        FileError::new(name, format!("`{key}` is not read")).with_hint(hint)
    };
    keys.iter().filter(|key| !is_read(key)).map(warning).collect()
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
