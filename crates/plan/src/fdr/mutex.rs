//! Mutex groups: sets of facts of which at most one holds in any reachable state.
//!
//! Monotonicity invariants after Helmert (2009, section 5): a candidate is a set of atoms with some arguments fixed (its
//! parameters) and at most one counted, as `at(p, *), in(p, *)`; for given parameters it is a mutex group if it holds at
//! most once initially and no action makes more of it true than it makes false. What makes a candidate fail suggests
//! atoms to add: those that the offending action consumes. Where we differ: candidates are lifted, but balance is looked
//! at ground action by ground action. So what can never happen does not count, and for some parameters a candidate may
//! be a group while for others it is none.
//!
//! The export to other planners looks for invariants too, among schemas alone (`pddl/src/export/exclusive.rs`). The two
//! share an idea, but no step: there is nothing ground there, and here nothing lifted is left.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use typelift_model::{HashMap, Stop};

use crate::fact::{FactId, ObjectId};
use crate::ground::GroundTask;
use crate::op::{Op, OpId};
use crate::packed_lists::PackedLists;
use crate::poll::Poll;

/// How many candidates are looked at.
const MOST_CANDIDATES: usize = 300;

/// How much work goes into candidates beyond the first look at each predicate.
const MOST_WORK: usize = 100_000_000;

/// Mutex groups of a task.
#[derive(Debug, Default)]
pub(crate) struct MutexGroups {
    groups: Vec<Vec<FactId>>,
    /// The groups of each fact.
    of_fact: PackedLists<u32>,
}

impl MutexGroups {
    pub(crate) fn of(task: &GroundTask, changing: &[bool], poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let groups = Finder::new(task, changing, poll)?.run(poll)?;
        let pairs =
            groups.iter().zip(0..).flat_map(|(group, g)| group.iter().map(move |fact| (fact.index() as u32, g)));
        let of_fact = PackedLists::from_pairs(task.fact_count(), pairs);
        Ok(Self { groups, of_fact })
    }

    /// The groups of a fact, by number.
    pub(crate) fn groups_of(&self, fact: FactId) -> &[u32] {
        self.of_fact.get(fact.index())
    }

    /// Two of these facts that never hold together.
    pub(crate) fn excluded_pair(&self, facts: &[FactId]) -> Option<(FactId, FactId)> {
        let mut in_group: HashMap<u32, FactId> = HashMap::default();
        for &fact in facts {
            for &group in self.groups_of(fact) {
                let other = *in_group.entry(group).or_insert(fact);
                if other != fact {
                    return Some((other, fact));
                }
            }
        }
        None
    }

    /// Whether these two never hold together.
    pub(crate) fn exclude(&self, one: FactId, other: FactId) -> bool {
        one != other && self.groups_of(one).iter().any(|group| self.groups_of(other).contains(group))
    }

    /// The facts among `negative` that may hold where all of `positive` do. That the others do not hold goes without saying.
    pub(crate) fn compatible(&self, negative: &[FactId], positive: &[FactId]) -> Vec<FactId> {
        let excluded = |fact: FactId| positive.iter().any(|&other| self.exclude(fact, other));
        negative.iter().copied().filter(|&fact| !excluded(fact)).collect()
    }

    /// Each fact that is marked in one group; the largest groups first, and what is left alone last.
    pub(crate) fn partition(&self, marked: &[bool]) -> Vec<Vec<FactId>> {
        let mut left = marked.to_vec();
        let mut heap: BinaryHeap<(usize, Reverse<usize>)> =
            self.groups.iter().enumerate().map(|(i, group)| (group.len(), Reverse(i))).collect();
        let mut parts = Vec::new();
        while let Some((size, Reverse(i))) = heap.pop() {
            let rest: Vec<FactId> = self.groups[i].iter().copied().filter(|fact| left[fact.index()]).collect();
            if rest.len() < 2 {
                continue;
            }
            if rest.len() < size {
                heap.push((rest.len(), Reverse(i)));
                continue;
            }
            for fact in &rest {
                left[fact.index()] = false;
            }
            parts.push(rest);
        }
        let alone = left.iter().enumerate().filter(|(_, left)| **left).map(|(index, _)| vec![FactId::new(index)]);
        parts.extend(alone);
        parts
    }
}

