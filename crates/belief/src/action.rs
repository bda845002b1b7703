//! What is believed of one action: the blame of its failures, shared.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionModel, ActionSchema, Hierarchy, LiftedAtom, Observations, TypeId};

use crate::around::Around;
use crate::cause::{Cause, Pair};
use crate::deed::Tried;
use crate::object::OutOfOrder;
use crate::outcome::{Outcome, failed, of_parameters, outcomes, tried, worked_at};
use crate::run::Run;
use crate::surroundings::Surrounding;
use crate::suspicion::{absence_odds, literal_odds, pair_odds, pairs, pairs_worked};
use crate::types::{Seen, TypeBelief};
use crate::{CHANCE, MOST_ALIKE, odds};

/// How often the blame is shared anew.
const ROUNDS: usize = 16;

/// The least odds that a type is rejected where only others worked that it has nothing in common with: the hierarchy says
/// that it is another kind of thing, and nothing that was seen says otherwise.
const FOREIGN: f64 = (1.0 - CHANCE) / CHANCE;

/// What a declared type counts, in successes.
const DECLARED: f64 = 3.0;

/// What is believed of one action.
#[derive(Debug, Clone)]
pub struct ActionBelief {
    /// Whether the call ever did anything else than the action says.
    pub(crate) has_failed: bool,
    /// Whether who stands at a parameter acts.
    acts: Vec<bool>,
    /// Whether it rests on no observation, but was written by somebody.
    is_given: bool,
    /// The type of each parameter, which covers what worked.
    covers: Vec<TypeId>,
    /// For each parameter the lowest type that covers all that worked there; none if that is the top.
    worked_below: Vec<Option<TypeId>>,
    top: TypeId,
    types: Vec<TypeBelief>,
    /// What was observed of it and tried of it.
    outcomes: Vec<Outcome>,
    /// How often each pair of types worked.
    pairs: BTreeMap<Pair, u64>,
    around: Around,
    blamed: BTreeMap<Cause, f64>,
    /// How much each failure speaks for what may have caused it, and how often it was seen.
    clauses: Vec<(BTreeMap<Cause, f64>, u64)>,
    /// The logarithmic odds that each literal is needed, without any blame.
    literals: BTreeMap<LiftedAtom, f64>,
    /// The same, that it must not hold.
    absent: BTreeMap<LiftedAtom, f64>,
}

impl ActionBelief {
    /// What observations say of a learned action, and what was tried of it besides. In time of the kinds of what was tried, and of
    /// the failures times the types of the hierarchy.
    pub fn new(schema: &ActionSchema, observed: &Observations, run: &Run<'_>, model: &ActionModel) -> Self {
        let hierarchy = &model.hierarchy;
        let mut outcomes = outcomes(schema, observed, hierarchy);
        outcomes.extend(tried(schema, run, hierarchy));
        let mut belief = Self {
            has_failed: outcomes.iter().any(|outcome| !outcome.worked),
            acts: schema.parameters.iter().map(|parameter| model.is_actor(parameter.ty)).collect(),
            is_given: schema.provenance.support().is_empty(),
            covers: schema.parameters.iter().map(|parameter| parameter.ty).collect(),
            worked_below: worked_below(&worked_at(&outcomes, schema.parameters.len()), hierarchy),
            top: hierarchy.top(),
            types: Vec::new(),
            literals: literal_odds(schema, &outcomes),
            absent: absence_odds(&outcomes, model),
            blamed: BTreeMap::new(),
            clauses: Vec::new(),
            pairs: pairs_worked(&outcomes),
            around: around(schema, &outcomes, run),
            outcomes,
        };
        belief.believe_types(hierarchy);
        let failures: Vec<Outcome> = belief.outcomes.iter().filter(|outcome| !outcome.worked).cloned().collect();
        let mut own = vec![BTreeMap::new(); failures.len()];
        let rounds = if failures.is_empty() { 0 } else { ROUNDS };
        for _ in 0..rounds {
            let shared = failures.iter().zip(&own);
            own = shared.map(|(failure, own)| halfway(own, belief.shares(hierarchy, failure, own))).collect();
            belief.blamed = BTreeMap::new();
            for (cause, share) in own.iter().flatten() {
                *belief.blamed.entry(cause.clone()).or_default() += share;
            }
            belief.believe_types(hierarchy);
        }
        belief.clauses = own.into_iter().zip(failures.iter().map(|failure| failure.count)).collect();
        belief
    }

