//! Derived predicates: from conditions to axioms, and the strata of these.

use std::collections::BTreeSet;

use typelift_model::{ActionModel, Atom, Axiom, Literal, Symbol, Term};

use super::block::{Block, Visible};
use super::case::Case;
use super::error::{CompileError, CompilePart};
use super::inventions::Inventions;
use super::strata::{dependencies, strata};
use super::world::World;
use crate::{Derived, Domain};

/// Adds the axioms of a condition of a derived predicate.
pub(super) fn compile_derived(
    derived: &Derived,
    world: World<'_>,
    inventions: &mut Inventions,
) -> Result<(), CompileError> {
    let name = &derived.head.name;
    let mut block = Block::new(CompilePart::Derived(name.clone()), name.clone(), world, inventions);
    match world.predicates.get(name) {
        Some(types) if types.len() == derived.head.parameters.len() => {}
        _ => return Err(block.error("no predicate of this name and number of arguments is declared")),
    }
    let mut visible = Visible::new();
    let head = block.declare(&derived.head.parameters, &mut visible)?;
    let condition = block.normal(&derived.condition, true, &mut visible)?;
    let cases = block.cases(&condition)?;
    let mut axioms = block.axioms(name, &head, &cases)?;
    if axioms.is_empty() {
        axioms = block.axioms(name, &head, &[own_consequence(name, &head)])?;
    }
    block.inventions.axioms.extend(axioms);
    Ok(())
}

/// That an atom follows from itself: it never holds, and is derived nevertheless.
fn own_consequence(name: &Symbol, head: &[u32]) -> Case {
    let atom = Atom { predicate: name.clone(), args: head.iter().copied().map(Term::Param).collect() };
    Case { exists: Vec::new(), literals: vec![Literal::positive(atom)] }
}

/// Refuses a domain in which a derived predicate depends on its own negation, or is changed by an action.
pub(super) fn check_derived(domain: &Domain) -> Result<(), CompileError> {
    let derived: BTreeSet<&Symbol> = domain.derived.iter().map(|derived| &derived.head.name).collect();
    let mut dependencies = BTreeSet::new();
    for Derived { head, condition, .. } in &domain.derived {
        condition.for_each_predicate(true, &mut |predicate, positive| {
            if derived.contains(predicate) {
                dependencies.insert((&head.name, predicate, positive));
            }
        });
    }
    strata(&dependencies).map(|_| ()).map_err(|cycle| cyclic(&cycle, |_| true, "depends on its own negation"))
}

/// Writes the strata into the axioms of a model. `stated` tells the predicates that are not invented.
pub(super) fn stratify(model: &mut ActionModel, stated: impl Fn(&Symbol) -> bool) -> Result<(), CompileError> {
    let found = strata(&dependencies(&model.axioms)).map_err(|cycle| {
        cyclic(&cycle, stated, "depends on itself inside of a universal quantification").not_supported()
    })?;
    let stratum = |axiom: &Axiom| found.get(&axiom.head.predicate).copied().unwrap_or(0);
    let strata: Vec<u32> = model.axioms.iter().map(stratum).collect();
    for (axiom, stratum) in model.axioms.iter_mut().zip(strata) {
        axiom.stratum = stratum;
    }
    Ok(())
}

/// The error about predicates that depend on each other.
fn cyclic(cycle: &BTreeSet<&Symbol>, stated: impl Fn(&Symbol) -> bool, what: &str) -> CompileError {
    let names: Vec<&Symbol> = cycle.iter().copied().filter(|name| stated(name)).collect();
    let (first, others) = names.split_first().map_or((Symbol::default(), &[][..]), |(f, rest)| ((*f).clone(), rest));
    let others: Vec<String> = others.iter().map(|name| format!("`{name}`")).collect();
    let through = if others.is_empty() { String::new() } else { format!(", through {}", others.join(", ")) };
    CompileError::new(&CompilePart::Derived(first.clone()), format!("`{first}` {what}{through}"))
}
