//! The account of a task: for people, and as JSON.

use serde::Serialize;
use typelift::agent::{Account, Ending, Episode, Suspect};
use typelift::model::{GroundCall, Plan};

use crate::plan_text::plan_size;
use crate::style::{BAD, DIM, GOOD, HEAD, count};

/// What is printed of a task with `--json`.
#[derive(Serialize)]
pub(crate) struct TaskReport<'a> {
    task: &'a str,
    solved: bool,
    ending: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<String>,
    proposals: u64,
    actions: u64,
    plan_length: Option<usize>,
    imagined_steps: Option<usize>,
    planning_seconds: f64,
    expansions: u64,
    ground_actions: u64,
    failures: Vec<FailureReport>,
    excluded: Vec<ExclusionReport>,
}

/// What is printed of a task with `--json` if its environment or its planner failed: there is no account then.
pub(crate) fn broken_off(task: &str, why: &str) -> String {
    #[derive(Serialize)]
    struct BrokenOff<'a> {
        task: &'a str,
        solved: bool,
        ending: &'static str,
        why: &'a str,
    }
    serde_json::to_string(&BrokenOff { task, solved: false, ending: "broken_off", why }).unwrap_or_default()
}

#[derive(Serialize)]
struct FailureReport {
    proposal: u64,
    step: usize,
    action: String,
    call: GroundCall,
    result: typelift::agent::StepResult,
    reason: Option<String>,
    imagined: bool,
}

#[derive(Serialize)]
struct ExclusionReport {
    #[serde(flatten)]
    suspect: Suspect,
    reason: String,
    count: u64,
}

/// Why the goal was not seen to hold, if it was not.
fn why_not(ending: &Ending) -> Option<String> {
    Some(match ending {
        Ending::Solved => return None,
        Ending::NoPlan(explanation) => format!("nothing left to try: {explanation}"),
        Ending::Circular => "the plan that is left went as expected before, from this very state, and did not lead to the goal: something happens besides what the model says".to_owned(),
        Ending::ProposalLimit(n) => format!("gave up after {}", count(*n, "proposal")),
        Ending::Stopped(stop) => stop.to_string(),
    })
}

/// The account of a task, for people.
pub(crate) fn summary(name: &str, account: &Account, planning_ms: u128) -> String {
    let proposals = count(account.proposals, "proposal");
    let actions = count(account.actions, "action");
    let mut text = match &account.plan {
        Some(plan) if account.solved() && account.proposals == 0 && plan.is_empty() => {
            format!("{HEAD}{name}{HEAD:#}  {GOOD}solved{GOOD:#}: the goal held already\n")
        }
        Some(plan) if account.solved() => format!(
            "{HEAD}{name}{HEAD:#}  {GOOD}solved{GOOD:#}: {}, {proposals}, {actions} executed, planned in {planning_ms} ms\n",
            plan_size(plan)
        ),
        _ => format!(
            "{HEAD}{name}{HEAD:#}  {BAD}not solved{BAD:#}: {proposals}, {actions} executed, planned in {planning_ms} ms\n"
        ),
    };
    for failure in &account.failures {
        let reason = failure.reason.as_ref().map(|reason| format!(" ({reason})")).unwrap_or_default();
        text += &format!(
            "  {DIM}proposal {}, step {}{DIM:#}  {}: {}{reason}\n",
            failure.proposal,
            failure.step,
            failure.call,
            failure.result.phrase()
        );
        for suspect in &failure.suspects {
            text += &format!("    excluded {suspect}\n");
        }
    }
    if account.resorts.lifted() {
        text += "  exclusions were lifted, since nothing else was left\n";
    }
    if account.resorts.relaxed() {
        text += "  actions were used although some of their effects held already, since nothing else was left\n";
    }
    for line in why_not(&account.ending).iter().flat_map(|why| why.lines()) {
        text += &format!("  {line}\n");
    }
    text
}

pub(crate) fn report<'a>(name: &'a str, account: &Account, episode: &Episode, seconds: f64) -> TaskReport<'a> {
    let plan = account.plan.as_ref().filter(|_| account.solved());
    TaskReport {
        task: name,
        solved: account.solved(),
        ending: account.ending.word(),
        why: why_not(&account.ending),
        proposals: account.proposals,
        actions: account.actions,
        plan_length: plan.map(Plan::len),
        imagined_steps: plan.map(|plan| plan.steps.iter().filter(|step| step.imagined.is_some()).count()),
        planning_seconds: seconds,
        expansions: account.expansions,
        ground_actions: account.ground_actions,
        failures: account
            .failures
            .iter()
            .map(|failure| FailureReport {
                proposal: failure.proposal,
                step: failure.step,
                action: failure.action.to_string(),
                call: failure.call.clone(),
                result: failure.result,
                reason: failure.reason.clone(),
                imagined: failure.imagined,
            })
            .collect(),
        excluded: episode
            .experience()
            .suspects(episode.instance())
            .into_iter()
            .map(|(suspect, why)| ExclusionReport { suspect, reason: why.reason, count: why.count })
            .collect(),
    }
}
