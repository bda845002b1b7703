//! What is believed of one action: the blame of its failures, shared.

use std::collections::BTreeMap;

use typelift_model::{ActionSchema, Hierarchy, LiftedAtom, Observations, TypeId};

use crate::outcome::{Outcome, outcomes, worked_at};
use crate::suspicion::{Pair, literal_odds, pair_odds, pairs};
use crate::types::{Seen, TypeBelief};
use crate::{CHANCE, MOST_ALIKE, odds};

/// How often the blame is shared anew.
const ROUNDS: usize = 8;

/// The least odds that a type is rejected where only others worked that it has nothing in common with: the hierarchy says
/// that it is another kind of thing, and nothing that was seen says otherwise.
const FOREIGN: f64 = (1.0 - CHANCE) / CHANCE;

/// Something that can be to blame for a failure of an action.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Cause {
    /// The type at a parameter.
    Type(usize, TypeId),
    /// Two types together.
    Together(Pair),
    /// A literal that did not hold.
    Missing(LiftedAtom),
    /// Nothing that is known.
    Chance,
}

/// What is believed of one action.
#[derive(Debug, Clone)]
pub(crate) struct ActionBelief {
    /// Whether the call ever did anything else than the action says.
    pub(crate) has_failed: bool,
    /// The type of each parameter, which covers what worked.
    covers: Vec<TypeId>,
    /// For each parameter the lowest type that covers all that worked there; none if that is the top.
    worked_below: Vec<Option<TypeId>>,
    top: TypeId,
    types: Vec<TypeBelief>,
    outcomes: Vec<Outcome>,
    blamed: BTreeMap<Cause, f64>,
    /// The logarithmic odds that each literal is needed, without any blame.
    literals: BTreeMap<LiftedAtom, f64>,
}

impl ActionBelief {
    /// What observations say of a learned action. In time of the failures, times the types of the hierarchy.
    pub(crate) fn new(schema: &ActionSchema, observed: &Observations, hierarchy: &Hierarchy) -> Self {
        let outcomes = outcomes(schema, observed, hierarchy);
        let mut belief = Self {
            has_failed: outcomes.iter().any(|outcome| !outcome.worked),
            covers: schema.parameters.iter().map(|parameter| parameter.ty).collect(),
            worked_below: worked_below(&worked_at(&outcomes, schema.parameters.len()), hierarchy),
            top: hierarchy.top(),
            types: Vec::new(),
            literals: literal_odds(schema, &outcomes),
            blamed: BTreeMap::new(),
            outcomes,
        };
        belief.believe_types(hierarchy);
        let failures: Vec<Outcome> = belief.outcomes.iter().filter(|outcome| !outcome.worked).cloned().collect();
        let mut own = vec![BTreeMap::new(); failures.len()];
        for _ in 0..ROUNDS {
            let shared = failures.iter().zip(&own);
            own = shared.map(|(failure, own)| belief.shares(hierarchy, failure, own)).collect();
            belief.blamed = BTreeMap::new();
            for (cause, share) in own.iter().flatten() {
                *belief.blamed.entry(cause.clone()).or_default() += share;
            }
            belief.believe_types(hierarchy);
        }
        belief
    }

    fn believe_types(&mut self, hierarchy: &Hierarchy) {
        let worked = worked_at(&self.outcomes, self.covers.len());
        let mut seen: Vec<BTreeMap<TypeId, Seen>> = worked
            .into_iter()
            .map(|worked| worked.into_iter().map(|(ty, worked)| (ty, Seen { worked, blamed: 0.0 })).collect())
            .collect();
        for (cause, blamed) in &self.blamed {
            if let Cause::Type(at, ty) = cause {
                seen[*at].entry(*ty).or_default().blamed += blamed;
            }
        }
        self.types = seen.iter().map(|seen| TypeBelief::new(hierarchy, seen)).collect();
    }

