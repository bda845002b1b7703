//! Task files.

use std::path::Path;

use typelift::model::ParseConfig;
use typelift::world::{FileError, Parser, TaskFile, read_task};

use super::errors::assert_shown;
use super::sample;
use super::scratch::in_file;

/// What is read is written so that it reads the same; it is a planning task, or says why not.
pub fn task(bytes: &[u8]) {
    // What is odd about a text is no part of the task.
    let read = |path: &Path| -> Result<TaskFile, FileError> {
        read_task(path).map(|task| TaskFile { warnings: Vec::new(), ..task })
    };
    let task = match in_file(bytes, read) {
        Ok(task) => task,
        Err(error) => return assert_shown(&error, bytes),
    };
    let written = task.to_json();
    let again = in_file(written.as_bytes(), read).unwrap_or_else(|error| panic!("{error}:\n{written}"));
    assert_eq!(again, task);
    assert_eq!(again.to_json(), written);
    let mut parser = Parser::new(sample::hierarchy(), ParseConfig::default());
    let root = parser.hierarchy().root();
    let predicates = task.goal.literals().map(|(atom, _)| (atom.predicate.clone(), vec![root; atom.arity()])).collect();
    match task.task(&mut parser, &predicates) {
        Ok(planned) => assert_eq!(planned.goal, task.goal),
        Err(error) => assert_shown(&error.in_file(Path::new("task"), &parser), bytes),
    }
}
