//! SplitMix64, a small generator of pseudo-random numbers: a seed means the same numbers on every machine and in every
//! version. Steele, Lea and Flood, *Fast Splittable Pseudorandom Number Generators*, OOPSLA 2014; the constants are
//! Vigna's, as in his public `splitmix64.c`.

/// The step between two states: 2^64 divided by the golden ratio, made odd.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// A stream of pseudo-random numbers. It is no source of secrets.
#[derive(Debug, Clone)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// The stream of a seed.
    pub const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next number.
    pub const fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        mix(self.state)
    }

    /// A number below `bound`, and 0 if the bound is 0. No number is more frequent than another by more than
    /// `bound` in 2^64.
    pub fn below(&mut self, bound: usize) -> usize {
        ((u128::from(self.next_u64()) * bound as u128) >> 64) as usize
    }

    /// Puts the elements in a random order (Fisher and Yates).
    pub fn shuffle<T>(&mut self, elements: &mut [T]) {
        for end in (1..elements.len()).rev() {
            elements.swap(end, self.below(end + 1));
        }
    }
}

/// The number at this place of the stream of seed 0, where the first stands at place 1: numbers near each other become
/// numbers that have nothing to do with each other, and different ones stay different.
pub const fn spread(number: u64) -> u64 {
    mix(number.wrapping_mul(STEP))
}

const fn mix(state: u64) -> u64 {
    let mut bits = state;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first_five(seed: u64) -> [u64; 5] {
        let mut random = SplitMix64::new(seed);
        std::array::from_fn(|_| random.next_u64())
    }

    /// What `splitmix64.c` prints.
    #[test]
    fn the_published_numbers() {
        let of_zero = [
            0xe220_a839_7b1d_cdaf,
            0x6e78_9e6a_a1b9_65f4,
            0x06c4_5d18_8009_454f,
            0xf88b_b8a8_724c_81ec,
            0x1b39_896a_51a8_749b,
        ];
        assert_eq!(first_five(0), of_zero);
        assert_eq!([1, 2, 3, 4, 5].map(spread), of_zero);
        let of_1234567 = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!(first_five(1_234_567), of_1234567);
    }

    #[test]
    fn numbers_stay_below_their_bound_and_reach_every_one() {
        let mut random = SplitMix64::new(1);
        let mut seen = [0; 7];
        for _ in 0..700 {
            seen[random.below(7)] += 1;
        }
        assert!(seen.iter().all(|count| (60..140).contains(count)), "{seen:?}");
        assert_eq!((random.below(1), random.below(0)), (0, 0));
    }

    #[test]
    fn shuffling_permutes() {
        let mut numbers: Vec<u32> = (0..20).collect();
        SplitMix64::new(3).shuffle(&mut numbers);
        assert_ne!(numbers, (0..20).collect::<Vec<_>>());
        numbers.sort_unstable();
        assert_eq!(numbers, (0..20).collect::<Vec<_>>());
    }
}
