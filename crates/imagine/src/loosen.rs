//! Preconditions that may be accidents: what held whenever an action was seen, and nothing suggests is needed.
//!
//! What was seen seven times carries what was the same those seven times. A precondition may be done without where the
//! action neither deletes its atom nor changes anything of its kind, and where it is not all that says which object one of
//! the action's unnamed parameters is. What holds of one thing is given up before what relates two, and what was seen
//! seldom before what was seen often: the more often something held, the less is it likely to be chance.
//!
//! An action that does without a precondition is used only where that does not hold: so a plan says of each of its steps what it
//! does without, and the action as it was learned is used wherever it can be.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use typelift_model::{ActionModel, ActionSchema, Goal, LiftedAtom, Literal, Provenance, Symbol, Term};

/// A precondition of a learned action that is done without.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Loosening {
    /// The action's name.
    pub action: Symbol,
    /// The precondition.
    pub precondition: LiftedAtom,
}

/// What could be done without on the way to a goal, the least doubtful first. In time of a look at every action, as often as
/// the way back from the goal is long.
pub fn loosenings(model: &ActionModel, goal: &Goal) -> Vec<Loosening> {
    let asked = goal.literals().map(|(atom, _)| &atom.predicate).collect();
    let relevant = leading_to(model, asked);
    let mut found: Vec<(bool, u64, Loosening)> = Vec::new();
    for schema in model.actions.iter().filter(|schema| !schema.provenance.support().is_empty()) {
        if !schema.effects.iter().any(|effect| relevant.contains(&effect.literal.atom.predicate)) {
            continue;
        }
        for precondition in schema.positive_preconditions().filter(|atom| may_be_an_accident(schema, atom)) {
            let loosening = Loosening { action: schema.name.clone(), precondition: precondition.clone() };
            found.push((precondition.args.len() > 1, schema.provenance.observations(), loosening));
        }
    }
    found.sort_unstable();
    found.into_iter().map(|(_, _, loosening)| loosening).collect()
}

/// These predicates, and all on which it depends whether atoms of theirs can come about.
fn leading_to<'a>(model: &'a ActionModel, mut predicates: BTreeSet<&'a Symbol>) -> BTreeSet<&'a Symbol> {
    loop {
        let before = predicates.len();
        for schema in &model.actions {
            if schema.effects.iter().any(|effect| predicates.contains(&effect.literal.atom.predicate)) {
                predicates.extend(schema.preconditions.iter().map(|literal| &literal.atom.predicate));
            }
        }
        for axiom in &model.axioms {
            if predicates.contains(&axiom.head.predicate) {
                predicates.extend(axiom.body.iter().map(|literal| &literal.atom.predicate));
            }
        }
        if predicates.len() == before {
            return predicates;
        }
    }
}

fn may_be_an_accident(schema: &ActionSchema, precondition: &LiftedAtom) -> bool {
    let is_touched = schema.effects.iter().any(|effect| effect.literal.atom.predicate == precondition.predicate);
    !is_touched && is_told_without(schema, &[precondition])
}

/// Whether the call and what is left of the preconditions say which object each parameter is.
fn is_told_without(schema: &ActionSchema, without: &[&LiftedAtom]) -> bool {
    let left = || schema.positive_preconditions().filter(|atom| !without.contains(atom));
    let is_told = |parameter: u32| {
        schema.call.args.contains(&Term::Param(parameter)) || left().any(|atom| atom.params().any(|p| p == parameter))
    };
    without.iter().flat_map(|atom| atom.params()).all(is_told)
}

/// The model in which all of these are done without, wherever they hold or not: what it cannot reach, nobody reaches by
/// doing without some of them.
pub fn without_all(model: &ActionModel, loosenings: &[Loosening]) -> ActionModel {
    let mut model = model.clone();
    for schema in &mut model.actions {
        let name = &schema.name;
        let is_loosened = |literal: &Literal| {
            let mut of_action = loosenings.iter().filter(|loosening| loosening.action == *name);
            literal.positive && of_action.any(|loosening| loosening.precondition == literal.atom)
        };
        schema.preconditions.retain(|literal| !is_loosened(literal));
    }
    model
}

/// For each of these actions, those that do without one or two of the preconditions named, and are used where these do not
/// hold.
pub(crate) fn loosened(model: &ActionModel, loosenings: &[Loosening]) -> Vec<ActionSchema> {
    let mut actions = Vec::new();
    for schema in &model.actions {
        let is_named = |atom: &&LiftedAtom| {
            loosenings.iter().any(|loosening| loosening.action == schema.name && loosening.precondition == **atom)
        };
        let named: Vec<&LiftedAtom> = schema.positive_preconditions().filter(is_named).collect();
        let alone = named.iter().map(|atom| vec![*atom]);
        let pairs = named.iter().enumerate().flat_map(|(at, one)| named[..at].iter().map(|other| vec![*other, *one]));
        let chosen = alone.chain(pairs).filter(|without| is_told_without(schema, without));
        actions.extend(chosen.map(|without| doing_without(schema, &without)));
    }
    actions
}

/// `seal-jar-without-dry`; the parameters are named where the action needs several atoms of the predicate. It does not depend
/// on what else is done without.
fn name_without(schema: &ActionSchema, without: &[&LiftedAtom]) -> Symbol {
    let mut name = format!("{}-without", schema.name);
    for atom in without {
        name += &format!("-{}", atom.predicate);
        if schema.positive_preconditions().filter(|other| other.predicate == atom.predicate).count() > 1 {
            for term in &atom.args {
                name += &match term {
                    Term::Param(parameter) => format!("-{}", schema.parameters[*parameter as usize].name),
                    Term::Const(object) => format!("-{object}"),
                };
            }
        }
    }
    Symbol::from(name)
}

fn doing_without(schema: &ActionSchema, without: &[&LiftedAtom]) -> ActionSchema {
    let mut action = schema.clone();
    action.name = name_without(schema, without);
    for literal in action.preconditions.iter_mut().filter(|l| l.positive && without.contains(&&l.atom)) {
        literal.positive = false;
    }
    action.preconditions.sort_unstable();
    action.provenance = Provenance::Loosened {
        from: schema.name.clone(),
        without: without.iter().map(|atom| (*atom).clone()).collect(),
        observations: schema.provenance.observations(),
    };
    action
}
