//! A model, and a task for it, as PDDL: so that every planner can plan with what was learned, and its plans come back.
//!
//! Names go through the model's mapping to PDDL's and back ([`ExportNames`]). A pair of parameters that must differ is
//! written only where their types can share an object; elsewhere the types say it. The model keeps no types of
//! predicates: an argument gets the lowest type that covers its uses in actions, axioms and task, so that the domain
//! written for one task may differ in this from the domain written for another. Types with several parents become a tree.

mod action;
mod argument_types;
mod complement;
mod cost;
mod derived;
mod domain;
mod exclusive;
mod names;
mod note;
mod problem;
mod single_parents;
mod strips;

use std::borrow::Cow;

use thiserror::Error;
use typelift_model::{ActionModel, NameCollision, Symbol, Task};

use crate::required::{required_by_both, required_by_domain};
use crate::{Domain, Problem};

pub(crate) use names::functions;
pub use names::{ExportNames, UnknownName};

/// How many facts may be added to an initial state at [`Level::Strips`], and how many values of costs that are sums.
pub const MOST_FACTS: u64 = 5_000_000;

/// How much of PDDL the planner knows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Level {
    /// STRIPS with types. What may not hold is written as a predicate of its own that holds where the other does not;
    /// costs are left out.
    Strips,
    /// Everything the model has: negative preconditions, inequality, effects with conditions and for every choice of
    /// objects, derived predicates, costs.
    #[default]
    Adl,
}

/// How a model is exported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportOptions {
    /// The domain's name.
    pub domain: Symbol,
    /// The problem's name.
    pub problem: Symbol,
    /// How much of PDDL may be used.
    pub level: Level,
}

/// A model and a task as PDDL.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exported {
    /// The model.
    pub domain: Domain,
    /// The task, if there is one.
    pub problem: Option<Problem>,
    /// The names of both, for reading plans.
    pub names: ExportNames,
}

/// Why a model and a task cannot be exported.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ExportError {
    /// Two names of one kind are the same name in PDDL.
    #[error(transparent)]
    Name(#[from] NameCollision),
    /// Something that [`Level::Strips`] has no words for.
    #[error("{subject} {feature}, which STRIPS cannot say")]
    Unsupported {
        /// The action or the predicate.
        subject: Symbol,
        /// What it has.
        feature: &'static str,
    },
    /// More than [`MOST_FACTS`] facts would have to be written.
    #[error("in STRIPS, every case in which `{predicate}` does not hold is written down, here {facts}")]
    TooManyFacts {
        /// The predicate.
        predicate: Symbol,
        /// How many there are, at most.
        facts: u64,
    },
    /// More than [`MOST_FACTS`] values of costs that are sums would have to be written.
    #[error("the cost of `{action}` is a sum, whose value for every choice of objects is written down, here {values}")]
    TooManyValues {
        /// The action.
        action: Symbol,
        /// How many there are, at most.
        values: u64,
    },
}

/// A model and a task, rewritten.
struct Compiled {
    model: ActionModel,
    task: Option<Task>,
    /// What was done, a line each.
    notes: Vec<String>,
}

/// The model as a domain, and the task, if there is one, as a problem. Equal arguments give equal results.
///
/// # Errors
/// [`ExportError`] if names collide, or if the level cannot express the model or the task.
pub fn export(model: &ActionModel, task: Option<&Task>, options: &ExportOptions) -> Result<Exported, ExportError> {
    let mut notes = Vec::new();
    let (mut model, mut task) = (Cow::Borrowed(model), task.map(Cow::Borrowed));
    let mut take = |compiled: Compiled| {
        notes.extend(compiled.notes);
        (Cow::Owned(compiled.model), compiled.task.map(Cow::Owned))
    };
    if !model.hierarchy.is_tree() {
        (model, task) = take(single_parents::compile(&model, task.as_deref()));
    }
    if options.level == Level::Strips {
        (model, task) = take(strips::compile(&model, task.as_deref())?);
    }
    if cost::has_sums(&model) {
        (model, task) = take(cost::compile(&model, task.as_deref())?);
    }
    let (model, task) = (model.as_ref(), task.as_deref());
    let names = ExportNames::of(model, task, options)?;
    let types = argument_types::Declared::of(model, task);
    let writer = Writer { model, task, names: &names, types, options };
    let mut domain = writer.domain(notes);
    let problem = task.map(|task| writer.problem(task, &domain));
    // Planners look for what the problem uses in the domain too.
    let required = problem.as_ref().map_or_else(|| required_by_domain(&domain), |p| required_by_both(&domain, p));
    domain.requirements = required.into_iter().map(Symbol::new).collect();
    Ok(Exported { domain, problem, names })
}

/// What is exported, with its names and types.
struct Writer<'a> {
    model: &'a ActionModel,
    task: Option<&'a Task>,
    names: &'a ExportNames,
    types: argument_types::Declared,
    options: &'a ExportOptions,
}
