//! What follows from a state: the ground axioms, evaluated stratum by stratum.

use std::collections::{BTreeMap, BTreeSet};

use crate::assignment::{Assignment, Place, Values};
use crate::fact::FactId;
use crate::op::Op;

/// The value of a derived fact's variable that holds, and the one that does not.
pub(crate) const FOLLOWS: u32 = 0;
const FOLLOWS_NOT: u32 = 1;

/// A ground axiom.
#[derive(Debug)]
pub(crate) struct GroundAxiom {
    /// The variable of its head.
    head: u32,
    /// What must hold, of derived facts of its own stratum.
    own: Vec<u32>,
    /// What else must hold: decided before the stratum is.
    positive: Vec<Assignment>,
    pub(crate) negative: Vec<Assignment>,
}

impl GroundAxiom {
    /// What follows.
    pub(crate) fn head(&self) -> Assignment {
        Assignment { variable: self.head, value: FOLLOWS }
    }

    /// What must hold.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = Assignment> {
        let own = self.own.iter().map(|&variable| Assignment { variable, value: FOLLOWS });
        own.chain(self.positive.iter().copied())
    }
}

/// Axioms that are evaluated together.
#[derive(Debug, Default)]
struct Stratum {
    axioms: Vec<GroundAxiom>,
    /// Which axioms wait for a derived fact of this stratum, by its variable.
    waiting: BTreeMap<u32, Vec<usize>>,
}

/// The ground axioms of a task.
#[derive(Debug, Default)]
pub(crate) struct Axioms {
    strata: Vec<Stratum>,
    /// The variables of derived facts.
    derived: Vec<u32>,
}

impl Axioms {
    /// Sorts ground axioms, given as actions that add their heads, into their strata. Each derived fact has a variable of
    /// its own, in which 0 stands for it and 1 for its absence.
    pub(crate) fn new<'a>(
        axioms: impl Iterator<Item = (&'a Op, u32)> + Clone,
        place: impl Fn(FactId) -> Place,
    ) -> Self {
        let mut stratum_of: BTreeMap<u32, u32> = BTreeMap::new();
        for (op, stratum) in axioms.clone() {
            stratum_of.extend(op.adds.iter().filter_map(|&head| variable(place(head))).map(|head| (head, stratum)));
        }
        let mut strata: BTreeMap<u32, Stratum> = BTreeMap::new();
        for (op, number) in axioms {
            let Some(head) = op.adds.first().and_then(|&head| variable(place(head))) else { continue };
            let (mut own, mut positive, mut negative, mut possible) = (Vec::new(), Vec::new(), Vec::new(), true);
            for &fact in &op.preconditions {
                match place(fact) {
                    Place::At(a) if stratum_of.get(&a.variable) == Some(&number) => own.push(a.variable),
                    Place::At(assignment) => positive.push(assignment),
                    Place::Always => {}
                    Place::Never => possible = false,
                }
            }
            for &fact in &op.negative {
                match place(fact) {
                    Place::At(assignment) => negative.push(assignment),
                    Place::Always => possible = false,
                    Place::Never => {}
                }
            }
            if !possible {
                continue;
            }
            let stratum = strata.entry(number).or_default();
            for &variable in &own {
                stratum.waiting.entry(variable).or_default().push(stratum.axioms.len());
            }
            stratum.axioms.push(GroundAxiom { head, own, positive, negative });
        }
        Self { strata: strata.into_values().collect(), derived: stratum_of.into_keys().collect() }
    }

    /// How many axioms there are.
    pub(crate) fn len(&self) -> usize {
        self.strata.iter().map(|stratum| stratum.axioms.len()).sum()
    }

    /// The axioms, by stratum.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &GroundAxiom> {
        self.strata.iter().flat_map(|stratum| &stratum.axioms)
    }

    /// The variables of derived facts that follow from themselves, or from such.
    pub(crate) fn dependent_on_themselves(&self) -> BTreeSet<u32> {
        let mut left: BTreeSet<u32> = self.derived.iter().copied().collect();
        loop {
            let waiting = self.iter().filter(|axiom| axiom.own.iter().any(|variable| left.contains(variable)));
            let waiting: BTreeSet<u32> = waiting.map(|axiom| axiom.head).collect();
            if waiting.len() == left.len() {
                return left;
            }
            left = waiting;
        }
    }

    /// Replaces the values of derived facts by what follows from the others. Linear in the axioms.
    pub(crate) fn close(&self, values: &mut Values) {
        for &variable in &self.derived {
            values[variable as usize] = FOLLOWS_NOT;
        }
        for stratum in &self.strata {
            let mut missing: Vec<Option<usize>> = Vec::with_capacity(stratum.axioms.len());
            let mut new: Vec<u32> = Vec::new();
            for axiom in &stratum.axioms {
                let decided =
                    axiom.positive.iter().all(|a| a.holds(values)) && !axiom.negative.iter().any(|a| a.holds(values));
                missing.push(decided.then_some(axiom.own.len()));
                if decided && axiom.own.is_empty() {
                    new.push(axiom.head);
                }
            }
            while let Some(head) = new.pop() {
                if std::mem::replace(&mut values[head as usize], FOLLOWS) == FOLLOWS {
                    continue;
                }
                for &waiting in stratum.waiting.get(&head).into_iter().flatten() {
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
}

fn variable(place: Place) -> Option<u32> {
    match place {
        Place::At(assignment) => Some(assignment.variable),
        Place::Always | Place::Never => None,
    }
}
