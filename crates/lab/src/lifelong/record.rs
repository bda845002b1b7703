//! What is kept of a life.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift::agent::Explanation;
use typelift::model::Symbol;
use typelift_kitchen::{Exception, Fault, Interlock};

use super::mistake::UNLIKELY;
use super::truth::Truth;

/// What came of a life.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LifeRecord {
    /// The pairs of a food and a tool that do not go together.
    pub exceptions: Vec<Exception>,
    /// The hidden rule.
    pub interlock: Interlock,
    /// Its tasks, in order.
    pub tasks: Vec<TaskRecord>,
    /// How true it was along the life what was thought to work, if somebody with a memory lived it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub truth: Vec<Truth>,
}

/// What came of a task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TaskRecord {
    /// The task.
    pub task: String,
    /// How it ended.
    pub ending: String,
    /// Plans that were carried out, the last one included.
    pub proposals: u64,
    /// Actions executed, retries included.
    pub actions: u64,
    /// The tool that broke just before it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub newly_broken: Option<Symbol>,
    /// The steps that failed, each retry one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<FailedStep>,
}

impl TaskRecord {
    /// Whether the goal was seen to hold.
    pub fn solved(&self) -> bool {
        self.ending == "solved"
    }
}

/// A step that did not become what was expected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FailedStep {
    /// The call.
    pub call: String,
    /// The action that was expected of it.
    pub action: String,
    /// Why, in truth.
    pub cause: TrueCause,
    /// Whether it was tried again just after it had failed.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub retry: bool,
    /// How likely it was thought to work, if somebody with a memory took it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p: Option<f64>,
    /// How likely another plan was thought to work, if the step was thought unlikely to, and a plan likelier than this one was
    /// found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub better: Option<f64>,
    /// What explained it, just after it counted as a failure, the likeliest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub explanations: Vec<Explanation>,
}

impl FailedStep {
    /// Whether it is a mistake repeated: it was thought unlikely to work, and there was a better plan; retries apart.
    pub fn is_repeated_mistake(&self) -> bool {
        !self.retry && self.p.is_some_and(|p| p < UNLIKELY) && self.better.is_some()
    }
}

/// Why a step failed, in truth.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(untagged)]
pub enum TrueCause {
    /// It changed nothing.
    Fault(Fault),
    /// It changed something else than was expected, by the kitchen's rules.
    Effect(OtherEffect),
}

/// That something else happened than was expected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OtherEffect {
    /// Some of it, or nothing of it.
    OtherEffect,
}

impl TrueCause {
    /// Of what kind it is, in words.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Fault(Fault::Broken { .. }) => "a broken tool",
            Self::Fault(Fault::Interlock(_)) => "the hidden rule",
            Self::Fault(Fault::Exception(_)) => "an exception",
            Self::Fault(Fault::Rule { of_types: true, .. }) => "a rule of the kitchen: types",
            Self::Fault(Fault::Rule { .. }) => "a rule of the kitchen: state",
            Self::Effect(_) => "another effect",
        }
    }

    /// All kinds.
    pub const KINDS: [&'static str; 6] = [
        "a broken tool",
        "the hidden rule",
        "an exception",
        "a rule of the kitchen: types",
        "a rule of the kitchen: state",
        "another effect",
    ];
}

impl fmt::Display for TrueCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fault(fault) => fault.fmt(f),
            Self::Effect(_) => f.write_str("something else happened"),
        }
    }
}