    /// How likely a call works against which these causes speak, with their odds. Where it failed before, one of what may have
    /// caused that is at fault, or it was chance, though nobody knows which.
    pub(crate) fn works(&self, causes: &[(Cause, f64)]) -> f64 {
        let odds_of: BTreeMap<&Cause, f64> = causes.iter().map(|(cause, odds)| (cause, *odds)).collect();
        let innocent = |odds: f64| 1.0 / (1.0 + odds);
        let by_now: f64 = causes.iter().map(|(_, odds)| innocent(*odds)).product();
        let after = |(clause, count): &(BTreeMap<Cause, f64>, u64)| -> Option<f64> {
            let mut all_innocent = 1.0;
            for (cause, share) in clause {
                let before = odds_of.get(cause)?.ln() + share * CHANCE.ln();
                all_innocent *= innocent(odds(before));
            }
            let chance = CHANCE.powf((*count as f64).min(MOST_ALIKE));
            let others = causes.iter().filter(|(cause, _)| !clause.contains_key(cause));
            let others: f64 = others.map(|(_, odds)| innocent(*odds)).product();
            Some(others * all_innocent * chance / (all_innocent * chance + 1.0 - all_innocent))
        };
        self.clauses.iter().filter_map(after).fold(by_now, f64::min)
    }

