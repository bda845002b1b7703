//! How an episode went.

use serde::{Deserialize, Serialize};
use typelift_agent::{
    Account, Avoided, Ending, Episode, Failure, GivenUp, LastResorts, Remembered, SeenDone, StepResult, StoppedAt,
    Suspect,
};
use typelift_model::{GroundAtom, GroundCall, Plan, Symbol};
use typelift_plan::Explanation;
use typelift_world::Verdict;

use crate::given_up::notes;
use crate::plan::plan_size;
use crate::text::{Role, Text, count};

/// The account of a task.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AccountView {
    /// The task's name.
    pub task: String,
    /// Whether the goal was seen to hold.
    pub solved: bool,
    /// The [word](Ending::word) for how it ended.
    pub ending: String,
    /// Why it was not solved, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
    /// Why there was nothing left to try, as data.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reasons: Option<Explanation<String>>,
    /// What is to be noted about the goal and about what was not imagined, in words.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// What was not imagined since it would have gone too far, where nothing was left to try.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub given_up: Vec<GivenUp>,
    /// Plans proposed, the successful one included.
    pub proposals: u64,
    /// Actions executed, retries included.
    pub actions: u64,
    /// The number of steps of the plan that worked.
    pub plan_length: Option<usize>,
    /// How many of them were imagined.
    pub imagined_steps: Option<usize>,
    /// Seconds spent planning.
    pub planning_seconds: f64,
    /// Nodes expanded by all searches.
    pub expansions: u64,
    /// Ground actions of the largest search.
    pub ground_actions: u64,
    /// What could be given up where nothing else was left, and what became of that.
    pub resorts: LastResorts,
    /// What failed, in order.
    pub failures: Vec<FailureView>,
    /// Steps that were seen to be done although the environment did not say so, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub seen_done: Vec<SeenDone>,
    /// Where it was stopped, if a plan was proposed or being carried out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped_at: Option<StoppedAt>,
    /// What is avoided after the task.
    pub excluded: Vec<ExclusionView>,
}

/// A step that failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FailureView {
    /// The proposal's number, from 1.
    pub proposal: u64,
    /// The step's number in it, from 1.
    pub step: usize,
    /// The name of the action in the model.
    pub action: Symbol,
    /// What the environment was told.
    pub call: GroundCall,
    /// The number of the action among those of the task, from 1, of the last if it was tried again; none if a person
    /// rejected the step.
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
    /// Whether the step was imagined.
    pub imagined: bool,
    /// What is to blame, as far as was known then, and excluded therefore.
    pub suspects: Vec<Suspect>,
}

/// Something that is avoided.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExclusionView {
    /// What.
    #[serde(flatten)]
    pub suspect: Suspect,
    /// The first failure that led to it, in words.
    pub reason: String,
    /// All of them, in order, each once.
    pub reasons: Vec<String>,
    /// How many failures led to it.
    pub count: u64,
}

impl AccountView {
    /// The view of a task's account; `planning_seconds` is what the caller measured.
    pub fn of(task: &str, account: &Account, episode: &Episode, planning_seconds: f64) -> Self {
        let plan = account.plan.as_ref().filter(|_| account.solved());
        let suspects = episode.experience().suspects(episode.instance());
        Self {
            task: task.to_owned(),
            solved: account.solved(),
            ending: account.ending.word().to_owned(),
            why: why_not(account, &account.failures),
            reasons: match &account.ending {
                Ending::NoPlan(explanation) => Some(explanation.clone()),
                _ => None,
            },
            notes: notes(&account.goal_type_mismatches, &account.given_up),
            given_up: account.given_up.clone(),
            proposals: account.proposals,
            actions: account.actions,
            plan_length: plan.map(Plan::len),
            imagined_steps: plan.map(Plan::imagined_steps),
            planning_seconds,
            expansions: account.expansions,
            ground_actions: account.ground_actions,
            resorts: account.resorts.clone(),
            failures: account.failures.iter().map(FailureView::of).collect(),
            seen_done: account.seen_done.clone(),
            stopped_at: account.stopped_at.clone(),
            excluded: suspects
                .into_iter()
                .map(|(suspect, Remembered { reasons, count })| {
                    let reason = reasons.first().cloned().unwrap_or_default();
                    ExclusionView { suspect, reason, reasons, count }
                })
                .collect(),
        }
    }
}

