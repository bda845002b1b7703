//! The second phase of Algorithm 1: pairs of actions with similar effects become one, until nothing changes.
//!
//! Two actions are *mergeable* if they have the same name and a bijection of their parameters maps call onto call
//! and effect onto effect. (The paper asks for the same set of predicates in the effect; a set would put "toast one"
//! beside "toast two".)
//!
//! **Candidate preconditions.** The paper scores the common preconditions together with every subset of the
//! difference. Recall can only fall when a precondition is added: an observation that contains the larger set
//! contains the smaller one. So no candidate has a higher recall than the common preconditions alone, and of equals
//! the one with fewest preconditions, the most general, is kept. The power set need not be enumerated: the
//! intersection is the answer, whatever the preconditions and the observations are. A property test holds this
//! against enumeration. What decides whether the pair is merged at all is failures: see `score.rs`.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{Hierarchy, LiftedAtom, Observations, RefusedMerges, Support, Symbol, TypeId, effect_bijections};

use crate::draft::Draft;
use crate::score::{Against, Failures, score_action};

/// Bijections between two effects that are compared at most; beyond it, the first ones in order.
const BIJECTION_BOUND: usize = 5_040;

/// What mergeable actions agree in: a cheap necessary condition.
type Shape = (Symbol, Vec<u32>, usize, Vec<(bool, Symbol)>);

fn shape(action: &Draft) -> Shape {
    let mut predicates: Vec<(bool, Symbol)> =
        action.signed_effect().into_iter().map(|(sign, atom)| (sign, atom.predicate)).collect();
    predicates.sort_unstable();
    (action.action.clone(), action.call.clone(), action.types.len(), predicates)
}

/// What generalizing counted.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    /// Pairs whose generalization was scored.
    pub(crate) scored: usize,
    /// Pairs that could be merged in the end and are not, since failures speak against it.
    pub(crate) refused: RefusedMerges,
    /// The places of the two of each in the order of all actions.
    pub(crate) pairs: Vec<(usize, usize)>,
    /// What speaks against it.
    pub(crate) against: Against,
}

/// Generalizes pairs until nothing changes.
pub(crate) fn to_fixed_point(
    actions: Vec<Draft>,
    evidence: &Observations,
    hierarchy: &Hierarchy,
) -> (Vec<Draft>, Counts) {
    let mut counts = Counts::default();
    let failures = Failures::of(evidence, hierarchy);
    let mut refused: Vec<Draft> = Vec::new();
    let mut groups: BTreeMap<Shape, Vec<Draft>> = BTreeMap::new();
    for action in actions {
        groups.entry(shape(&action)).or_default().push(action);
    }
    let mut first = 0;
    for group in groups.values_mut() {
        let of_group = loop {
            let search = first_merge(group, evidence, &failures, hierarchy);
            counts.scored += search.scored;
            let Some((i, j, generalized)) = search.merge else { break search.refused };
            group[i] = generalized;
            group.remove(j);
        };
        for (i, j, generalized) in of_group {
            counts.pairs.push((first + i, first + j));
            refused.push(generalized);
        }
        first += group.len();
    }
    counts.refused = RefusedMerges { pairs: refused.len(), failures: failures.allowed_by(&refused, hierarchy) };
    counts.against = failures.against(&refused, hierarchy);
    (groups.into_values().flatten().collect(), counts)
}

/// A look through the pairs of a group.
#[derive(Default)]
struct Search {
    /// The first two to be merged, and what they become.
    merge: Option<(usize, usize, Draft)>,
    /// The pairs before them, and what they would have become.
    refused: Vec<(usize, usize, Draft)>,
    scored: usize,
}

/// The first pair, in order, whose generalization is at least as good as the mean of the two.
fn first_merge(group: &[Draft], evidence: &Observations, failures: &Failures<'_>, hierarchy: &Hierarchy) -> Search {
    let score = |action: &Draft| score_action(action, evidence, failures, hierarchy);
    let mut search = Search::default();
    for (i, left) in group.iter().enumerate() {
        for (j, right) in group.iter().enumerate().skip(i + 1) {
            let Some(correspondence) = corresponding_parameters(left, right, hierarchy) else { continue };
            let types = create_gen_pars(left, right, &correspondence, hierarchy);
            let generalized = create_gen_action(left, right, &correspondence, types);
            search.scored += 1;
            if score(&generalized).at_least_mean_of(score(left), score(right)) {
                search.merge = Some((i, j, generalized));
                return search;
            }
            search.refused.push((i, j, generalized));
        }
    }
    search
}

