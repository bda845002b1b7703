//! Best-first width search, with landmarks for goals (Lipovetzky and Geffner, *Best-first width search: exploration and
//! exploitation in classical planning*, AAAI 2017, BFWS(f5); the landmarks as in their Dual-BFWS).
//!
//! States that are new come first, and of those the ones with the fewest landmarks to come. New means: among the states with
//! as many landmarks to come, and as much done of the relaxed plan that was made when a landmark was last reached. Relaxed plans
//! are made only then, so that a state costs little; and where estimates lead astray, what is new leads on.
//!
//! Greedy: a state that is reached again is not looked at again. It never drops a state but dead ends, so that where it ends
//! there is no plan.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

use typelift_model::{Budget, GroundAtom, HashMap, Stop};

use super::novelty::{Novelty, SeenFacts};
use super::{Found, Search, Space};
use crate::fdr::{ActionIndex, Registry, StateId, Values};
use crate::heuristic::{Ff, Heuristic, LandmarkCount, Reached, Step};
use crate::poll::Poll;
use crate::report::Report;
use crate::symmetry::UnchangedMembers;

/// The facts of a relaxed plan, each with its place in the bits of a node.
type Facts = HashMap<u32, u32>;

#[derive(Debug, Clone, Copy)]
struct Node {
    /// By which action, from which state; the initial state comes from itself.
    parent: StateId,
    action: ActionIndex,
    cost: u64,
    landmarks: u32,
    /// The relaxed plan that was made last on the way here, where the bits of its facts reached since begin, and how many
    /// those are.
    plan: u32,
    reached_from: u32,
    reached: u32,
}

impl Node {
    /// States are new or not among those of one class.
    fn class(&self) -> u64 {
        u64::from(self.landmarks) << 32 | u64::from(self.reached)
    }
}

/// A best-first width search.
#[derive(Debug)]
pub(crate) struct WidthFirst {
    space: Arc<Space>,
    ff: Ff,
    landmarks: LandmarkCount,
    registry: Registry,
    nodes: Vec<Node>,
    memories: Vec<u32>,
    plans: Vec<Facts>,
    reached: Vec<u64>,
    seen: SeenFacts,
    open: BTreeMap<(Novelty, u32), VecDeque<StateId>>,
    /// The fewest landmarks to come, and where that was.
    closest: Option<(u32, StateId)>,
    report: Report,
    improvements: u64,
    applicable: Vec<ActionIndex>,
    unchanged: UnchangedMembers,
    memory: Vec<u32>,
}

impl WidthFirst {
    pub(crate) fn new(space: Arc<Space>, ff: Ff, landmarks: LandmarkCount) -> Self {
        Self {
            registry: Registry::new(&space.task.domains),
            seen: SeenFacts::new(&space.task),
            memory: vec![0; landmarks.memory_len()],
            space,
            ff,
            landmarks,
            nodes: Vec::new(),
            memories: Vec::new(),
            plans: Vec::new(),
            reached: Vec::new(),
            open: BTreeMap::new(),
            closest: None,
            report: Report::default(),
            improvements: 0,
            applicable: Vec::new(),
            unchanged: UnchangedMembers::default(),
        }
    }

    /// The landmarks to come; fills `memory`.
    fn count(&mut self, space: &Space, values: &Values, by: Option<(StateId, ActionIndex, &Values)>) -> u32 {
        let by = by.map(|(parent, action, values)| {
            let memory = &self.memories[parent.index() * self.memory.len()..][..self.memory.len()];
            Step { action, values, memory }
        });
        self.landmarks.estimate(&space.task, Reached { values, by }, &mut self.memory).unwrap_or(u32::MAX)
    }

    /// Makes the relaxed plan of a state, of which nothing is reached yet. False at a dead end.
    fn make_plan(&mut self, space: &Space, values: &Values, node: &mut Node) -> bool {
        self.report.evaluations += 1;
        if self.ff.estimate(&space.task, Reached { values, by: None }, &mut []).is_none() {
            return false;
        }
        let facts: Facts = self.ff.achieved(&space.task).zip(0..).collect();
        (node.plan, node.reached_from, node.reached) = (self.plans.len() as u32, self.reached.len() as u32, 0);
        self.reached.resize(self.reached.len() + facts.len().div_ceil(64), 0);
        self.plans.push(facts);
        true
    }

    /// Marks what a step reached of the relaxed plan.
    fn follow_plan(&mut self, space: &Space, before: &Values, after: &Values, node: &mut Node) {
        let plan = &self.plans[node.plan as usize];
        let mut is_own = false;
        for place in space.task.gained(before, after).filter_map(|fact| plan.get(&fact)) {
            let (word, bit) = ((place / 64) as usize, 1 << (place % 64));
            let from = node.reached_from as usize;
            if self.reached[from + word] & bit == 0 {
                if !std::mem::replace(&mut is_own, true) {
                    node.reached_from = self.reached.len() as u32;
                    self.reached.extend_from_within(from..from + plan.len().div_ceil(64));
                }
                self.reached[node.reached_from as usize + word] |= bit;
                node.reached += 1;
            }
        }
    }

