//! The compiler: from a domain and a problem as PDDL states them to a model and a task.
//!
//! Conditions are brought into negation normal form, what is universally quantified becomes a derived predicate, and a
//! disjunction of cases an action, an effect or an axiom for each. This follows the normalization of Helmert 2009
//! (Concise finite-domain representations for PDDL planning tasks, section 4), except that equalities are solved, and
//! that a disjunction whose multiplication would give too many cases becomes a derived predicate as well. Goals are
//! compiled for the objects of their problem.
//!
//! What a schema has beyond learned ones is in three fields: an effect's own parameters, a cost's functions, the model's
//! axioms. Equality is a literal of a reserved predicate; that two parameters differ is in `distinct`, where grounding
//! uses it.

mod block;
mod case;
mod derived;
mod effect;
mod error;
mod expand;
mod goal;
mod invent;
mod inventions;
#[cfg(test)]
mod law;
mod limits;
mod names;
mod normal;
mod said;
mod schema;
mod solve;
mod strata;
#[cfg(test)]
mod tests;
mod world;

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionModel, ArgumentTypes, Cost, GroundAtom, Hierarchy, ROOT, State, Symbol, Task, TypeId};

pub use error::{CompileError, CompilePart};

use self::inventions::Inventions;
use self::limits::Limits;
use self::names::FreshNames;
use self::world::World;
use crate::syntax::TOTAL_COST;
use crate::{Domain, Problem, Typed};

/// The model of a domain: given actions, axioms, constants.
///
/// An action of several cases becomes several, of the same call: `go`, `go-2`, …; one that can never be used, none.
/// Where the domain declares no total cost, each costs 1.
///
/// # Errors
/// [`CompileError`] if derived predicates depend on their own negation or are changed by actions, something is not
/// declared, or the model would be too large.
pub fn compile_domain(domain: &Domain) -> Result<ActionModel, CompileError> {
    domain_within(domain, Limits::default())
}

fn domain_within(domain: &Domain, limits: Limits) -> Result<ActionModel, CompileError> {
    let edges = domain.types.iter().map(|(child, parent)| (child.as_str(), parent.as_str()));
    let hierarchy =
        Hierarchy::from_edges(edges).map_err(|error| CompileError::new(&CompilePart::Types, error.to_string()))?;
    let mut constants = BTreeMap::new();
    add_objects(&mut constants, &domain.constants, &hierarchy, &CompilePart::Constants)?;
    // An argument that may be of either of several types gets the lowest that covers them.
    let ty = |typed: &Typed| {
        let types = typed.types.iter().filter_map(|ty| hierarchy.id(ty.as_str()));
        types.reduce(|a, b| hierarchy.lca(a, b)).unwrap_or(hierarchy.root())
    };
    let declared = domain.predicates.iter();
    let predicates: ArgumentTypes =
        declared.map(|predicate| (predicate.name.clone(), predicate.parameters.iter().map(ty).collect())).collect();
    derived::check_derived(domain)?;

    let world = World { hierarchy: &hierarchy, objects: &constants, predicates: &predicates, limits };
    let functions = domain.functions.iter().map(|function| function.name.clone());
    let mut inventions = Inventions::new(predicates.keys().cloned().chain(functions));
    for derived in &domain.derived {
        derived::compile_derived(derived, world, &mut inventions)?;
    }
    let derived: BTreeSet<&Symbol> = domain.derived.iter().map(|derived| &derived.head.name).collect();
    let mut names = FreshNames::with(domain.actions.iter().map(|action| action.name.clone()));
    let (mut actions, mut never_used) = (Vec::new(), BTreeMap::new());
    let mut seen = BTreeSet::new();
    for action in &domain.actions {
        if !seen.insert(&action.name) {
            let part = CompilePart::Action(action.name.clone());
            return Err(CompileError::new(&part, "there is another action of this name"));
        }
        let schemas = schema::compile_action(action, world, &mut inventions, &derived, &mut names)?;
        if schemas.is_empty() {
            let mut added = BTreeSet::new();
            action.effect.for_each_added(&mut |atom| {
                added.insert(atom.predicate.clone());
            });
            never_used.insert(action.name.clone(), added);
        }
        actions.extend(schemas);
    }
    actions.sort_by(|a, b| a.name.cmp(&b.name));
    if !domain.actions.iter().any(|action| action.effect.increases()) {
        let is_declared = domain.functions.iter().any(|function| function.name == *TOTAL_COST);
        let cost = if is_declared { Cost::from(0) } else { Cost::UNIT };
        actions.iter_mut().for_each(|action| action.cost = cost.clone());
    }
    let mut model = ActionModel {
        predicates: predicates.clone(),
        actions,
        hierarchy: hierarchy.clone(),
        constants: constants.clone(),
        never_used,
        ..ActionModel::default()
    };
    inventions.finish(&mut model);
    derived::stratify(&mut model, |name| predicates.contains_key(name))?;
    Ok(model)
}

