//! How planning ended.

use typelift_model::{Plan, Stop};

/// How planning ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// With a plan.
    Solved(Plan),
    /// Everything that the model allows was searched: there is no plan.
    Unsolvable,
    /// Everything that the search kept was searched: it holds no further plan.
    NoMorePlans,
    /// The budget ended it.
    Stopped(Stop),
}

impl Outcome {
    /// The word for it wherever a program reads it. There being no more plans has the same word as there being none at
    /// all: a program that was given plans can tell the two apart.
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
