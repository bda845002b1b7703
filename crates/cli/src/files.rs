//! Reading models and tasks, as every command that takes them does.

use std::path::{Path, PathBuf};

use typelift::model::{ActionModel, ModelFileError, Symbol, Task};
use typelift::world::{FileError, Parser, read_task, read_text, read_types};

use crate::exit::Exit;
use crate::failure::{Failure, NOT_AS_WRITTEN};

/// Reads a model file, and adds the types of another file to it.
pub(crate) fn read_model(path: &Path, types: Option<&PathBuf>) -> Result<ActionModel, Failure> {
    let text = read_text(path)?;
    if text.trim_start().starts_with(['(', ';']) {
        return Err(Failure::new(
            Exit::Unsupported,
            format!("{}: this is a PDDL file; typelift reads learned models (JSON) here so far", path.display()),
        ));
    }
    if text.trim().is_empty() {
        return Err(FileError::new(path, "the file is empty").into());
    }
    let mut model = ActionModel::from_json(&text).map_err(|error| match error {
        ModelFileError::Json { line, column, message } => {
            let error = FileError::at_line(path, line, message).with_column(column);
            error.with_hint(NOT_AS_WRITTEN.to_owned()).into()
        }
        error => Failure::from(error).in_file(path),
    })?;
    if let Some(types) = types {
        model.hierarchy = read_types(types)?.extend(&model.hierarchy)?;
    }
    Ok(model)
}

/// Reads a task file that says from which state to plan.
pub(crate) fn read_planning_task(path: &Path, model: &ActionModel) -> Result<Task, Failure> {
    let file = read_task(path)?;
    let mut parser = Parser::new(model.hierarchy.clone(), model.parse.clone());
    file.task(&mut parser, &model.predicates).map_err(|error| {
        let error: FileError = error.in_file(path, &parser);
        error.into()
    })
}

/// A task's name, for people: its file's, without folders and ending.
pub(crate) fn task_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| path.display().to_string(), |stem| stem.to_string_lossy().into_owned())
}

/// A name for a domain: the model file's, as far as PDDL allows it.
pub(crate) fn domain_name(path: &Path) -> Symbol {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().to_lowercase()).unwrap_or_default();
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' }).collect();
    Symbol::from(if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("model-{name}") })
}

/// Refuses to write over what is read.
pub(crate) fn keep_inputs<'a>(
    output: Option<&Path>,
    inputs: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    let Some(output) = output else { return Ok(()) };
    // A file that is not there yet is no input.
    let Ok(written) = output.canonicalize() else { return Ok(()) };
    // Of a folder, demonstrations are read.
    let is_trace = written.extension().is_some_and(|ending| ending == "jsonl" || ending == "trajectory");
    for input in inputs {
        let is_read = |read: PathBuf| read == written || is_trace && written.parent() == Some(&read);
        if written.is_file() && input.canonicalize().is_ok_and(is_read) {
            return Err(Failure::bad_input(format!("{} is read, and would be written over", output.display()))
                .with_hint(
                    "name another file to write to; a pattern such as *.jsonl after -o is expanded by the shell",
                ));
        }
    }
    Ok(())
}
