//! A*: f = g + h, smaller h first among equal f, then first in first out. The first goal state popped wins; with an
//! admissible heuristic its plan is a cheapest one, else nothing is claimed.
//!
//! A node is a state together with the heuristic's memory. A node reached again on a smaller g is reopened.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::Arc;

use typelift_model::{Budget, GroundAtom, Stop};

use super::{Found, Search, Space};
use crate::fdr::{ActionIndex, Registry, StateId};
use crate::heuristic::{Heuristic, Reached, Step};
use crate::poll::Poll;
use crate::report::Report;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct NodeId(u32);

#[derive(Debug, Clone, Copy)]
struct Node {
    state: StateId,
    g: u64,
    /// The predecessor and the action that led here; none for the initial node.
    came_by: Option<(NodeId, ActionIndex)>,
    /// Another node took its place.
    superseded: bool,
    /// The next node of the same state.
    next: Option<NodeId>,
}

/// A* with one heuristic.
#[derive(Debug)]
pub(crate) struct AStar {
    space: Arc<Space>,
    heuristic: Box<dyn Heuristic>,
    memory_len: usize,
    /// Whether h is never more than the rest costs.
    is_admissible: bool,
    /// What one of h is worth: where it counts steps, as much as the cheapest costs.
    step: u64,
    registry: Registry,
    memories: Vec<u32>,
    nodes: Vec<Node>,
    /// The last node of each state.
    last: Vec<Option<NodeId>>,
    open: BinaryHeap<Reverse<(u64, u32, NodeId)>>,
    /// The most goal facts seen in an expanded state, and that state.
    closest: (usize, Option<StateId>),
    expansions: u64,
    evaluations: u64,
    reopened: u64,
    values: Vec<u32>,
    after: Vec<u32>,
}

impl AStar {
    pub(crate) fn new(space: Arc<Space>, heuristic: Box<dyn Heuristic>, is_admissible: bool) -> Self {
        let variables = space.task.domains.len();
        let cheapest = space.task.actions.costs.iter().copied().min().map_or(1, |cost| u64::from(cost.max(1)));
        Self {
            step: if is_admissible { 1 } else { cheapest },
            memory_len: heuristic.memory_len(),
            registry: Registry::new(&space.task.domains),
            space,
            heuristic,
            is_admissible,
            memories: Vec::new(),
            nodes: Vec::new(),
            last: Vec::new(),
            open: BinaryHeap::new(),
            closest: (0, None),
            expansions: 0,
            evaluations: 0,
            reopened: 0,
            values: vec![0; variables],
            after: vec![0; variables],
        }
    }

    fn memory(&self, node: NodeId) -> &[u32] {
        let at = node.0 as usize * self.memory_len;
        &self.memories[at..at + self.memory_len]
    }

    /// Estimates the state in `after`, and adds a node of it unless an equal one is known that is at least as good.
    fn insert(&mut self, space: &Space, g: u64, came_by: Option<(NodeId, ActionIndex)>) {
        let (state, is_new) = self.registry.insert(&self.after);
        if is_new {
            self.last.push(None);
        }
        // Without a memory nothing has to be estimated to know that a way is no better.
        if self.memory_len == 0 && self.equal(state, &[]).is_some_and(|known| g >= self.node(known).g) {
            return;
        }
        let mut memory = vec![0; self.memory_len];
        let by = came_by.map(|(from, action)| {
            let at = from.0 as usize * self.memory_len;
            Step { action, values: &self.values, memory: &self.memories[at..at + self.memory_len] }
        });
        self.evaluations += 1;
        let Some(h) = self.heuristic.estimate(&space.task, Reached { values: &self.after, by }, &mut memory) else {
            return;
        };
        if let Some(known) = self.equal(state, &memory) {
            if g >= self.node(known).g {
                return;
            }
            self.nodes[known.0 as usize].superseded = true;
            self.reopened += 1;
        }
        let id = NodeId(self.nodes.len() as u32);
        self.memories.extend_from_slice(&memory);
        let next = self.last[state.index()].replace(id);
        self.nodes.push(Node { state, g, came_by, superseded: false, next });
        self.open.push(Reverse((g + u64::from(h) * self.step, h, id)));
    }

    fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// The node of a state and memory, if there is one that no other took the place of.
    fn equal(&self, state: StateId, memory: &[u32]) -> Option<NodeId> {
        let of_state = std::iter::successors(self.last[state.index()], |&id| self.node(id).next);
        let mut standing = of_state.filter(|&id| !self.node(id).superseded);
        standing.find(|&id| self.memory(id) == memory)
    }

    fn note_closest(&mut self, space: &Space, state: StateId) {
        let held = space.task.goal.iter().filter(|goal| goal.holds(&self.values)).count();
        if self.closest.1.is_none() || held > self.closest.0 {
            self.closest = (held, Some(state));
        }
    }

    fn actions_to(&self, goal: NodeId) -> Vec<ActionIndex> {
        let mut actions = Vec::new();
        let mut current = goal;
        while let Some((predecessor, action)) = self.nodes[current.0 as usize].came_by {
            actions.push(action);
            current = predecessor;
        }
        actions.reverse();
        actions
    }
}

impl Search for AStar {
    fn next(&mut self, cost_bound: Option<u64>, budget: &Budget) -> Found {
        let space = &*Arc::clone(&self.space);
        if self.nodes.is_empty() {
            self.after.copy_from_slice(&space.task.init);
            self.insert(space, 0, None);
        }
        let cheapest = space.task.actions.costs.iter().copied().min().map_or(0, u64::from);
        let limit = budget.expansions.map(|allowed| self.expansions + allowed);
        let mut applicable = Vec::new();
        let mut poll = Poll::new(budget);
        while let Some(Reverse((f, _, id))) = self.open.pop() {
            let node = self.nodes[id.0 as usize];
            if node.superseded {
                continue;
            }
            self.registry.unpack(node.state, &mut self.values);
            if space.task.is_goal(&self.values) {
                if cost_bound.is_none_or(|bound| node.g < bound) {
                    return Found::Plan(space.plan(self.actions_to(id)));
                }
                continue;
            }
            let at_least = if self.is_admissible { f } else { node.g + cheapest };
            if cost_bound.is_some_and(|bound| at_least >= bound) {
                continue;
            }
            if limit.is_some_and(|limit| self.expansions >= limit) {
                self.open.push(Reverse((0, 0, id)));
                return Found::Stopped(Stop::Expansions);
            }
            self.expansions += 1;
            self.note_closest(space, node.state);
            space.successors.applicable(&space.task, &self.values, &mut applicable);
            for &action in &applicable {
                // A node that is left half expanded is expanded again: what is known already is not inserted twice.
                let work = 1 + space.task.domains.len() + space.task.axioms.len();
                if let Some(stop) = poll.stopped(work) {
                    self.open.push(Reverse((0, 0, id)));
                    return Found::Stopped(stop);
                }
                self.after.copy_from_slice(&self.values);
                space.task.apply(action, &self.values, &mut self.after);
                let cost = u64::from(space.task.actions.costs[action as usize]);
                self.insert(space, node.g + cost, Some((id, action)));
            }
        }
        Found::Nothing
    }

    fn report(&self) -> Report {
        Report {
            expansions: self.expansions,
            evaluations: self.evaluations,
            reopened: self.reopened,
            ..Report::default()
        }
    }

    fn missing(&self) -> Vec<(GroundAtom, bool)> {
        let Some(closest) = self.closest.1 else { return Vec::new() };
        let mut values = vec![0; self.values.len()];
        self.registry.unpack(closest, &mut values);
        self.space.missing(&values)
    }
}