/// The bijection `map[left] = right` of the parameters; of several the one with most common preconditions, then the
/// deepest common ancestors, then the smallest.
fn corresponding_parameters(left: &Draft, right: &Draft, hierarchy: &Hierarchy) -> Option<Vec<u32>> {
    let mut fixed = vec![None; left.types.len()];
    for (&l, &r) in left.call.iter().zip(&right.call) {
        fixed[l as usize] = Some(r);
    }
    let (effect_l, effect_r) = (left.signed_effect(), right.signed_effect());
    let maps = effect_bijections(&fixed, |_, _| true, &effect_l, &effect_r, BIJECTION_BOUND);
    let common =
        |map: &[u32]| left.preconditions.iter().filter(|a| right.preconditions.contains(&a.renamed(map))).count();
    let depth = |map: &[u32]| {
        create_gen_pars(left, right, map, hierarchy).into_iter().map(|ty| u64::from(hierarchy.depth(ty))).sum::<u64>()
    };
    maps.into_iter().min_by_key(|map| (Reverse(common(map)), Reverse(depth(map)), map.clone()))
}

/// CreateGenPars: the lowest common ancestor of each pair of corresponding parameters.
fn create_gen_pars(left: &Draft, right: &Draft, correspondence: &[u32], hierarchy: &Hierarchy) -> Vec<TypeId> {
    let pairs = left.types.iter().zip(correspondence);
    pairs.map(|(&ty, &other)| hierarchy.lca(ty, right.types[other as usize])).collect()
}

/// CreateGenAction: the action over the generalized parameters, with the best candidate preconditions.
fn create_gen_action(left: &Draft, right: &Draft, correspondence: &[u32], types: Vec<TypeId>) -> Draft {
    let mut to_left = vec![0; correspondence.len()];
    for (l, &r) in correspondence.iter().enumerate() {
        to_left[r as usize] = l as u32;
    }
    let moved = right.preconditions.iter().map(|atom| atom.renamed(&to_left)).collect();
    let mut support = left.support.clone();
    support.extend(right.support.iter().map(|of_right| Support {
        map: of_right.map.iter().map(|&parameter| to_left[parameter as usize]).collect(),
        ..of_right.clone()
    }));
    support.sort_by(|a, b| a.cluster.cmp(&b.cluster));
    Draft { types, preconditions: best_candidate(&left.preconditions, &moved), support, ..left.clone() }
}

/// The best of the candidates `common ∪ subset of the difference`: the common preconditions (see the file's head).
fn best_candidate(left: &BTreeSet<LiftedAtom>, right: &BTreeSet<LiftedAtom>) -> BTreeSet<LiftedAtom> {
    left.intersection(right).cloned().collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use typelift_model::{Cluster, Witness};

    use super::*;
    use crate::draft::extract_preconditions;

    fn atom(i: u8) -> LiftedAtom {
        LiftedAtom::new(format!("p{i}").as_str(), Vec::new())
    }

    fn atoms(bits: u8) -> BTreeSet<LiftedAtom> {
        (0..8).filter(|i| bits >> i & 1 == 1).map(atom).collect()
    }

    /// Every candidate, enumerated as the paper has it; the best by recall, then size, then order.
    fn by_enumeration(left: u8, right: u8, observations: &[u8]) -> u8 {
        let (common, difference) = (left & right, left ^ right);
        let recall = |candidate: u8| observations.iter().filter(|&&o| o & candidate == candidate).count();
        (0..=u8::MAX)
            .filter(|subset| subset & !difference == 0)
            .map(|subset| common | subset)
            .min_by_key(|&candidate| (Reverse(recall(candidate)), candidate.count_ones(), candidate))
            .unwrap_or(common)
    }

    proptest! {
        #[test]
        fn the_intersection_is_the_best_candidate(left: u8, right: u8, observations in prop::collection::vec(any::<u8>(), 0..12)) {
            prop_assert_eq!(best_candidate(&atoms(left), &atoms(right)), atoms(by_enumeration(left, right, &observations)));
        }

        /// Where each side's preconditions are all that its observations have in common, nothing ties with it.
        #[test]
        fn after_extraction_it_is_the_only_best_one(
            left in prop::collection::vec(any::<u8>(), 1..5),
            right in prop::collection::vec(any::<u8>(), 1..5),
        ) {
            let extracted = |states: &[u8]| {
                let mut cluster = Cluster::default();
                states.iter().for_each(|&state| cluster.add(atoms(state), Witness { file: "t".into(), step: 1 }));
                extract_preconditions(&cluster)
            };
            let (pre_l, pre_r) = (extracted(&left), extracted(&right));
            let observations: Vec<BTreeSet<LiftedAtom>> = left.iter().chain(&right).copied().map(atoms).collect();
            let explains_all = |candidate: &BTreeSet<LiftedAtom>| observations.iter().all(|o| candidate.is_subset(o));
            let best = best_candidate(&pre_l, &pre_r);
            prop_assert!(explains_all(&best));
            // A larger candidate explains no more than each candidate between, so one atom more will do.
            for more in pre_l.symmetric_difference(&pre_r) {
                let mut larger = best.clone();
                prop_assert!(larger.insert(more.clone()) && !explains_all(&larger), "{more}");
            }
        }
    }
}
