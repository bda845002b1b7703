//! Numbers that look random and are not: the same seed gives the same order.

/// A number with its bits spread (SplitMix64's finalizer; Steele, Lea and Flood 2014).
pub(crate) fn spread(number: u64) -> u64 {
    let mut bits = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

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
