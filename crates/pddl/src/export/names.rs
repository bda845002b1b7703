//! The names of an exported model and task, in both directions.

use std::collections::{BTreeMap, BTreeSet};

use thiserror::Error;
use typelift_model::{ActionModel, EQUALS, GroundAtom, NameCollision, PddlNames, Symbol, Task};

use super::ExportOptions;
use super::argument_types::constants;

/// The mapping between a model's and a task's names and those of the PDDL that they were exported as.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ExportNames {
    /// Of types.
    pub types: PddlNames,
    /// Of predicates, those included that the level added.
    pub predicates: PddlNames,
    /// Of the functions that costs mention.
    pub functions: PddlNames,
    /// Of actions: each schema's own name, also that of a given one.
    pub actions: PddlNames,
    /// Of objects and constants.
    pub objects: PddlNames,
    /// Of the domain.
    pub domain: PddlNames,
    /// Of the problem.
    pub problem: PddlNames,
}

/// A step of a plan that names nothing of the model.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no {kind} `{name}`")]
pub struct UnknownName {
    /// `action` or `object`.
    pub kind: &'static str,
    /// The name in the plan.
    pub name: String,
}

impl ExportNames {
    pub(super) fn of(model: &ActionModel, task: Option<&Task>, options: &ExportOptions) -> Result<Self, NameCollision> {
        let own = model.pddl_names()?;
        let constants = constants(model, task);
        let objects: BTreeSet<&Symbol> =
            constants.keys().chain(task.iter().flat_map(|t| t.init.objects.keys())).collect();
        let functions: BTreeSet<&Symbol> = functions(model).into_keys().collect();
        Ok(Self {
            types: own.types,
            predicates: PddlNames::fold("predicate", predicates(model, task).keys().copied())?,
            functions: PddlNames::fold("function", functions)?,
            actions: own.actions,
            objects: PddlNames::fold("object", objects)?,
            domain: PddlNames::fold("domain", [&options.domain])?,
            problem: PddlNames::fold("problem", [&options.problem])?,
        })
    }

    /// The step of a plan in the model's names: the schema's name and its objects.
    ///
    /// # Errors
    /// [`UnknownName`] for an action or an object that was not exported.
    pub fn step<'t>(
        &self,
        action: &str,
        args: impl IntoIterator<Item = &'t str>,
    ) -> Result<(Symbol, Vec<Symbol>), UnknownName> {
        let find = |names: &PddlNames, kind: &'static str, name: &str| {
            names.name(name).cloned().ok_or_else(|| UnknownName { kind, name: name.to_owned() })
        };
        let schema = find(&self.actions, "action", action)?;
        let objects = args.into_iter().map(|arg| find(&self.objects, "object", arg)).collect::<Result<_, _>>()?;
        Ok((schema, objects))
    }

    /// The names that PDDL spells otherwise than in lower case, each with its spelling there.
    pub(super) fn respelled<'n>(names: &[&'n PddlNames]) -> Vec<(&'n Symbol, &'n Symbol)> {
        let all = names.iter().flat_map(|names| names.iter());
        all.filter(|(name, pddl)| name.as_str().to_ascii_lowercase() != pddl.as_str()).collect()
    }
}

/// A name that was folded.
pub(super) fn pddl(names: &PddlNames, name: &Symbol) -> Symbol {
    names.pddl(name.as_str()).unwrap_or(name).clone()
}

/// Every predicate with its number of arguments: the model's, and those that only the task mentions.
pub(super) fn predicates<'a>(model: &'a ActionModel, task: Option<&'a Task>) -> BTreeMap<&'a Symbol, usize> {
    let of_task = |task: &'a Task| task.init.atoms.iter().chain(task.goal.literals().map(|(atom, _)| atom));
    let mentioned = task.into_iter().flat_map(of_task).map(|atom: &GroundAtom| (&atom.predicate, atom.args.len()));
    let mut all: BTreeMap<&Symbol, usize> = mentioned.collect();
    all.extend(model.predicates.iter().map(|(name, types)| (name, types.len())));
    all.retain(|name, _| name.as_str() != EQUALS);
    all
}

/// The functions that costs mention, with their number of arguments.
pub(crate) fn functions(model: &ActionModel) -> BTreeMap<&Symbol, usize> {
    let functions = model.actions.iter().flat_map(|action| &action.cost.functions);
    functions.map(|function| (&function.predicate, function.args.len())).collect()
}

/// How PDDL spells a name.
pub(super) fn folded(name: &Symbol) -> Symbol {
    // One name cannot collide with itself.
    PddlNames::fold("predicate", [name]).ok().and_then(|names| names.pddl(name.as_str()).cloned()).unwrap_or_default()
}

/// This name, numbered if PDDL would take it for one that is in use.
pub(super) fn unused(base: &str, used: &mut BTreeSet<Symbol>) -> Symbol {
    let mut name = Symbol::new(base);
    for number in 2.. {
        if used.insert(folded(&name)) {
            break;
        }
        name = Symbol::from(format!("{base}-{number}"));
    }
    name
}
