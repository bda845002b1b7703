//! ScoreAction (Algorithm 1, lines 12 and 13): recall on the observations that an action rests on.

use std::collections::BTreeSet;

use typelift_model::{Evidence, LiftedAtom, Support};

/// Recall: of `total` positive observations, `hits` have a pre-state that contains the preconditions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Recall {
    pub(crate) hits: u64,
    pub(crate) total: u64,
}

impl Recall {
    /// Whether this is at least the mean of two others; exact.
    pub(crate) fn at_least_mean_of(self, a: Self, b: Self) -> bool {
        let [hits, total] = [self.hits, self.total.max(1)].map(u128::from);
        let [hits_a, total_a, hits_b, total_b] = [a.hits, a.total.max(1), b.hits, b.total.max(1)].map(u128::from);
        2 * hits * total_a * total_b >= total * (hits_a * total_b + hits_b * total_a)
    }
}

/// The recall of `preconditions` on the observations of clusters, each under its mapping of parameters.
pub(crate) fn score_action(preconditions: &BTreeSet<LiftedAtom>, support: &[Support], evidence: &Evidence) -> Recall {
    let mut recall = Recall { hits: 0, total: 0 };
    for Support { cluster, map, .. } in support {
        let Some(cluster) = evidence.clusters.get(&**cluster) else { continue };
        let mut back = vec![0; map.len()];
        for (own, &parameter) in map.iter().enumerate() {
            back[parameter as usize] = own as u32;
        }
        let (hits, total) = cluster.states.containing(&preconditions.iter().map(|a| a.renamed(&back)).collect());
        recall.hits += hits;
        recall.total += total;
    }
    recall
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_compared_exactly() {
        let r = |hits, total| Recall { hits, total };
        assert!(r(1, 1).at_least_mean_of(r(1, 1), r(1, 1)));
        assert!(r(1, 2).at_least_mean_of(r(1, 3), r(2, 3)));
        assert!(!r(1, 2).at_least_mean_of(r(1, 3), r(3, 4)));
    }
}
