//! What is measured, and what came of it.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;
use typelift::model::Stop;

/// What grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Series {
    /// Objects of a kitchen with one of each tool and one plate.
    Storeroom,
    /// Objects of a kitchen in which tools and plates grow with them.
    Kitchens,
    /// Foods that the goal asks for, in one kitchen.
    Goals,
    /// Transitions learned from.
    Transitions,
}

impl Series {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Storeroom, Self::Kitchens, Self::Goals, Self::Transitions];

    /// Its word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Storeroom => "storeroom",
            Self::Kitchens => "kitchens",
            Self::Goals => "goals",
            Self::Transitions => "transitions",
        }
    }

    /// The series of this word.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|series| series.name() == name)
    }
}

/// One size of one series: `storeroom 320`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Point {
    /// What grows.
    pub series: Series,
    /// How many there are of it.
    pub size: u64,
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.series.name(), self.size)
    }
}

/// A text that names no point.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{text}` is no series with a size, as `storeroom:320` is")]
pub struct UnknownPoint {
    /// The text.
    pub text: String,
}

impl FromStr for Point {
    type Err = UnknownPoint;

    fn from_str(text: &str) -> Result<Self, UnknownPoint> {
        let words = text.split_once([' ', ':']);
        let point =
            words.and_then(|(series, size)| Some(Self { series: Series::parse(series)?, size: size.parse().ok()? }));
        point.ok_or_else(|| UnknownPoint { text: text.to_owned() })
    }
}

/// How a measurement ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// With what was to be found.
    Finished,
    /// With no plan: a defect, since there is one.
    NoPlan,
    /// The allowance ended it.
    #[serde(untagged)]
    Stopped(Stop),
}

impl End {
    /// The word that it is written as.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::NoPlan => "no_plan",
            Self::Stopped(stop) => stop.word(),
        }
    }
}

/// What came of measuring one point; what does not apply or was not reached is left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// How it ended.
    pub end: End,
    /// Seconds of planning, or of learning, on a processor.
    pub seconds: f64,
    /// The most memory that the process held, in bytes, the program itself included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak_bytes: Option<u64>,
    /// Ground actions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground_actions: Option<u64>,
    /// Nodes expanded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expansions: Option<u64>,
    /// Steps of the plan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<u64>,
    /// Actions learned.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub actions: Option<u64>,
    /// Individual actions before generalization.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub individual_actions: Option<u64>,
    /// The seconds of learning that grew with each transition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub observing_seconds: Option<f64>,
    /// The size of the model's file, its evidence included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model_bytes: Option<u64>,
}

impl Measurement {
    /// With nothing but how it ended and what it took.
    pub fn new(end: End, seconds: f64) -> Self {
        Self {
            end,
            seconds,
            peak_bytes: None,
            ground_actions: None,
            expansions: None,
            steps: None,
            actions: None,
            individual_actions: None,
            observing_seconds: None,
            model_bytes: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_are_written_as_their_words() {
        for end in [End::Finished, End::NoPlan].into_iter().chain(Stop::ALL.map(End::Stopped)) {
            let written = serde_json::to_string(&end).expect("a word");
            assert_eq!(written, format!("\"{}\"", end.word()));
            assert_eq!(serde_json::from_str::<End>(&written).expect("written so"), end);
        }
        assert!(serde_json::from_str::<End>("\"tired\"").is_err());
    }

    #[test]
    fn points_are_read_as_they_are_written() {
        let point = Point { series: Series::Goals, size: 12 };
        assert_eq!(point.to_string().parse(), Ok(point));
        assert_eq!("goals:12".parse(), Ok(point));
        for wrong in ["", "goals", "goals:x", "shelves:3"] {
            assert!(wrong.parse::<Point>().is_err(), "{wrong}");
        }
    }
}
