//! Effects: nested ones become a list, each with a condition in cases.
//!
//! What a condition quantifies existentially is a further choice for which the effect happens.

use std::collections::BTreeSet;

use typelift_model::{Effect, LiftedAtom, Literal, Parameter, Symbol, Term};

use super::block::{Block, Visible};
use super::case::Case;
use super::error::CompileError;
use super::invent::renumbered;
use super::normal::{Normal, negated};
use super::solve::{Solved, solve};
use crate::{Amount, PddlAtom, PddlEffect};

/// What an action changes, over the variables of its block.
#[derive(Debug, Default)]
pub(super) struct Changes {
    effects: Vec<Change>,
    /// The fixed part of the cost.
    pub(super) fixed: u32,
    /// The functions that are added to the cost.
    pub(super) functions: Vec<LiftedAtom>,
}

/// One literal that is changed.
#[derive(Debug)]
struct Change {
    /// For every choice of objects for these,
    own: Vec<u32>,
    /// in any of these cases,
    cases: Vec<Case>,
    /// it holds afterwards.
    literal: Literal,
}

/// Where in an effect one is.
#[derive(Debug, Clone, Default)]
struct Place {
    own: Vec<u32>,
    conditions: Vec<Normal>,
}

/// Collects the changes of one effect.
struct Flattening<'b, 'w> {
    block: &'b mut Block<'w>,
    derived: &'b BTreeSet<&'b Symbol>,
    changes: Changes,
}

impl Block<'_> {
    /// What an effect changes. None of it may be of a derived predicate.
    pub(super) fn changes<'f>(
        &mut self,
        effect: &'f PddlEffect,
        derived: &BTreeSet<&Symbol>,
        visible: &mut Visible<'f>,
    ) -> Result<Changes, CompileError> {
        let mut flattening = Flattening { block: self, derived, changes: Changes::default() };
        flattening.flatten(effect, &Place::default(), visible)?;
        Ok(flattening.changes)
    }
}

impl Flattening<'_, '_> {
    fn flatten<'f>(
        &mut self,
        effect: &'f PddlEffect,
        place: &Place,
        visible: &mut Visible<'f>,
    ) -> Result<(), CompileError> {
        match effect {
            PddlEffect::And(parts) => parts.iter().try_for_each(|part| self.flatten(part, place, visible)),
            PddlEffect::Add(atom) => self.change(atom, true, place, visible),
            PddlEffect::Delete(atom) => self.change(atom, false, place, visible),
            PddlEffect::Forall(variables, body) => {
                let outside = visible.len();
                let mut inner = place.clone();
                inner.own.extend(self.block.declare(variables, visible)?);
                self.flatten(body, &inner, visible)?;
                visible.truncate(outside);
                Ok(())
            }
            PddlEffect::When(condition, body) => {
                let mut inner = place.clone();
                inner.conditions.push(self.block.normal(condition, true, visible)?);
                self.flatten(body, &inner, visible)
            }
            PddlEffect::Increase(_) if !(place.own.is_empty() && place.conditions.is_empty()) => {
                let message = "its cost depends on the state, or on a choice";
                Err(self.block.error(message).not_supported())
            }
            PddlEffect::Increase(Amount::Number(number)) => {
                self.changes.fixed = self.changes.fixed.saturating_add(*number);
                Ok(())
            }
            PddlEffect::Increase(Amount::Function(function)) => {
                self.changes.functions.push(self.block.function(function, visible)?);
                Ok(())
            }
        }
    }

    fn change(
        &mut self,
        atom: &PddlAtom,
        positive: bool,
        place: &Place,
        visible: &Visible<'_>,
    ) -> Result<(), CompileError> {
        if self.derived.contains(&atom.predicate) {
            let message = format!("it changes `{}`, which is a derived predicate", atom.predicate);
            return Err(self.block.error(message));
        }
        let literal = Literal { atom: self.block.atom(atom, visible)?, positive };
        let condition = Normal::junction(true, place.conditions.iter().cloned());
        let cases = self.block.few_cases(&condition)?;
        self.changes.effects.push(Change { own: place.own.clone(), cases, literal });
        Ok(())
    }
}

/// The effects of a schema, sorted, each once. `declared` are the action's own variables, `schema` is what its
/// precondition made of them.
pub(super) fn effects_of(
    block: &mut Block<'_>,
    changes: &Changes,
    declared: &[u32],
    schema: &Solved,
) -> Result<Vec<Effect>, CompileError> {
    let most = block.world.limits.effects;
    let mut effects = Vec::with_capacity(changes.effects.len());
    for change in &changes.effects {
        for case in &change.cases {
            let own = [change.own.as_slice(), &case.exists].concat();
            block.check_parameters(schema.variables.len() + own.len())?;
            for typing in block.typings(&own)? {
                block.count_literals(case.literals.len())?;
                let literals = [case.literals.as_slice(), std::slice::from_ref(&change.literal)].concat();
                let literals = in_schema(&literals, declared, &own, schema);
                let rigid = schema.variables.len();
                let variables = [schema.variables.as_slice(), &typing].concat();
                let effect = effect(block, variables, rigid, &literals);
                effects.extend(effect.and_then(|effect| without_known_equalities(effect, &schema.literals)));
                if effects.len() > most {
                    return Err(block.error(format!("it has more than {most} effects")).not_supported());
                }
            }
        }
    }
    effects.sort_unstable();
    effects.dedup();
    Ok(effects)
}

/// The literals over the schema's parameters and, numbered after these, the variables of the effect's own.
fn in_schema(literals: &[Literal], declared: &[u32], own: &[u32], schema: &Solved) -> Vec<Literal> {
    let parameters = schema.variables.len() as u32;
    let term = |term: &Term| match term {
        Term::Param(index) => match index.checked_sub(declared.len() as u32) {
            Some(own) => Term::Param(parameters + own),
            None => schema.term(term),
        },
        object @ Term::Const(_) => object.clone(),
    };
    let positions = renumbered(literals, &[declared, own].concat());
    positions.into_iter().map(|l| Literal { atom: l.atom.map(term), positive: l.positive }).collect()
}

/// The effect of a condition and, as the last of the literals, what changes; `None` if it never happens.
fn effect(block: &Block<'_>, variables: Vec<Parameter>, rigid: usize, literals: &[Literal]) -> Option<Effect> {
    let (changed, condition) = literals.split_last()?;
    let solved = solve(block.world, variables, rigid, condition)?;
    let literal = Literal { atom: changed.atom.map(|term| solved.term(term)), positive: changed.positive };
    Some(Effect { condition: solved.literals, literal, parameters: solved.variables[rigid..].to_vec() })
}

/// The effect without the equalities that the precondition decides; `None` if it decides against one.
fn without_known_equalities(mut effect: Effect, precondition: &[Literal]) -> Option<Effect> {
    let is_known = |literal: &Literal| literal.atom.is_equality() && precondition.binary_search(literal).is_ok();
    if effect.condition.iter().any(|literal| is_known(&negated(literal))) {
        return None;
    }
    effect.condition.retain(|literal| !is_known(literal));
    Some(effect)
}