    /// Keeps a state that was just registered, and lets it wait.
    fn add(&mut self, space: &Space, id: StateId, node: Node, values: &Values, before: Option<&Values>) {
        self.nodes.push(node);
        self.memories.extend_from_slice(&self.memory);
        if self.closest.is_none_or(|(fewest, _)| node.landmarks < fewest) {
            self.closest = Some((node.landmarks, id));
            self.improvements += 1;
        }
        let novelty = self.seen.look_at(&space.task, node.class(), values, before);
        self.open.entry((novelty, node.landmarks)).or_default().push_back(id);
    }

    /// Keeps a dead end, which is not looked at again.
    fn add_dead_end(&mut self, node: Node) {
        self.nodes.push(node);
        self.memories.extend_from_slice(&self.memory);
    }

    fn begin(&mut self, space: &Space) {
        let values = &space.task.init;
        let (id, _) = self.registry.insert(values);
        let landmarks = self.count(space, values, None);
        let mut node = Node { parent: id, action: 0, cost: 0, landmarks, plan: 0, reached_from: 0, reached: 0 };
        if self.make_plan(space, values, &mut node) {
            self.add(space, id, node, values, None);
        } else {
            self.add_dead_end(node);
        }
    }

    fn pop(&mut self) -> Option<StateId> {
        let mut first = self.open.first_entry()?;
        let id = first.get_mut().pop_front();
        if first.get().is_empty() {
            first.remove();
        }
        id
    }

    /// Adds the successors of a state; one of them, if the goal holds there.
    fn expand(&mut self, space: &Space, id: StateId, cost_bound: Option<u64>) -> Option<StateId> {
        self.report.expansions += 1;
        let from = self.nodes[id.index()];
        let mut before = vec![0; space.task.domains.len()];
        self.registry.unpack(id, &mut before);
        let mut after = before.clone();
        let mut applicable = std::mem::take(&mut self.applicable);
        space.successors.applicable(&space.task, &before, &mut applicable);
        if !space.symmetry.is_trivial() {
            space.symmetry.look_at(&space.task, &before, &mut self.unchanged);
            applicable.retain(|&action| space.symmetry.takes_first(action, &mut self.unchanged));
        }
        let goal = applicable.iter().find_map(|&action| {
            let cost = from.cost + u64::from(space.task.actions.costs[action as usize]);
            if cost_bound.is_some_and(|bound| cost >= bound) {
                return None;
            }
            after.copy_from_slice(&before);
            space.task.apply(action, &before, &mut after);
            let (next, is_new) = self.registry.insert(&after);
            if !is_new {
                return None;
            }
            let landmarks = self.count(space, &after, Some((id, action, &before)));
            let mut node = Node { parent: id, action, cost, landmarks, ..from };
            if landmarks >= from.landmarks {
                self.follow_plan(space, &before, &after, &mut node);
            } else if !self.make_plan(space, &after, &mut node) {
                self.add_dead_end(node);
                return None;
            }
            let same_class = node.class() == from.class();
            self.add(space, next, node, &after, same_class.then_some(&before));
            space.task.is_goal(&after).then_some(next)
        });
        self.applicable = applicable;
        goal
    }

    fn actions_to(&self, goal: StateId) -> Vec<ActionIndex> {
        let mut actions = Vec::new();
        let (mut id, mut node) = (goal, &self.nodes[goal.index()]);
        while node.parent != id {
            actions.push(node.action);
            (id, node) = (node.parent, &self.nodes[node.parent.index()]);
        }
        actions.reverse();
        actions
    }
}

impl Search for WidthFirst {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let space = &*Arc::clone(&self.space);
        let limit = budget.expansions.map(|allowed| self.report.expansions + allowed);
        let mut poll = Poll::new(budget);
        if self.nodes.is_empty() {
            if space.task.is_goal(&space.task.init) && cost_bound.is_none_or(|bound| bound > 0) {
                return Found::Plan(space.plan(Vec::new()));
            }
            self.begin(space);
        }
        loop {
            if limit.is_some_and(|limit| self.report.expansions >= limit) {
                return Found::Stopped(Stop::Expansions);
            }
            let Some(id) = self.pop() else { return Found::Nothing };
            if let Some(goal) = self.expand(space, id, cost_bound) {
                return Found::Plan(space.plan(self.actions_to(goal)));
            }
            // A successor is a look at every fact that holds, and at a few landmarks.
            let work = 1 + self.applicable.len() * space.task.domains.len() / 8;
            if let Some(stop) = poll.stopped(work) {
                return Found::Stopped(stop);
            }
        }
    }

    fn report(&self) -> Report {
        self.report
    }

    fn improvements(&self) -> u64 {
        self.improvements
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        let Some((_, closest)) = self.closest else { return Vec::new() };
        let mut values = vec![0; self.space.task.domains.len()];
        self.registry.unpack(closest, &mut values);
        self.space.missing(&values)
    }
}