impl FailureView {
    fn of(failure: &Failure) -> Self {
        Self {
            proposal: failure.proposal,
            step: failure.step,
            action: failure.action.clone(),
            call: failure.call.clone(),
            record: failure.record,
            result: failure.result,
            reason: failure.reason.clone(),
            missed: failure.missed.clone(),
            added: failure.added.clone(),
            deleted: failure.deleted.clone(),
            imagined: failure.imagined,
            suspects: failure.suspects.clone(),
        }
    }
}

/// What there is of a task whose environment or planner failed: what was done until then.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BrokenOffView {
    /// The task's name.
    pub task: String,
    /// It is not solved.
    pub solved: bool,
    /// `broken_off`.
    pub ending: &'static str,
    /// What failed, in words.
    pub why: String,
    /// Plans proposed.
    pub proposals: u64,
    /// Actions executed, retries included.
    pub actions: u64,
    /// What failed before, in order.
    pub failures: Vec<FailureView>,
    /// Where it was broken off, if a plan was proposed or being carried out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stopped_at: Option<StoppedAt>,
}

impl BrokenOffView {
    /// The view of a task that was broken off, of which there is this account until then.
    pub fn of(task: &str, why: String, account: &Account) -> Self {
        Self {
            task: task.to_owned(),
            solved: false,
            ending: "broken_off",
            why,
            proposals: account.proposals,
            actions: account.actions,
            failures: account.failures.iter().map(FailureView::of).collect(),
            stopped_at: account.stopped_at.clone(),
        }
    }
}

/// Why the goal was not seen to hold, if it was not, where these failures are told of already.
fn why_not(account: &Account, told: &[Failure]) -> Option<String> {
    Some(match &account.ending {
        Ending::Solved => return None,
        Ending::NoPlan(explanation) if account.avoided.is_empty() => format!("nothing left to try: {explanation}"),
        Ending::NoPlan(explanation) => {
            let mut lines = all_avoided(&account.avoided, told);
            lines.extend(no_longer_avoided(&account.avoided, told));
            format!("nothing left to try without what is excluded:\n  {}\n{explanation}", lines.join("\n  "))
        }
        Ending::Circular => "the plan that is left went as expected before, from this very state, and did not lead to \
                             the goal: something happens besides what the model says"
            .to_owned(),
        Ending::ProposalLimit(n) => format!("gave up after {}", count(*n, "proposal")),
        Ending::Stopped(stop) => match &account.stopped_at {
            None => stop.to_string(),
            Some(stopped_at) => format!("{stop} {}", stopped_place(stopped_at)),
        },
    })
}

/// All that is excluded, each once and in order, with the failures that it follows from.
fn all_avoided(all: &[Avoided], told: &[Failure]) -> Vec<String> {
    let mut found: Vec<(String, Vec<&str>)> = Vec::new();
    for avoided in all {
        for what in excluded_by(avoided, told) {
            let at = found.iter().position(|(known, _)| *known == what).unwrap_or_else(|| {
                found.push((what, Vec::new()));
                found.len() - 1
            });
            let reasons = &mut found[at].1;
            if !reasons.contains(&avoided.reason.as_str()) {
                reasons.push(&avoided.reason);
            }
        }
    }
    let lines = found.into_iter().map(|(what, reasons)| {
        let after: Vec<String> = reasons.iter().flat_map(|reason| after(reason, &what, told)).collect();
        format!("{what}, after {}", after.join(", and "))
    });
    lines.collect()
}

/// What one failure, or one word of a person, has excluded; if nothing is to blame, the very same action.
fn excluded_by(Avoided { reason, by_person, suspects }: &Avoided, told: &[Failure]) -> Vec<String> {
    let by = if *by_person { "by your word: " } else { "" };
    let failure = told.iter().find(|failure| failure.in_words() == *reason);
    match (suspects.is_empty(), failure) {
        (false, _) => suspects.iter().map(|suspect| format!("{by}{suspect}")).collect(),
        (true, Some(failure)) => vec![format!("{by}{} again", failure.call)],
        (true, None) => vec![format!("{by}the same action again")],
    }
}

