//! The FF heuristic (Hoffmann and Nebel, *The FF planning system*, JAIR 14, 2001): the cost of a plan for the delete
//! relaxation, here made of the best supporters by the additive heuristic (Bonet and Geffner 2001; Keyder and Geffner 2008).
//!
//! Not admissible. A state that it calls a dead end is one. Conditional effects are relaxed actions of their own, of which
//! an action in the relaxed plan is paid once; derived facts follow without cost, their negations by what blocks their
//! axioms. Preferred are the actions of the relaxed plan whose preconditions hold.
//!
//! Helpful, as in FF, are all actions that achieve something that the relaxed plan achieves at once, whether or not they are in
//! the plan. Where many actions are equally good (parking), only their numbers decide which of them are in the plan.

use std::sync::Arc;

use super::bucket_queue::BucketQueue;
use super::undominated::Undominated;
use super::{Heuristic, Reached};
use crate::fdr::{ActionIndex, Fdr};
use crate::packed_lists::PackedLists;
use crate::relaxation::{Prop, Relaxation, RelaxedIndex};
use crate::shuffle::Shuffler;

const UNREACHED: u32 = u32::MAX;
const NO_SUPPORTER: RelaxedIndex = RelaxedIndex::MAX;

/// A relaxed action while the costs are computed.
#[derive(Debug, Clone, Copy)]
struct Progress {
    /// Preconditions not reached yet.
    missing: u32,
    /// Its cost and its reached preconditions'.
    cost: u32,
}

/// Relaxed plans.
#[derive(Debug)]
pub(crate) struct Ff {
    relaxation: Arc<Relaxation>,
    relaxed: Arc<Undominated>,
    /// The relaxed actions that need each proposition, in the order in which they are looked at.
    needed_by: PackedLists<RelaxedIndex>,
    /// The cost of each action.
    action_costs: Vec<u32>,
    start: Vec<Progress>,
    progress: Vec<Progress>,
    without_preconditions: Vec<RelaxedIndex>,
    prop_costs: Vec<u32>,
    supporters: Vec<RelaxedIndex>,
    is_goal: Vec<bool>,
    queue: BucketQueue,
    /// When each proposition and action was last seen in a relaxed plan.
    seen_props: Vec<u32>,
    seen_actions: Vec<u32>,
    now: u32,
    stack: Vec<Prop>,
    preferred: Vec<ActionIndex>,
    helpful: Vec<ActionIndex>,
}

impl Ff {
    /// Relaxed plans made of the undominated relaxed actions, where the actions have these costs.
    pub(crate) fn new(relaxation: Arc<Relaxation>, relaxed: Arc<Undominated>, action_costs: Vec<u32>) -> Self {
        let missing = relaxed.preconditions.iter().map(|list| list.len() as u32);
        let start: Vec<Progress> =
            missing.zip(&relaxed.costs).map(|(missing, &cost)| Progress { missing, cost }).collect();
        let mut is_goal = vec![false; relaxation.len()];
        for &goal in &relaxation.goal {
            is_goal[goal as usize] = true;
        }
        Self {
            progress: start.clone(),
            without_preconditions: (0..start.len() as u32).filter(|&i| start[i as usize].missing == 0).collect(),
            start,
            needed_by: relaxed.needed_by.clone(),
            prop_costs: vec![UNREACHED; relaxation.len()],
            supporters: vec![NO_SUPPORTER; relaxation.len()],
            is_goal,
            queue: BucketQueue::default(),
            seen_props: vec![0; relaxation.len()],
            seen_actions: vec![0; action_costs.len()],
            now: 0,
            stack: Vec::new(),
            preferred: Vec::new(),
            helpful: Vec::new(),
            action_costs,
            relaxed,
            relaxation,
        }
    }

    /// The same, with ties between best supporters broken another way.
    pub(crate) fn shuffled(mut self, shuffler: &mut Shuffler) -> Self {
        for prop in 0..self.needed_by.len() {
            shuffler.shuffle(self.needed_by.get_mut(prop));
        }
        self
    }

    fn enqueue(&mut self, prop: Prop, cost: u32, supporter: RelaxedIndex) {
        let known = &mut self.prop_costs[prop as usize];
        if cost < *known {
            *known = cost;
            self.supporters[prop as usize] = supporter;
            self.queue.push(cost, prop);
        }
    }

    /// The additive heuristic's costs, until all goals are reached; whether they are.
    fn explore(&mut self, task: &Fdr, reached: Reached<'_>) -> bool {
        let relaxation = Arc::clone(&self.relaxation);
        self.progress.copy_from_slice(&self.start);
        self.prop_costs.fill(UNREACHED);
        self.queue.clear();
        for prop in relaxation.held(task, reached.values) {
            self.enqueue(prop, 0, NO_SUPPORTER);
        }
        for i in 0..self.without_preconditions.len() {
            let relaxed = self.without_preconditions[i];
            self.achieve(relaxed, self.start[relaxed as usize].cost);
        }
        let mut goals_left = relaxation.goal.len();
        if goals_left == 0 {
            return true;
        }
        while let Some((cost, prop)) = self.queue.pop() {
            if self.prop_costs[prop as usize] < cost {
                continue;
            }
            if self.is_goal[prop as usize] {
                goals_left -= 1;
                if goals_left == 0 {
                    return true;
                }
            }
            for i in self.needed_by.range(prop as usize) {
                let relaxed = self.needed_by.item(i);
                let progress = &mut self.progress[relaxed as usize];
                progress.cost = progress.cost.saturating_add(cost);
                progress.missing -= 1;
                if progress.missing == 0 {
                    let cost = progress.cost.min(UNREACHED - 1);
                    self.achieve(relaxed, cost);
                }
            }
        }
        false
    }

