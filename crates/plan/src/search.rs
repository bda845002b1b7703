//! A*: f = g + h, smaller h first among equal f, then first in first out. The first goal state popped wins; nothing
//! is claimed about optimality, since the heuristic is not admissible.
//!
//! A node is a packed state together with the heuristic's memory. A node reached again on a smaller g is reopened.
//! The search can be continued for further plans: of each node up to `paths` ways that differ in their multiset of
//! actions are kept (with one, this is the plain search), and a plan is new if its multiset of actions is.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hash::{BuildHasher, Hash};

use typelift_model::{Budget, HashMap, HashSet, Plan, Stop};

use crate::ground::{GroundTask, OpId};
use crate::heuristic::Heuristic;
use crate::poll::Poll;
use crate::successor::{applicable, apply, initial, is_goal, words};

/// How a search ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// With a plan.
    Solved(Plan),
    /// All that the model allows was searched, and nothing cut off: there is no plan.
    Unsolvable,
    /// All that was kept was searched: there is no further plan among it.
    NoMorePlans,
    /// The expansions allowed are used up.
    GaveUp,
    /// The time allowed is used up.
    OutOfTime,
    /// The bytes allowed are used up.
    OutOfMemory,
    /// Somebody asked it to stop.
    Cancelled,
}

impl From<Stop> for Outcome {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Time => Self::OutOfTime,
            Stop::Cancelled => Self::Cancelled,
        }
    }
}

/// What grounding and search counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Report {
    /// Ground actions.
    pub ground_actions: u64,
    /// Facts.
    pub facts: u64,
    /// Nodes expanded.
    pub expansions: u64,
    /// Nodes evaluated by the heuristic.
    pub evaluations: u64,
    /// Nodes opened again, having been reached on a smaller g.
    pub reopened: u64,
    /// Bytes held by the search's nodes and tables, by its own count.
    pub bytes: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct NodeId(u32);

#[derive(Debug, Clone, Copy)]
struct Node {
    g: u64,
    /// The predecessor and the action that led here; none for the initial node.
    came_by: Option<(NodeId, OpId)>,
    /// A commutative hash of the multiset of actions on the way here.
    actions: u64,
    /// Another node took its place.
    superseded: bool,
    /// The next node with the same hash of state and memory.
    next: Option<NodeId>,
}

/// A search that can be continued.
#[derive(Debug)]
pub(crate) struct Search {
    heuristic: Box<dyn Heuristic>,
    words: usize,
    memory_len: usize,
    paths: usize,
    states: Vec<u64>,
    memories: Vec<u32>,
    nodes: Vec<Node>,
    by_hash: HashMap<u64, NodeId>,
    open: BinaryHeap<Reverse<(u64, u32, NodeId)>>,
    found: HashSet<u64>,
    /// Only plans cheaper than this are wanted.
    pub(crate) cost_bound: Option<u64>,
    cheapest_op: u64,
    /// The most goal facts seen in an expanded state, and the node that has them.
    closest: (usize, NodeId),
    pub(crate) report: Report,
    started: bool,
}

impl Search {
    pub(crate) fn new(task: &GroundTask, heuristic: Box<dyn Heuristic>, paths: usize) -> Self {
        Self {
            words: words(task.fact_count()),
            memory_len: heuristic.memory_len(),
            heuristic,
            paths: paths.max(1),
            states: Vec::new(),
            memories: Vec::new(),
            nodes: Vec::new(),
            by_hash: HashMap::default(),
            open: BinaryHeap::new(),
            found: HashSet::default(),
            cost_bound: None,
            cheapest_op: task.ops().map(|(_, op)| u64::from(op.cost)).min().unwrap_or(0),
            closest: (0, NodeId(0)),
            report: Report {
                ground_actions: task.op_count() as u64,
                facts: task.fact_count() as u64,
                ..Report::default()
            },
            started: false,
        }
    }

    fn state(&self, node: NodeId) -> &[u64] {
        let at = node.0 as usize * self.words;
        &self.states[at..at + self.words]
    }

    fn memory(&self, node: NodeId) -> &[u32] {
        let at = node.0 as usize * self.memory_len;
        &self.memories[at..at + self.memory_len]
    }

