//! How new a state is (Lipovetzky and Geffner, *Width and serialization of classical planning problems*, ECAI 2012).
//!
//! What was seen is kept in one table of bits, by a hash: where two things fall together, a state may pass for less new than
//! it is (Singh, Lipovetzky, Ramirez and Segovia-Aguas, *Approximate novelty search*, ICAPS 2021).

use crate::fdr::{Fdr, Values};

/// The most bits of the table, 16 MiB.
const MOST_BITS: u64 = 1 << 27;

/// The size of the smallest set of facts that holds for the first time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Novelty {
    /// A fact.
    Fact,
    /// A pair of facts, but no fact.
    Pair,
    /// Neither.
    None,
}

/// The facts and pairs of facts that held in some state, apart for each class of states.
#[derive(Debug)]
pub(crate) struct SeenFacts {
    bits: Vec<u64>,
    /// The bits of a hash that are not used.
    shift: u32,
    held: Vec<u32>,
    changed: Vec<u32>,
}

impl SeenFacts {
    /// Nothing seen yet, in a table that suits the task.
    pub(crate) fn new(task: &Fdr) -> Self {
        let facts = task.fact_count() as u64;
        let bits = (16 * facts * facts).clamp(64, MOST_BITS).next_power_of_two();
        let words = vec![0; (bits / 64) as usize];
        Self { bits: words, shift: u64::BITS - bits.ilog2(), held: Vec::new(), changed: Vec::new() }
    }

    /// How new a state is in its class, whose facts are seen from now on. If the state before it is of the same class, only
    /// what the two differ in can be new. The work grows with the facts that hold, times those that may be new.
    pub(crate) fn look_at(&mut self, task: &Fdr, class: u64, values: &Values, before: Option<&Values>) -> Novelty {
        let (mut held, mut changed) = (std::mem::take(&mut self.held), std::mem::take(&mut self.changed));
        held.clear();
        held.extend(task.held(values));
        changed.clear();
        match before {
            Some(before) => changed.extend(task.gained(before, values)),
            None => changed.extend_from_slice(&held),
        }
        let mut novelty = Novelty::None;
        for &fact in &changed {
            for &other in &held {
                let (one, two) = (fact.min(other), fact.max(other));
                if self.is_first(class, one, two) {
                    novelty = novelty.min(if one == two { Novelty::Fact } else { Novelty::Pair });
                }
            }
        }
        (self.held, self.changed) = (held, changed);
        novelty
    }

    /// Whether it sees these two, or one if they are the same, in the class for the first time.
    fn is_first(&mut self, class: u64, one: u32, two: u32) -> bool {
        let pair = u64::from(one) << 32 | u64::from(two);
        // Fibonacci hashing, once for the class, once for the pair.
        let mixed = (class.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ pair).wrapping_mul(0xD6E8_FEB8_6659_FD93);
        let place = (mixed ^ mixed >> 32).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> self.shift;
        let (word, bit) = (&mut self.bits[(place / 64) as usize], 1 << (place % 64));
        let is_first = *word & bit == 0;
        *word |= bit;
        is_first
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worked::Worked;

    #[test]
    fn a_fact_then_a_pair_then_nothing() {
        let worked = Worked::new(
            "init: a c
             goal: d
             ab: a -> b !a
             ba: b -> a !b
             cd: c -> d !c
             dc: d -> c !d",
        );
        let mut seen = SeenFacts::new(&worked.fdr);
        let mut novelty = |class, now: &str, before: Option<&str>| {
            let before = before.map(|before| worked.values_of(before));
            seen.look_at(&worked.fdr, class, &worked.values_of(now), before.as_deref())
        };
        assert_eq!(novelty(1, "a c", None), Novelty::Fact);
        assert_eq!(novelty(1, "b c", Some("a c")), Novelty::Fact);
        assert_eq!(novelty(1, "a d", Some("a c")), Novelty::Fact);
        // Both were seen, but not together.
        assert_eq!(novelty(1, "b d", Some("a d")), Novelty::Pair);
        assert_eq!(novelty(1, "a c", Some("b c")), Novelty::None);
        // In another class everything is new.
        assert_eq!(novelty(2, "a c", None), Novelty::Fact);
    }
}
