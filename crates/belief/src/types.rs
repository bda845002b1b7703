//! Which types a place of a call accepts, as a signed belief over the hierarchy: each type is accepted or not as its parent
//! is, but for a small rate (Kemp, Griffiths, Stromsten and Tenenbaum, *Semi-supervised learning with trees*, NIPS 2003). Two
//! passes of messages, in time linear in the types.
//!
//! Of a type with several parents the one with the fewest types below it counts, ties by name: the most special facet.

use std::collections::BTreeMap;

use typelift_model::{Hierarchy, TypeId};

use crate::CHANCE;

/// How often a type is accepted where its parent is not, or the other way round.
const FLIP: f64 = 0.05;

/// How likely the root is accepted: most things do not fit most places.
const ROOT: f64 = 0.3;

/// The odds of chances that are nearly certain stay finite.
const LEAST: f64 = 1e-12;

/// Evidence about a type: how often it worked, and how much blame it has, in failures.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Seen {
    pub(crate) worked: f64,
    pub(crate) blamed: f64,
}

impl Seen {
    /// How likely the evidence is if the type is rejected, and if it is accepted.
    fn likelihood(self) -> [f64; 2] {
        // Of many of both only by how much there are more of one.
        let fewer = self.worked.min(self.blamed);
        [CHANCE.powf(self.worked - fewer).max(LEAST), CHANCE.powf(self.blamed - fewer).max(LEAST)]
    }
}

/// The chance that each type is accepted.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TypeBelief {
    accepted: BTreeMap<TypeId, f64>,
}

impl TypeBelief {
    /// From what was seen of some types.
    pub(crate) fn new(hierarchy: &Hierarchy, seen: &BTreeMap<TypeId, Seen>) -> Self {
        let types: Vec<TypeId> = hierarchy.types().collect();
        let place: BTreeMap<TypeId, usize> = types.iter().copied().zip(0..).collect();
        let parents = special_parents(hierarchy, &types, &place);
        let mut up: Vec<[f64; 2]> =
            types.iter().map(|ty| seen.get(ty).copied().unwrap_or_default().likelihood()).collect();
        // Ancestors come first, so that the reverse order has every type before its parent.
        let mut sent = vec![[1.0; 2]; types.len()];
        for child in (0..types.len()).rev() {
            up[child] = normal(up[child]);
            sent[child] = through(up[child]);
            if let Some(parent) = parents[child] {
                up[parent] = [up[parent][0] * sent[child][0], up[parent][1] * sent[child][1]];
            }
        }
        let mut both = vec![[0.0; 2]; types.len()];
        for child in 0..types.len() {
            let from_above = match parents[child] {
                None => [1.0 - ROOT, ROOT],
                Some(parent) => {
                    let others: [f64; 2] = both[parent];
                    through(normal([others[0] / sent[child][0], others[1] / sent[child][1]]))
                }
            };
            both[child] = normal([from_above[0] * up[child][0], from_above[1] * up[child][1]]);
        }
        Self { accepted: types.into_iter().zip(both.into_iter().map(|[_, accepted]| accepted)).collect() }
    }

    /// The chance that a type of that hierarchy is accepted; next to none for another.
    pub(crate) fn accepts(&self, ty: TypeId) -> f64 {
        self.accepted.get(&ty).copied().unwrap_or(LEAST)
    }
}

/// Of the parents of each type the one with the fewest types below it.
fn special_parents(hierarchy: &Hierarchy, types: &[TypeId], place: &BTreeMap<TypeId, usize>) -> Vec<Option<usize>> {
    let mut below = vec![1_usize; types.len()];
    for (at, &ty) in types.iter().enumerate().rev() {
        for parent in hierarchy.parents(ty) {
            below[place[parent]] += below[at];
        }
    }
    let special = |ty: &TypeId| {
        let parents = hierarchy.parents(*ty).iter();
        parents.min_by_key(|parent| (below[place[parent]], hierarchy.name(**parent))).map(|parent| place[parent])
    };
    types.iter().map(special).collect()
}

