//! Lazy best-first search (Richter and Helmert, *Preferred operators and deferred evaluation in satisficing planning*, ICAPS
//! 2009): a state is evaluated when it is expanded, and its successors wait with their predecessor's estimates.
//!
//! Greedy by h alone; weighted by g + w·h, reopening what is reached on a smaller g. With several heuristics the open list
//! alternates between them. Nothing is claimed of the first plan's cost; but if a search ends without a plan below a
//! bound, there is none, provided that the heuristics' dead ends really are dead ends.

use std::sync::Arc;

use typelift_model::{Budget, GroundAtom, Stop};

use super::open_list::Alternation;
use super::{Found, Search, Space};
use crate::fdr::{ActionIndex, Registry, StateId};
use crate::heuristic::{CostMeasure, Heuristic, Reached, Step};
use crate::poll::Poll;
use crate::report::Report;
use crate::shuffle::Shuffler;
use crate::symmetry::UnchangedMembers;

/// What comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Priority {
    /// The smallest h.
    Greedy,
    /// The smallest g + w·h.
    Weighted(u32),
}

/// How states are ranked, and costs measured.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ranking {
    pub(crate) priority: Priority,
    pub(crate) measure: CostMeasure,
}

/// The actions whose successors get an open list of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Preference {
    /// None.
    None,
    /// The applicable actions of relaxed plans.
    Preferred,
    /// All applicable actions that achieve something that these achieve.
    Helpful,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    /// By which action, from which state; the initial state comes from itself.
    parent: StateId,
    action: ActionIndex,
    /// The cost so far as the search measures it, and as the task does.
    g: u64,
    cost: u64,
    is_dead_end: bool,
}

/// A lazy search.
#[derive(Debug)]
pub(crate) struct Lazy {
    space: Arc<Space>,
    priority: Priority,
    preference: Preference,
    heuristics: Vec<Box<dyn Heuristic>>,
    /// Where each heuristic's memory begins, and how long all are.
    memory_starts: Vec<usize>,
    memory_len: usize,
    costs: Vec<u32>,
    registry: Registry,
    nodes: Vec<Node>,
    memories: Vec<u32>,
    open: Alternation<(StateId, ActionIndex)>,
    /// The smallest estimate of each heuristic.
    best: Vec<Option<u32>>,
    closest: (usize, Option<StateId>),
    expansions: u64,
    evaluations: u64,
    reopened: u64,
    improvements: u64,
    values: Vec<u32>,
    before: Vec<u32>,
    memory: Vec<u32>,
    applicable: Vec<ActionIndex>,
    unchanged: UnchangedMembers,
    /// When each action was last preferred.
    preferred: Vec<u64>,
    /// Brings successors into another order.
    shuffler: Option<Shuffler>,
}

impl Lazy {
    pub(crate) fn new(
        space: Arc<Space>,
        ranking: Ranking,
        heuristics: Vec<Box<dyn Heuristic>>,
        preference: Preference,
    ) -> Self {
        let mut memory_len = 0;
        let mut memory_starts = Vec::with_capacity(heuristics.len());
        for heuristic in &heuristics {
            memory_starts.push(memory_len);
            memory_len += heuristic.memory_len();
        }
        let variables = space.task.domains.len();
        Self {
            priority: ranking.priority,
            preference,
            memory_starts,
            memory_len,
            costs: ranking.measure.of(&space.task),
            registry: Registry::new(&space.task.domains),
            nodes: Vec::new(),
            memories: Vec::new(),
            open: Alternation::new(heuristics.len(), preference != Preference::None),
            best: vec![None; heuristics.len()],
            closest: (0, None),
            expansions: 0,
            evaluations: 0,
            reopened: 0,
            improvements: 0,
            values: vec![0; variables],
            before: vec![0; variables],
            memory: vec![0; memory_len],
            applicable: Vec::new(),
            unchanged: UnchangedMembers::default(),
            preferred: vec![0; space.task.action_count()],
            shuffler: None,
            heuristics,
            space,
        }
    }