    fn believe_types(&mut self, hierarchy: &Hierarchy) {
        let mut worked = worked_at(&self.outcomes, self.covers.len());
        if self.is_given {
            // Who wrote the action said which types it is for.
            worked.iter_mut().zip(&self.covers).for_each(|(worked, ty)| *worked.entry(*ty).or_default() += DECLARED);
        }
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

    /// What may be to blame where these types are used, these atoms do not hold and those do, with its odds; without the
    /// blame that is its `own`.
    fn causes(
        &self,
        hierarchy: &Hierarchy,
        types: &[Option<TypeId>],
        missing: impl IntoIterator<Item = LiftedAtom>,
        present: impl IntoIterator<Item = LiftedAtom>,
        own: &BTreeMap<Cause, f64>,
    ) -> Vec<(Cause, f64)> {
        let mut causes = Vec::new();
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
        let blamed = |cause: &Cause| self.blamed_by_others(cause, own);
        if self.has_failed {
            // Who acts goes with whatever it can go with: to pair it says nothing of its own.
            let paired =
                pairs(types).into_iter().filter(|((one, _), (other, _))| !self.acts[*one] && !self.acts[*other]);
            for pair in paired {
                let worked = self.pairs.get(&pair).copied().unwrap_or_default();
                let (before, cause) = (pair_odds(worked), Cause::Together(pair));
                causes.push((cause.clone(), odds(before + blamed(&cause))));
            }
        }
        let missing = missing.into_iter().filter_map(|atom| Some((*self.literals.get(&atom)?, Cause::Missing(atom))));
        let present = present.into_iter().filter_map(|atom| Some((*self.absent.get(&atom)?, Cause::Present(atom))));
        for (before, cause) in missing.chain(present) {
            let now = odds(before + blamed(&cause));
            causes.push((cause, now));
        }
        causes
    }

    /// What speaks against a call of these types where these atoms do not hold, with its odds.
    pub(crate) fn against(
        &self,
        hierarchy: &Hierarchy,
        types: &[Option<TypeId>],
        missing: impl IntoIterator<Item = LiftedAtom>,
        present: impl IntoIterator<Item = LiftedAtom>,
    ) -> Vec<(Cause, f64)> {
        let mut causes = self.causes(hierarchy, types, missing, present, &BTreeMap::new());
        if self.has_failed {
            causes.push((Cause::Chance, CHANCE / (1.0 - CHANCE)));
        }
        causes
    }

    /// The literals that may be needed.
    pub(crate) fn literals(&self) -> impl Iterator<Item = &LiftedAtom> {
        self.literals.keys()
    }

    /// Whether a literal may stand in the way.
    pub(crate) fn is_absent(&self, atom: &LiftedAtom) -> bool {
        self.absent.contains_key(atom)
    }

    /// The literals that may stand in the way.
    pub(crate) fn absent(&self) -> impl Iterator<Item = &LiftedAtom> {
        self.absent.keys()
    }

    /// What may have caused a failure of the run, with the odds that it is at fault now that all is known; none if it was of
    /// another action.
    pub fn blame(
        &self,
        schema: &ActionSchema,
        failure: &Tried<'_>,
        run: &Run<'_>,
        hierarchy: &Hierarchy,
    ) -> Vec<(Cause, f64)> {
        let Some(failure) = failed(schema, failure, hierarchy, run) else { return Vec::new() };
        let mut causes = self.causes_of(hierarchy, &failure, &BTreeMap::new());
        for (cause, odds) in &mut causes {
            if let Some(object) = failure.objects.get(cause) {
                *odds *= object.since.exp();
            }
        }
        causes.sort_by(|(a, x), (b, y)| y.total_cmp(x).then_with(|| a.cmp(b)));
        causes
    }

    /// What speaks against objects of these types in any place of the action, and against those that failed together, each
    /// with its odds. Nothing speaks against what worked, as long as nothing failed.
    pub fn doubts(&self, hierarchy: &Hierarchy, types: &BTreeSet<TypeId>) -> Vec<(Cause, f64)> {
        let nothing_said = BTreeMap::new();
        let mut doubts = Vec::new();
        for at in 0..self.covers.len() {
            for ty in types {
                let mut alone = vec![None; self.covers.len()];
                alone[at] = Some(*ty);
                doubts.extend(self.causes(hierarchy, &alone, [], [], &nothing_said));
            }
        }
        let failures = self.outcomes.iter().filter(|outcome| !outcome.worked);
        let causes = failures.flat_map(|failure| self.causes_of(hierarchy, failure, &nothing_said));
        let together: BTreeMap<Cause, f64> = causes.filter(|(cause, _)| matches!(cause, Cause::Together(_))).collect();
        doubts.extend(together);
        doubts
    }

    /// The literals that are no preconditions and yet hold nearly always where the action works, with the odds that each is
    /// needed.
    pub fn needed(&self, schema: &ActionSchema) -> Vec<(LiftedAtom, f64)> {
        let is_stated = |atom: &LiftedAtom| schema.preconditions.iter().any(|literal| literal.atom == *atom);
        let odds = self.literals.iter().filter(|(atom, _)| !is_stated(atom));
        odds.map(|(atom, before)| (atom.clone(), odds_of_missing(*before, &self.blamed, atom))).collect()
    }

    /// What may have caused a failure, chance apart.
    fn causes_of(&self, hierarchy: &Hierarchy, failure: &Outcome, own: &BTreeMap<Cause, f64>) -> Vec<(Cause, f64)> {
        let held = failure.held.iter().filter(|atom| self.absent.contains_key(*atom)).cloned();
        let mut causes = self.causes(hierarchy, &failure.types, self.missing_in(failure), held, own);
        for (cause, OutOfOrder { then: before, .. }) in &failure.objects {
            causes.push((cause.clone(), odds(before + self.blamed_by_others(cause, own))));
        }
        causes.extend(failure.around.iter().flat_map(|held| self.causes_around(held, own)));
        causes
    }

    /// What may have caused a failure around which these held, without the blame that is its `own`.
    pub(crate) fn causes_around<'s>(
        &'s self,
        held: &'s BTreeSet<Surrounding>,
        own: &'s BTreeMap<Cause, f64>,
    ) -> impl Iterator<Item = (Cause, f64)> {
        self.around.suspects(held).map(move |(surrounding, held, before)| {
            let cause = Cause::Around(surrounding.clone(), held);
            let now = odds(before + self.blamed_by_others(&cause, own));
            (cause, now)
        })
    }

