//! How planning ended.

use typelift_model::{Plan, Stop};

/// How planning ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// With a plan.
    Solved(Plan),
    /// All that the model allows was searched, and nothing cut off: there is no plan.
    Unsolvable,
    /// All that was kept was searched: there is no further plan among it.
    NoMorePlans,
    /// The budget ended it.
    Stopped(Stop),
}

impl Outcome {
    /// The word for it wherever a program reads it. That there are no more plans is the same word as that there is none:
    /// whoever has plans knows.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Solved(_) => "solved",
            Self::Unsolvable | Self::NoMorePlans => "unsolvable",
            Self::Stopped(stop) => stop.word(),
        }
    }
}

impl From<Stop> for Outcome {
    fn from(stop: Stop) -> Self {
        Self::Stopped(stop)
    }
}
