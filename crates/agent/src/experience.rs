//! What failed, remembered from task to task of one run.

use std::collections::BTreeMap;

use typelift_plan::{Ban, Exclusion, Restrictions};

/// Why something is avoided, and how often that was seen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remembered {
    /// The failure that led to it, in words.
    pub reason: String,
    /// How many failures led to it.
    pub count: u64,
}

/// Objects and ground actions to avoid, with the reasons.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Experience {
    exclusions: BTreeMap<Exclusion, Remembered>,
    bans: BTreeMap<Ban, Remembered>,
}

impl Experience {
    /// Nothing experienced yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Excludes an object.
    pub fn exclude(&mut self, exclusion: Exclusion, reason: &str) {
        note(&mut self.exclusions, exclusion, reason);
    }

    /// Bans a ground action.
    pub fn ban(&mut self, ban: Ban, reason: &str) {
        note(&mut self.bans, ban, reason);
    }

    /// Forgets the exclusions of another experience; bans stay.
    pub fn lift_exclusions_of(&mut self, other: &Self) {
        self.exclusions.retain(|exclusion, _| !other.exclusions.contains_key(exclusion));
    }

    /// Excluded objects, with the reasons.
    pub fn exclusions(&self) -> impl Iterator<Item = (&Exclusion, &Remembered)> {
        self.exclusions.iter()
    }

    /// Banned ground actions, with the reasons.
    pub fn bans(&self) -> impl Iterator<Item = (&Ban, &Remembered)> {
        self.bans.iter()
    }

    /// The same as a planner is told.
    pub fn restrictions(&self) -> Restrictions {
        Restrictions {
            excluded: self.exclusions.keys().cloned().collect(),
            banned: self.bans.keys().cloned().collect(),
        }
    }
}

fn note<K: Ord>(map: &mut BTreeMap<K, Remembered>, key: K, reason: &str) {
    map.entry(key).or_insert_with(|| Remembered { reason: reason.to_owned(), count: 0 }).count += 1;
}
