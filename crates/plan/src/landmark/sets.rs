//! Which facts every delete-relaxed plan makes true on the way to a fact.
//!
//! The sets are the greatest fixpoint of `LM(p) = {p} ∪ ⋂ over achievers a of p, ⋃ over preconditions q of a, LM(q)`, with
//! `LM(p) = ∅` for what holds initially (Zhu and Givan, *Landmark extraction via planning graph propagation*, 2003): all
//! landmarks of the delete relaxation that do not hold initially. Computed by propagation, in the order in which actions
//! become applicable.

use std::collections::VecDeque;
use typelift_model::Stop;

use crate::fdr::{ActionIndex, Assignment, Fdr};
use crate::poll::Poll;
use crate::relaxation::{Prop, Relaxation, RelaxedIndex};

/// The landmarks of every proposition.
pub(crate) struct LandmarkSets<'a> {
    pub(crate) task: &'a Fdr,
    pub(crate) relaxation: &'a Relaxation,
    /// What holds initially.
    pub(crate) initial: Vec<bool>,
    /// The landmarks of each proposition, sorted, itself among them; `None` if it cannot be reached.
    sets: Vec<Option<Vec<Prop>>>,
}

impl<'a> LandmarkSets<'a> {
    pub(crate) fn of(task: &'a Fdr, relaxation: &'a Relaxation, poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let n = relaxation.len();
        let mut this = Self { task, relaxation, initial: vec![false; n], sets: vec![None; n] };
        for prop in relaxation.held(task, &task.init) {
            this.initial[prop as usize] = true;
            this.sets[prop as usize] = Some(Vec::new());
        }
        let mut queue: VecDeque<RelaxedIndex> = this.in_order_of_reachability(poll)?.into();
        let mut queued = vec![false; relaxation.action.len()];
        for &relaxed in &queue {
            queued[relaxed as usize] = true;
        }
        let (mut needed, mut merged) = (Vec::new(), Vec::new());
        while let Some(relaxed) = queue.pop_front() {
            queued[relaxed as usize] = false;
            this.needed(relaxed, &mut needed, &mut merged);
            poll.check(1 + needed.len())?;
            for &prop in relaxation.adds.get(relaxed as usize) {
                poll.check(needed.len())?;
                if !this.initial[prop as usize] && this.narrow(prop, &needed) {
                    for &user in relaxation.needed_by.get(prop as usize) {
                        if !std::mem::replace(&mut queued[user as usize], true) {
                            queue.push_back(user);
                        }
                    }
                }
            }
        }
        Ok(this)
    }

    /// The relaxed actions that can be reached, each after one that makes it applicable.
    fn in_order_of_reachability(&self, poll: &mut Poll<'_>) -> Result<Vec<RelaxedIndex>, Stop> {
        let preconditions = &self.relaxation.preconditions;
        let mut reached = self.initial.clone();
        let mut missing: Vec<u32> = preconditions.iter().map(|list| list.len() as u32).collect();
        let mut order: Vec<RelaxedIndex> =
            (0..missing.len() as u32).filter(|&relaxed| missing[relaxed as usize] == 0).collect();
        let mut props: VecDeque<Prop> = (0..reached.len() as u32).filter(|&prop| reached[prop as usize]).collect();
        let mut next = 0;
        loop {
            while let Some(&relaxed) = order.get(next) {
                next += 1;
                for &prop in self.relaxation.adds.get(relaxed as usize) {
                    if !std::mem::replace(&mut reached[prop as usize], true) {
                        props.push_back(prop);
                    }
                }
            }
            let Some(prop) = props.pop_front() else { return Ok(order) };
            let users = self.relaxation.needed_by.get(prop as usize);
            poll.check(1 + users.len())?;
            for &user in users {
                missing[user as usize] -= 1;
                if missing[user as usize] == 0 {
                    order.push(user);
                }
            }
        }
    }

    /// What all of a reached relaxed action's preconditions need, together.
    fn needed(&self, relaxed: RelaxedIndex, needed: &mut Vec<Prop>, merged: &mut Vec<Prop>) {
        needed.clear();
        for &prop in self.relaxation.preconditions.get(relaxed as usize) {
            let set = self.of_prop(prop);
            if set.is_empty() {
                continue;
            }
            merge(needed, set, merged);
            std::mem::swap(needed, merged);
        }
    }

    /// Leaves of a proposition's landmarks those that one achiever needs; whether that changed anything.
    fn narrow(&mut self, prop: Prop, needed: &[Prop]) -> bool {
        match &mut self.sets[prop as usize] {
            Some(known) => {
                let before = known.len();
                let mut rest = needed;
                known.retain(|&landmark| {
                    let skipped = rest.iter().take_while(|&&other| other < landmark).count();
                    rest = &rest[skipped..];
                    landmark == prop || rest.first() == Some(&landmark)
                });
                known.len() < before
            }
            unknown => {
                let mut set = needed.to_vec();
                if let Err(place) = set.binary_search(&prop) {
                    set.insert(place, prop);
                }
                *unknown = Some(set);
                true
            }
        }
    }

    /// The landmarks of a proposition that do not hold initially, sorted.
    pub(crate) fn of_prop(&self, prop: Prop) -> &[Prop] {
        self.sets[prop as usize].as_deref().unwrap_or_default()
    }

    /// Whether `a` is a landmark of `b`.
    pub(crate) fn is_before(&self, a: Prop, b: Prop) -> bool {
        a != b && self.of_prop(b).binary_search(&a).is_ok()
    }

    /// The relaxed actions that add a proposition.
    pub(crate) fn achievers(&self, prop: Prop) -> &'a [RelaxedIndex] {
        self.relaxation.achievers.get(prop as usize)
    }

    /// The relaxed actions that can be the first to add a proposition: those that do not need it themselves.
    pub(crate) fn first_achievers(&self, prop: Prop) -> impl Iterator<Item = RelaxedIndex> + '_ {
        self.achievers(prop).iter().copied().filter(move |&relaxed| {
            let preconditions = self.relaxation.preconditions.get(relaxed as usize);
            preconditions
                .iter()
                .all(|&needed| self.sets[needed as usize].is_some() && !self.is_before(prop, needed) && needed != prop)
        })
    }

    /// What a relaxed action deletes whatever the state; axioms delete nothing.
    pub(crate) fn deletes(&self, relaxed: RelaxedIndex) -> &'a [Assignment] {
        self.relaxation.action[relaxed as usize]
            .map_or(&[], |action: ActionIndex| self.task.actions.deletes.get(action as usize))
    }
}

/// The union of two sorted lists.
fn merge(a: &[Prop], b: &[Prop], into: &mut Vec<Prop>) {
    into.clear();
    let (mut a, mut b) = (a.iter().copied().peekable(), b.iter().copied().peekable());
    while let (Some(&x), Some(&y)) = (a.peek(), b.peek()) {
        if x <= y {
            a.next();
        }
        if y <= x {
            b.next();
        }
        into.push(x.min(y));
    }
    into.extend(a);
    into.extend(b);
}
