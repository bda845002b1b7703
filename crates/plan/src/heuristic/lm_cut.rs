//! The LM-cut heuristic (Helmert and Domshlak, *Landmarks, critical paths and abstractions*, ICAPS 2009): disjunctive action
//! landmarks from cuts in the justification graph of h^max, each paid once.
//!
//! Admissible, also with conditional effects and derived predicates: an effect with a condition is a relaxed action of its
//! own, but all of one action's share its cost, so that a cut through one of them pays for all. A state that it calls a dead
//! end is one. Where we differ from the article: nothing but that.

use std::sync::Arc;

use super::bucket_queue::BucketQueue;
use super::{CostMeasure, Heuristic, Reached};
use crate::fdr::{ActionIndex, Fdr};
use crate::packed_lists::PackedLists;
use crate::relaxation::{Prop, Relaxation, RelaxedIndex};

const UNREACHED: u32 = u32::MAX;

/// Where a proposition lies in the justification graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Zone {
    Unknown,
    /// Reached from the state before the cut.
    Before,
    /// The goal is reached from it without cost.
    Goal,
}

/// Cuts.
#[derive(Debug)]
pub(crate) struct LmCut {
    relaxation: Arc<Relaxation>,
    /// The relaxed actions, in which each needs something, and last one without cost that needs the goal.
    preconditions: PackedLists<Prop>,
    adds: PackedLists<Prop>,
    needed_by: PackedLists<RelaxedIndex>,
    achievers: PackedLists<RelaxedIndex>,
    action: Vec<Option<ActionIndex>>,
    parts: PackedLists<RelaxedIndex>,
    /// Holds always.
    nothing: Prop,
    goal: Prop,
    action_costs: Vec<u32>,
    /// What is left of each action's cost.
    left: Vec<u32>,
    missing: Vec<u32>,
    /// The dearest precondition of each relaxed action.
    supporter: Vec<Prop>,
    prop_costs: Vec<u32>,
    zones: Vec<Zone>,
    queue: BucketQueue,
}

impl LmCut {
    pub(crate) fn new(task: &Fdr, relaxation: Arc<Relaxation>) -> Self {
        let (nothing, goal) = (relaxation.len() as Prop, relaxation.len() as Prop + 1);
        let (mut preconditions, mut adds) = (PackedLists::default(), PackedLists::default());
        let or_nothing = |list: &[Prop]| if list.is_empty() { vec![nothing] } else { list.to_vec() };
        for (needed, added) in relaxation.preconditions.iter().zip(relaxation.adds.iter()) {
            preconditions.push(or_nothing(needed));
            adds.push(added.iter().copied());
        }
        preconditions.push(or_nothing(&relaxation.goal));
        adds.push([goal]);
        let mut action = relaxation.action.clone();
        action.push(None);
        let props = goal as usize + 1;
        let pairs = action.iter().zip(0..).filter_map(|(action, relaxed)| action.map(|action| (action, relaxed)));
        let parts = PackedLists::from_pairs(task.action_count(), pairs);
        let action_costs = CostMeasure::Plain.of(task);
        Self {
            needed_by: preconditions.inverse(props),
            achievers: adds.inverse(props),
            left: action_costs.clone(),
            missing: vec![0; action.len()],
            supporter: vec![nothing; action.len()],
            prop_costs: vec![UNREACHED; props],
            zones: vec![Zone::Unknown; props],
            queue: BucketQueue::default(),
            relaxation,
            preconditions,
            adds,
            action,
            parts,
            nothing,
            goal,
            action_costs,
        }
    }

    fn cost(&self, relaxed: RelaxedIndex) -> u32 {
        self.action[relaxed as usize].map_or(0, |action| self.left[action as usize])
    }

    fn enqueue(&mut self, prop: Prop, cost: u32) {
        let known = &mut self.prop_costs[prop as usize];
        if cost < *known {
            *known = cost;
            self.queue.push(cost, prop);
        }
    }

    fn enqueue_effects(&mut self, relaxed: RelaxedIndex) {
        let cost = self.prop_costs[self.supporter[relaxed as usize] as usize].saturating_add(self.cost(relaxed));
        for i in 0..self.adds.get(relaxed as usize).len() {
            self.enqueue(self.adds.get(relaxed as usize)[i], cost.min(UNREACHED - 1));
        }
    }

    /// h^max of every proposition.
    fn explore(&mut self, task: &Fdr, reached: Reached<'_>) {
        self.prop_costs.fill(UNREACHED);
        for (missing, list) in self.missing.iter_mut().zip(self.preconditions.iter()) {
            *missing = list.len() as u32;
        }
        self.queue.clear();
        self.enqueue(self.nothing, 0);
        let relaxation = Arc::clone(&self.relaxation);
        for prop in relaxation.held(task, reached.values) {
            self.enqueue(prop, 0);
        }
        while let Some((cost, prop)) = self.queue.pop() {
            if self.prop_costs[prop as usize] < cost {
                continue;
            }
            for i in 0..self.needed_by.get(prop as usize).len() {
                let relaxed = self.needed_by.get(prop as usize)[i];
                self.missing[relaxed as usize] -= 1;
                if self.missing[relaxed as usize] == 0 {
                    // The last to be reached is the dearest.
                    self.supporter[relaxed as usize] = prop;
                    self.enqueue_effects(relaxed);
                }
            }
        }
    }

