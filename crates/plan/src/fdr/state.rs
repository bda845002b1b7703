//! States, packed into an arena, each once.

use std::hash::BuildHasher;

use hashbrown::HashTable;

use super::Values;

/// A state of one [`Registry`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct StateId(u32);

impl StateId {
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// Where a variable stands in a packed state.
#[derive(Debug, Clone, Copy)]
struct Field {
    word: u32,
    shift: u32,
    mask: u64,
}

/// Packed states: each takes a fixed number of 64-bit words, in which a variable of n values takes log2(n) bits.
#[derive(Debug)]
pub(crate) struct Registry {
    fields: Vec<Field>,
    words: usize,
    arena: Vec<u64>,
    table: HashTable<u32>,
    buffer: Vec<u64>,
}

impl Registry {
    /// No states yet, of variables with so many values.
    pub(crate) fn new(domains: &[u32]) -> Self {
        let mut order: Vec<usize> = (0..domains.len()).collect();
        let bits = |variable: usize| 32 - (domains[variable] - 1).leading_zeros();
        order.sort_by_key(|&variable| std::cmp::Reverse(bits(variable)));
        let mut fields = vec![Field { word: 0, shift: 0, mask: 0 }; domains.len()];
        let (mut word, mut used) = (0, 0);
        for variable in order {
            let bits = bits(variable);
            if used + bits > 64 {
                (word, used) = (word + 1, 0);
            }
            fields[variable] = Field { word, shift: used, mask: (1 << bits) - 1 };
            used += bits;
        }
        let words = word as usize + 1;
        Self { fields, words, arena: Vec::new(), table: HashTable::new(), buffer: vec![0; words] }
    }

    /// The state with these values, and whether it is new.
    pub(crate) fn insert(&mut self, values: &Values) -> (StateId, bool) {
        self.buffer.fill(0);
        for (field, &value) in self.fields.iter().zip(values) {
            self.buffer[field.word as usize] |= u64::from(value) << field.shift;
        }
        let (arena, words, buffer) = (&self.arena, self.words, &self.buffer);
        let state = |id: u32| &arena[id as usize * words..][..words];
        let entry = self.table.entry(hash(buffer), |&id| state(id) == buffer.as_slice(), |&id| hash(state(id)));
        match entry {
            hashbrown::hash_table::Entry::Occupied(known) => (StateId(*known.get()), false),
            hashbrown::hash_table::Entry::Vacant(vacant) => {
                let id = (self.arena.len() / self.words) as u32;
                vacant.insert(id);
                self.arena.extend_from_slice(&self.buffer);
                (StateId(id), true)
            }
        }
    }

    /// Writes a state's values.
    pub(crate) fn unpack(&self, id: StateId, values: &mut Values) {
        let state = &self.arena[id.index() * self.words..][..self.words];
        for (field, value) in self.fields.iter().zip(values) {
            *value = (state[field.word as usize] >> field.shift & field.mask) as u32;
        }
    }
}

fn hash(words: &[u64]) -> u64 {
    rustc_hash::FxBuildHasher.hash_one(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_kept_once_and_comes_back_as_it_was() {
        let domains = [2, 1000, 5, 2, 70_000, 2, 3, 1 << 30, 4];
        let mut registry = Registry::new(&domains);
        let states: Vec<Vec<u32>> =
            (0..50_u32).map(|i| domains.iter().map(|size| i.wrapping_mul(2_654_435_761) % size).collect()).collect();
        let ids: Vec<StateId> = states.iter().map(|state| registry.insert(state).0).collect();
        for (state, id) in states.iter().zip(ids) {
            assert_eq!(registry.insert(state), (id, false));
            let mut values = vec![0; domains.len()];
            registry.unpack(id, &mut values);
            assert_eq!(&values, state);
        }
        assert_eq!(registry.arena.len(), 50 * registry.words);
    }
}
