//! Reading models and tasks, as every command that takes them does.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use typelift::model::{
    ActionModel, Familiar, Hierarchy, LearnedModel, ModelFileError, Observations, ParseConfig, Symbol, Task,
    Unfamiliar, did_you_mean,
};
use typelift::pddl::misfits;
use typelift::words::count;
use typelift::world::{
    DomainFile, FileError, ParseError, ParseErrorKind, Parser, TaskError, TaskFile, is_pddl, model_problem_from_text,
    read_text, read_types,
};
use typelift_memory::{Access, Memory, looks_like_memory};

use crate::failure::{Failure, NOT_AS_WRITTEN, about_goal};
use crate::style::{HINT, WARNING};

/// Warnings of files that are said.
const MOST_WARNINGS: usize = 5;

/// A model as it is read: learned, or stated in PDDL.
#[derive(Debug)]
pub(crate) enum ModelInput {
    Learned(Box<LearnedModel>),
    Given(Box<DomainFile>),
}

/// Reads a model file, a memory or a PDDL domain, and adds the types of another file to a model; warns unless it is to be
/// `quiet`.
pub(crate) fn read_model_input(path: &Path, types: Option<&PathBuf>, quiet: bool) -> Result<ModelInput, Failure> {
    if looks_like_memory(path) {
        return read_remembered(path, types, quiet);
    }
    model_input_from_text(path, read_text(path)?, types)
}

/// The model that a memory has learned.
pub(crate) fn read_remembered(file: &Path, types: Option<&PathBuf>, quiet: bool) -> Result<ModelInput, Failure> {
    let memory = Memory::open(file, Access::Read)?;
    if !quiet {
        warn_unread(&memory);
    }
    let mut learned = memory.learned().clone();
    add_types(&mut learned, types)?;
    Ok(ModelInput::Learned(Box::new(learned)))
}

/// As [`read_model_input`], from the text of the model or domain.
pub(crate) fn model_input_from_text(path: &Path, text: String, types: Option<&PathBuf>) -> Result<ModelInput, Failure> {
    if is_pddl(&text) {
        if let Some(types) = types {
            let message = format!("--types {}: a PDDL domain declares its own types", types.display());
            return Err(Failure::bad_input(message));
        }
        return Ok(ModelInput::Given(Box::new(DomainFile::from_text(path, text)?)));
    }
    if text.trim().is_empty() {
        return Err(FileError::new(path, "the file is empty").into());
    }
    let mut learned = LearnedModel::from_json(&text).map_err(|error| match error {
        ModelFileError::Json { line, column, message } => {
            let error = FileError::at_line(path, line, message).with_column(column);
            error.with_hint(NOT_AS_WRITTEN.to_owned()).into()
        }
        error => Failure::from(error).in_file(path),
    })?;
    add_types(&mut learned, types)?;
    Ok(ModelInput::Learned(Box::new(learned)))
}

/// Adds the types of a file to those of a model.
pub(crate) fn add_types(learned: &mut LearnedModel, types: Option<&PathBuf>) -> Result<(), Failure> {
    if let Some(types) = types {
        learned.model.hierarchy = read_types(types)?.extend(&learned.model.hierarchy)?;
    }
    Ok(())
}

/// What is to be done, as it is read: a task file, or a PDDL problem compiled with the model it needs.
pub(crate) enum TaskInput {
    File(TaskFile),
    Problem(Box<(ActionModel, Task)>),
}

impl ModelInput {
    /// What it was learned from; nothing for a domain.
    pub(crate) fn evidence(&self) -> Observations {
        match self {
            Self::Learned(learned) => learned.evidence.total().into_owned(),
            Self::Given(_) => Observations::default(),
        }
    }

    /// What it knows of states.
    pub(crate) fn familiar(&self) -> Familiar {
        Familiar::of(&self.model().predicates, &self.evidence())
    }