    /// Lowers h^max after these actions have become cheaper.
    fn explore_again(&mut self, cheaper: &[ActionIndex]) {
        self.queue.clear();
        for &action in cheaper {
            for i in 0..self.parts.get(action as usize).len() {
                let relaxed = self.parts.get(action as usize)[i];
                if self.missing[relaxed as usize] == 0 {
                    self.enqueue_effects(relaxed);
                }
            }
        }
        while let Some((cost, prop)) = self.queue.pop() {
            if self.prop_costs[prop as usize] < cost {
                continue;
            }
            for i in 0..self.needed_by.get(prop as usize).len() {
                let relaxed = self.needed_by.get(prop as usize)[i];
                if self.missing[relaxed as usize] > 0 || self.supporter[relaxed as usize] != prop {
                    continue;
                }
                let costs = &self.prop_costs;
                let dearest = self.preconditions.get(relaxed as usize).iter().max_by_key(|&&p| costs[p as usize]);
                self.supporter[relaxed as usize] = dearest.copied().unwrap_or(prop);
                self.enqueue_effects(relaxed);
            }
        }
    }

    /// Marks the propositions from which the goal is reached without cost.
    fn mark_goal_zone(&mut self) {
        self.zones.fill(Zone::Unknown);
        self.zones[self.goal as usize] = Zone::Goal;
        let mut stack = vec![self.goal];
        while let Some(prop) = stack.pop() {
            for &relaxed in self.achievers.get(prop as usize) {
                if self.missing[relaxed as usize] == 0 && self.cost(relaxed) == 0 {
                    let supporter = self.supporter[relaxed as usize];
                    if std::mem::replace(&mut self.zones[supporter as usize], Zone::Goal) != Zone::Goal {
                        stack.push(supporter);
                    }
                }
            }
        }
    }

    /// The actions that lead from what the state reaches into the goal zone.
    fn cut(&mut self, task: &Fdr, reached: Reached<'_>) -> Vec<ActionIndex> {
        let mut stack: Vec<Prop> = self.relaxation.held(task, reached.values).chain([self.nothing]).collect();
        for &prop in &stack {
            self.zones[prop as usize] = Zone::Before;
        }
        let mut cut = Vec::new();
        while let Some(prop) = stack.pop() {
            for &relaxed in self.needed_by.get(prop as usize) {
                if self.missing[relaxed as usize] > 0 || self.supporter[relaxed as usize] != prop {
                    continue;
                }
                let adds = self.adds.get(relaxed as usize);
                if adds.iter().any(|&added| self.zones[added as usize] == Zone::Goal) {
                    cut.extend(self.action[relaxed as usize]);
                }
                for &added in adds {
                    if self.zones[added as usize] == Zone::Unknown {
                        self.zones[added as usize] = Zone::Before;
                        stack.push(added);
                    }
                }
            }
        }
        cut.sort_unstable();
        cut.dedup();
        cut
    }
}

impl Heuristic for LmCut {
    fn estimate(&mut self, task: &Fdr, reached: Reached<'_>, _memory: &mut [u32]) -> Option<u32> {
        self.left.copy_from_slice(&self.action_costs);
        self.explore(task, reached);
        let mut total: u32 = 0;
        while self.prop_costs[self.goal as usize] > 0 {
            if self.prop_costs[self.goal as usize] == UNREACHED {
                return None;
            }
            self.mark_goal_zone();
            let cut = self.cut(task, reached);
            let Some(cheapest) = cut.iter().map(|&action| self.left[action as usize]).min() else { break };
            for &action in &cut {
                self.left[action as usize] -= cheapest;
            }
            total = total.saturating_add(cheapest);
            self.explore_again(&cut);
        }
        Some(total)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worked::Worked;

    fn lm_cut(worked: &Worked) -> LmCut {
        LmCut::new(&worked.fdr, Arc::clone(&worked.relaxation))
    }

    #[test]
    fn three_cuts_by_hand() {
        // h^max of i 0, a 4, b 3, c 3, d 3 + 2 = 5, g 5.
        // 1. The last action's dearest precondition is d. Only red leads to it: 2, and red is free.
        // 2. Now d is 3 and a 4, so that a is the dearest. Blue and green lead to it: 4, and green has 1 left.
        // 3. Now a and b are free, c costs green's 1 and so do d and g. Green, 1, and black, 3, lead to c: 1.
        // Then the goal is free. 2 + 4 + 1; a cheapest relaxed plan, blue, black and red, costs 9.
        let worked = Worked::new(
            "init: i
             goal: g
             blue cost 4: i -> a b
             green cost 5: i -> a c
             black cost 3: i -> b c
             red cost 2: b c -> d
             last cost 0: a d -> g",
        );
        let mut lm_cut = lm_cut(&worked);
        assert_eq!(worked.estimate(&mut lm_cut, "i"), Some(7));
        // With a and b there: red, 2, then green or black for c, 3.
        assert_eq!(worked.estimate(&mut lm_cut, "i a b"), Some(5));
        assert_eq!(worked.estimate(&mut lm_cut, "i a d"), Some(0));
    }

    #[test]
    fn a_cut_through_one_part_of_an_action_pays_for_all_of_it() {
        // One painting does both: were each effect's part paid for itself, it would be 8, more than a plan costs.
        let worked = Worked::new(
            "init: wall door
             goal: red green
             paint cost 4: -> wall=>red door=>green",
        );
        assert_eq!(worked.estimate(&mut lm_cut(&worked), "wall door"), Some(4));
        assert_eq!(worked.estimate(&mut lm_cut(&worked), "wall door red"), Some(4));
    }

    #[test]
    fn a_dead_end_is_one() {
        let worked = Worked::new(
            "init: a
             goal: b
             do: a -> b !a
             drop: a -> c !a",
        );
        assert_eq!(worked.estimate(&mut lm_cut(&worked), "a"), Some(1));
        assert_eq!(worked.estimate(&mut lm_cut(&worked), "c"), None);
    }
}
