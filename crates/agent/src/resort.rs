//! What is given up, one thing after the other, where there is no plan.
//!
//! Without restart, the agent says that nothing is left to try only after all of them, in this order: strictness is given up,
//! exclusions that are guesses are lifted, then those inherited from earlier tasks, then this task's own. Ground actions that
//! failed stay banned throughout, until in the end they may be tried where what held around them then does not. What a
//! person objected to is not lifted. The account says what became of each.

use serde::{Deserialize, Serialize};

/// Which exclusions count. Bans always do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CountedExclusions {
    /// All.
    All,
    /// Those that are more than guesses, and those that a person asked for.
    Likely,
    /// Those that failures in the current task led to, and those that a person asked for.
    OfThisTask,
    /// Those that a person asked for.
    None,
    /// Those that a person asked for; and what failed may be tried again in other circumstances.
    Elsewhere,
}

/// What may be given up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Resort {
    /// What was excluded as a guess may be used, from then on.
    GuessedExclusions,
    /// What was excluded in earlier tasks may be used, from then on.
    EarlierExclusions,
    /// Actions may be used although some of what they add holds already, for one proposal.
    Strictness,
    /// Whatever was excluded may be used, from then on. Ground actions that failed stay banned.
    AllExclusions,
    /// A ground action that failed may be tried where what held around it then does not, from then on.
    Bans,
}

impl Resort {
    /// A short phrase for what is given up.
    pub fn phrase(self) -> &'static str {
        match self {
            Self::GuessedExclusions => "exclusions that are guesses are lifted",
            Self::EarlierExclusions | Self::AllExclusions => "exclusions are lifted",
            Self::Strictness => "effects may hold already",
            Self::Bans => "what failed may be tried elsewhere",
        }
    }
}

/// What became of a resort.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ResortState {
    /// It was not needed, or does not apply.
    Untried,
    /// It was tried and led to no proposal: there was no plan either, none but what was in vain before, or no time for one.
    InVain,
    /// It led to a proposal: the number of the first that rests on it.
    Taken(u64),
}

/// A resort, and what became of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LastResort {
    /// The resort.
    pub resort: Resort,
    /// What became of it.
    pub state: ResortState,
}

/// The resorts of an episode, in the order in which they are tried.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct LastResorts(Vec<LastResort>);

impl Default for LastResorts {
    fn default() -> Self {
        let untried = |resort| LastResort { resort, state: ResortState::Untried };
        let all = [
            Resort::Strictness,
            Resort::GuessedExclusions,
            Resort::EarlierExclusions,
            Resort::AllExclusions,
            Resort::Bans,
        ];
        Self(all.map(untried).to_vec())
    }
}

impl LastResorts {
    /// The resorts in order.
    pub fn iter(&self) -> impl Iterator<Item = &LastResort> {
        self.0.iter()
    }

    /// Whether this one led to a plan.
    pub fn is_taken(&self, resort: Resort) -> bool {
        self.0.iter().any(|last| last.resort == resort && matches!(last.state, ResortState::Taken(_)))
    }

    /// Whether exclusions were lifted.
    pub fn lifted(&self) -> bool {
        [Resort::EarlierExclusions, Resort::AllExclusions, Resort::Bans].into_iter().any(|resort| self.is_taken(resort))
    }

    /// Whether some plan was made without strictness, although it was asked for.
    pub fn relaxed(&self) -> bool {
        self.is_taken(Resort::Strictness)
    }

    /// Which exclusions count, with what was given up so far.
    pub(crate) fn counted(&self) -> CountedExclusions {
        if self.is_taken(Resort::Bans) {
            CountedExclusions::Elsewhere
        } else if self.is_taken(Resort::AllExclusions) {
            CountedExclusions::None
        } else if self.is_taken(Resort::EarlierExclusions) {
            CountedExclusions::OfThisTask
        } else if self.is_taken(Resort::GuessedExclusions) {
            CountedExclusions::Likely
        } else {
            CountedExclusions::All
        }
    }

    /// Notes whether a resort led to a proposal, with its number. What was taken once stays taken.
    pub(crate) fn tried(&mut self, resort: Resort, proposal: Option<u64>) {
        let found = self.0.iter_mut().filter(|last| last.resort == resort);
        for last in found.filter(|last| !matches!(last.state, ResortState::Taken(_))) {
            last.state = proposal.map_or(ResortState::InVain, ResortState::Taken);
        }
    }
}
