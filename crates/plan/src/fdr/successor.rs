//! The applicable actions of a state, found by a decision tree over the variables' values (Helmert, *The Fast Downward
//! planning system*, JAIR 26, 2006, section 5.3.1), without testing every action.

use super::{ActionIndex, Assignment, Fdr, Values};

/// The place of a node; none where nothing follows.
type NodeIndex = Option<u32>;

#[derive(Debug)]
enum Choice {
    /// The node of each value.
    Table(Box<[NodeIndex]>),
    /// The nodes of the values that have one, sorted.
    Few(Box<[(u32, u32)]>),
}

#[derive(Debug)]
enum Node {
    /// A single action, of which not everything is decided.
    Test(ActionIndex),
    /// Actions whose preconditions hold.
    Here(Box<[ActionIndex]>),
    /// A variable that some action asks for, and what is left for the others.
    Ask { variable: u32, choice: Choice, otherwise: NodeIndex },
}

/// Finds applicable actions.
#[derive(Debug)]
pub(crate) struct SuccessorGenerator {
    nodes: Vec<Node>,
    root: NodeIndex,
}

impl SuccessorGenerator {
    pub(crate) fn new(task: &Fdr) -> Self {
        let mut this = Self { nodes: Vec::new(), root: None };
        let preconditions = &task.actions.preconditions;
        let mut actions: Vec<ActionIndex> = (0..task.action_count() as u32).collect();
        actions.sort_by(|&a, &b| preconditions.get(a as usize).cmp(preconditions.get(b as usize)).then(a.cmp(&b)));
        this.root = this.build(task, &actions, 0);
        this
    }

    /// The node for actions that are sorted by their preconditions, of which the first `depth` are decided.
    fn build(&mut self, task: &Fdr, actions: &[ActionIndex], depth: usize) -> NodeIndex {
        let open = |action: ActionIndex| task.actions.preconditions.get(action as usize).get(depth).copied();
        let decided = actions.iter().take_while(|&&action| open(action).is_none()).count();
        let (here, mut actions) = actions.split_at(decided);
        if let ([], [only]) = (here, actions) {
            return self.push(Node::Test(*only));
        }
        let mut chain: Vec<(u32, Choice)> = Vec::new();
        while let Some(Assignment { variable, .. }) = actions.first().and_then(|&action| open(action)) {
            let size = actions.partition_point(|&action| open(action).is_some_and(|a| a.variable == variable));
            let (mut asking, rest) = actions.split_at(size);
            actions = rest;
            let mut few = Vec::new();
            while let Some(Assignment { value, .. }) = asking.first().and_then(|&action| open(action)) {
                let size = asking.partition_point(|&action| open(action).is_some_and(|a| a.value == value));
                let (same, rest) = asking.split_at(size);
                asking = rest;
                if let Some(node) = self.build(task, same, depth + 1) {
                    few.push((value, node));
                }
            }
            chain.push((variable, choice(few, task.domains[variable as usize])));
        }
        let mut node = if here.is_empty() { None } else { self.push(Node::Here(here.into())) };
        while let Some((variable, choice)) = chain.pop() {
            node = self.push(Node::Ask { variable, choice, otherwise: node });
        }
        node
    }

    fn push(&mut self, node: Node) -> NodeIndex {
        self.nodes.push(node);
        Some(self.nodes.len() as u32 - 1)
    }

    /// The actions applicable in a state, in the order in which they are tried.
    pub(crate) fn applicable(&self, task: &Fdr, values: &Values, into: &mut Vec<ActionIndex>) {
        into.clear();
        self.collect(task, self.root, values, into);
        into.retain(|&action| !task.actions.negative.get(action as usize).iter().any(|a| a.holds(values)));
        into.sort_unstable();
    }

    fn collect(&self, task: &Fdr, mut node: NodeIndex, values: &Values, into: &mut Vec<ActionIndex>) {
        while let Some(index) = node {
            node = match &self.nodes[index as usize] {
                Node::Test(action) => {
                    if task.actions.preconditions.get(*action as usize).iter().all(|a| a.holds(values)) {
                        into.push(*action);
                    }
                    None
                }
                Node::Here(actions) => {
                    into.extend_from_slice(actions);
                    None
                }
                Node::Ask { variable, choice, otherwise } => {
                    let child = choice.of(values[*variable as usize]);
                    match (child, *otherwise) {
                        (Some(_), Some(_)) => {
                            self.collect(task, child, values, into);
                            *otherwise
                        }
                        (child, otherwise) => child.or(otherwise),
                    }
                }
            };
        }
    }
}

impl Choice {
    fn of(&self, value: u32) -> NodeIndex {
        match self {
            Self::Table(nodes) => nodes[value as usize],
            Self::Few(nodes) => nodes.binary_search_by_key(&value, |node| node.0).ok().map(|place| nodes[place].1),
        }
    }
}

fn choice(few: Vec<(u32, u32)>, domain: u32) -> Choice {
    if few.len() < 4 || few.len() * 4 < domain as usize {
        return Choice::Few(few.into());
    }
    let mut table = vec![None; domain as usize];
    for (value, node) in few {
        table[value as usize] = Some(node);
    }
    Choice::Table(table.into())
}
