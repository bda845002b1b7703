//! What can be to blame besides the type in a place: a literal that has to hold, or must not; two types that do not go
//! together. Each has odds, as they are before any failure has its share of blame.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionModel, ActionSchema, LiftedAtom, TypeId};

use crate::CHANCE;
use crate::cause::Pair;
use crate::outcome::Outcome;

/// How often a literal holds that nothing asks for.
const HOLDS_ANYWAY: f64 = 0.7;
/// The odds that a literal is needed: what the action makes false, what is of a kind that it changes, anything else.
const DELETED: f64 = 20.0;
const TOUCHED: f64 = 2.0;
const OTHER: f64 = 1.0;

/// The odds that what never held where it worked must not hold, and how often such an atom does not hold anyway.
const MUST_NOT: f64 = 0.02;
/// The same of a literal of which the model never heard: the world has begun to speak of something else.
const UNHEARD_OF: f64 = 0.004;
const FALSE_ANYWAY: f64 = 0.8;

/// The odds that two types do not go together, though each goes with others.
const PAIR: f64 = 0.06;

/// The logarithmic odds that each literal is needed, of those that held in some success.
pub(crate) fn literal_odds(schema: &ActionSchema, outcomes: &[Outcome]) -> BTreeMap<LiftedAtom, f64> {
    let worked = || outcomes.iter().filter(|outcome| outcome.worked);
    let atoms: BTreeSet<&LiftedAtom> = worked().flat_map(|outcome| &outcome.held).collect();
    let deleted: BTreeSet<&LiftedAtom> = schema.deletes().collect();
    let touched: BTreeSet<_> = schema.effects.iter().map(|effect| &effect.literal.atom.predicate).collect();
    let odds = |atom: &LiftedAtom| {
        let prior = match atom {
            _ if deleted.contains(atom) => DELETED,
            _ if touched.contains(&atom.predicate) => TOUCHED,
            _ => OTHER,
        };
        let told = || worked().filter(|outcome| outcome.tells_of(atom));
        let count = |held: bool| -> f64 {
            told().filter(|outcome| outcome.held.contains(atom) == held).map(|outcome| outcome.count as f64).sum()
        };
        prior.ln() - count(true) * HOLDS_ANYWAY.ln() + count(false) * CHANCE.ln()
    };
    atoms.into_iter().map(|atom| (atom.clone(), odds(atom))).collect()
}

/// The logarithmic odds that what held where it failed, and never where it worked, must not hold.
pub(crate) fn absence_odds(outcomes: &[Outcome], model: &ActionModel) -> BTreeMap<LiftedAtom, f64> {
    let worked = || outcomes.iter().filter(|outcome| outcome.worked);
    let failed = outcomes.iter().filter(|outcome| !outcome.worked);
    let atoms: BTreeSet<&LiftedAtom> = failed.flat_map(|outcome| &outcome.held).collect();
    let never = atoms.into_iter().filter(|atom| !worked().any(|outcome| outcome.held.contains(*atom)));
    let odds = |atom: &LiftedAtom| {
        let told = worked().filter(|outcome| outcome.tells_of(atom)).map(|outcome| outcome.count as f64);
        let prior = if model.predicates.contains_key(&atom.predicate) { MUST_NOT } else { UNHEARD_OF };
        prior.ln() - told.sum::<f64>() * FALSE_ANYWAY.ln()
    };
    never.map(|atom| (atom.clone(), odds(atom))).collect()
}

/// Every pair of types of an outcome.
pub(crate) fn pairs(types: &[Option<TypeId>]) -> Vec<Pair> {
    let known: Vec<(usize, TypeId)> = types.iter().enumerate().filter_map(|(at, ty)| Some((at, (*ty)?))).collect();
    let mut pairs = Vec::new();
    for (i, &one) in known.iter().enumerate() {
        pairs.extend(known[i + 1..].iter().map(|&other| (one, other)));
    }
    pairs
}

/// How often each pair of types worked.
pub(crate) fn pairs_worked(outcomes: &[Outcome]) -> BTreeMap<Pair, u64> {
    let mut worked = BTreeMap::new();
    for outcome in outcomes.iter().filter(|outcome| outcome.worked) {
        for pair in pairs(&outcome.types) {
            *worked.entry(pair).or_default() += outcome.count;
        }
    }
    worked
}

/// The logarithmic odds that a pair does not go together which worked so often: small, and next to nothing once it did.
pub(crate) fn pair_odds(worked: u64) -> f64 {
    PAIR.ln() + worked as f64 * CHANCE.ln()
}
