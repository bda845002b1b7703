//! Numbers that look random and are not: the same seed gives the same order.

use typelift_model::spread;

/// Brings lists into an order that depends on its seed and on how many came before.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shuffler {
    state: u64,
}

impl Shuffler {
    pub(crate) fn new(seed: u64) -> Self {
        Self { state: spread(seed) }
    }

    pub(crate) fn shuffle<T>(&mut self, list: &mut [T]) {
        for end in (1..list.len()).rev() {
            self.state = self.state.wrapping_add(1);
            list.swap(end, (spread(self.state) % (end as u64 + 1)) as usize);
        }
    }
}
