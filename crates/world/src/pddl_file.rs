//! Domains and problems from files, compiled into a model and a task.

use std::path::{Path, PathBuf};

use typelift_model::{ActionModel, Symbol, Task};
use typelift_pddl::{
    CompileError, Domain, Meaning, Problem, compile_domain, compile_problem, read_domain, read_model_problem,
    read_problem,
};

use crate::{FileError, read_text};

/// A domain that was read, with the model that it states.
#[derive(Debug, Clone)]
pub struct DomainFile {
    /// The domain as it is written.
    pub domain: Domain,
    /// Its model.
    pub model: ActionModel,
    path: PathBuf,
    text: String,
}

/// Whether a text is PDDL rather than JSON.
pub fn is_pddl(text: &str) -> bool {
    text.trim_start().starts_with(['(', ';'])
}

impl DomainFile {
    /// Reads the text of a domain; errors call it `path`.
    ///
    /// # Errors
    /// [`FileError`] if it is not one, or has no model.
    pub fn from_text(path: &Path, text: String) -> Result<Self, FileError> {
        let domain = read_domain(&text).map_err(|error| FileError::from_pddl(path, &text, error))?;
        let model = compile_domain(&domain).map_err(|error| located(path, &text, &error))?;
        Ok(Self { domain, model, path: path.to_owned(), text })
    }

    /// Reads a problem of this domain: the model for it, and its task.
    ///
    /// # Errors
    /// [`FileError`] if it is not one, or has no task.
    pub fn read_problem(&self, path: &Path) -> Result<(ActionModel, Task), FileError> {
        self.problem_from_text(path, &read_text(path)?)
    }

    /// Reads the text of a problem; errors call it `name`.
    ///
    /// # Errors
    /// As for [`read_problem`](Self::read_problem).
    pub fn problem_from_text(&self, name: &Path, text: &str) -> Result<(ActionModel, Task), FileError> {
        self.compile(name, text, &self.stated_problem(name, text)?)
    }

    /// Reads the text of a problem, as it is written; errors call it `name`.
    ///
    /// # Errors
    /// [`FileError`] if it is not one.
    pub fn stated_problem(&self, name: &Path, text: &str) -> Result<Problem, FileError> {
        read_problem(text, &self.domain).map_err(|error| FileError::from_pddl(name, text, error))
    }

    /// The model for a problem that was read from this text, and its task.
    ///
    /// # Errors
    /// [`FileError`] if it has no task.
    pub fn compile(&self, name: &Path, text: &str, problem: &Problem) -> Result<(ActionModel, Task), FileError> {
        let mut model = self.model.clone();
        let task = compile_problem(problem, &mut model).map_err(|error| match error.part.is_of_problem() {
            true => located(name, text, &error),
            false => located(&self.path, &self.text, &error),
        })?;
        Ok((model, task))
    }
}

/// A domain and a problem as they are written, not compiled.
#[derive(Debug, Clone)]
pub struct StatedProblem {
    domain: Domain,
    problem: Problem,
    /// The domain's file, and the problem's.
    files: [(PathBuf, String); 2],
}

impl StatedProblem {
    /// Reads the texts of a domain and of a problem; errors call them by these paths.
    ///
    /// # Errors
    /// [`FileError`] if they are not that.
    pub fn from_texts(domain: (&Path, String), problem: (&Path, String)) -> Result<Self, FileError> {
        let files = [domain, problem].map(|(path, text)| (path.to_owned(), text));
        let [(domain_path, domain_text), (problem_path, problem_text)] = &files;
        let domain = read_domain(domain_text).map_err(|e| FileError::from_pddl(domain_path, domain_text, e))?;
        let problem =
            read_problem(problem_text, &domain).map_err(|e| FileError::from_pddl(problem_path, problem_text, e))?;
        Ok(Self { domain, problem, files })
    }

    /// What they mean.
    ///
    /// # Errors
    /// [`FileError`] where they mean nothing, as [`Meaning::of`] says.
    pub fn meaning(&self) -> Result<Meaning<'_>, FileError> {
        Meaning::of(&self.domain, &self.problem).map_err(|error| {
            let (path, text) = &self.files[usize::from(error.part.is_of_problem())];
            located(path, text, &error)
        })
    }
}

/// Reads the text of a problem for a model that was not made from a PDDL domain: the model for it, and its task. The
/// problem belongs to the domain of this name, or, without one, to any; errors call it `name`.
///
/// # Errors
/// [`FileError`] if it is not one, mentions what the model does not have, or has no task.
pub fn model_problem_from_text(
    model: &ActionModel,
    domain: Option<&Symbol>,
    name: &Path,
    text: &str,
) -> Result<(ActionModel, Task), FileError> {
    let problem = read_model_problem(text, model, domain).map_err(|error| FileError::from_pddl(name, text, error))?;
    let mut model = model.clone();
    let task = compile_problem(&problem, &mut model).map_err(|error| located(name, text, &error))?;
    Ok((model, task))
}

fn located(path: &Path, text: &str, error: &CompileError) -> FileError {
    FileError::from_pddl(path, text, error.locate(text))
}
