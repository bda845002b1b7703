//! GetUnreachablePreconds: the preconditions of an imagined action that cannot be reached either.

use std::collections::BTreeSet;

use typelift_model::{GroundAtom, LiftedAtom, Symbol, Term, TypeId};

use crate::Context;
use crate::create::Proposal;
use crate::potential::are_distinct;

/// Instances of one precondition that are considered at most, the first in order.
const INSTANCE_BOUND: usize = 10_000;

/// For each precondition of which no instance is reachable, all its instances, up to [`INSTANCE_BOUND`]. Bound
/// parameters stay bound; others range over the objects of their original type, or of their new type if there are none.
pub(crate) fn get_unreachable_preconds(context: &Context<'_>, proposal: &Proposal<'_>) -> Vec<GroundAtom> {
    let choices = choices(context, proposal);
    let mut unreachable = Vec::new();
    for precondition in proposal.schema.positive_preconditions() {
        let reached = context.reached.get(&precondition.predicate).into_iter().flatten();
        if !reached.into_iter().any(|atom| is_instance(atom, precondition, proposal, &choices)) {
            unreachable.extend(instances(precondition, proposal, &choices));
        }
    }
    unreachable
}

/// Whether an atom is an instance of a lifted one under the choices.
fn is_instance(atom: &GroundAtom, lifted: &LiftedAtom, proposal: &Proposal<'_>, choices: &[Vec<&Symbol>]) -> bool {
    let mut binding: Vec<Option<&Symbol>> = vec![None; choices.len()];
    lifted.bind(atom, &mut binding, |p, object, _| choices[p].binary_search(&object).is_ok()).is_some()
        && are_distinct(proposal.schema, &binding)
}

/// The objects that may take each parameter's place, sorted.
fn choices<'a>(context: &'a Context<'_>, proposal: &'a Proposal<'a>) -> Vec<Vec<&'a Symbol>> {
    let hierarchy = &context.model.hierarchy;
    let bound: BTreeSet<&Symbol> = proposal.binding.iter().copied().flatten().collect();
    let available: Vec<(&Symbol, TypeId)> = context.available(&bound).collect();
    let of_type = |wanted| -> Vec<&Symbol> {
        available.iter().filter(|(_, ty)| hierarchy.is_a(*ty, wanted)).map(|(name, _)| *name).collect()
    };
    let parameters = proposal.schema.parameters.iter().zip(&proposal.types).zip(&proposal.binding);
    parameters
        .map(|((parameter, new), object)| match object {
            Some(object) => vec![*object],
            None => Some(of_type(parameter.ty)).filter(|found| !found.is_empty()).unwrap_or_else(|| of_type(*new)),
        })
        .collect()
}

/// Every instance of an atom under the choices, objects being different where parameters must be.
fn instances(atom: &LiftedAtom, proposal: &Proposal<'_>, choices: &[Vec<&Symbol>]) -> Vec<GroundAtom> {
    let mut parameters: Vec<usize> = atom.params().map(|p| p as usize).collect();
    parameters.sort_unstable();
    parameters.dedup();
    let mut bindings: Vec<Vec<&Symbol>> = vec![Vec::new()];
    for (at, &parameter) in parameters.iter().enumerate() {
        let differs = |binding: &[&Symbol], object: &Symbol| {
            proposal.schema.distinct.iter().all(|&(a, b)| {
                let other = match (a as usize == parameter, b as usize == parameter) {
                    (true, false) => b as usize,
                    (false, true) => a as usize,
                    _ => return true,
                };
                parameters[..at].iter().position(|&p| p == other).is_none_or(|i| binding[i] != object)
            })
        };
        bindings = bindings
            .iter()
            .flat_map(|binding| {
                let fitting = choices[parameter].iter().filter(|object| differs(binding, object));
                fitting.map(|object| binding.iter().copied().chain([*object]).collect()).collect::<Vec<Vec<_>>>()
            })
            .take(INSTANCE_BOUND)
            .collect();
    }
    let place = |p: u32| parameters.iter().position(|&q| q == p as usize).unwrap_or_default();
    let ground = |binding: &Vec<&Symbol>| {
        atom.map(|term| match term {
            Term::Const(name) => name.clone(),
            Term::Param(p) => binding[place(*p)].clone(),
        })
    };
    bindings.iter().map(ground).collect()
}
