//! Types with several parents as a tree and static predicates, since other planners know one parent a type.
//!
//! Each type keeps its first parent. A type that then no longer covers all that it covered is told by a predicate: where a
//! parameter is of it, the parameter gets the lowest type that still covers all, and the predicate as a condition.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{
    ActionModel, Atom, GroundAtom, Hierarchy, LiftedAtom, Literal, Parameter, Symbol, Task, Term, TypeId,
};

use super::Compiled;
use super::names::{folded, predicates, unused};

/// A type that the tree does not have as it was.
struct TypeOutsideTree {
    /// The lowest type of the tree that covers all that it covered.
    cover: TypeId,
    predicate: Symbol,
}

/// A model and a task whose types are a tree; the types keep their ids.
pub(super) fn compile(model: &ActionModel, task: Option<&Task>) -> Compiled {
    let (hierarchy, tree) = (&model.hierarchy, tree_of(&model.hierarchy));
    let mut used: BTreeSet<Symbol> = predicates(model, task).into_keys().map(folded).collect();
    let told: BTreeMap<TypeId, TypeOutsideTree> = hierarchy
        .types()
        .filter_map(|ty| {
            let below: Vec<TypeId> = hierarchy.types().filter(|&below| hierarchy.is_a(below, ty)).collect();
            let is_told = below.iter().any(|&below| !tree.is_a(below, ty));
            let cover = is_told.then(|| below.into_iter().reduce(|a, b| tree.lca(a, b))).flatten()?;
            Some((ty, TypeOutsideTree { cover, predicate: unused(&format!("is-{}", hierarchy.name(ty)), &mut used) }))
        })
        .collect();
    let mut compiled = Compiled { model: model.clone(), task: task.cloned(), notes: Vec::new() };
    let mut needed = BTreeSet::new();
    let mut conditions = |parameters: &mut [Parameter], first: u32| -> Vec<Literal> {
        let mut conditions = Vec::new();
        for (parameter, index) in parameters.iter_mut().zip(first..) {
            if let Some(TypeOutsideTree { cover, predicate }) = told.get(&parameter.ty) {
                needed.insert(parameter.ty);
                parameter.ty = *cover;
                conditions.push(Literal::positive(LiftedAtom::new(predicate.clone(), vec![Term::Param(index)])));
            }
        }
        conditions
    };
    for action in &mut compiled.model.actions {
        let own = action.parameters.len() as u32;
        action.preconditions.extend(conditions(&mut action.parameters, 0));
        action.preconditions.sort_unstable();
        for effect in &mut action.effects {
            effect.condition.extend(conditions(&mut effect.parameters, own));
            effect.condition.sort_unstable();
        }
    }
    for axiom in &mut compiled.model.axioms {
        axiom.body.extend(conditions(&mut axiom.parameters, 0));
        axiom.body.sort_unstable();
    }
    for ty in compiled.model.predicates.values_mut().flatten() {
        *ty = told.get(ty).map_or(*ty, |told| told.cover);
    }
    for ty in needed {
        let TypeOutsideTree { cover, predicate } = &told[&ty];
        compiled.model.predicates.insert(predicate.clone(), vec![*cover]);
        compiled.notes.push(format!("{predicate} holds of what is of the type {}", hierarchy.name(ty)));
        if let Some(task) = &mut compiled.task {
            let objects = model.constants.iter().chain(&task.init.objects);
            let of_type: Vec<GroundAtom> = objects
                .filter(|&(_, &object)| hierarchy.is_a(object, ty))
                .map(|(name, _)| Atom::new(predicate.clone(), vec![name.clone()]))
                .collect();
            task.init.atoms.extend(of_type);
        }
    }
    compiled.model.hierarchy = tree;
    compiled
}

/// The tree in which each type has its first parent.
fn tree_of(hierarchy: &Hierarchy) -> Hierarchy {
    let first =
        |ty: TypeId| Some((hierarchy.name(ty).as_str(), hierarchy.name(*hierarchy.parents(ty).first()?).as_str()));
    // One parent each, above which it is not: there is no error.
    Hierarchy::from_edges(hierarchy.types().filter_map(first)).unwrap_or_default()
}