    /// The objects of each failure, with the odds that they are out of order now.
    pub(crate) fn objects_out_of_order(&self) -> impl Iterator<Item = (&Cause, f64)> {
        let nothing = BTreeMap::new();
        self.outcomes.iter().flat_map(|outcome| &outcome.objects).map(move |(cause, object)| {
            (cause, odds(object.then + self.blamed_by_others(cause, &nothing)) * object.since.exp())
        })
    }

    /// By how much all failures but the one whose blame is its `own` raise the logarithmic odds of a cause.
    fn blamed_by_others(&self, cause: &Cause, own: &BTreeMap<Cause, f64>) -> f64 {
        (share(own, cause) - share(&self.blamed, cause)) * CHANCE.ln()
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

    /// How much one failure speaks for each of what may have caused it, as so many failures that nothing else explains: the
    /// less, the likelier the others are at fault by all other observations. What it said before is its `own`, and is
    /// taken out of them. (Messages of a noisy-or, as in Pearl, *Probabilistic Reasoning in Intelligent Systems*, 1988.)
    fn shares(&self, hierarchy: &Hierarchy, failure: &Outcome, own: &BTreeMap<Cause, f64>) -> BTreeMap<Cause, f64> {
        let causes = self.causes_of(hierarchy, failure, own);
        let innocent: Vec<f64> = causes.iter().map(|(_, odds)| 1.0 / (1.0 + odds)).collect();
        let not_by_chance = 1.0 - CHANCE.powf((failure.count as f64).min(MOST_ALIKE));
        let share = |at: usize| {
            let others = innocent.iter().enumerate().filter(|(other, _)| *other != at).map(|(_, innocent)| innocent);
            let unexplained = not_by_chance * others.product::<f64>();
            (1.0 - unexplained).ln() / CHANCE.ln()
        };
        let shares: Vec<f64> = (0..causes.len()).map(share).collect();
        causes.into_iter().map(|(cause, _)| cause).zip(shares).collect()
    }

    /// The literals that held in a success and are known not to have held here.
    pub(crate) fn missing_in(&self, outcome: &Outcome) -> Vec<LiftedAtom> {
        let missing = |atom: &&LiftedAtom| outcome.tells_of(atom) && !outcome.held.contains(*atom);
        self.literals.keys().filter(missing).cloned().collect()
    }
}

/// What held around where an action worked and failed; nothing as long as it did not fail.
fn around(schema: &ActionSchema, outcomes: &[Outcome], run: &Run<'_>) -> Around {
    let failures = || outcomes.iter().filter_map(|outcome| outcome.around.as_ref());
    let alike = run.failed().iter().find(|failure| of_parameters(schema, failure.deed));
    if failures().next().is_none() {
        Around::default()
    } else {
        Around::new(alike.and_then(|one| run.around(one.deed)), failures())
    }
}

fn worked_below(worked: &[BTreeMap<TypeId, f64>], hierarchy: &Hierarchy) -> Vec<Option<TypeId>> {
    let top = hierarchy.top();
    let covering = |worked: &BTreeMap<TypeId, f64>| worked.keys().copied().reduce(|a, b| hierarchy.lca(a, b));
    worked.iter().map(|worked| covering(worked).filter(|&ty| !hierarchy.is_a(top, ty))).collect()
}

/// Between what was said before and what is said now: where failures share several causes, the blame would else go to all of
/// them and to none of them in turn.
fn halfway(before: &BTreeMap<Cause, f64>, mut now: BTreeMap<Cause, f64>) -> BTreeMap<Cause, f64> {
    for (cause, share) in &mut now {
        *share = (*share + self::share(before, cause)) / 2.0;
    }
    now
}

/// The odds that a literal is needed, with the blame that it has.
fn odds_of_missing(before: f64, blamed: &BTreeMap<Cause, f64>, atom: &LiftedAtom) -> f64 {
    odds(before - share(blamed, &Cause::Missing(atom.clone())) * CHANCE.ln())
}

fn share(shares: &BTreeMap<Cause, f64>, cause: &Cause) -> f64 {
    shares.get(cause).copied().unwrap_or_default()
}
