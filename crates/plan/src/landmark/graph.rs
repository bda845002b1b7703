//! The landmark graph: facts, and sets of facts, that every plan makes true, with the orders between them.
//!
//! Nodes are the [landmarks](LandmarkSets) of the goals; the goals; what holds initially and every first achiever of a
//! landmark needs; and disjunctive landmarks, found by backchaining: sets of up to four facts of one predicate of which
//! every first achiever of a landmark needs one (Porteous and Cresswell, *Extending landmarks analysis to reason about
//! resources and repetition*, 2002). Orders, after Hoffmann, Porteous and Sebastia (*Ordered landmarks in planning*, JAIR
//! 22, 2004) and Richter and Westphal (*The LAMA planner*, JAIR 39, 2010): natural, A is true some time before B;
//! greedy-necessary, A is true immediately before B first is; reasonable, else B would have to be made true twice. Cycles
//! are broken where they are reasonable. We differ in that all natural orders of the delete relaxation are known from
//! the landmark sets, and in that an order is reasonable too if each achiever interferes in a way of its own.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use fixedbitset::FixedBitSet;
use typelift_model::{HashMap, Stop};

use super::LandmarkSets;
use crate::fdr::Fdr;
use crate::ground::GroundTask;
use crate::poll::Poll;
use crate::relaxation::{Prop, Relaxation, RelaxedIndex};

/// The most facts of a disjunctive landmark.
const MOST_DISJUNCTS: usize = 4;

/// A landmark: one of these propositions is true at some time in every plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Landmark {
    pub(crate) props: Vec<Prop>,
    pub(crate) is_goal: bool,
    /// The landmarks that are true before it first is, by natural orders; sorted.
    pub(crate) predecessors: Vec<u32>,
    /// The landmarks immediately before which it has to be true; sorted.
    pub(crate) needed_for: Vec<u32>,
    /// The landmarks that are reasonably made true before it; sorted.
    pub(crate) better_after: Vec<u32>,
}

/// Landmarks and orders.
#[derive(Debug, Default)]
pub(crate) struct LandmarkGraph {
    pub(crate) landmarks: Vec<Landmark>,
}

impl LandmarkGraph {
    /// The graph of a task whose goals can be reached.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub(crate) fn new(
        task: &GroundTask,
        fdr: &Fdr,
        relaxation: &Relaxation,
        poll: &mut Poll<'_>,
    ) -> Result<Self, Stop> {
        let sets = LandmarkSets::of(fdr, relaxation, poll)?;
        let mut builder = Builder { task, fdr, sets, landmarks: Vec::new(), by_prop: HashMap::default() };
        builder.collect(poll)?;
        builder.natural(poll)?;
        builder.reasonable(poll)?;
        Ok(Self { landmarks: builder.landmarks })
    }
}

struct Builder<'a> {
    task: &'a GroundTask,
    fdr: &'a Fdr,
    sets: LandmarkSets<'a>,
    landmarks: Vec<Landmark>,
    /// The landmarks that are one fact.
    by_prop: HashMap<Prop, u32>,
}

