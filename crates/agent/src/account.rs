//! The account of an episode: what was tried, what failed and was excluded and why, and how it ended.

use serde::{Deserialize, Serialize};
use typelift_imagine::GivenUp;
use typelift_model::{GoalTypeMismatch, GroundAtom, GroundCall, Plan, Stop, Symbol};
use typelift_plan::Explanation;
use typelift_world::Verdict;

use crate::monitor::StepResult;
use crate::resort::LastResorts;
use crate::suspect::Suspect;

/// How an episode ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// The goal was seen to hold.
    Solved,
    /// There is nothing left to try.
    NoPlan(Explanation<String>),
    /// The plan that was left had been carried out from the very same state before, as expected, and did not lead to
    /// the goal: something happens besides what the model says.
    Circular,
    /// The proposals allowed are used up.
    ProposalLimit(u64),
    /// The budget ended planning, or a person the episode.
    Stopped(Stop),
}

impl Ending {
    /// The word for it wherever a program reads it.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::NoPlan(_) => "no_plan",
            Self::Circular => "circular",
            Self::ProposalLimit(_) => "proposal_limit",
            Self::Stopped(stop) => stop.word(),
        }
    }
}

/// A step that failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Failure {
    /// The proposal's number, from 1.
    pub proposal: u64,
    /// The step's number in it, from 1.
    pub step: usize,
    /// The action schema.
    pub action: Symbol,
    /// What the environment was told.
    pub call: GroundCall,
    /// The number of the [record](typelift_world::Record) of it, of the last if it was tried again, which has the states
    /// before and after; none if a person rejected it.
    pub record: Option<u64>,
    /// What came of it.
    pub result: StepResult,
    /// The environment's or the person's reason, if given.
    pub reason: Option<String>,
    /// What was expected of it and did not come about: what was to hold, and after `not` what was to hold no longer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub missed: Vec<String>,
    /// What it added.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub added: Vec<GroundAtom>,
    /// What it deleted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub deleted: Vec<GroundAtom>,
    /// Whether it rests on an imagined action.
    pub imagined: bool,
    /// What is to blame, as far as was known then, and excluded therefore.
    pub suspects: Vec<Suspect>,
}

impl Failure {
    /// The step and what came of it, in words: `wrap(drum_1): "a drum rolls off"`.
    pub fn in_words(&self) -> String {
        let Self { call, result, reason, missed, added, deleted, .. } = self;
        failure_in_words(call, *result, reason.as_deref(), missed, added, deleted)
    }
}

/// A step that failed and what came of it, in words.
pub(crate) fn failure_in_words(
    call: &GroundCall,
    result: StepResult,
    reason: Option<&str>,
    missed: &[String],
    added: &[GroundAtom],
    deleted: &[GroundAtom],
) -> String {
    match (result, reason) {
        (StepResult::Rejected, None) => format!("{call} was rejected"),
        (StepResult::Rejected, Some(reason)) => format!("{call} was rejected: {reason}"),
        (StepResult::Tried(Verdict::Refused), Some(reason)) => format!("{call}: \"{reason}\""),
        (result, Some(reason)) => format!("{call}: {}: \"{reason}\"", result.in_words(missed, added, deleted)),
        (result, None) => format!("{call}: {}", result.in_words(missed, added, deleted)),
    }
}

/// A step that was seen to be done although the environment did not say so.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SeenDone {
    /// The proposal's number, from 1.
    pub proposal: u64,
    /// The step's number in it, from 1.
    pub step: usize,
    /// What the environment was told.
    pub call: GroundCall,
    /// What it reported: a refusal, or nothing in time.
    pub reported: Verdict,
    /// Its reason, if given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The step at which an episode was stopped.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StoppedAt {
    /// The proposal's number, from 1.
    pub proposal: u64,
    /// The step's number in it, from 1.
    pub step: usize,
    /// How many steps it has.
    pub steps: usize,
    /// What the environment was told, or was to be told next.
    pub call: GroundCall,
    /// Whether it was told already: then what came of it is not known.
    pub begun: bool,
}

/// Something that is avoided since a step failed or was rejected, and stands in the way where there is no plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Avoided {
    /// The failure, in words.
    pub reason: String,
    /// Whether a person said so.
    pub by_person: bool,
    /// What is excluded; if nothing, the very same action is not tried again.
    pub suspects: Vec<Suspect>,
}

/// The account of an episode.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Account {
    /// How it ended.
    pub ending: Ending,
    /// Plans proposed, the successful one included (paper: #p).
    pub proposals: u64,
    /// Actions executed, retries included.
    pub actions: u64,
    /// The plan that worked (paper: |p| is its length); for a goal that held already the empty one.
    #[serde(skip)]
    pub plan: Option<Plan>,
    /// What failed, in order.
    pub failures: Vec<Failure>,
    /// Steps that were seen to be done although the environment did not say so, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub seen_done: Vec<SeenDone>,
    /// Where it was stopped, if a plan was proposed or being carried out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped_at: Option<StoppedAt>,
    /// What was avoided where nothing was left to try: first what a person said.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub avoided: Vec<Avoided>,
    /// Nodes expanded by all searches.
    pub expansions: u64,
    /// Ground actions of the largest search.
    pub ground_actions: u64,
    /// What was given up where nothing else was left.
    pub resorts: LastResorts,
    /// Where the goal goes beyond the types of which the model has its predicates, if nothing was left to try.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub goal_type_mismatches: Vec<GoalTypeMismatch>,
    /// What was not imagined since it would have gone too far, if nothing was left to try.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub given_up: Vec<GivenUp>,
}

impl Account {
    /// The account of an episode in which nothing has happened yet.
    pub(crate) fn begun() -> Self {
        Self {
            ending: Ending::Stopped(Stop::Cancelled),
            proposals: 0,
            actions: 0,
            plan: None,
            failures: Vec::new(),
            seen_done: Vec::new(),
            stopped_at: None,
            avoided: Vec::new(),
            expansions: 0,
            ground_actions: 0,
            resorts: LastResorts::default(),
            goal_type_mismatches: Vec::new(),
            given_up: Vec::new(),
        }
    }

    /// Whether the goal was seen to hold.
    pub fn solved(&self) -> bool {
        self.ending == Ending::Solved
    }
}
