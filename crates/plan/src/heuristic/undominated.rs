//! The relaxed actions that a heuristic has to look at: an effect is left out where another relaxed action has it at no
//! higher cost from a subset of the preconditions (Helmert, *The Fast Downward planning system*, JAIR 26, 2006).

use typelift_model::{HashMap, Stop};

use crate::fdr::ActionIndex;
use crate::packed_lists::PackedLists;
use crate::poll::Poll;
use crate::relaxation::{Prop, Relaxation};

/// Preconditions of more propositions are compared with equal ones alone.
const MOST_SUBSETS_OF: usize = 5;

/// The relaxed actions that no other dominates.
#[derive(Debug, Default)]
pub(crate) struct Undominated {
    pub(crate) preconditions: PackedLists<Prop>,
    pub(crate) adds: PackedLists<Prop>,
    pub(crate) action: Vec<Option<ActionIndex>>,
    pub(crate) costs: Vec<u32>,
    pub(crate) needed_by: PackedLists<u32>,
}

impl Undominated {
    /// Leaves out dominated relaxed actions, where the actions have these costs.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub(crate) fn of(relaxation: &Relaxation, action_costs: &[u32], poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let cost = |relaxed: usize| relaxation.action[relaxed].map_or(0, |action| action_costs[action as usize]);
        // Each set of preconditions once.
        let mut set_ids: HashMap<&[Prop], u32> = HashMap::default();
        let mut sets: Vec<&[Prop]> = Vec::new();
        let mut set_of: Vec<u32> = Vec::with_capacity(relaxation.action.len());
        for preconditions in relaxation.preconditions.iter() {
            poll.check(1 + preconditions.len())?;
            let id = *set_ids.entry(preconditions).or_insert_with(|| {
                sets.push(preconditions);
                sets.len() as u32 - 1
            });
            set_of.push(id);
        }
        // The cheapest way, and the first of these, from each set to each effect.
        let mut best: HashMap<(u32, Prop), (u32, u32)> = HashMap::default();
        for (relaxed, adds) in relaxation.adds.iter().enumerate() {
            poll.check(1 + adds.len())?;
            let way = (cost(relaxed), relaxed as u32);
            for &prop in adds {
                let known = best.entry((set_of[relaxed], prop)).or_insert(way);
                *known = way.min(*known);
            }
        }
        let mut subsets = PackedLists::default();
        for set in &sets {
            poll.check(1 << set.len().min(MOST_SUBSETS_OF))?;
            subsets.push(known_subsets(set, &set_ids));
        }
        let mut this = Self::default();
        for (relaxed, adds) in relaxation.adds.iter().enumerate() {
            poll.check(1 + adds.len())?;
            let own = (cost(relaxed), relaxed as u32);
            let set = set_of[relaxed];
            let is_best = |prop: &&Prop| {
                best.get(&(set, **prop)) == Some(&own)
                    && !subsets
                        .get(set as usize)
                        .iter()
                        .any(|&subset| best.get(&(subset, **prop)).is_some_and(|way| way.0 <= own.0))
            };
            let left: Vec<Prop> = adds.iter().filter(is_best).copied().collect();
            if left.is_empty() {
                continue;
            }
            this.preconditions.push(relaxation.preconditions.get(relaxed).iter().copied());
            this.adds.push(left);
            this.action.push(relaxation.action[relaxed]);
            this.costs.push(own.0);
        }
        this.needed_by = this.preconditions.inverse(relaxation.len());
        Ok(this)
    }
}

/// The proper subsets of a set that are sets of preconditions as well.
fn known_subsets(set: &[Prop], known: &HashMap<&[Prop], u32>) -> Vec<u32> {
    if set.len() > MOST_SUBSETS_OF {
        return Vec::new();
    }
    let mut subset = [0; MOST_SUBSETS_OF];
    let proper = 0..(1_usize << set.len()) - 1;
    let subsets = proper.filter_map(|chosen| {
        let mut len = 0;
        for (_, &prop) in set.iter().enumerate().filter(|(i, _)| chosen >> i & 1 == 1) {
            subset[len] = prop;
            len += 1;
        }
        known.get(&subset[..len]).copied()
    });
    subsets.collect()
}
