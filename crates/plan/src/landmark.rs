//! Landmarks with orders, in one sequence per goal object.
//!
//! A fact is a landmark of a goal if every delete-relaxed plan for the goal makes it true (Hoffmann, Porteous,
//! Sebastia 2004). The sets are the greatest fixpoint of `LM(f) = {f} ∪ ⋂ over achievers a of f, ⋃ over
//! preconditions p of a, LM(p)`, with `LM(f) = {f}` for initial facts (Zhu and Givan 2003), computed by propagation.
//!
//! The paper clusters landmarks by the objects of the goal. A *goal object* is one with a unary goal atom; its
//! sequence holds the landmarks, of all goal atoms that mention it, which mention it and do not hold initially. An
//! atom that mentions several goal objects joins the sequence of the first. Any other goal atom gets a sequence of
//! its own. Orders: A comes before B if it must: naturally (A is a landmark of B), or since B would foreclose it (each
//! achiever of A needs a fact that every achiever of B deletes and nothing adds again). Else if it is reasonable:
//! every achiever of B destroys something that A needs and that does not hold initially, and not the other way round.
//! Cycles and ties by the size of the landmark sets, then by name. Finally a landmark that is needed again is inserted again: before each L, what all achievers of L
//! need and every achiever of some landmark since has destroyed.

use std::collections::{BTreeSet, VecDeque};

use typelift_model::{GroundAtom, Symbol};

use crate::fact::FactId;
use crate::ground::{GroundTask, Op, OpId};

/// Landmarks in the order in which they are to be passed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LandmarkSequence {
    /// The goal object, if the sequence belongs to one.
    pub object: Option<Symbol>,
    /// The facts, with repetitions.
    pub facts: Vec<FactId>,
}

/// The landmark sequences of a task whose goals are all reachable, by goal object, then by other goal atom.
pub fn landmark_sequences(task: &GroundTask) -> Vec<LandmarkSequence> {
    let landmarks = LandmarkSets::of(task);
    let mut sequences = Vec::new();
    for (object, goals) in clusters(task) {
        let objects: BTreeSet<&Symbol> = match &object {
            Some(object) => BTreeSet::from([object]),
            None => goals.iter().flat_map(|goal| &goal.args).collect(),
        };
        let mut facts: BTreeSet<FactId> = BTreeSet::new();
        for goal in &goals {
            let Some(fact) = task.goal().iter().copied().find(|&fact| task.atom(fact) == *goal) else { continue };
            facts.extend(landmarks.of_fact(fact).iter().copied().filter(|&landmark| {
                !landmarks.initial[landmark.index()]
                    && (landmark == fact || task.atom(landmark).args.iter().any(|arg| objects.contains(arg)))
            }));
        }
        let ordered = landmarks.ordered(&facts.into_iter().collect::<Vec<_>>());
        let facts = landmarks.with_repetitions(&ordered);
        sequences.push(LandmarkSequence { object, facts });
    }
    sequences
}

/// The goal's atoms by goal object; atoms that mention none stand alone, after them.
fn clusters(task: &GroundTask) -> Vec<(Option<Symbol>, Vec<GroundAtom>)> {
    let objects: BTreeSet<&Symbol> =
        task.goal_atoms().iter().filter(|atom| atom.arity() == 1).map(|atom| &atom.args[0]).collect();
    let owner = |atom: &GroundAtom| atom.args.iter().find(|arg| objects.contains(arg)).cloned();
    let mut clusters: Vec<(Option<Symbol>, Vec<GroundAtom>)> =
        objects.iter().map(|&object| (Some(object.clone()), Vec::new())).collect();
    for atom in task.goal_atoms() {
        match owner(atom) {
            Some(object) => {
                if let Some(cluster) = clusters.iter_mut().find(|(o, _)| o.as_ref() == Some(&object)) {
                    cluster.1.push(atom.clone());
                }
            }
            None => clusters.push((None, vec![atom.clone()])),
        }
    }
    clusters
}

struct LandmarkSets<'a> {
    task: &'a GroundTask,
    initial: Vec<bool>,
    achievers: Vec<Vec<OpId>>,
    /// The landmarks of each fact, sorted; `None` while nothing is known, which stands for all facts.
    sets: Vec<Option<Vec<FactId>>>,
}

impl<'a> LandmarkSets<'a> {
    fn of(task: &'a GroundTask) -> Self {
        let n = task.fact_count();
        let mut this = Self { task, initial: vec![false; n], achievers: vec![Vec::new(); n], sets: vec![None; n] };
        for &fact in task.init() {
            this.initial[fact.index()] = true;
            this.sets[fact.index()] = Some(vec![fact]);
        }
        // Which actions must be looked at again when the set of a fact changes.
        let mut users: Vec<Vec<OpId>> = vec![Vec::new(); n];
        for (id, op) in task.ops() {
            for (fact, condition) in added(op) {
                if this.achievers[fact.index()].last() != Some(&id) {
                    this.achievers[fact.index()].push(id);
                }
                for used in op.preconditions.iter().chain(condition) {
                    if users[used.index()].last() != Some(&id) {
                        users[used.index()].push(id);
                    }
                }
            }
        }
        let mut queued = vec![true; task.op_count()];
        let mut queue: VecDeque<OpId> = task.ops().map(|(id, _)| id).collect();
        while let Some(id) = queue.pop_front() {
            queued[id.index()] = false;
            for fact in this.propagate(task.op(id)) {
                for &user in &users[fact.index()] {
                    if !std::mem::replace(&mut queued[user.index()], true) {
                        queue.push_back(user);
                    }
                }
            }
        }
        this
    }

