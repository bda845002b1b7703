//! Actions: a schema for each case of the precondition.
//!
//! Variables that the precondition quantifies existentially become parameters that the call does not mention.

use std::collections::BTreeSet;

use typelift_model::{
    ActionSchema, Cost, LiftedAtom, LiftedCall, Literal, MOST_PRECONDITIONS, Parameter, Provenance, Symbol, Term,
};

use super::block::{Block, Visible};
use super::case::Case;
use super::effect::{Changes, effects_of};
use super::error::{CompileError, CompilePart};
use super::invent::renumbered;
use super::inventions::Inventions;
use super::names::FreshNames;
use super::solve::{Solved, solve};
use super::world::World;
use crate::Action;

/// The action that is compiled.
struct Compiled {
    name: Symbol,
    /// The variables that its call mentions.
    declared: Vec<u32>,
    changes: Changes,
}

/// The schemas of an action, with new names; none if it can never be used.
pub(super) fn compile_action(
    action: &Action,
    world: World<'_>,
    inventions: &mut Inventions,
    derived: &BTreeSet<&Symbol>,
    names: &mut FreshNames,
) -> Result<Vec<ActionSchema>, CompileError> {
    let mut block = Block::new(CompilePart::Action(action.name.clone()), action.name.clone(), world, inventions);
    let mut visible = Visible::new();
    let declared = block.declare(&action.parameters, &mut visible)?;
    let condition = block.normal(&action.precondition, true, &mut visible)?;
    let cases = block.few_cases(&condition)?;
    let changes = block.changes(&action.effect, derived, &mut visible)?;
    let compiled = Compiled { name: action.name.clone(), declared, changes };
    let most = block.world.limits.schemas;
    let mut schemas: Vec<ActionSchema> = Vec::with_capacity(cases.len());
    for case in &cases {
        let variables = [compiled.declared.as_slice(), &case.exists].concat();
        for typing in block.typings(&variables)? {
            let Some(schema) = schema(&mut block, &compiled, case, &variables, typing)? else { continue };
            if schemas.iter().any(|other| is_same(other, &schema)) {
                continue;
            }
            if schemas.len() == most {
                let message = format!("its precondition can hold in more than {most} ways");
                return Err(block.error(message).not_supported());
            }
            schemas.push(schema);
        }
    }
    for (index, schema) in schemas.iter_mut().enumerate() {
        if index > 0 {
            schema.name = names.numbered(action.name.as_str(), 2);
        }
    }
    Ok(schemas)
}

/// Whether two schemas of one action are the same but for the names of their parameters.
fn is_same(a: &ActionSchema, b: &ActionSchema) -> bool {
    let types = |s: &ActionSchema| -> Vec<_> { s.parameters.iter().map(|p| p.ty).collect() };
    a.call == b.call && a.preconditions == b.preconditions && a.distinct == b.distinct && types(a) == types(b)
}

/// The schema of one case with these types of its variables; `None` if it can never be used.
fn schema(
    block: &mut Block<'_>,
    compiled: &Compiled,
    case: &Case,
    variables: &[u32],
    typing: Vec<Parameter>,
) -> Result<Option<ActionSchema>, CompileError> {
    block.count_literals(case.literals.len())?;
    let Some(solved) = solve(block.world, typing, 0, &renumbered(&case.literals, variables)) else { return Ok(None) };
    block.check_parameters(solved.variables.len())?;
    let effects = effects_of(block, &compiled.changes, &compiled.declared, &solved)?;
    let functions = compiled.changes.functions.iter().map(|f| in_case(f, &compiled.declared, &solved)).collect();
    let (distinct, preconditions) = split_distinct(&solved.literals);
    if preconditions.len() > MOST_PRECONDITIONS {
        let message = format!("its precondition has more than {MOST_PRECONDITIONS} literals");
        return Err(block.error(message).not_supported());
    }
    Ok(Some(ActionSchema {
        name: compiled.name.clone(),
        call: LiftedCall { name: compiled.name.clone(), args: solved.image[..compiled.declared.len()].to_vec() },
        parameters: solved.variables,
        preconditions,
        distinct,
        effects,
        cost: Cost { fixed: compiled.changes.fixed, functions },
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    }))
}

/// An atom over the action's declared variables, over the parameters of a case.
fn in_case(atom: &LiftedAtom, declared: &[u32], solved: &Solved) -> LiftedAtom {
    let literal = renumbered(&[Literal::positive(atom.clone())], declared);
    literal.first().map_or_else(|| atom.clone(), |l| l.atom.map(|term| solved.term(term)))
}

/// The pairs of parameters that must differ, and the other literals.
fn split_distinct(literals: &[Literal]) -> (Vec<(u32, u32)>, Vec<Literal>) {
    let mut distinct = Vec::new();
    let mut others = Vec::new();
    for literal in literals {
        match literal.atom.args.as_slice() {
            [Term::Param(a), Term::Param(b)] if literal.atom.is_equality() && !literal.positive => {
                distinct.push((*a.min(b), *a.max(b)));
            }
            _ => others.push(literal.clone()),
        }
    }
    distinct.sort_unstable();
    (distinct, others)
}