/// The atoms of one predicate that a candidate speaks of.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Part {
    predicate: u32,
    /// The position of each of the candidate's parameters.
    positions: Vec<usize>,
    /// The position that is counted, if there is one.
    counted: Option<usize>,
}

impl Part {
    fn parameters(&self, args: &[ObjectId]) -> Vec<ObjectId> {
        self.positions.iter().map(|&position| args[position]).collect()
    }
}

/// A set of atoms of which, for given parameters, at most one may hold.
type Candidate = Vec<Part>;

/// One way in which an action makes a fact true that may not have been true before.
#[derive(Debug, Clone, Copy)]
struct Production {
    op: u32,
    fact: FactId,
}

struct Finder<'a> {
    task: &'a GroundTask,
    productions: Vec<Production>,
    /// What each production certainly makes false.
    consumed: PackedLists<FactId>,
    /// The facts that can change and are not derived, by predicate.
    by_predicate: HashMap<u32, Vec<FactId>>,
    initially: Vec<FactId>,
}

const NO_INSTANCE: u32 = u32::MAX;

impl<'a> Finder<'a> {
    fn new(task: &'a GroundTask, changing: &[bool], poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let mut by_predicate: HashMap<u32, Vec<FactId>> = HashMap::default();
        let facts = task.reached_facts().filter(|fact| changing[fact.index()] && !task.derives(*fact));
        for fact in facts {
            by_predicate.entry(task.facts().predicate(fact)).or_default().push(fact);
        }
        let initially = task.init().iter().copied().filter(|fact| changing[fact.index()]).collect();
        let mut this =
            Self { task, productions: Vec::new(), consumed: PackedLists::default(), by_predicate, initially };
        for ((_, op), number) in task.ops().zip(0..) {
            poll.check(1 + op.preconditions.len() + op.adds.len() + op.conditional.len())?;
            this.add_productions(op, number);
        }
        Ok(this)
    }

    fn add_productions(&mut self, op: &Op, number: u32) {
        let added_somehow = |fact: &FactId| {
            op.adds.binary_search(fact).is_ok() || op.conditional.iter().any(|e| e.adds && e.fact == *fact)
        };
        let needs = |fact: &FactId| op.preconditions.binary_search(fact).is_ok();
        let always: Vec<FactId> =
            op.deletes.iter().copied().filter(|fact| needs(fact) && !added_somehow(fact)).collect();
        for &fact in op.adds.iter().filter(|fact| !needs(fact)) {
            self.productions.push(Production { op: number, fact });
            self.consumed.push(always.iter().copied());
        }
        for effect in op.conditional.iter().filter(|e| e.adds && !needs(&e.fact) && !e.positive.contains(&e.fact)) {
            let known = |fact: &FactId| needs(fact) || effect.positive.contains(fact);
            // What is deleted whenever this effect happens, and was there.
            let deleted =
                op.conditional.iter().filter(|e| !e.adds && e.negative.iter().all(|f| effect.negative.contains(f)));
            let with_it = deleted.filter(|e| known(&e.fact) && !added_somehow(&e.fact) && e.positive.iter().all(known));
            let anyway = op.deletes.iter().filter(|fact| known(fact) && !added_somehow(fact));
            self.productions.push(Production { op: number, fact: effect.fact });
            self.consumed.push(anyway.copied().chain(with_it.map(|e| e.fact)));
        }
    }

