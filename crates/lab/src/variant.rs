//! The four variants of the paper's evaluation.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift::agent::Options;
use typelift::{imagine, plan};

/// What is learned from the demonstrations, and whether more is imagined. In the order of the paper's table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Variant {
    /// Both algorithms.
    #[serde(rename = "generalized+imagined")]
    GeneralizedImagined,
    /// Generalized actions, as learned (Algorithm 1).
    #[serde(rename = "generalized")]
    Generalized,
    /// Individual actions, and what is imagined from them (Algorithm 2).
    #[serde(rename = "individual+imagined")]
    IndividualImagined,
    /// Individual actions: the baseline.
    #[serde(rename = "individual")]
    Individual,
}

impl Variant {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::GeneralizedImagined, Self::Generalized, Self::IndividualImagined, Self::Individual];

    /// Its name in the paper.
    pub const fn name(self) -> &'static str {
        match self {
            Self::GeneralizedImagined => "generalized+imagined",
            Self::Generalized => "generalized",
            Self::IndividualImagined => "individual+imagined",
            Self::Individual => "individual",
        }
    }

    /// Whether learning stops at individual actions.
    pub const fn individual(self) -> bool {
        matches!(self, Self::IndividualImagined | Self::Individual)
    }

    /// Whether actions are imagined.
    pub const fn imagines(self) -> bool {
        matches!(self, Self::GeneralizedImagined | Self::IndividualImagined)
    }

    /// The variant of this name.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|variant| variant.name() == name)
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// How an episode goes about its task in the paper's experiments: with the paper's search alone, and after a failure the world
/// is set back.
pub fn paper_options(imagine: bool) -> Options {
    let plan = plan::Options { strategy: plan::Strategy::OrderedLandmarks, ..plan::Options::default() };
    Options { imagine: imagine.then(imagine::Options::default), plan, restart: true, risk: 0, ..Options::default() }
}