/// The task of a problem of the domain that the model was compiled from.
///
/// The model becomes that of this task: it gets the axioms and predicates that the goal needs, and every action costs 1
/// if the problem does not minimize the total cost. Give each problem a copy.
///
/// # Errors
/// [`CompileError`] if the initial state states a derived predicate, something is not declared, or the goal is too
/// large.
pub fn compile_problem(problem: &Problem, model: &mut ActionModel) -> Result<Task, CompileError> {
    problem_within(problem, model, Limits::default())
}

fn problem_within(problem: &Problem, model: &mut ActionModel, limits: Limits) -> Result<Task, CompileError> {
    let mut objects = model.constants.clone();
    add_objects(&mut objects, &problem.objects, &model.hierarchy, &CompilePart::Objects)?;
    let derived = model.derived_predicates();
    if let Some(atom) = problem.init.iter().find(|atom| derived.contains(&atom.predicate)) {
        let message = format!("{atom} is stated, but `{}` is derived", atom.predicate);
        return Err(CompileError::new(&CompilePart::Init, message));
    }
    let atoms: BTreeSet<GroundAtom> = problem.init.iter().cloned().collect();

    let functions = model.actions.iter().flat_map(|action| &action.cost.functions).map(|f| f.predicate.clone());
    let mut inventions = Inventions::new(model.predicates.keys().cloned().chain(functions));
    let world = World { hierarchy: &model.hierarchy, objects: &objects, predicates: &model.predicates, limits };
    let goal = goal::compile_goal(&problem.goal, world, &atoms, &goal::fluents(model), &mut inventions)?;
    inventions.finish(model);
    derived::stratify(model, |_| true)?;
    if !problem.minimizes_cost {
        model.actions.iter_mut().for_each(|action| action.cost = Cost::UNIT);
    }
    let values = problem.values.iter().filter(|(function, _)| function.predicate != *TOTAL_COST).cloned();
    Ok(Task { init: State { objects, atoms, ..State::default() }, goal, values: values.collect() })
}

/// Adds declared objects with their types.
fn add_objects(
    objects: &mut BTreeMap<Symbol, TypeId>,
    declared: &[Typed],
    hierarchy: &Hierarchy,
    part: &CompilePart,
) -> Result<(), CompileError> {
    for Typed { name, types } in declared {
        let ty = match types.as_slice() {
            [] => ROOT,
            [ty] => ty.as_str(),
            _ => {
                let message = format!("`{name}` is `either` of several types");
                return Err(CompileError::new(part, message).not_supported());
            }
        };
        let Some(id) = hierarchy.id(ty) else {
            return Err(CompileError::new(part, format!("there is no type `{ty}`")));
        };
        match objects.insert(name.clone(), id) {
            Some(other) if other != id => {
                let message = format!("`{name}` is of the types `{}` and `{ty}`", hierarchy.name(other));
                return Err(CompileError::new(part, message));
            }
            _ => {}
        }
    }
    Ok(())
}
