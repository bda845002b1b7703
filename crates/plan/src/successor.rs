//! Packed states and their successors.

use crate::fact::FactId;
use crate::ground::{GroundTask, Op, OpId};

/// The number of 64-bit words that a state of so many facts takes.
pub(crate) fn words(facts: usize) -> usize {
    facts.div_ceil(64).max(1)
}

/// Whether a fact holds in a packed state.
pub(crate) fn holds(state: &[u64], fact: FactId) -> bool {
    state[fact.index() / 64] >> (fact.index() % 64) & 1 == 1
}

pub(crate) fn set(state: &mut [u64], fact: FactId, value: bool) {
    let bit = 1 << (fact.index() % 64);
    if value {
        state[fact.index() / 64] |= bit;
    } else {
        state[fact.index() / 64] &= !bit;
    }
}

fn all_hold(state: &[u64], facts: &[FactId]) -> bool {
    facts.iter().all(|&fact| holds(state, fact))
}

fn none_holds(state: &[u64], facts: &[FactId]) -> bool {
    facts.iter().all(|&fact| !holds(state, fact))
}

/// The initial state, packed.
pub(crate) fn initial(task: &GroundTask) -> Vec<u64> {
    let mut state = vec![0; words(task.fact_count())];
    for &fact in task.init() {
        set(&mut state, fact, true);
    }
    state
}

/// Whether every goal atom holds, and none that must not.
pub(crate) fn is_goal(task: &GroundTask, state: &[u64]) -> bool {
    all_hold(state, task.goal()) && none_holds(state, task.negative_goal())
}

/// The actions applicable in a state, in the task's order.
pub(crate) fn applicable(task: &GroundTask, state: &[u64], into: &mut Vec<OpId>) {
    into.clear();
    into.extend(
        task.ops()
            .filter(|(_, op)| all_hold(state, &op.preconditions) && none_holds(state, &op.negative))
            .map(|(id, _)| id),
    );
}

/// Applies an action; `after` starts as a copy of `before`.
pub(crate) fn apply(task: &GroundTask, op: &Op, before: &[u64], after: &mut [u64]) {
    change(op, before, after);
    task.axioms().close(after);
}

fn change(op: &Op, before: &[u64], after: &mut [u64]) {
    for &fact in &op.deletes {
        set(after, fact, false);
    }
    if op.conditional.is_empty() {
        for &fact in &op.adds {
            set(after, fact, true);
        }
        return;
    }
    let fires =
        |effect: &&crate::ConditionalEffect| all_hold(before, &effect.positive) && none_holds(before, &effect.negative);
    for adds in [false, true] {
        for effect in op.conditional.iter().filter(|e| e.adds == adds).filter(fires) {
            set(after, effect.fact, adds);
        }
    }
    for &fact in &op.adds {
        set(after, fact, true);
    }
}