/// The failures that a reason is of, by their places where they are told already, with the call unless `what` names it.
fn after(reason: &str, what: &str, told: &[Failure]) -> Vec<String> {
    let these = told.iter().filter(|failure| failure.in_words() == reason);
    let at = |failure: &Failure| match failure.call.to_string() {
        call if what.contains(&call) => place(failure),
        call => format!("{}: {call}", place(failure)),
    };
    let places: Vec<String> = these.map(at).collect();
    if places.is_empty() { vec![reason.to_owned()] } else { places }
}

/// What was excluded when it failed and is no longer, since what came later spoke against something else.
fn no_longer_avoided(all: &[Avoided], told: &[Failure]) -> Option<String> {
    let mut dropped: Vec<String> = Vec::new();
    for suspect in told.iter().flat_map(|failure| &failure.suspects) {
        let what = suspect.to_string();
        if !all.iter().any(|avoided| avoided.suspects.contains(suspect)) && !dropped.contains(&what) {
            dropped.push(what);
        }
    }
    (!dropped.is_empty()).then(|| format!("no longer excluded: {}", dropped.join(", ")))
}

/// Where a step failed.
fn place(failure: &Failure) -> String {
    format!("proposal {}, step {}", failure.proposal, failure.step)
}

/// Where an episode was stopped.
fn stopped_place(StoppedAt { proposal, step, steps, call, begun }: &StoppedAt) -> String {
    let step = format!("step {step} of {steps} of proposal {proposal}, {call}");
    match begun {
        true => format!("during {step}: what came of it was not observed"),
        false => format!("before {step}"),
    }
}

/// What the environment reported of a step that was done all the same.
pub(crate) fn although(reported: Verdict) -> String {
    match reported {
        Verdict::TimedOut => "as observed after it timed out".to_owned(),
        reported => format!("although it was reported as: {}", StepResult::Tried(reported).phrase()),
    }
}

/// The account of a task in lines: how it ended, what failed and was excluded, unless that was `told` as it happened, and
/// why it is not solved, which names failures of this task by their places.
pub fn summary(task: &str, account: &Account, planning_ms: u128, told: bool) -> Vec<Text> {
    let mut lines = vec![headline(task, account, planning_ms)];
    lines.extend(failures(account, told));
    if account.resorts.lifted() {
        lines.push(Text::new().plain("  exclusions were lifted, since nothing else was left"));
    }
    if account.resorts.relaxed() {
        let what = "  actions were used although some of their effects held already, since nothing else was left";
        lines.push(Text::new().plain(what));
    }
    let why = why_not(account, &account.failures);
    lines.extend(why.iter().flat_map(|why| why.lines()).map(|line| Text::new().plain(format!("  {line}"))));
    let notes = notes(&account.goal_type_mismatches, &account.given_up).into_iter();
    lines.extend(notes.map(|note| Text::new().plain("  ").with(Role::Warning, "note").plain(format!(": {note}"))));
    lines
}

/// What there is of a task that was broken off, in lines: what was done, what failed, unless that was `told` as it happened, and
/// where it was broken off.
pub fn broken_off(task: &str, account: &Account, planning_ms: u128, told: bool) -> Vec<Text> {
    let head = Text::new().with(Role::Heading, task).plain("  ").with(Role::Bad, "broken off");
    let mut lines = vec![head.plain(format!(": {}", counted(account, planning_ms)))];
    lines.extend(failures(account, told));
    lines.extend(account.stopped_at.iter().map(|at| Text::new().plain(format!("  {}", stopped_place(at)))));
    lines
}

