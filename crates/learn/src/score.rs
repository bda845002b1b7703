//! ScoreAction (Algorithm 1, lines 12 and 13): how much of what was observed an action explains.
//!
//! The paper scores by recall and merges two actions if that of the merged one is at least the mean of theirs. The recall
//! of an intersection of preconditions is always 1, so this comparison alone is always true and refuses nothing. What can
//! speak against a merge is a failure that the merged action would have allowed. So the score here is
//!
//! ```text
//! v = explained / (explained + missed + wrongly allowed)
//! ```
//!
//! over the observations that the action rests on (explained where its preconditions held) and the failures of its call.
//! A failure is wrongly allowed if its entities fit the action's types and, before it, the preconditions held and nothing
//! held that the action adds: where something did, the action would not have changed all that it says anyway. An action
//! with more parameters than are recorded of a failure (a trace that does not say which action was expected records the
//! call's arguments alone) is not held against it: nothing tells what the others would have been. Without failures, v is
//! the recall.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{
    Cluster, Hierarchy, LiftedAtom, Observations, PreStates, Support, Symbol, TypeId, WITNESS_BOUND, Witness,
};

use crate::draft::Draft;

/// Ways in which the entities of one failure can be an action's parameters that are tried at most.
const WAYS_BOUND: usize = 5_040;

/// How an action does on what was observed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Score {
    explained: u64,
    missed: u64,
    wrongly_allowed: u64,
}

impl Score {
    /// Whether v is at least the mean of two others'; exact.
    pub(crate) fn at_least_mean_of(self, a: Self, b: Self) -> bool {
        let fraction = |s: Self| {
            let all = s.explained + s.missed + s.wrongly_allowed;
            (u128::from(s.explained), u128::from(all.max(1)))
        };
        let ((own, all), (own_a, all_a), (own_b, all_b)) = (fraction(self), fraction(a), fraction(b));
        2 * own * all_a * all_b >= all * (own_a * all_b + own_b * all_a)
    }
}

/// Failures of a call that speak against merging actions of it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FailuresAgainst {
    /// How many.
    pub times: u64,
    /// Some of the places where they were seen.
    pub places: BTreeSet<Witness>,
}

/// Of each call of which actions were not merged, the failures that speak against it.
pub(crate) type Against = BTreeMap<Symbol, FailuresAgainst>;

/// The failures of an evidence, by call.
pub(crate) struct Failures<'e> {
    by_call: BTreeMap<(&'e Symbol, &'e [u32]), Vec<Failure<'e>>>,
}

/// Failures over entities of the same types.
struct Failure<'e> {
    types: Vec<TypeId>,
    seen: &'e Cluster,
}

impl<'e> Failures<'e> {
    pub(crate) fn of(evidence: &'e Observations, hierarchy: &Hierarchy) -> Self {
        let mut by_call: BTreeMap<_, Vec<Failure<'e>>> = BTreeMap::new();
        for (key, seen) in &evidence.negatives {
            // A type that the hierarchy does not have fits no parameter.
            let types = key.types.iter().map(|name| hierarchy.id(name.as_str())).collect::<Option<_>>();
            let Some(types) = types else { continue };
            by_call.entry((&key.action, key.call.as_slice())).or_default().push(Failure { types, seen });
        }
        Self { by_call }
    }

    /// How many of them these actions wrongly allow; one that several allow counts once.
    pub(crate) fn allowed_by(&self, actions: &[Draft], hierarchy: &Hierarchy) -> u64 {
        self.of_calls(actions).map(|(_, failure, actions)| failure.times_allowed(&actions, hierarchy)).sum()
    }

    /// Of each call of these actions, the failures that they wrongly allow, with the smallest places where they were seen.
    pub(crate) fn against(&self, actions: &[Draft], hierarchy: &Hierarchy) -> Against {
        let mut against = Against::new();
        for (call, failure, actions) in self.of_calls(actions) {
            let times = failure.times_allowed(&actions, hierarchy);
            if times > 0 {
                let of_call = against.entry(call.clone()).or_default();
                of_call.times += times;
                of_call.places.extend(failure.seen.witnesses.iter().cloned());
            }
        }
        for of_call in against.values_mut() {
            of_call.places = std::mem::take(&mut of_call.places).into_iter().take(WITNESS_BOUND).collect();
        }
        against
    }

