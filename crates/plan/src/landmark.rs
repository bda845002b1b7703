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

use typelift_model::{Budget, GroundAtom, Symbol};

use crate::fact::FactId;
use crate::ground::{GroundTask, Op, OpId};
use crate::poll::Poll;
use crate::reach::Cut;

/// Landmarks in the order in which they are to be passed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LandmarkSequence {
    /// The goal object, if the sequence belongs to one.
    pub object: Option<Symbol>,
    /// The facts, with repetitions.
    pub facts: Vec<FactId>,
}

/// The landmark sequences of a task whose goals are all reachable, by goal object, then by other goal atom.
///
/// # Errors
/// [`Cut`] if the budget ends it.
pub fn landmark_sequences(task: &GroundTask, budget: &Budget) -> Result<Vec<LandmarkSequence>, Cut> {
    let mut poll = Poll::new(budget);
    let landmarks = LandmarkSets::of(task, &mut poll)?;
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
        let ordered = landmarks.ordered(&facts.into_iter().collect::<Vec<_>>(), &mut poll)?;
        let facts = landmarks.with_repetitions(&ordered, &mut poll)?;
        sequences.push(LandmarkSequence { object, facts });
    }
    Ok(sequences)
}

/// Two goal facts that cannot hold together: one does not hold initially, and everything that achieves it deletes the
/// other, which nothing adds again; or each is deleted by everything that achieves the other, and neither holds initially.
///
/// # Errors
/// [`Cut`] if the budget ends it.
pub(crate) fn exclusive_goals(task: &GroundTask, budget: &Budget) -> Result<Option<(FactId, FactId)>, Cut> {
    let mut poll = Poll::new(budget);
    let goal = task.goal();
    let mut achievers: Vec<Vec<&Op>> = vec![Vec::new(); goal.len()];
    for (_, op) in task.ops_and_axioms() {
        poll.check(1 + op.adds.len() + op.conditional.len())?;
        for (fact, _) in added(op) {
            if let Ok(place) = goal.binary_search(&fact) {
                achievers[place].push(op);
            }
        }
    }
    let initial: Vec<bool> = goal.iter().map(|fact| task.init().contains(fact)).collect();
    let destroys = |achieved: usize, other: usize| {
        achievers[achieved].iter().all(|op| op.deletes.binary_search(&goal[other]).is_ok())
    };
    let exclude = |a: usize, b: usize| {
        let gone_for_good = achievers[b].is_empty();
        a != b && !initial[a] && destroys(a, b) && (gone_for_good || !initial[b] && destroys(b, a))
    };
    for (a, b) in (0..goal.len()).flat_map(|a| (0..goal.len()).map(move |b| (a, b))) {
        poll.check(1 + achievers[a].len())?;
        if exclude(a, b) {
            return Ok(Some((goal[a], goal[b])));
        }
    }
    Ok(None)
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
    fn of(task: &'a GroundTask, poll: &mut Poll<'_>) -> Result<Self, Cut> {
        let n = task.fact_count();
        let mut this = Self { task, initial: vec![false; n], achievers: vec![Vec::new(); n], sets: vec![None; n] };
        for &fact in task.init() {
            this.initial[fact.index()] = true;
            this.sets[fact.index()] = Some(vec![fact]);
        }
        // Which actions must be looked at again when the set of a fact changes.
        let mut users: Vec<Vec<OpId>> = vec![Vec::new(); n];
        for (id, op) in task.ops_and_axioms() {
            poll.check(1 + op.preconditions.len() * (op.adds.len() + op.conditional.len()))?;
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
        let mut queue: VecDeque<OpId> = task.ops_and_axioms().map(|(id, _)| id).collect();
        let mut queued = vec![true; queue.len()];
        while let Some(id) = queue.pop_front() {
            queued[id.index()] = false;
            let (changed, work) = this.propagate(task.op(id));
            poll.check(1 + work)?;
            for fact in changed {
                for &user in &users[fact.index()] {
                    if !std::mem::replace(&mut queued[user.index()], true) {
                        queue.push_back(user);
                    }
                }
            }
        }
        Ok(this)
    }

    /// What all of an action's preconditions need, together; `None` while one is unknown.
    fn needed<'b>(&self, facts: impl Iterator<Item = &'b FactId>) -> Option<BTreeSet<FactId>> {
        let mut union = BTreeSet::new();
        for fact in facts {
            union.extend(self.sets[fact.index()].as_ref()?);
        }
        Some(union)
    }

    /// Narrows the sets of the facts that an action adds; the facts whose sets changed, and how much work it was.
    fn propagate(&mut self, op: &Op) -> (Vec<FactId>, usize) {
        let (mut changed, mut work) = (Vec::new(), op.preconditions.len());
        let Some(base) = self.needed(op.preconditions.iter()) else { return (changed, work) };
        work += base.len();
        for (fact, condition) in added(op) {
            if self.initial[fact.index()] {
                continue;
            }
            let Some(mut union) = self.needed(condition.iter()) else { continue };
            union.extend(&base);
            union.insert(fact);
            work += union.len();
            let narrowed: Vec<FactId> = match &self.sets[fact.index()] {
                None => union.into_iter().collect(),
                Some(known) => known.iter().copied().filter(|f| union.contains(f)).collect(),
            };
            if self.sets[fact.index()].as_ref() != Some(&narrowed) {
                self.sets[fact.index()] = Some(narrowed);
                changed.push(fact);
            }
        }
        (changed, work)
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

    /// What every achiever of a fact has in a list, sorted.
    fn common(&self, fact: FactId, list: impl Fn(&Op) -> &[FactId]) -> Vec<FactId> {
        let mut achievers = self.achievers[fact.index()].iter().map(|&id| list(self.task.op(id)));
        let Some(first) = achievers.next() else { return Vec::new() };
        achievers.fold(first.to_vec(), |mut common, other| {
            common.retain(|fact| other.binary_search(fact).is_ok());
            common
        })
    }

    /// Whether `a` cannot be achieved any more once the facts `lost` are lost: each achiever of `a` needs one of them.
    fn foreclosed(&self, a: FactId, lost: &[FactId]) -> bool {
        !lost.is_empty()
            && self.every_achiever(a, |op| op.preconditions.iter().any(|fact| lost.binary_search(fact).is_ok()))
    }

    fn ordered(&self, facts: &[FactId], poll: &mut Poll<'_>) -> Result<Vec<FactId>, Cut> {
        let mut sorted: Vec<(usize, GroundAtom, FactId)> =
            facts.iter().map(|&fact| (self.of_fact(fact).len(), self.task.atom(fact), fact)).collect();
        sorted.sort_unstable();
        let facts: Vec<FactId> = sorted.into_iter().map(|(_, _, fact)| fact).collect();
        // What achieving each fact deletes and nothing ever adds again.
        let lost: Vec<Vec<FactId>> = facts
            .iter()
            .map(|&fact| {
                let mut deleted = self.common(fact, |op| &op.deletes);
                deleted.retain(|fact| self.achievers[fact.index()].is_empty());
                deleted
            })
            .collect();
        // What forecloses each other has to be achieved at once: neither comes before the other.
        let must = |a: usize, b: usize| {
            self.of_fact(facts[b]).binary_search(&facts[a]).is_ok()
                || self.foreclosed(facts[a], &lost[b]) && !self.foreclosed(facts[b], &lost[a])
        };
        let before = |a: usize, b: usize| {
            must(a, b)
                || !must(b, a)
                    && self.destroyed_by_achieving(facts[a], facts[b])
                    && !self.destroyed_by_achieving(facts[b], facts[a])
        };
        let n = facts.len();
        let mut waits_for = vec![0_usize; n];
        let mut followers: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (a, b) in (0..n).flat_map(|a| (0..n).map(move |b| (a, b))).filter(|(a, b)| a != b) {
            poll.check(1 + self.achievers[facts[a].index()].len() + self.achievers[facts[b].index()].len())?;
            if before(a, b) {
                waits_for[b] += 1;
                followers[a].push(b);
            }
        }
        let mut left: Vec<usize> = (0..n).collect();
        let mut ordered = Vec::with_capacity(n);
        while !left.is_empty() {
            let next = left.remove(left.iter().position(|&fact| waits_for[fact] == 0).unwrap_or(0));
            for &follower in &followers[next] {
                waits_for[follower] -= 1;
            }
            ordered.push(facts[next]);
        }
        Ok(ordered)
    }

    fn with_repetitions(&self, ordered: &[FactId], poll: &mut Poll<'_>) -> Result<Vec<FactId>, Cut> {
        let mut sequence: Vec<FactId> = Vec::with_capacity(ordered.len());
        // Whether each landmark was destroyed, by what every achiever of a later one deletes, since its last place.
        let mut destroyed = vec![false; ordered.len()];
        for (i, &landmark) in ordered.iter().enumerate() {
            poll.check(1 + i * self.achievers[landmark.index()].len())?;
            let needed = self.common(landmark, |op| &op.preconditions);
            let mut insert = |place: usize, fact: FactId, destroyed: &mut Vec<bool>| {
                let deleted = self.common(fact, |op| &op.deletes);
                for (j, earlier) in ordered[..i].iter().enumerate() {
                    destroyed[j] |= *earlier != fact && deleted.binary_search(earlier).is_ok();
                }
                destroyed[place] = false;
                sequence.push(fact);
            };
            for (j, &earlier) in ordered[..i].iter().enumerate() {
                if destroyed[j] && needed.binary_search(&earlier).is_ok() {
                    insert(j, earlier, &mut destroyed);
                }
            }
            insert(i, landmark, &mut destroyed);
        }
        Ok(sequence)
    }
}

/// What an action can add, each fact with the facts that its condition needs.
fn added(op: &Op) -> impl Iterator<Item = (FactId, &[FactId])> {
    let always = op.adds.iter().map(|&fact| (fact, &[][..]));
    always.chain(op.conditional.iter().filter(|e| e.adds).map(|e| (e.fact, e.positive.as_slice())))
}
