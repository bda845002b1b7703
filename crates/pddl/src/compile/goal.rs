//! Goals: literals, and a derived predicate for each part that is a disjunction.

use std::collections::BTreeSet;

use typelift_model::{ActionModel, Atom, Goal, GroundAtom, Literal, Symbol, Wording};

use super::block::{Block, Visible};
use super::case::Case;
use super::error::{CompileError, CompilePart};
use super::expand::{Expansion, ground};
use super::inventions::Inventions;
use super::normal::Normal;
use super::world::World;
use crate::Formula;
use crate::formula_text::shortened;

/// Compiles a goal for this initial state. Where it is clear that it can never hold, and no atom of the text says so, it
/// is given an atom that never does.
pub(super) fn compile_goal(
    goal: &Formula,
    world: World<'_>,
    init: &BTreeSet<GroundAtom>,
    fluents: &BTreeSet<Symbol>,
    inventions: &mut Inventions,
) -> Result<Goal, CompileError> {
    let mut block = Block::new(CompilePart::Goal, Symbol::new("goal"), world, inventions);
    let normal = block.normal(goal, true, &mut Visible::new())?;
    let parts = expanded(&mut Expansion::new(&block, init, fluents), normal)?;
    let literals = match goal_literals(&mut block, &parts)? {
        Some(literals) => literals,
        None => {
            let part = impossible_part(&mut block, goal, init, fluents)?;
            let wording = Wording { formula: shortened(part).into(), positive: true, variables: Vec::new() };
            let predicate = inventions.predicate("unsatisfiable-goal", Some(wording));
            vec![Literal::positive(Atom { predicate, args: Vec::new() })]
        }
    };
    let mut compiled = Goal::default();
    for literal in literals {
        let Some(atom) = ground(&literal.atom) else { continue };
        if literal.positive { compiled.required.push(atom) } else { compiled.forbidden.push(atom) }
    }
    Ok(compiled)
}

/// Of a goal that can never hold, the part that alone cannot, if one is found; else the whole.
fn impossible_part<'g>(
    block: &mut Block<'_>,
    goal: &'g Formula,
    init: &BTreeSet<GroundAtom>,
    fluents: &BTreeSet<Symbol>,
) -> Result<&'g Formula, CompileError> {
    let Formula::And(parts) = goal else { return Ok(goal) };
    let normal = |part| block.normal(part, true, &mut Visible::new());
    let normals: Vec<Normal> = parts.iter().map(normal).collect::<Result<_, _>>()?;
    let mut expansion = Expansion::new(block, init, fluents);
    for (part, normal) in parts.iter().zip(&normals) {
        if expansion.expand(normal)?.decided() == Some(false) {
            return impossible_part(block, part, init, fluents);
        }
    }
    Ok(goal)
}

/// The parts of a goal, expanded. A literal that never changes and does not hold stays: it says why the goal cannot be
/// reached.
fn expanded(expansion: &mut Expansion<'_, '_>, goal: Normal) -> Result<Vec<Normal>, CompileError> {
    let parts = match goal {
        Normal::And(parts) => parts,
        part => vec![part],
    };
    let mut expanded = Vec::with_capacity(parts.len());
    for part in parts {
        let is_literal = matches!(part, Normal::Literal(_));
        match expansion.expand(&part)? {
            Normal::And(inner) => expanded.extend(inner),
            new if is_literal && new.decided() == Some(false) => expanded.push(part),
            new => expanded.push(new),
        }
    }
    Ok(expanded)
}

/// The literals of a goal of these parts, each once; `None` if it can never hold.
fn goal_literals(block: &mut Block<'_>, parts: &[Normal]) -> Result<Option<Vec<Literal>>, CompileError> {
    let mut seen = BTreeSet::new();
    let mut literals: Vec<Literal> = Vec::new();
    for part in parts {
        let cases = block.cases(part)?;
        let new = match cases.as_slice() {
            [Case { exists, literals }] if exists.is_empty() => literals.clone(),
            _ => match block.invent_as("goal", part.said(), &cases)? {
                Some(atom) => vec![Literal::positive(atom)],
                None => return Ok(None),
            },
        };
        for literal in new {
            let opposite = Literal { atom: literal.atom.clone(), positive: !literal.positive };
            if seen.contains(&opposite) {
                return Ok(None);
            }
            if seen.insert(literal.clone()) {
                literals.push(literal);
            }
        }
    }
    Ok(Some(literals))
}

/// The predicates of a model that change or are derived.
pub(super) fn fluents(model: &ActionModel) -> BTreeSet<Symbol> {
    let changed = model.actions.iter().flat_map(|action| &action.effects).map(|effect| &effect.literal.atom.predicate);
    changed.chain(model.derived_predicates()).cloned().collect()
}
