//! Subsets of the eight demonstrations, which are numbered from 1 in the paper's order.

use std::fmt;

use serde::{Deserialize, Serialize};

/// How many demonstrations there are.
const ALL: u8 = 8;

/// Some of the demonstrations, by number, ascending. Ordered by size, then by numbers.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "Vec<u8>", into = "Vec<u8>")]
pub struct Subset(Vec<u8>);

impl Subset {
    /// All subsets of this size.
    pub fn of_size(size: usize) -> Vec<Self> {
        let members = |mask: &u32| (1..=ALL).filter(|number| mask >> (number - 1) & 1 == 1).collect();
        let mut subsets: Vec<Self> = (0..1_u32 << ALL).map(|mask| Self(members(&mask))).collect();
        subsets.retain(|subset| subset.len() == size);
        subsets.sort();
        subsets
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether this one is among them.
    pub fn contains(&self, number: u8) -> bool {
        self.0.contains(&number)
    }

    /// With one more.
    #[must_use]
    pub fn with(&self, number: u8) -> Self {
        let mut numbers = self.0.clone();
        numbers.push(number);
        numbers.sort_unstable();
        numbers.dedup();
        Self(numbers)
    }

    /// Those of a list in which everything is in order.
    pub fn choose<T: Clone>(&self, all: &[T]) -> Vec<T> {
        self.0.iter().filter_map(|number| all.get(usize::from(*number).checked_sub(1)?)).cloned().collect()
    }
}

impl Ord for Subset {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.len().cmp(&other.len()).then_with(|| self.0.cmp(&other.0))
    }
}

impl PartialOrd for Subset {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl TryFrom<Vec<u8>> for Subset {
    type Error = String;

    fn try_from(numbers: Vec<u8>) -> Result<Self, String> {
        let ascending = numbers.is_sorted_by(|a, b| a < b);
        if ascending && numbers.iter().all(|number| (1..=ALL).contains(number)) {
            Ok(Self(numbers))
        } else {
            Err(format!("demonstrations are numbers from 1 to {ALL}, ascending"))
        }
    }
}

impl From<Subset> for Vec<u8> {
    fn from(subset: Subset) -> Self {
        subset.0
    }
}

/// `1,3,8`.
impl fmt::Display for Subset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.pad(&numbers.join(","))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_247_of_two_to_eight() {
        let sizes: Vec<usize> = (2..=8).map(|size| Subset::of_size(size).len()).collect();
        assert_eq!(sizes, [28, 56, 70, 56, 28, 8, 1]);
        assert_eq!(sizes.iter().sum::<usize>(), 247);
        let pairs = Subset::of_size(2);
        assert_eq!([&pairs[0], &pairs[1], &pairs[27]].map(ToString::to_string), ["1,2", "1,3", "7,8"]);
    }

    #[test]
    fn members() {
        let subset = Subset::try_from(vec![1, 8]).expect("a subset");
        assert_eq!(subset.choose(&["a", "b", "c", "d", "e", "f", "g", "h"]), ["a", "h"]);
        assert_eq!(subset.with(3).to_string(), "1,3,8");
        assert!(subset.contains(8) && !subset.contains(2));
        for wrong in [vec![0], vec![9], vec![2, 1], vec![1, 1]] {
            assert!(Subset::try_from(wrong).is_err());
        }
    }
}