    /// The same, with successors in another order.
    pub(crate) fn shuffled(self, shuffler: Shuffler) -> Self {
        Self { shuffler: Some(shuffler), ..self }
    }

    fn actions_to(&self, goal: StateId) -> Vec<ActionIndex> {
        let mut actions = Vec::new();
        let mut state = goal;
        loop {
            let node = &self.nodes[state.index()];
            if node.parent == state {
                break;
            }
            actions.push(node.action);
            state = node.parent;
        }
        actions.reverse();
        actions
    }

    /// Estimates `values`, reached by an action from a state, whose values are `before`, if not initial; fills `memory` and
    /// the estimates. False at a dead end.
    fn evaluate(&mut self, space: &Space, by: Option<(StateId, ActionIndex)>, keys: &mut Vec<u32>) -> bool {
        self.evaluations += 1;
        keys.clear();
        let mut progress = false;
        for (i, heuristic) in self.heuristics.iter_mut().enumerate() {
            let own = self.memory_starts[i]..self.memory_starts[i] + heuristic.memory_len();
            let by = by.map(|(parent, action)| {
                let memory = &self.memories[parent.index() * self.memory_len..][own.clone()];
                Step { action, values: &self.before, memory }
            });
            let reached = Reached { values: &self.values, by };
            let Some(h) = heuristic.estimate(&space.task, reached, &mut self.memory[own]) else { return false };
            let preferred = match self.preference {
                Preference::None => &[],
                Preference::Preferred => heuristic.preferred(),
                Preference::Helpful => heuristic.helpful(),
            };
            for &action in preferred {
                self.preferred[action as usize] = self.evaluations;
            }
            if self.best[i].is_none_or(|best| h < best) {
                self.best[i] = Some(h);
                progress = true;
            }
            keys.push(h);
        }
        if progress {
            self.improvements += 1;
            self.open.boost();
        }
        true
    }

    /// Evaluates the state in `values`, and lists its successors.
    fn expand(&mut self, space: &Space, id: StateId, keys: &mut Vec<u32>, cost_bound: Option<u64>) -> bool {
        let node = self.nodes[id.index()];
        let by = (node.parent != id).then_some((node.parent, node.action));
        if !self.evaluate(space, by, keys) {
            self.nodes[id.index()].is_dead_end = true;
            return false;
        }
        self.expansions += 1;
        self.memories[id.index() * self.memory_len..][..self.memory_len].copy_from_slice(&self.memory);
        let held = space.task.goal.iter().filter(|goal| goal.holds(&self.values)).count();
        if self.closest.1.is_none() || held > self.closest.0 {
            self.closest = (held, Some(id));
        }
        space.successors.applicable(&space.task, &self.values, &mut self.applicable);
        self.keep_first(space);
        if let Some(shuffler) = &mut self.shuffler {
            shuffler.shuffle(&mut self.applicable);
        }
        let mut priorities = [0_u64; 4];
        for &action in &self.applicable {
            if cost_bound.is_some_and(|bound| node.cost + u64::from(space.task.actions.costs[action as usize]) >= bound)
            {
                continue;
            }
            let g = node.g + u64::from(self.costs[action as usize]);
            for (priority, &h) in priorities.iter_mut().zip(keys.iter()) {
                *priority = match self.priority {
                    Priority::Greedy => u64::from(h),
                    Priority::Weighted(weight) => g + u64::from(weight) * u64::from(h),
                };
            }
            let preferred = self.preferred[action as usize] == self.evaluations;
            self.open.push(&priorities, preferred, (id, action));
        }
        true
    }