/// A message across the edge between a type and its parent.
fn through([rejected, accepted]: [f64; 2]) -> [f64; 2] {
    [(1.0 - FLIP) * rejected + FLIP * accepted, FLIP * rejected + (1.0 - FLIP) * accepted]
}

fn normal([rejected, accepted]: [f64; 2]) -> [f64; 2] {
    let sum = rejected + accepted;
    [(rejected / sum).max(LEAST), (accepted / sum).max(LEAST)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kitchen() -> Hierarchy {
        let edges = [
            ("food", "object"),
            ("fruit", "food"),
            ("apple", "fruit"),
            ("coconut", "fruit"),
            ("pear", "fruit"),
            ("bread", "food"),
            ("bagel", "bread"),
            ("tool", "object"),
            ("knife", "tool"),
        ];
        Hierarchy::from_edges(edges).expect("a tree")
    }

    /// The chance of each type named, in hundredths, after what worked and what is to blame.
    fn chances(worked: &[&str], blamed: &[&str], asked: &[&str]) -> Vec<u32> {
        let hierarchy = kitchen();
        let id = |name: &&str| hierarchy.id(name).expect("a type");
        let mut seen: BTreeMap<TypeId, Seen> = BTreeMap::new();
        worked.iter().for_each(|name| seen.entry(id(name)).or_default().worked += 1.0);
        blamed.iter().for_each(|name| seen.entry(id(name)).or_default().blamed += 1.0);
        let belief = TypeBelief::new(&hierarchy, &seen);
        asked.iter().map(|name| (100.0 * belief.accepts(id(name))).round() as u32).collect()
    }

    #[test]
    fn what_worked_speaks_for_its_kin_first() {
        let [apple, pear, bagel, knife] = chances(&["apple"], &[], &["apple", "pear", "bagel", "knife"])[..] else {
            panic!("four")
        };
        assert!(apple > pear && pear > bagel && bagel > knife, "{apple} {pear} {bagel} {knife}");
        assert!(pear > 50 && knife < 80);
    }

    #[test]
    fn an_exception_is_no_rule() {
        let [coconut, pear, bagel] = chances(&["apple", "bagel"], &["coconut"], &["coconut", "pear", "bagel"])[..]
        else {
            panic!("three")
        };
        assert!(coconut < 50 && pear > 50 && bagel > 90, "{coconut} {pear} {bagel}");
    }

    #[test]
    fn it_is_the_sum_over_all_labellings() {
        // Every way to accept or reject the ten types, weighed by the flips along the tree and by what was seen.
        let hierarchy = kitchen();
        let types: Vec<TypeId> = hierarchy.types().collect();
        let id = |name: &str| hierarchy.id(name).expect("a type");
        let seen = BTreeMap::from([
            (id("apple"), Seen { worked: 2.0, blamed: 0.0 }),
            (id("coconut"), Seen { worked: 0.0, blamed: 0.7 }),
            (id("knife"), Seen { worked: 0.0, blamed: 1.0 }),
        ]);
        let belief = TypeBelief::new(&hierarchy, &seen);
        let (mut total, mut accepted) = (0.0, vec![0.0; types.len()]);
        for labels in 0_u32..1 << types.len() {
            let label = |at: usize| (labels >> at & 1) as usize;
            let mut weight = 1.0;
            for (at, &ty) in types.iter().enumerate() {
                weight *= match hierarchy.parents(ty).first() {
                    None => [1.0 - ROOT, ROOT][label(at)],
                    Some(parent) => {
                        let parent = types.iter().position(|other| other == parent).expect("listed");
                        if label(parent) == label(at) { 1.0 - FLIP } else { FLIP }
                    }
                };
                weight *= seen.get(&ty).copied().unwrap_or_default().likelihood()[label(at)];
            }
            total += weight;
            (0..types.len()).filter(|&at| label(at) == 1).for_each(|at| accepted[at] += weight);
        }
        for (at, &ty) in types.iter().enumerate() {
            let exact = accepted[at] / total;
            assert!((belief.accepts(ty) - exact).abs() < 1e-9, "{}: {exact}", hierarchy.name(ty));
        }
    }
}