    /// The model alone.
    pub(crate) fn model(&self) -> &ActionModel {
        match self {
            Self::Learned(learned) => &learned.model,
            Self::Given(domain) => &domain.model,
        }
    }

    /// How snapshots are read.
    pub(crate) fn parse(&self) -> ParseConfig {
        match self {
            Self::Learned(learned) => learned.parse.clone(),
            Self::Given(_) => ParseConfig::default(),
        }
    }

    /// The name of it as a domain: its own, that of the domain that its types were given by, or else that of the file.
    pub(crate) fn domain_name(&self, path: &Path) -> Symbol {
        match self {
            Self::Learned(learned) => learned.domain.clone().unwrap_or_else(|| domain_name(path)),
            Self::Given(domain) => Symbol::from(domain.domain.name.as_str().to_ascii_lowercase()),
        }
    }

    /// The predicates that its domain declares and no demonstration showed.
    pub(crate) fn undemonstrated(&self) -> BTreeSet<Symbol> {
        match self {
            Self::Learned(learned) => learned.undemonstrated(),
            Self::Given(_) => BTreeSet::new(),
        }
    }

    /// Whether it is a PDDL domain.
    pub(crate) fn is_given(&self) -> bool {
        matches!(self, Self::Given(_))
    }

    /// Reads a task file, or a PDDL problem; warns unless it is to be `quiet`.
    pub(crate) fn read_task(&self, path: &Path, quiet: bool) -> Result<TaskInput, Failure> {
        self.task_from_text(path, &read_text(path)?, quiet)
    }

    /// As [`read_task`](Self::read_task), from the text, which is read once: it may come from a pipe.
    pub(crate) fn task_from_text(&self, path: &Path, text: &str, quiet: bool) -> Result<TaskInput, Failure> {
        match self {
            Self::Given(domain) if is_pddl(text) => {
                let problem = domain.stated_problem(path, text)?;
                let compiled = domain.compile(path, text, &problem)?;
                if !quiet {
                    let misfits = misfits(&problem, &domain.domain);
                    warn_of_misfits(path, &misfits.iter().map(ToString::to_string).collect::<Vec<_>>());
                }
                Ok(TaskInput::Problem(Box::new(compiled)))
            }
            Self::Learned(learned) if is_pddl(text) => {
                let problem = model_problem_from_text(&learned.model, learned.domain.as_ref(), path, text)?;
                Ok(TaskInput::Problem(Box::new(problem)))
            }
            _ => {
                let file = TaskFile::from_text(path, text)?;
                if !quiet {
                    warn(file.warnings.iter());
                }
                Ok(TaskInput::File(file))
            }
        }
    }

    /// Reads a task that says from which state to plan: the model for it, and the task.
    pub(crate) fn read_planning_task(self, path: &Path, quiet: bool) -> Result<(ActionModel, Task), Failure> {
        let text = read_text(path)?;
        self.planning_task_from_text(path, &text, quiet)
    }

    /// As [`read_planning_task`](Self::read_planning_task), from the text.
    pub(crate) fn planning_task_from_text(
        self,
        path: &Path,
        text: &str,
        quiet: bool,
    ) -> Result<(ActionModel, Task), Failure> {
        let familiar = (!quiet).then(|| self.familiar());
        let (model, task) = self.posed(path, text, quiet)?;
        if let Some(familiar) = familiar {
            warn_of_doubts(path, &familiar.doubts(&task.init, &model.hierarchy));
        }
        Ok((model, task))
    }

    /// The model for a task that says from which state to plan, and the task.
    fn posed(self, path: &Path, text: &str, quiet: bool) -> Result<(ActionModel, Task), Failure> {
        match self.task_from_text(path, text, quiet)? {
            TaskInput::Problem(problem) => Ok(*problem),
            TaskInput::File(file) => {
                let is_given = self.is_given();
                let (model, parse) = match self {
                    Self::Learned(learned) => (learned.model, learned.parse),
                    Self::Given(domain) => (domain.model, ParseConfig::default()),
                };
                let mut parser = Parser::new(model.hierarchy.clone(), parse).knowing(&model.predicates);
                let task = file.task(&mut parser, &model.predicates);
                let task = task.map_err(|error| not_of_model(&error, path, &parser, is_given))?;
                Ok((model, task))
            }
        }
    }
}