    /// Reaches what a relaxed action adds.
    fn achieve(&mut self, relaxed: RelaxedIndex, cost: u32) {
        for i in self.relaxed.adds.range(relaxed as usize) {
            self.enqueue(self.relaxed.adds.item(i), cost, relaxed);
        }
    }

    /// The cost of the relaxed plan that the supporters make.
    fn relaxed_plan(&mut self) -> u32 {
        self.now += 1;
        let mut total: u32 = 0;
        self.stack.extend_from_slice(&self.relaxation.goal);
        while let Some(prop) = self.stack.pop() {
            if std::mem::replace(&mut self.seen_props[prop as usize], self.now) == self.now {
                continue;
            }
            let supporter = self.supporters[prop as usize];
            if supporter == NO_SUPPORTER {
                continue;
            }
            let supporter = supporter as usize;
            self.stack.extend_from_slice(self.relaxed.preconditions.get(supporter));
            let Some(action) = self.relaxed.action[supporter] else { continue };
            if self.progress[supporter].cost == self.relaxed.costs[supporter] {
                self.preferred.push(action);
                self.add_helpful(prop);
            }
            if std::mem::replace(&mut self.seen_actions[action as usize], self.now) != self.now {
                total = total.saturating_add(self.action_costs[action as usize]).min(UNREACHED - 1);
            }
        }
        total
    }
}

impl Ff {
    /// The facts that the last relaxed plan makes true, by their dense numbers.
    pub(crate) fn achieved<'a>(&'a self, task: &'a Fdr) -> impl Iterator<Item = u32> + 'a {
        let marks = self.seen_props.iter().zip(&self.supporters).zip(0..);
        let made = marks.filter(|&((&seen, &supporter), _)| seen == self.now && supporter != NO_SUPPORTER);
        let literals = made.filter_map(|(_, prop)| self.relaxation.literal(task, prop));
        literals.filter(|&(_, wanted)| wanted).map(|(fact, _)| task.number(fact))
    }

    /// The actions that achieve a proposition at once.
    fn add_helpful(&mut self, prop: Prop) {
        for &relaxed in self.relaxation.achievers.get(prop as usize) {
            let mut preconditions = self.relaxation.preconditions.get(relaxed as usize).iter();
            if preconditions.all(|&needed| self.prop_costs[needed as usize] == 0) {
                self.helpful.extend(self.relaxation.action[relaxed as usize]);
            }
        }
    }
}

impl Heuristic for Ff {
    fn estimate(&mut self, task: &Fdr, reached: Reached<'_>, _memory: &mut [u32]) -> Option<u32> {
        self.preferred.clear();
        self.helpful.clear();
        self.explore(task, reached).then(|| self.relaxed_plan())
    }

    fn preferred(&self) -> &[ActionIndex] {
        &self.preferred
    }

    fn helpful(&self) -> &[ActionIndex] {
        &self.helpful
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heuristic::CostMeasure;
    use crate::poll::Poll;
    use crate::worked::Worked;
    use typelift_model::Budget;

    fn ff(worked: &Worked) -> Ff {
        let costs = CostMeasure::Plain.of(&worked.fdr);
        let no_limit = Budget::unlimited();
        let undominated = Undominated::of(&worked.relaxation, &costs, &mut Poll::new(&no_limit)).expect("no limits");
        Ff::new(Arc::clone(&worked.relaxation), Arc::new(undominated), costs)
    }

    #[test]
    fn what_two_goals_share_is_paid_once() {
        // The additive heuristic's costs: c by get 3, a by make-a 3 + 1 = 4, b by make-b 3 + 2 = 5 rather than by buy-b, 6.
        // Those supporters together are the relaxed plan: get, make-a, make-b, which cost 3 + 1 + 2.
        let worked = Worked::new(
            "init: p
             goal: a b
             get cost 3: p -> c !p
             get-dear cost 4: p -> c !p
             make-a: c -> a !c
             make-b cost 2: c -> b !c
             buy-b cost 6: p -> b !p",
        );
        let mut ff = ff(&worked);
        assert_eq!(worked.estimate(&mut ff, "p"), Some(6));
        // Of the relaxed plan only get can be done at once, and get-dear achieves the same at once. Buying b does not count,
        // although b is needed: the relaxed plan does not achieve b at once.
        assert_eq!(worked.names(ff.preferred()), ["get"]);
        assert_eq!(worked.names(ff.helpful()), ["get", "get-dear"]);
        // With c there both are made of it, for 1 + 2; with a there too only b is left, for 2.
        assert_eq!(worked.estimate(&mut ff, "c"), Some(3));
        assert_eq!(worked.names(ff.preferred()), ["make-a", "make-b"]);
        assert_eq!(worked.estimate(&mut ff, "a c"), Some(2));
        assert_eq!(worked.names(ff.preferred()), ["make-b"]);
        assert_eq!(worked.estimate(&mut ff, "a b"), Some(0));
        // Nothing makes p or c.
        assert_eq!(worked.estimate(&mut ff, "a"), None);
    }

    #[test]
    fn an_action_with_two_conditional_effects_is_paid_once() {
        // Painting has two relaxed actions, one for each effect, but is one action of cost 4. What must not hold is made
        // false by drying, for 1.
        let worked = Worked::new(
            "init: wall door wet
             goal: red green !wet
             paint cost 4: -> wall=>red door=>green
             dry: wet -> !wet",
        );
        assert_eq!(worked.estimate(&mut ff(&worked), "wall door wet"), Some(4 + 1));
        assert_eq!(worked.estimate(&mut ff(&worked), "wall door red green wet"), Some(1));
    }
}
