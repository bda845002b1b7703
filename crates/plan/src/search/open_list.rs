//! Open lists that alternate between heuristics (Röger and Helmert, *The more, the merrier*, ICAPS 2010), with lists of
//! their own for what preferred actions lead to, which are boosted at progress (Richter and Helmert 2009).
use std::collections::{BTreeMap, VecDeque};

/// How many extra turns the lists of preferred entries get when an estimate improves.
const BOOST: i64 = 1000;

#[derive(Debug)]
struct List<T> {
    /// Which key counts here.
    key: usize,
    preferred_only: bool,
    /// How many turns it had, minus the boosts.
    turns: i64,
    buckets: BTreeMap<u64, VecDeque<T>>,
}

/// Entries under several keys each, first in first out among those of equal keys.
#[derive(Debug)]
pub(crate) struct Alternation<T> {
    lists: Vec<List<T>>,
}

impl<T: Copy> Alternation<T> {
    /// A list for each key, and one for the preferred entries if there are such.
    pub(crate) fn new(keys: usize, prefers: bool) -> Self {
        let kinds = if prefers { &[false, true][..] } else { &[false] };
        let list = |key, preferred_only| List { key, preferred_only, turns: 0, buckets: BTreeMap::new() };
        let lists = (0..keys).flat_map(|key| kinds.iter().map(move |&preferred_only| list(key, preferred_only)));
        Self { lists: lists.collect() }
    }

    /// Adds an entry under all of its keys.
    pub(crate) fn push(&mut self, keys: &[u64], preferred: bool, entry: T) {
        for list in self.lists.iter_mut().filter(|list| preferred || !list.preferred_only) {
            list.buckets.entry(keys[list.key]).or_default().push_back(entry);
        }
    }

    /// Takes the first entry of the list whose turn it is. Its copies in other lists stay there.
    pub(crate) fn pop(&mut self) -> Option<T> {
        let list = self.lists.iter_mut().filter(|list| !list.buckets.is_empty()).min_by_key(|list| list.turns)?;
        list.turns += 1;
        let mut bucket = list.buckets.first_entry()?;
        let entry = bucket.get_mut().pop_front();
        if bucket.get().is_empty() {
            bucket.remove();
        }
        entry
    }

    /// Gives preferred entries more turns.
    pub(crate) fn boost(&mut self) {
        for list in self.lists.iter_mut().filter(|list| list.preferred_only) {
            list.turns -= BOOST;
        }
    }
}