impl Builder<'_> {
    fn relaxation(&self) -> &Relaxation {
        self.sets.relaxation
    }

    fn simple(&mut self, prop: Prop) -> u32 {
        if let Some(&known) = self.by_prop.get(&prop) {
            return known;
        }
        let index = self.push(vec![prop]);
        self.by_prop.insert(prop, index);
        index
    }

    fn push(&mut self, props: Vec<Prop>) -> u32 {
        self.landmarks.push(Landmark {
            props,
            is_goal: false,
            predecessors: Vec::new(),
            needed_for: Vec::new(),
            better_after: Vec::new(),
        });
        self.landmarks.len() as u32 - 1
    }

    /// Finds all landmarks, with the greedy-necessary orders.
    fn collect(&mut self, poll: &mut Poll<'_>) -> Result<(), Stop> {
        let goals = self.relaxation().goal.clone();
        let mut props: BTreeSet<Prop> = BTreeSet::new();
        for &goal in &goals {
            props.extend(self.sets.of_prop(goal));
        }
        for prop in props.into_iter().filter(|&prop| !self.relaxation().is_auxiliary(prop)).collect::<Vec<_>>() {
            self.simple(prop);
        }
        for goal in goals {
            let index = self.simple(goal);
            self.landmarks[index as usize].is_goal = true;
        }
        let mut disjunctive: BTreeMap<Vec<Prop>, u32> = BTreeMap::new();
        let mut open: VecDeque<u32> = (0..self.landmarks.len() as u32).collect();
        while let Some(landmark) = open.pop_front() {
            let props = self.landmarks[landmark as usize].props.clone();
            if props.iter().any(|&prop| self.sets.initial[prop as usize]) {
                continue;
            }
            let mut achievers: Vec<RelaxedIndex> =
                props.iter().flat_map(|&prop| self.sets.first_achievers(prop)).collect();
            achievers.sort_unstable();
            achievers.dedup();
            poll.check(achievers.len() * 4)?;
            for prop in self.needed_by_all(&achievers) {
                if !self.by_prop.contains_key(&prop) && !self.sets.initial[prop as usize] {
                    // Everything that is needed for certain is among the sets already, but for what a disjunction needs.
                    open.push_back(self.landmarks.len() as u32);
                }
                let needed = self.simple(prop);
                self.landmarks[needed as usize].needed_for.push(landmark);
            }
            for props in self.one_needed_by_all(&achievers) {
                let known = disjunctive.get(&props).copied();
                let needed = known.unwrap_or_else(|| self.push(props.clone()));
                if known.is_none() {
                    disjunctive.insert(props, needed);
                    open.push_back(needed);
                }
                if needed != landmark {
                    self.landmarks[needed as usize].needed_for.push(landmark);
                }
            }
        }
        for landmark in &mut self.landmarks {
            landmark.needed_for.sort_unstable();
            landmark.needed_for.dedup();
        }
        Ok(())
    }

    /// What each of these relaxed actions needs.
    fn needed_by_all(&self, achievers: &[RelaxedIndex]) -> Vec<Prop> {
        let preconditions = |relaxed: RelaxedIndex| self.relaxation().preconditions.get(relaxed as usize);
        let Some((&first, rest)) = achievers.split_first() else { return Vec::new() };
        let mut common = preconditions(first).to_vec();
        common.retain(|&prop| !self.relaxation().is_auxiliary(prop));
        for &relaxed in rest {
            if common.is_empty() {
                break;
            }
            common.retain(|prop| preconditions(relaxed).binary_search(prop).is_ok());
        }
        common
    }

    /// Small sets of facts, none of which holds initially or is a landmark itself, of which each of these relaxed actions
    /// needs one.
    fn one_needed_by_all(&self, achievers: &[RelaxedIndex]) -> Vec<Vec<Prop>> {
        if achievers.len() < 2 {
            return Vec::new();
        }
        let mut by_predicate: BTreeMap<u32, (BTreeSet<Prop>, usize)> = BTreeMap::new();
        for (number, &relaxed) in achievers.iter().enumerate() {
            for &prop in self.relaxation().preconditions.get(relaxed as usize) {
                if !self.relaxation().is_fact(prop) {
                    continue;
                }
                let predicate = self.task.facts().predicate(self.fdr.fact(prop));
                if number == 0 {
                    by_predicate.entry(predicate).or_default();
                }
                let Some((props, seen)) = by_predicate.get_mut(&predicate) else { continue };
                if *seen == number || *seen == number + 1 {
                    *seen = number + 1;
                    props.insert(prop);
                }
            }
            by_predicate.retain(|_, (props, seen)| *seen == number + 1 && props.len() <= MOST_DISJUNCTS);
            if by_predicate.is_empty() {
                break;
            }
        }
        let sets = by_predicate.into_values().map(|(props, _)| props.into_iter().collect::<Vec<_>>());
        let plain = |prop: &Prop| !self.sets.initial[*prop as usize] && !self.by_prop.contains_key(prop);
        sets.filter(|props| props.len() > 1 && props.iter().all(plain)).collect()
    }

    fn natural(&mut self, poll: &mut Poll<'_>) -> Result<(), Stop> {
        for index in 0..self.landmarks.len() {
            let (first, rest) = self.landmarks[index].props.split_at(1);
            let mut before: Vec<Prop> = self.sets.of_prop(first[0]).to_vec();
            for &prop in rest {
                before.retain(|other| self.sets.of_prop(prop).binary_search(other).is_ok());
            }
            poll.check(1 + before.len())?;
            let nodes = before.iter().filter_map(|prop| self.by_prop.get(prop).copied());
            self.landmarks[index].predecessors = nodes.filter(|&node| node as usize != index).collect();
        }
        for index in 0..self.landmarks.len() {
            for follower in self.landmarks[index].needed_for.clone() {
                self.landmarks[follower as usize].predecessors.push(index as u32);
            }
        }
        for landmark in &mut self.landmarks {
            landmark.predecessors.sort_unstable();
            landmark.predecessors.dedup();
        }
        Ok(())
    }

    /// Adds orders that spare making something true twice, as far as they agree with each other and with the others.
    fn reasonable(&mut self, poll: &mut Poll<'_>) -> Result<(), Stop> {
        let mut in_group: HashMap<u32, Vec<u32>> = HashMap::default();
        for (&prop, &landmark) in &self.by_prop {
            for &group in self.groups(prop) {
                in_group.entry(group).or_default().push(landmark);
            }
        }
        let mut needs: Vec<Vec<u32>> = vec![Vec::new(); self.landmarks.len()];
        for (index, landmark) in self.landmarks.iter().enumerate() {
            for &follower in &landmark.needed_for {
                needs[follower as usize].push(index as u32);
            }
        }
        let mut orders: Vec<(u32, u32)> = Vec::new();
        let mut interesting: Vec<Option<FixedBitSet>> = vec![None; self.landmarks.len()];
        for a in 0..self.landmarks.len() as u32 {
            let Landmark { props, is_goal, .. } = &self.landmarks[a as usize];
            if props.len() > 1 || self.sets.initial[props[0] as usize] && !is_goal {
                continue;
            }
            let spoiled = self.spoiled_by_achieving(props[0], &needs[a as usize], &in_group);
            poll.check(1 + spoiled.len() + self.sets.achievers(props[0]).len())?;
            for b in spoiled.into_iter().filter(|&b| b != a) {
                let reasonable = if self.landmarks[b as usize].is_goal {
                    *is_goal
                } else {
                    let interesting = interesting[b as usize].get_or_insert_with(|| self.needed_together_with(b));
                    poll.check(1)?;
                    interesting.contains(a as usize)
                };
                if reasonable && self.landmarks[a as usize].predecessors.binary_search(&b).is_err() {
                    orders.push((b, a));
                }
            }
        }
        self.add_without_cycles(&orders);
        Ok(())
    }

    fn groups(&self, prop: Prop) -> &[u32] {
        if self.relaxation().is_fact(prop) { self.fdr.mutexes.groups_of(self.fdr.fact(prop)) } else { &[] }
    }

    /// The landmarks that are certainly not true when, or immediately before, a proposition becomes true.
    fn spoiled_by_achieving(&self, prop: Prop, needs: &[u32], in_group: &HashMap<u32, Vec<u32>>) -> BTreeSet<u32> {
        let rivals = |prop: Prop| {
            let groups = self.groups(prop).iter().filter_map(|group| in_group.get(group));
            groups.flatten().copied().filter(move |&landmark| self.landmarks[landmark as usize].props[0] != prop)
        };
        let mut spoiled: BTreeSet<u32> = rivals(prop).collect();
        for &needed in needs {
            let Landmark { props, .. } = &self.landmarks[needed as usize];
            if let [only] = props[..] {
                spoiled.extend(rivals(only));
            }
        }
        let made_false = |relaxed: RelaxedIndex| -> BTreeSet<u32> {
            let deleted = self.sets.deletes(relaxed).iter().map(|&place| self.fdr.number(place));
            let deleted = deleted.filter_map(|prop| self.by_prop.get(&prop).copied());
            let added = self.relaxation().adds.get(relaxed as usize).iter();
            deleted.chain(added.flat_map(|&prop| rivals(prop))).collect()
        };
        let mut always: Option<BTreeSet<u32>> = None;
        for &relaxed in self.sets.achievers(prop) {
            let made_false = made_false(relaxed);
            let left = match always {
                None => made_false,
                Some(always) => always.intersection(&made_false).copied().collect(),
            };
            let is_empty = left.is_empty();
            always = Some(left);
            if is_empty {
                break;
            }
        }
        spoiled.extend(always.unwrap_or_default());
        spoiled
    }

    /// What comes before everything that a landmark is needed for.
    fn needed_together_with(&self, landmark: u32) -> FixedBitSet {
        let mut together: Option<FixedBitSet> = None;
        for &follower in &self.landmarks[landmark as usize].needed_for {
            let mut set = FixedBitSet::with_capacity(self.landmarks.len());
            for &other in &self.landmarks[follower as usize].predecessors {
                set.insert(other as usize);
                for &before in &self.landmarks[other as usize].predecessors {
                    set.insert(before as usize);
                }
            }
            if let Some(others) = &together {
                set.intersect_with(others);
            }
            together = Some(set);
        }
        together.unwrap_or_default()
    }

    /// Adds reasonable orders (each as what comes later, and what comes before it) that leave the graph without cycles:
    /// landmarks are taken in the graph's order, and where all that is left waits for others, the one that waits for the
    /// fewest by reasonable orders alone is taken without them.
    fn add_without_cycles(&mut self, orders: &[(u32, u32)]) {
        let n = self.landmarks.len();
        let mut followers: Vec<Vec<(u32, bool)>> = vec![Vec::new(); n];
        let mut waits = vec![(0_u32, 0_u32); n];
        for (index, landmark) in self.landmarks.iter().enumerate() {
            for &before in &landmark.predecessors {
                followers[before as usize].push((index as u32, false));
                waits[index].0 += 1;
            }
        }
        for &(later, before) in orders {
            followers[before as usize].push((later, true));
            waits[later as usize].1 += 1;
        }
        let mut left: BTreeSet<(u32, u32, u32)> = (0..n).map(|i| (waits[i].0, waits[i].1, i as u32)).collect();
        let mut taken = vec![false; n];
        let mut kept: Vec<(u32, u32)> = Vec::new();
        while let Some((_, _, next)) = left.pop_first() {
            taken[next as usize] = true;
            for &(follower, reasonable) in &followers[next as usize] {
                if taken[follower as usize] {
                    continue;
                }
                let wait = &mut waits[follower as usize];
                left.remove(&(wait.0, wait.1, follower));
                if reasonable {
                    wait.1 -= 1;
                    kept.push((follower, next));
                } else {
                    wait.0 -= 1;
                }
                left.insert((wait.0, wait.1, follower));
            }
        }
        kept.sort_unstable();
        for (later, before) in kept {
            self.landmarks[later as usize].better_after.push(before);
        }
    }
}