/// Why a task is none for a model. One with a type that the model does not know was probably written for another.
fn not_of_model(error: &TaskError, path: &Path, parser: &Parser, is_given: bool) -> Failure {
    let told = Failure::from(error.in_file(path, parser));
    let TaskError::State(ParseError { entity, kind: ParseErrorKind::UnknownType { ty, .. } }) = error else {
        return match error {
            TaskError::Goal(error) => about_goal(error).into_iter().fold(told, Failure::with_hint),
            _ => told,
        };
    };
    let entity = entity.as_ref().map(|entity| format!("entity {entity}: ")).unwrap_or_default();
    let message = format!("in the state: {entity}the model does not know the type `{ty}`");
    Failure::bad_input(message).in_file(path).with_hint(about_unknown_type(ty, parser.hierarchy(), is_given))
}

/// What to do about a type that a model does not know.
pub(crate) fn about_unknown_type(ty: &Symbol, hierarchy: &Hierarchy, is_given: bool) -> String {
    let near = did_you_mean(ty.as_str(), hierarchy.types().map(|ty| hierarchy.name(ty)));
    let near = near.map(|question| format!("{question} Or is")).unwrap_or_else(|| "Is".to_owned());
    let more = if is_given { "" } else { " --types FILE adds types to a learned model." };
    format!("{near} it another model that this belongs to?{more}")
}

/// Says what is probably not meant in files; not all of it where there is much.
pub(crate) fn warn<'w>(mut warnings: impl Iterator<Item = &'w FileError>) {
    for warning in warnings.by_ref().take(MOST_WARNINGS) {
        anstream::eprintln!("{WARNING}warning{WARNING:#}: {warning}");
        if let Some(hint) = &warning.hint {
            anstream::eprintln!("{HINT}hint{HINT:#}: {hint}");
        }
    }
    let more = warnings.count();
    if more > 0 {
        anstream::eprintln!("{WARNING}warning{WARNING:#}: {more} more of this kind");
    }
}

/// Warns of what was probably meant otherwise in a state.
pub(crate) fn warn_of_doubts(whose: &Path, doubts: &[Unfamiliar]) {
    let warning = |doubt: &Unfamiliar| FileError::new(whose, doubt.to_string()).with_hint(doubt.hint());
    warn(doubts.iter().map(warning).collect::<Vec<_>>().iter());
}

/// Warns of atoms of a problem that no action which declares the same types as their predicate ever meets.
pub(crate) fn warn_of_misfits(problem: &Path, misfits: &[String]) {
    if let Some(first) = misfits.first() {
        let (problem, several) = (problem.display(), count(misfits.len() as u64, "atom"));
        anstream::eprintln!(
            "{WARNING}warning{WARNING:#}: {problem}: {several} not of the types that the predicate declares: {first}"
        );
    }
}

/// Says which parts of a memory nothing is learned from.
pub(crate) fn warn_unread(memory: &Memory) {
    for unread in memory.unread() {
        anstream::eprintln!("{WARNING}warning{WARNING:#}: {}: {unread}", memory.file().display());
    }
}

/// A task's name, for people: its file's, without folders and ending.
pub(crate) fn task_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| path.display().to_string(), |stem| stem.to_string_lossy().into_owned())
}

/// A name for a learned model as a domain: its file's, as far as PDDL allows it.
fn domain_name(path: &Path) -> Symbol {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().to_lowercase()).unwrap_or_default();
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' }).collect();
    Symbol::from(if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("model-{name}") })
}
