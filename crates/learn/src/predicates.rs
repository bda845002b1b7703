//! Which predicates were met, and of what: from states to the types of a model's predicates.

use typelift_model::{
    ArgumentTypes, Atom, Hierarchy, LiftedAtom, Observations, Slot, State, Symbol, Term, TypeId, Unknown, cover,
    predicate_told_apart,
};
use typelift_world::Trace;

use crate::LearnError;
use crate::draft::Draft;

/// Adds the predicates of a trace's states. What is in the state before as well is not looked at again.
pub(crate) fn observe_predicates(observations: &mut Observations, trace: &Trace, hierarchy: &Hierarchy) {
    let mut before: Option<&State> = None;
    for state in &trace.states {
        let before = before.replace(state).filter(|before| before.objects == state.objects);
        let ty = |object: &Symbol| state.objects.get(object).map(|ty| hierarchy.name(*ty));
        let mut met = |atom: &Atom<Symbol>| {
            observations.add_predicate(&atom.without_arity().predicate, atom.args.iter().map(ty));
        };
        match before {
            None => state.atoms.iter().for_each(&mut met),
            Some(before) => state.atoms.difference(&before.atoms).for_each(&mut met),
        }
        if before.is_some_and(|before| before.unknown == state.unknown) {
            continue;
        }
        match &state.unknown {
            Unknown::AllBut(known) => known.iter().for_each(&mut met),
            Unknown::Matching(patterns) => {
                for pattern in patterns {
                    let named = pattern.args.iter().map(|slot| match slot {
                        Slot::Is(object) => ty(object),
                        Slot::Any => None,
                    });
                    observations.add_predicate(&pattern.without_arity().predicate, named);
                }
            }
        }
    }
}

/// Predicates of one name that take different numbers of arguments get names of their own.
pub(crate) fn tell_apart_by_arity(actions: &mut [Draft], observations: &Observations) {
    let by_arity = observations.names_of_several_arities();
    if by_arity.is_empty() {
        return;
    }
    let named = |atom: LiftedAtom| LiftedAtom {
        predicate: predicate_told_apart(&by_arity, &atom.predicate, atom.arity()),
        ..atom
    };
    for Draft { preconditions, adds, deletes, .. } in actions {
        for atoms in [preconditions, adds, deletes] {
            *atoms = std::mem::take(atoms).into_iter().map(named).collect();
        }
    }
}

/// The predicates with the lowest types that cover what was met, and what the actions are for.
pub(crate) fn types_of_predicates(
    observations: &Observations,
    actions: &[Draft],
    hierarchy: &Hierarchy,
) -> Result<ArgumentTypes, LearnError> {
    let id = |name: &Symbol| hierarchy.id(name.as_str()).ok_or_else(|| LearnError::UnknownType(name.clone()));
    let mut predicates = ArgumentTypes::new();
    let by_arity = observations.names_of_several_arities();
    for ((name, arity), arguments) in &observations.predicates {
        let mut types: Vec<TypeId> = Vec::with_capacity(arguments.len());
        for met in arguments {
            let ids = met.iter().map(id).collect::<Result<Vec<_>, _>>()?;
            types.push(ids.into_iter().reduce(|a, b| hierarchy.lca(a, b)).unwrap_or(hierarchy.root()));
        }
        predicates.insert(predicate_told_apart(&by_arity, name, *arity), types);
    }
    for action in actions {
        let ty = |term: &Term| match term {
            Term::Param(index) => action.types[*index as usize],
            Term::Const(_) => hierarchy.root(),
        };
        let atoms = action.adds.iter().chain(&action.deletes).chain(&action.preconditions);
        atoms.for_each(|atom: &LiftedAtom| {
            cover(&mut predicates, hierarchy, &atom.predicate, atom.args.iter().map(ty));
        });
    }
    Ok(predicates)
}