/// What failed, and what was seen to be done although it was reported to fail, unless that was `told`.
fn failures(account: &Account, told: bool) -> Vec<Text> {
    let mut lines = Vec::new();
    for failure in account.failures.iter().filter(|_| !told) {
        let place = place(failure);
        let Failure { reason, missed, added, deleted, .. } = failure;
        let reason = reason.as_ref().map(|reason| format!(" ({reason})")).unwrap_or_default();
        let what = format!("  {}: {}{reason}", failure.call, failure.result.in_words(missed, added, deleted));
        lines.push(Text::new().plain("  ").with(Role::Aside, place).plain(what));
        lines.extend(failure.suspects.iter().map(|suspect| Text::new().plain(format!("    excluded {suspect}"))));
    }
    for SeenDone { proposal, step, call, reported, reason } in account.seen_done.iter().filter(|_| !told) {
        let place = format!("proposal {proposal}, step {step}");
        let reason = reason.as_ref().map(|reason| format!(" ({reason})")).unwrap_or_default();
        let what = format!("  {call}: done, {}{reason}", although(*reported));
        lines.push(Text::new().plain("  ").with(Role::Aside, place).plain(what));
    }
    lines
}

fn counted(account: &Account, planning_ms: u128) -> String {
    let (proposals, actions) = (count(account.proposals, "proposal"), count(account.actions, "action"));
    format!("{proposals}, {actions} executed, planned in {planning_ms} ms")
}

fn headline(task: &str, account: &Account, planning_ms: u128) -> Text {
    let counted = counted(account, planning_ms);
    let line = Text::new().with(Role::Heading, task).plain("  ");
    match &account.plan {
        Some(plan) if account.solved() && account.proposals == 0 && plan.is_empty() => {
            line.with(Role::Good, "solved").plain(": the goal held already")
        }
        Some(plan) if account.solved() => {
            line.with(Role::Good, "solved").plain(format!(": {}, {counted}", plan_size(plan)))
        }
        _ => line.with(Role::Bad, "not solved").plain(format!(": {counted}")),
    }
}

#[cfg(test)]
mod tests {
    use typelift_plan::Exclusion;

    use super::*;

    fn avoiding(reason: &str, suspects: Vec<Suspect>) -> Avoided {
        Avoided { reason: reason.to_owned(), by_person: false, suspects }
    }

    fn suspect(object: &str) -> Suspect {
        Suspect::Object(Exclusion { object: object.into(), call: Some("weld".into()) })
    }

    /// Welding this failed in this proposal, and this was blamed for it then.
    fn failure(proposal: u64, object: &str, blamed: &str) -> Failure {
        Failure {
            proposal,
            step: 2,
            action: "weld".into(),
            call: GroundCall { name: "weld".into(), args: vec![object.into()] },
            record: None,
            result: StepResult::Tried(Verdict::Refused),
            reason: Some("no gas".to_owned()),
            missed: Vec::new(),
            added: Vec::new(),
            deleted: Vec::new(),
            imagined: false,
            suspects: vec![suspect(blamed)],
        }
    }

    #[test]
    fn what_is_excluded_twice_is_said_once() {
        let all = ["weld(a): \"no gas\"", "weld(b): \"no gas\"", "weld(a): \"no gas\""];
        assert_eq!(
            all_avoided(&all.map(|reason| avoiding(reason, Vec::new())), &[]),
            ["the same action again, after weld(a): \"no gas\", and weld(b): \"no gas\""]
        );
    }

    #[test]
    fn what_is_excluded_now_is_said_with_the_places_of_the_failures_that_were_told() {
        let told = [failure(1, "rod_1", "rod_1"), failure(2, "rod_2", "torch_1"), failure(4, "rod_1", "torch_1")];
        let of = |failure: &Failure, object: &str| avoiding(&failure.in_words(), vec![suspect(object)]);
        let earlier = avoiding("weld(rod_9): \"no power\"", vec![suspect("torch_1"), suspect("socket_1")]);
        let all = [of(&told[0], "torch_1"), of(&told[1], "torch_1"), of(&told[2], "torch_1"), earlier];
        assert_eq!(
            all_avoided(&all, &told),
            [
                "torch_1 from weld, after proposal 1, step 2: weld(rod_1), and proposal 4, step 2: weld(rod_1), and \
                 proposal 2, step 2: weld(rod_2), and weld(rod_9): \"no power\"",
                "socket_1 from weld, after weld(rod_9): \"no power\"",
            ]
        );
        assert_eq!(no_longer_avoided(&all, &told), Some("no longer excluded: rod_1 from weld".to_owned()));
        assert_eq!(no_longer_avoided(&[of(&told[0], "rod_1"), of(&told[1], "torch_1")], &told), None);
    }
}