    fn run(&self, poll: &mut Poll<'_>) -> Result<Vec<Vec<FactId>>, Stop> {
        let mut queue: Vec<Candidate> = Vec::new();
        let mut predicates: Vec<u32> = self.by_predicate.keys().copied().collect();
        predicates.sort_unstable();
        for predicate in predicates {
            let arity = self.task.facts().args(self.by_predicate[&predicate][0]).len();
            for counted in (0..arity).map(Some).chain([None]) {
                let positions = (0..arity).filter(|&position| Some(position) != counted).collect();
                queue.push(vec![Part { predicate, positions, counted }]);
            }
        }
        let mut known: BTreeSet<Candidate> = queue.iter().cloned().collect();
        let mut groups: BTreeSet<Vec<FactId>> = BTreeSet::new();
        let (mut next, first, mut work) = (0, queue.len(), 0);
        while next < queue.len() && next < first.max(MOST_CANDIDATES) && (next < first || work < MOST_WORK) {
            let candidate = queue[next].clone();
            next += 1;
            work += self.productions.len();
            poll.check(1 + self.productions.len())?;
            for refined in self.check(&candidate, &mut groups) {
                if known.insert(refined.clone()) {
                    queue.push(refined);
                }
            }
        }
        Ok(groups.into_iter().collect())
    }

    /// Adds the groups that a candidate has; the candidates that may be groups where it is none.
    fn check(&self, candidate: &Candidate, groups: &mut BTreeSet<Vec<FactId>>) -> Vec<Candidate> {
        let (instance_of, members) = self.instances(candidate);
        let mut weight = vec![0_u32; members.len()];
        for fact in &self.initially {
            if let Some(weight) = weight.get_mut(instance_of[fact.index()] as usize) {
                *weight += 1;
            }
        }
        // What holds twice from the beginning, or is made true twice by one action, cannot be mended by more atoms.
        let mut heavy: Vec<bool> = weight.iter().map(|&weight| weight > 1).collect();
        let mut unbalanced: Vec<Option<usize>> = vec![None; members.len()];
        // The production that last touched each instance.
        let mut last: Vec<Option<Production>> = vec![None; members.len()];
        for (p, production) in self.productions.iter().enumerate() {
            let instance = instance_of[production.fact.index()];
            if instance == NO_INSTANCE {
                continue;
            }
            let i = instance as usize;
            let before = last[i].replace(*production);
            if before.is_some_and(|before| before.op == production.op && before.fact != production.fact) {
                heavy[i] = true;
            } else if unbalanced[i].is_none()
                && !self.consumed.get(p).iter().any(|fact| instance_of[fact.index()] == instance)
            {
                unbalanced[i] = Some(p);
            }
        }
        let mut refined = BTreeSet::new();
        let mut tried: BTreeSet<Vec<(u32, u32)>> = BTreeSet::new();
        for (i, mut group) in members.into_iter().enumerate() {
            match unbalanced[i] {
                _ if heavy[i] => {}
                None if group.len() > 1 => {
                    group.sort_unstable();
                    groups.insert(group);
                }
                None => {}
                Some(production) => {
                    // Productions of one schema and predicate suggest the same.
                    let Production { op, fact } = self.productions[production];
                    let schema = self.task.op(OpId::new(op as usize)).schema as u32;
                    let consumed = self.consumed.get(production).iter().map(|&fact| self.task.facts().predicate(fact));
                    let mut kind = vec![(schema, self.task.facts().predicate(fact))];
                    kind.extend(consumed.map(|predicate| (u32::MAX, predicate)));
                    if tried.insert(kind) {
                        self.refine(candidate, production, &mut refined);
                    }
                }
            }
        }
        refined.into_iter().collect()
    }

    /// Of each fact the number of its instance of the candidate, or [`NO_INSTANCE`]; of each instance its facts.
    fn instances(&self, candidate: &Candidate) -> (Vec<u32>, Vec<Vec<FactId>>) {
        let mut instance_of = vec![NO_INSTANCE; self.task.fact_count()];
        let mut instances: HashMap<Vec<ObjectId>, u32> = HashMap::default();
        let mut members: Vec<Vec<FactId>> = Vec::new();
        for part in candidate {
            for &fact in self.by_predicate.get(&part.predicate).into_iter().flatten() {
                let parameters = part.parameters(self.task.facts().args(fact));
                let instance = *instances.entry(parameters).or_insert_with(|| {
                    members.push(Vec::new());
                    members.len() as u32 - 1
                });
                instance_of[fact.index()] = instance;
                members[instance as usize].push(fact);
            }
        }
        (instance_of, members)
    }