    /// Searches on until a plan that was not found before.
    pub(crate) fn next(&mut self, task: &GroundTask, budget: &Budget) -> Outcome {
        if !self.started {
            self.started = true;
            let state = initial(task);
            let mut memory = vec![0; self.memory_len];
            let h = self.heuristic.initial(&state, &mut memory);
            self.report.evaluations += 1;
            self.insert(&state, &memory, h, 0, None, 0);
        }
        let limit = budget.expansions.map(|allowed| self.report.expansions + allowed);
        let (mut state, mut after) = (vec![0; self.words], vec![0; self.words]);
        let (mut parent_memory, mut memory) = (vec![0; self.memory_len], vec![0; self.memory_len]);
        let mut ops = Vec::new();
        let mut poll = Poll::new(budget);
        while let Some(Reverse((_, _, id))) = self.open.pop() {
            let node = self.nodes[id.0 as usize];
            if node.superseded {
                continue;
            }
            state.copy_from_slice(self.state(id));
            if is_goal(task, &state) {
                let cheap_enough = self.cost_bound.is_none_or(|bound| node.g < bound);
                if cheap_enough && self.found.insert(node.actions) {
                    return Outcome::Solved(self.plan(task, id));
                }
                continue;
            }
            if self.cost_bound.is_some_and(|bound| node.g + self.cheapest_op >= bound) {
                continue;
            }
            if limit.is_some_and(|limit| self.report.expansions >= limit) {
                self.open.push(Reverse((0, 0, id)));
                return Outcome::GaveUp;
            }
            // Looking for the applicable actions is work as well.
            if let Some(stop) = poll.stopped(1 + task.op_count()) {
                self.open.push(Reverse((0, 0, id)));
                return stop.into();
            }
            self.report.expansions += 1;
            self.note_closest(task, &state, id);
            parent_memory.copy_from_slice(self.memory(id));
            applicable(task, &state, &mut ops);
            for &op_id in &ops {
                // A node that is left half expanded is expanded again: what is known already is not inserted twice.
                if budget.bytes.is_some_and(|limit| self.report.bytes > limit) {
                    self.open.push(Reverse((0, 0, id)));
                    return Outcome::OutOfMemory;
                }
                if let Some(stop) = poll.stopped(1 + self.words + task.axiom_count()) {
                    self.open.push(Reverse((0, 0, id)));
                    return stop.into();
                }
                let op = task.op(op_id);
                after.copy_from_slice(&state);
                apply(task, op, &state, &mut after);
                let h = self.heuristic.successor(&parent_memory, op, &after, &mut memory);
                self.report.evaluations += 1;
                let actions = node.actions.wrapping_add(spread(op_id.index() as u64 + 1));
                self.insert(&after, &memory, h, node.g + u64::from(op.cost), Some((id, op_id)), actions);
            }
        }
        if self.found.is_empty() && self.cost_bound.is_none() { Outcome::Unsolvable } else { Outcome::NoMorePlans }
    }

    fn note_closest(&mut self, task: &GroundTask, state: &[u64], id: NodeId) {
        let held = task.goal().iter().filter(|&&fact| crate::successor::holds(state, fact)).count();
        if held > self.closest.0 {
            self.closest = (held, id);
        }
    }

    /// The state expanded so far in which most goal facts held.
    pub(crate) fn closest_state(&self) -> Option<&[u64]> {
        (!self.nodes.is_empty()).then(|| self.state(self.closest.1))
    }

    /// Adds a node unless enough equal ones are known that are at least as good.
    fn insert(&mut self, state: &[u64], memory: &[u32], h: u32, g: u64, came_by: Option<(NodeId, OpId)>, actions: u64) {
        let hash = hash_of(&(state, memory));
        let (mut same_way, mut worst, mut known) = (None, None::<(u64, NodeId)>, 0);
        let mut next = self.by_hash.get(&hash).copied();
        while let Some(id) = next {
            let node = &self.nodes[id.0 as usize];
            next = node.next;
            if node.superseded || self.state(id) != state || self.memory(id) != memory {
                continue;
            }
            known += 1;
            if node.actions == actions {
                same_way = Some((node.g, id));
            }
            if worst.is_none_or(|(g, _)| node.g > g) {
                worst = Some((node.g, id));
            }
        }
        let rival = same_way.or(worst.filter(|_| known >= self.paths));
        if let Some((known_g, id)) = rival {
            if g >= known_g {
                return;
            }
            self.nodes[id.0 as usize].superseded = true;
            self.report.reopened += 1;
        }
        let id = NodeId(self.nodes.len() as u32);
        self.states.extend_from_slice(state);
        self.memories.extend_from_slice(memory);
        let next = self.by_hash.insert(hash, id);
        self.nodes.push(Node { g, came_by, actions, superseded: false, next });
        self.open.push(Reverse((g + u64::from(h), h, id)));
        // A node with its share of the hash table and the open list.
        self.report.bytes += (self.words * 8 + self.memory_len * 4 + std::mem::size_of::<Node>() + 48) as u64;
    }

    fn plan(&self, task: &GroundTask, goal: NodeId) -> Plan {
        let mut steps = Vec::new();
        let mut current = goal;
        while let Some((predecessor, op)) = self.nodes[current.0 as usize].came_by {
            steps.push(task.step(op));
            current = predecessor;
        }
        steps.reverse();
        Plan { steps }
    }
}

fn hash_of(value: &impl Hash) -> u64 {
    rustc_hash::FxBuildHasher.hash_one(value)
}

/// A number with its bits spread (SplitMix64's finalizer), so that sums of different multisets differ.
fn spread(number: u64) -> u64 {
    let mut bits = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
