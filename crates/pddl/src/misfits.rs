//! Atoms of a problem that are not of the types that their predicates declare.

use typelift_model::{Atom, HashMap, Hierarchy, Symbol};

use crate::{Domain, Formula, PddlAtom, PddlTerm, Problem, Signature, Typed};

/// The initial atoms, and then those of the goal, over objects of other types than the domain declares for their predicate.
/// They mean what they say, as for planners that do not look at types; but actions that declare the same types never meet
/// them.
pub fn misfits(problem: &Problem, domain: &Domain) -> Vec<PddlAtom> {
    let edges = domain.types.iter().map(|(child, parent)| (child.as_str(), parent.as_str()));
    // The types of a domain that was read are in order.
    let Ok(hierarchy) = Hierarchy::from_edges(edges) else { return Vec::new() };
    let declared = domain.constants.iter().chain(&problem.objects);
    let objects: HashMap<&Symbol, &Typed> = declared.map(|object| (&object.name, object)).collect();
    let signatures: HashMap<&Symbol, &Signature> = domain.predicates.iter().map(|p| (&p.name, p)).collect();
    let is_one_of = |object: &Typed, wanted: &Typed| {
        let id = |ty: &Symbol| hierarchy.id(ty.as_str()).unwrap_or(hierarchy.root());
        object.types.iter().any(|given| wanted.types.iter().any(|wanted| hierarchy.is_a(id(given), id(wanted))))
    };
    let fits = |(arg, wanted): (&PddlTerm, &Typed)| match arg {
        PddlTerm::Object(name) => objects.get(name).is_none_or(|object| is_one_of(object, wanted)),
        PddlTerm::Variable(_) => true,
    };
    let object = |name: &Symbol| PddlTerm::Object(name.clone());
    let initial = |atom: &Atom<Symbol>| PddlAtom {
        predicate: atom.predicate.clone(),
        args: atom.args.iter().map(object).collect(),
    };
    let mut atoms: Vec<PddlAtom> = problem.init.iter().map(initial).collect();
    add_atoms(&problem.goal, &mut atoms);
    atoms.retain(|atom| {
        let signature = signatures.get(&atom.predicate);
        signature.is_some_and(|signature| !atom.args.iter().zip(&signature.parameters).all(fits))
    });
    atoms
}

fn add_atoms(formula: &Formula, atoms: &mut Vec<PddlAtom>) {
    match formula {
        Formula::Atom(atom) => atoms.push(atom.clone()),
        Formula::Equal(..) => {}
        Formula::Not(part) | Formula::Exists(_, part) | Formula::Forall(_, part) => add_atoms(part, atoms),
        Formula::And(parts) | Formula::Or(parts) => parts.iter().for_each(|part| add_atoms(part, atoms)),
        Formula::Imply(left, right) => [left, right].into_iter().for_each(|part| add_atoms(part, atoms)),
    }
}