    /// Adds to a candidate what a production consumes.
    fn refine(&self, candidate: &Candidate, production: usize, into: &mut BTreeSet<Candidate>) {
        let facts = self.task.facts();
        let produced = self.productions[production].fact;
        let Some(part) = candidate.iter().find(|part| part.predicate == facts.predicate(produced)) else { return };
        let parameters = part.parameters(facts.args(produced));
        for &fact in self.consumed.get(production) {
            let predicate = facts.predicate(fact);
            let args = facts.args(fact);
            if candidate.iter().any(|part| part.predicate == predicate) || args.len() > parameters.len() + 1 {
                continue;
            }
            let mut ways: Vec<Vec<usize>> = vec![Vec::new()];
            for parameter in &parameters {
                ways = ways
                    .into_iter()
                    .flat_map(|way| {
                        let positions = (0..args.len()).filter(|&p| args[p] == *parameter && !way.contains(&p));
                        let positions: Vec<usize> = positions.collect();
                        positions.into_iter().map(move |p| way.iter().copied().chain([p]).collect())
                    })
                    .collect();
            }
            for positions in ways {
                let counted = (0..args.len()).find(|position| !positions.contains(position));
                let mut candidate = candidate.clone();
                candidate.push(Part { predicate, positions, counted });
                candidate.sort_unstable();
                into.insert(candidate);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::worked::Worked;

    #[test]
    fn a_ball_is_in_one_place_and_a_hand_holds_one_thing() {
        let worked = Worked::new(
            "init: room(a) room(b) robby(a) at(red,a) at(blue,a) free
             goal: at(red,b) at(blue,b)
             move(?0,?1): robby(?0) room(?1) -> robby(?1) !robby(?0)
             pick(?0,?1): at(?0,?1) robby(?1) free -> held(?0) !at(?0,?1) !free
             drop(?0,?1): held(?0) robby(?1) -> at(?0,?1) free !held(?0)",
        );
        let exclude_each_other = |atoms: &str| worked.fdr.mutexes.excluded_pair(&worked.facts_of(atoms)).is_some();
        for pair in [
            "robby(a) robby(b)",
            "at(red,a) at(red,b)",
            "at(red,a) held(red)",
            "held(red) held(blue)",
            "held(red) free",
        ] {
            assert!(exclude_each_other(pair), "{pair}");
        }
        for pair in ["robby(a) at(red,a)", "at(red,a) at(blue,a)", "at(red,a) held(blue)", "at(red,a) free"] {
            assert!(!exclude_each_other(pair), "{pair}");
        }
        // Each ball has a variable of three values, its two rooms and the hand; the robot of two, its rooms; and the hand, of
        // which only free is left, of one. Each has one more value, for none of these.
        let mut sizes = worked.fdr.domains.clone();
        sizes.sort_unstable();
        assert_eq!(sizes, [2, 3, 4, 4]);
    }

    #[test]
    fn what_a_mutex_group_implies_is_no_condition_of_its_own() {
        let worked = Worked::new(
            "init: free thing(red) thing(blue)
             goal: held(red)
             pick(?0): free !held(?0) !wet(?0) -> held(?0) !free
             drop(?0): held(?0) -> free !held(?0)
             pour(?0): free thing(?0) -> wet(?0)",
        );
        let compatible = |negative: &str, positive: &str| {
            let (negative, positive) = (worked.facts_of(negative), worked.facts_of(positive));
            worked.fdr.mutexes.compatible(&negative, &positive)
        };
        assert_eq!(compatible("held(red) wet(red)", "free"), worked.facts_of("wet(red)"), "a free hand holds nothing");
        assert_eq!(compatible("held(red)", "held(blue)"), []);
        assert_eq!(compatible("held(red)", "wet(red)"), worked.facts_of("held(red)"));
    }
}
