//! What follows from a packed state: the ground axioms, evaluated stratum by stratum.

use std::collections::BTreeMap;

use crate::fact::{FactId, Facts};
use crate::ground::Op;
use crate::successor::{holds, set, words};

/// A ground axiom.
#[derive(Debug)]
struct GroundAxiom {
    head: FactId,
    /// What must hold, of derived facts of its own stratum.
    own: Vec<FactId>,
    /// What else must hold: decided before the stratum is.
    positive: Vec<FactId>,
    negative: Vec<FactId>,
}

/// Axioms that are evaluated together.
#[derive(Debug)]
struct Stratum {
    axioms: Vec<GroundAxiom>,
    /// Which axioms wait for a derived fact of this stratum, by fact; sorted.
    waiting: BTreeMap<FactId, Vec<usize>>,
}

/// The ground axioms of a task.
#[derive(Debug, Default)]
pub(crate) struct Axioms {
    strata: Vec<Stratum>,
    derived: Vec<FactId>,
}

impl Axioms {
    /// Sorts ground axioms, given as actions that add their heads, into their strata.
    pub(crate) fn new(ops: &[Op], strata: &[u32], facts: &Facts) -> Self {
        let mut heads: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (i, stratum) in strata.iter().enumerate() {
            heads.entry(*stratum).or_default().push(i);
        }
        let mut is_derived: Vec<Option<u32>> = vec![None; facts.len()];
        for (op, stratum) in ops.iter().zip(strata) {
            for fact in &op.adds {
                is_derived[fact.index()] = Some(*stratum);
            }
        }
        let derived = facts.ids().filter(|fact| is_derived[fact.index()].is_some()).collect();
        let strata = heads.into_iter().map(|(stratum, members)| {
            let axioms = members.iter().filter_map(|&i| {
                let op = &ops[i];
                let head = *op.adds.first()?;
                let (own, positive) =
                    op.preconditions.iter().partition(|fact| is_derived[fact.index()] == Some(stratum));
                Some(GroundAxiom { head, own, positive, negative: op.negative.clone() })
            });
            let axioms: Vec<GroundAxiom> = axioms.collect();
            let mut waiting: BTreeMap<FactId, Vec<usize>> = BTreeMap::new();
            for (i, axiom) in axioms.iter().enumerate() {
                for fact in &axiom.own {
                    waiting.entry(*fact).or_default().push(i);
                }
            }
            Stratum { axioms, waiting }
        });
        Self { strata: strata.collect(), derived }
    }

    /// Replaces the derived facts of a packed state by those that follow from the others. Linear in the axioms.
    pub(crate) fn close(&self, state: &mut [u64]) {
        for &fact in &self.derived {
            set(state, fact, false);
        }
        for stratum in &self.strata {
            let mut missing: Vec<Option<usize>> = Vec::with_capacity(stratum.axioms.len());
            let mut new: Vec<FactId> = Vec::new();
            for axiom in &stratum.axioms {
                let decided = axiom.positive.iter().all(|&fact| holds(state, fact))
                    && !axiom.negative.iter().any(|&fact| holds(state, fact));
                missing.push(decided.then_some(axiom.own.len()));
                if decided && axiom.own.is_empty() {
                    new.push(axiom.head);
                }
            }
            while let Some(fact) = new.pop() {
                if holds(state, fact) {
                    continue;
                }
                set(state, fact, true);
                for &waiting in stratum.waiting.get(&fact).into_iter().flatten() {
                    if let Some(missing) = &mut missing[waiting] {
                        *missing -= 1;
                        if *missing == 0 {
                            new.push(stratum.axioms[waiting].head);
                        }
                    }
                }
            }
        }
    }

    /// Whether a fact follows from others.
    pub(crate) fn derives(&self, fact: FactId) -> bool {
        self.derived.binary_search(&fact).is_ok()
    }

    /// Facts with those that follow from them, which come last.
    pub(crate) fn closed(&self, facts: &[FactId], count: usize) -> Vec<FactId> {
        let mut state = vec![0; words(count)];
        for &fact in facts {
            set(&mut state, fact, true);
        }
        self.close(&mut state);
        let mut closed = facts.to_vec();
        closed.extend(self.derived.iter().filter(|&&fact| holds(&state, fact)));
        closed
    }
}