    /// What may be to blame where these types are used and these atoms do not hold, with its odds; without the blame that is
    /// its `own`.
    fn causes(
        &self,
        hierarchy: &Hierarchy,
        types: &[Option<TypeId>],
        missing: impl IntoIterator<Item = LiftedAtom>,
        own: &BTreeMap<Cause, f64>,
    ) -> Vec<(Cause, f64)> {
        let mut causes = Vec::new();
        let share = |shares: &BTreeMap<Cause, f64>, cause: &Cause| shares.get(cause).copied().unwrap_or_default();
        for (at, ty) in types.iter().enumerate().filter_map(|(at, ty)| Some((at, (*ty)?))) {
            if !self.is_settled(hierarchy, at, ty) {
                let mut accepted = self.types[at].accepts(ty);
                if !self.has_failed {
                    // What was generalized covers what is likely; beyond it there is imagination.
                    accepted /= 2.0;
                }
                let cause = Cause::Type(at, ty);
                let rejected = ((1.0 - accepted) / accepted).ln() + share(own, &cause) * CHANCE.ln();
                let least = if self.is_foreign(hierarchy, at, ty) { FOREIGN.ln() } else { f64::NEG_INFINITY };
                causes.push((cause, odds(rejected.max(least))));
            }
        }
        let blamed = |cause: &Cause| (share(own, cause) - share(&self.blamed, cause)) * CHANCE.ln();
        if self.has_failed {
            for pair in pairs(types) {
                let (before, cause) = (pair_odds(&pair, &self.outcomes), Cause::Together(pair));
                causes.push((cause.clone(), odds(before + blamed(&cause))));
            }
        }
        for atom in missing {
            let Some(before) = self.literals.get(&atom) else { continue };
            let cause = Cause::Missing(atom);
            causes.push((cause.clone(), odds(before + blamed(&cause))));
        }
        causes
    }

    /// What speaks against a call of these types where these atoms do not hold, with its odds.
    pub(crate) fn against(
        &self,
        hierarchy: &Hierarchy,
        types: &[Option<TypeId>],
        missing: impl IntoIterator<Item = LiftedAtom>,
    ) -> Vec<(Cause, f64)> {
        let mut causes = self.causes(hierarchy, types, missing, &BTreeMap::new());
        if self.has_failed {
            causes.push((Cause::Chance, CHANCE / (1.0 - CHANCE)));
        }
        causes
    }

    /// The literals that may be needed.
    pub(crate) fn literals(&self) -> impl Iterator<Item = &LiftedAtom> {
        self.literals.keys()
    }

    /// With successes alone, whatever the generalized type covers is accepted, as in the paper.
    fn is_settled(&self, hierarchy: &Hierarchy, at: usize, ty: TypeId) -> bool {
        !self.has_failed && hierarchy.is_a(ty, self.covers[at])
    }

    /// Whether a type has nothing in common, below the top, with all that worked in a place.
    fn is_foreign(&self, hierarchy: &Hierarchy, at: usize, ty: TypeId) -> bool {
        let shares_nothing =
            |worked| !hierarchy.is_a(worked, ty) && hierarchy.is_a(self.top, hierarchy.lca(worked, ty));
        self.worked_below[at].is_some_and(shares_nothing)
    }

    /// The blame of one failure, shared among what may have caused it, in proportion to the odds that all other
    /// observations give; `own` is the blame that it gave before, which is taken out of them.
    fn shares(&self, hierarchy: &Hierarchy, failure: &Outcome, own: &BTreeMap<Cause, f64>) -> BTreeMap<Cause, f64> {
        let count = (failure.count as f64).min(MOST_ALIKE);
        let mut causes = self.causes(hierarchy, &failure.types, self.missing_in(failure), own);
        causes.push((Cause::Chance, CHANCE.powf(count)));
        let sum: f64 = causes.iter().map(|(_, odds)| odds).sum();
        causes.into_iter().map(|(cause, odds)| (cause, count * odds / sum)).collect()
    }

    /// The literals that held in a success and are known not to have held here.
    fn missing_in(&self, outcome: &Outcome) -> Vec<LiftedAtom> {
        let missing = |atom: &&LiftedAtom| outcome.tells_of(atom) && !outcome.held.contains(*atom);
        self.literals.keys().filter(missing).cloned().collect()
    }
}

fn worked_below(worked: &[BTreeMap<TypeId, f64>], hierarchy: &Hierarchy) -> Vec<Option<TypeId>> {
    let top = hierarchy.top();
    let covering = |worked: &BTreeMap<TypeId, f64>| worked.keys().copied().reduce(|a, b| hierarchy.lca(a, b));
    worked.iter().map(|worked| covering(worked).filter(|&ty| !hierarchy.is_a(top, ty))).collect()
}
