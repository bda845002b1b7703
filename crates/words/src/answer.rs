//! The answer to a planning question: how the search ended, the plans, and why there is none.

use serde::Serialize;
use typelift_agent::{GivenUp, Proposal};
use typelift_model::{Plan, Stop, Symbol};
use typelift_plan::{Explanation, Outcome};

use crate::given_up::notes;
use crate::plan::PlanView;

/// The answer to a planning question.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AnswerView {
    /// `solved` if there is a plan; else the [word](Outcome::word) for how the search ended.
    pub outcome: &'static str,
    /// The plans, in the order in which they were found.
    pub plans: Vec<PlanView>,
    /// The names of the actions that were imagined, whether a plan uses them or not.
    pub imagined_actions: Vec<Symbol>,
    /// Ground actions.
    pub ground_actions: u64,
    /// Nodes expanded.
    pub expansions: u64,
    /// Nodes evaluated by heuristics.
    pub evaluations: u64,
    /// Bytes that were held in the end, beyond what was held before.
    pub bytes: u64,
    /// Seconds from when all was read.
    pub seconds: f64,
    /// Why there is no plan, a line for each reason; only where everything was searched.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub explanation: Option<String>,
    /// The same as data.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reasons: Option<Explanation<String>>,
    /// What is to be noted about the goal and about what was not imagined, in words.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// What was not imagined since it would have gone too far, where there is no plan.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub given_up: Vec<GivenUp>,
}

impl AnswerView {
    /// The answer of a proposal that has given these plans, and then ended in `last`. Memory and
    /// time are what the caller measured.
    pub fn of(proposal: &Proposal, plans: &[Plan], last: &Outcome, bytes: u64, seconds: f64) -> Self {
        let report = proposal.report();
        let explanation = plans.is_empty().then(|| why_none(proposal, last)).flatten();
        let mut mismatches = proposal.goal_type_mismatches();
        // Where there is a plan, only what never holds, and need not be asked not to, is to be noted.
        mismatches.retain(|mismatch| explanation.is_some() || !plans.is_empty() && !mismatch.positive);
        let given_up: Vec<GivenUp> = explanation.iter().flat_map(|_| proposal.imagination.given_up.clone()).collect();
        Self {
            outcome: if plans.is_empty() { last.word() } else { "solved" },
            plans: plans.iter().map(|plan| PlanView::of(plan, &proposal.model.hierarchy)).collect(),
            imagined_actions: proposal.imagination.actions.iter().map(|action| action.name.clone()).collect(),
            ground_actions: report.ground_actions,
            expansions: report.expansions,
            evaluations: report.evaluations,
            bytes,
            seconds,
            notes: notes(&mismatches, &given_up),
            given_up,
            explanation: explanation.as_ref().map(Explanation::to_string),
            reasons: explanation,
        }
    }

    /// The answer where the budget ended planning before the search began.
    pub fn stopped(stop: Stop, seconds: f64) -> Self {
        Self { outcome: stop.word(), seconds, ..Self::default() }
    }
}

/// Why a proposal that ended so has no plan; of a search that was ended early nothing can be said.
pub fn why_none(proposal: &Proposal, last: &Outcome) -> Option<Explanation<String>> {
    matches!(last, Outcome::Unsolvable | Outcome::NoMorePlans).then(|| proposal.explain())
}

/// Why a search went no further, in words.
pub fn ending(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Solved(_) => "found".to_owned(),
        Outcome::Unsolvable | Outcome::NoMorePlans => "everything was searched".to_owned(),
        Outcome::Stopped(stop) => stop.to_string(),
    }
}
