//! Whether to try a step that failed once more: as long as that may help.

use serde::{Deserialize, Serialize};

/// How often it helped to try again what had failed, and how often not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct Retries {
    /// Steps that worked when they were tried again.
    helped: u64,
    /// Steps that failed again.
    in_vain: u64,
}

/// Of ten failures one is thought to be chance at first, and that counts as five failures do.
const CHANCE: f64 = 0.1;
const THOUGHT: f64 = 5.0;
/// Trying again is worth it if it helps so often.
const WORTH_IT: f64 = 0.05;

impl Retries {
    /// Notes what became of a step that was tried more than once.
    pub(crate) fn note(&mut self, helped: bool) {
        match helped {
            true => self.helped += 1,
            false => self.in_vain += 1,
        }
    }

    /// Whether it may help to try again what failed: until it was five times in vain, and then for as long as one time in twenty
    /// it is not.
    pub(crate) fn may_help(self) -> bool {
        let (helped, in_vain) = (self.helped as f64, self.in_vain as f64);
        (helped + CHANCE * THOUGHT) / (helped + in_vain + THOUGHT) > WORTH_IT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_never_helps_is_left() {
        let after = |helped, in_vain| Retries { helped, in_vain }.may_help();
        assert_eq!([0, 4, 5, 6].map(|in_vain| after(0, in_vain)), [true, true, false, false]);
        assert_eq!([5, 23, 24].map(|in_vain| after(1, in_vain)), [true, true, false], "it helped once");
    }
}