    /// The failures of the calls of these actions, each with the actions of its call.
    fn of_calls<'a>(
        &'a self,
        actions: &'a [Draft],
    ) -> impl Iterator<Item = (&'a Symbol, &'a Failure<'e>, Vec<&'a Draft>)> {
        let mut by_call: BTreeMap<_, Vec<&Draft>> = BTreeMap::new();
        for action in actions {
            by_call.entry((&action.action, action.call.as_slice())).or_default().push(action);
        }
        by_call.into_iter().flat_map(move |(call, actions)| {
            let failures = self.by_call.get(&call).into_iter().flatten();
            failures.map(move |failure| (call.0, failure, actions.clone()))
        })
    }
}

impl Failure<'_> {
    /// In how many the preconditions of one of these actions held. Beyond the bound of pre-states kept apart, the most that
    /// the counts allow to one action in one way.
    fn times_allowed(&self, actions: &[&Draft], hierarchy: &Hierarchy) -> u64 {
        let moved = |atoms: &BTreeSet<LiftedAtom>, way: &[u32]| -> BTreeSet<LiftedAtom> {
            atoms.iter().map(|atom| atom.renamed(way)).collect()
        };
        let mut ways = Vec::new();
        for action in actions {
            let of_action = self.ways(action, hierarchy);
            ways.extend(of_action.iter().map(|way| (moved(&action.preconditions, way), moved(&action.adds, way))));
        }
        match &self.seen.states {
            PreStates::Exact(states) => {
                let allowed = |state: &BTreeSet<LiftedAtom>| {
                    ways.iter().any(|(needs, adds)| needs.is_subset(state) && adds.is_disjoint(state))
                };
                states.iter().filter(|(state, _)| allowed(state)).map(|(_, count)| count).sum()
            }
            counted => ways.iter().map(|(needs, _)| counted.containing(needs).0).max().unwrap_or(0),
        }
    }

    /// The ways to take its entities for the action's parameters, as `way[parameter] = entity`, that respect the call and
    /// the types. The call's arguments come first in both, in their order.
    fn ways(&self, action: &Draft, hierarchy: &Hierarchy) -> Vec<Vec<u32>> {
        let named = action.call.iter().collect::<BTreeSet<_>>().len();
        let fits = |entity: usize, parameter: usize| hierarchy.is_a(self.types[entity], action.types[parameter]);
        if action.types.len() > self.types.len() || !(0..named).all(|i| fits(i, i)) {
            return Vec::new();
        }
        let mut ways: Vec<Vec<u32>> = vec![(0..named as u32).collect()];
        for parameter in named..action.types.len() {
            let longer = |way: &Vec<u32>| {
                let free = (named..self.types.len()).filter(|&e| fits(e, parameter) && !way.contains(&(e as u32)));
                free.map(|entity| [way.as_slice(), &[entity as u32]].concat()).collect::<Vec<_>>()
            };
            ways = ways.iter().flat_map(longer).take(WAYS_BOUND).collect();
        }
        ways
    }
}

/// The score of an action on the observations that it rests on, each under its mapping of parameters, and on the failures
/// of its call.
pub(crate) fn score_action(
    action: &Draft,
    evidence: &Observations,
    failures: &Failures<'_>,
    hierarchy: &Hierarchy,
) -> Score {
    let mut score = Score::default();
    for Support { cluster, map, .. } in &action.support {
        let Some(cluster) = evidence.clusters.get(&**cluster) else { continue };
        let mut back = vec![0; map.len()];
        for (own, &parameter) in map.iter().enumerate() {
            back[parameter as usize] = own as u32;
        }
        let preconditions = action.preconditions.iter().map(|a| a.renamed(&back)).collect();
        let (explained, total) = cluster.states.containing(&preconditions);
        score.explained += explained;
        score.missed += total - explained;
    }
    score.wrongly_allowed = failures.allowed_by(std::slice::from_ref(action), hierarchy);
    score
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn score(explained: u64, missed: u64, wrongly_allowed: u64) -> Score {
        Score { explained, missed, wrongly_allowed }
    }

    #[test]
    fn the_mean_is_compared_exactly() {
        assert!(score(1, 0, 0).at_least_mean_of(score(1, 0, 0), score(1, 0, 0)));
        assert!(score(1, 1, 0).at_least_mean_of(score(1, 2, 0), score(2, 0, 1)));
        assert!(!score(1, 0, 1).at_least_mean_of(score(1, 2, 0), score(3, 1, 0)));
    }

    proptest! {
        /// Nothing missed and nothing wrongly allowed is at least as good as anything.
        #[test]
        fn without_failures_every_merge_is_made(seen in 1..1000_u64, a in 0..1000_u64, b in 0..1000_u64) {
            prop_assert!(score(seen, 0, 0).at_least_mean_of(score(a, 0, 0), score(b, 0, 0)));
        }
    }
}