    /// Leaves out applicable actions that are the same as another but for interchangeable objects; if one was preferred, the
    /// other becomes preferred.
    fn keep_first(&mut self, space: &Space) {
        if space.symmetry.is_trivial() {
            return;
        }
        space.symmetry.look_at(&space.task, &self.values, &mut self.unchanged);
        let (preferred, now) = (&mut self.preferred, self.evaluations);
        self.applicable.retain(|&action| {
            let keep = space.symmetry.takes_first(action, &mut self.unchanged);
            if !keep
                && preferred[action as usize] == now
                && let Some(first) = space.symmetry.first_like(action, &mut self.unchanged)
            {
                preferred[first as usize] = now;
            }
            keep
        });
    }

    /// Makes the initial state the first node.
    fn insert_initial_state(&mut self, space: &Space) -> StateId {
        self.values.copy_from_slice(&space.task.init);
        let (id, _) = self.registry.insert(&self.values);
        self.new_node(Node { parent: id, action: 0, g: 0, cost: 0, is_dead_end: false });
        id
    }

    fn new_node(&mut self, node: Node) {
        self.nodes.push(node);
        self.memories.resize(self.nodes.len() * self.memory_len, 0);
    }
}

impl Search for Lazy {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let space = &*Arc::clone(&self.space);
        let limit = budget.expansions.map(|allowed| self.expansions + allowed);
        let mut poll = Poll::new(budget);
        let mut keys = Vec::new();
        if self.nodes.is_empty() {
            let id = self.insert_initial_state(space);
            if space.task.is_goal(&self.values) && cost_bound.is_none_or(|bound| bound > 0) {
                return Found::Plan(space.plan(Vec::new()));
            }
            if limit == Some(0) {
                self.nodes.clear();
                return Found::Stopped(Stop::Expansions);
            }
            self.expand(space, id, &mut keys, cost_bound);
        }
        // Evaluating a state is a look at every relaxed action, at most.
        let work = 1 + space.task.action_count() / 8 + space.task.axioms.len();
        loop {
            if limit.is_some_and(|limit| self.expansions >= limit) {
                return Found::Stopped(Stop::Expansions);
            }
            if let Some(stop) = poll.stopped(work) {
                return Found::Stopped(stop);
            }
            let Some((parent, action)) = self.open.pop() else { return Found::Nothing };
            let from = self.nodes[parent.index()];
            let g = from.g + u64::from(self.costs[action as usize]);
            let cost = from.cost + u64::from(space.task.actions.costs[action as usize]);
            if cost_bound.is_some_and(|bound| cost >= bound) {
                continue;
            }
            self.registry.unpack(parent, &mut self.before);
            self.values.copy_from_slice(&self.before);
            space.task.apply(action, &self.before, &mut self.values);
            let (id, is_new) = self.registry.insert(&self.values);
            let node = Node { parent, action, g, cost, is_dead_end: false };
            if is_new {
                self.new_node(node);
            } else {
                let known = &mut self.nodes[id.index()];
                if self.priority == Priority::Greedy || known.is_dead_end || g >= known.g {
                    continue;
                }
                *known = node;
                self.reopened += 1;
            }
            if space.task.is_goal(&self.values) {
                let actions = self.actions_to(id);
                // A predecessor may have been reached again on another way since.
                let costs = actions.iter().map(|&action| u64::from(space.task.actions.costs[action as usize]));
                if cost_bound.is_none_or(|bound| costs.sum::<u64>() < bound) {
                    return Found::Plan(space.plan(actions));
                }
                continue;
            }
            self.expand(space, id, &mut keys, cost_bound);
        }
    }

    fn report(&self) -> Report {
        Report {
            expansions: self.expansions,
            evaluations: self.evaluations,
            reopened: self.reopened,
            ..Report::default()
        }
    }

    fn improvements(&self) -> u64 {
        self.improvements
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        let Some(closest) = self.closest.1 else { return Vec::new() };
        let mut values = vec![0; self.values.len()];
        self.registry.unpack(closest, &mut values);
        self.space.missing(&values)
    }
}