    /// What all of an action's preconditions need, together; `None` while one is unknown.
    fn needed<'b>(&self, facts: impl Iterator<Item = &'b FactId>) -> Option<BTreeSet<FactId>> {
        let mut union = BTreeSet::new();
        for fact in facts {
            union.extend(self.sets[fact.index()].as_ref()?);
        }
        Some(union)
    }

    /// Narrows the sets of the facts that an action adds; the facts whose sets changed.
    fn propagate(&mut self, op: &Op) -> Vec<FactId> {
        let mut changed = Vec::new();
        let Some(base) = self.needed(op.preconditions.iter()) else { return changed };
        for (fact, condition) in added(op) {
            if self.initial[fact.index()] {
                continue;
            }
            let Some(mut union) = self.needed(condition.iter()) else { continue };
            union.extend(&base);
            union.insert(fact);
            let narrowed: Vec<FactId> = match &self.sets[fact.index()] {
                None => union.into_iter().collect(),
                Some(known) => known.iter().copied().filter(|f| union.contains(f)).collect(),
            };
            if self.sets[fact.index()].as_ref() != Some(&narrowed) {
                self.sets[fact.index()] = Some(narrowed);
                changed.push(fact);
            }
        }
        changed
    }

    fn of_fact(&self, fact: FactId) -> &[FactId] {
        self.sets[fact.index()].as_deref().unwrap_or_default()
    }

    fn every_achiever(&self, fact: FactId, test: impl Fn(&Op) -> bool) -> bool {
        self.achievers[fact.index()].iter().all(|&id| test(self.task.op(id)))
    }

    /// Whether every achiever of `b` destroys something that `a` needs.
    fn destroyed_by_achieving(&self, a: FactId, b: FactId) -> bool {
        let needs = self.of_fact(a);
        self.every_achiever(b, |op| {
            op.deletes.iter().any(|fact| *fact != a && !self.initial[fact.index()] && needs.binary_search(fact).is_ok())
        })
    }

    /// Whether `a` cannot be achieved any more once `b` is: each achiever of `a` needs a fact that every achiever of
    /// `b` deletes and nothing ever adds.
    fn foreclosed_by_achieving(&self, a: FactId, b: FactId) -> bool {
        let lost_for_good = |fact: FactId| {
            self.achievers[fact.index()].is_empty()
                && self.every_achiever(b, |op| op.deletes.binary_search(&fact).is_ok())
        };
        self.every_achiever(a, |op| op.preconditions.iter().any(|&fact| lost_for_good(fact)))
    }

    fn ordered(&self, facts: &[FactId]) -> Vec<FactId> {
        // What forecloses each other has to be achieved at once: neither comes before the other.
        let must = |a: FactId, b: FactId| {
            self.of_fact(b).binary_search(&a).is_ok()
                || self.foreclosed_by_achieving(a, b) && !self.foreclosed_by_achieving(b, a)
        };
        let before = |a: FactId, b: FactId| {
            must(a, b) || !must(b, a) && self.destroyed_by_achieving(a, b) && !self.destroyed_by_achieving(b, a)
        };
        let mut left: Vec<(usize, GroundAtom, FactId)> =
            facts.iter().map(|&fact| (self.of_fact(fact).len(), self.task.atom(fact), fact)).collect();
        left.sort_unstable();
        let mut ordered = Vec::with_capacity(left.len());
        while !left.is_empty() {
            let free = left.iter().position(|(_, _, b)| left.iter().all(|(_, _, a)| a == b || !before(*a, *b)));
            ordered.push(left.remove(free.unwrap_or(0)).2);
        }
        ordered
    }

    fn with_repetitions(&self, ordered: &[FactId]) -> Vec<FactId> {
        let mut sequence: Vec<FactId> = Vec::with_capacity(ordered.len());
        for (i, &landmark) in ordered.iter().enumerate() {
            for &needed in &ordered[..i] {
                let Some(last) = sequence.iter().rposition(|&f| f == needed) else { continue };
                let destroyed = sequence[last + 1..].iter().any(|&since| {
                    since != needed && self.every_achiever(since, |op| op.deletes.binary_search(&needed).is_ok())
                });
                if destroyed && self.every_achiever(landmark, |op| op.preconditions.binary_search(&needed).is_ok()) {
                    sequence.push(needed);
                }
            }
            sequence.push(landmark);
        }
        sequence
    }
}

/// What an action can add, each fact with the facts that its condition needs.
fn added(op: &Op) -> impl Iterator<Item = (FactId, &[FactId])> {
    let always = op.adds.iter().map(|&fact| (fact, &[][..]));
    always.chain(op.conditional.iter().filter(|e| e.adds).map(|e| (e.fact, e.positive.as_slice())))
}
