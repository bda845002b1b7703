//! What was found in trying an environment.

use serde::Serialize;
use typelift_model::{GroundAtom, GroundCall};
use typelift_world::{BrokenOffAt, Finding, Inspection, Tried};

use crate::text::{Role, Text, count};

/// What a program reads of an environment that was tried.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InspectionView {
    /// What the environment calls itself.
    pub name: String,
    /// Whether it can be reset.
    pub can_reset: bool,
    /// How many entities its first state has.
    pub entities: usize,
    /// The types that entities have.
    pub types: Vec<String>,
    /// The predicates that learning would see.
    pub predicates: Vec<String>,
    /// The actions that were carried out.
    pub tried: Vec<TriedView>,
    /// What is wrong.
    pub findings: Vec<FindingView>,
    /// The request at which it was broken off, if the environment failed, or was stopped, before all was tried.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub broken_off: Option<String>,
}

/// An action that was carried out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TriedView {
    /// The action.
    pub call: GroundCall,
    /// Whether the environment says that it did it.
    pub executed: bool,
    /// Why not, if it says so.
    pub reason: Option<String>,
    /// What it added, without what changes by itself; missing where a state could not be read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub added: Option<Vec<GroundAtom>>,
    /// What it deleted, in the same way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deleted: Option<Vec<GroundAtom>>,
}

/// Something that is wrong.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FindingView {
    /// The request whose answer shows it: `reset`, `observe`, or the action. `state` if all states together do,
    /// `types` if the file of types does.
    pub place: String,
    /// The kind of problem, in one word.
    pub problem: &'static str,
    /// Whether it hurts in any case; otherwise it may be meant.
    pub certain: bool,
    /// What is wrong, in words.
    pub what: String,
    /// What to do about it.
    pub hint: String,
}

impl InspectionView {
    /// The view of what was found in the environment of this name.
    pub fn of(name: &str, can_reset: bool, inspection: &Inspection) -> Self {
        Self {
            name: name.to_owned(),
            can_reset,
            entities: inspection.entities,
            types: inspection.types.iter().map(ToString::to_string).collect(),
            predicates: inspection.predicates.iter().map(ToString::to_string).collect(),
            tried: inspection.tried.iter().map(TriedView::of).collect(),
            findings: inspection.findings.iter().map(FindingView::of).collect(),
            broken_off: inspection.broken_off.as_ref().map(|at| at.asked.clone()),
        }
    }
}

impl TriedView {
    fn of(tried: &Tried) -> Self {
        Self {
            call: tried.call.clone(),
            executed: tried.executed,
            reason: tried.reason.clone(),
            added: tried.change.as_ref().map(|change| change.added.iter().cloned().collect()),
            deleted: tried.change.as_ref().map(|change| change.deleted.iter().cloned().collect()),
        }
    }
}

impl FindingView {
    fn of(finding: &Finding) -> Self {
        Self {
            place: finding.place.clone(),
            problem: finding.problem.word(),
            certain: finding.problem.is_certain(),
            what: finding.problem.to_string(),
            hint: finding.problem.hint(),
        }
    }
}

/// What was found in the environment of this name, in lines: what it is, what the actions did, what is wrong and what to do
/// about it, and how much of it there is.
pub fn inspection_lines(name: &str, can_reset: bool, inspection: &Inspection) -> Vec<Text> {
    let resets = if can_reset { "can be reset" } else { "cannot be reset" };
    let counted = format!(
        ": {resets}; {}, {}, {}",
        entities(inspection.entities),
        count(inspection.types.len() as u64, "type"),
        count(inspection.predicates.len() as u64, "predicate"),
    );
    let mut lines = vec![Text::new().with(Role::Heading, name).plain(counted)];
    lines.extend(inspection.tried.iter().map(tried));
    for finding in &inspection.findings {
        let (word, role) = match finding.problem.is_certain() {
            true => ("hurts", Role::Bad),
            false => ("may hurt", Role::Warning),
        };
        lines.push(Text::new().with(role, word).plain(format!("  {}: {}", finding.place, finding.problem)));
        lines.push(Text::new().plain("  ").with(Role::Aside, finding.problem.hint()));
    }
    if let Some(BrokenOffAt { asked, answered }) = &inspection.broken_off {
        let why = if *answered { "the answer cannot be used" } else { "it was not answered" };
        lines.push(Text::new().with(Role::Warning, "broken off").plain(format!("  at {asked}: {why}")));
    }
    lines.push(verdict(inspection));
    lines
}

fn entities(n: usize) -> String {
    if n == 1 { "1 entity".to_owned() } else { format!("{n} entities") }
}

fn tried(tried: &Tried) -> Text {
    let line = Text::new().plain(format!("{}  ", tried.call));
    let changes = match &tried.change {
        None => "what changed is not known".to_owned(),
        Some(change) if change.is_empty() => "nothing changed".to_owned(),
        Some(change) => change.atoms().join(" "),
    };
    if tried.executed {
        return line.plain(changes);
    }
    let reason = tried.reason.as_ref().map(|reason| format!(" ({reason})")).unwrap_or_default();
    line.with(Role::Bad, "not executed").plain(format!("{reason}: {changes}"))
}

fn verdict(inspection: &Inspection) -> Text {
    let certain = inspection.findings.iter().filter(|finding| finding.problem.is_certain()).count();
    let others = inspection.findings.len() - certain;
    match (certain, others) {
        (0, 0) if inspection.broken_off.is_some() => Text::new().plain("nothing found so far that would hurt learning"),
        (0, 0) if inspection.tried.iter().any(|tried| tried.executed) => {
            Text::new().with(Role::Good, "nothing found that would hurt learning")
        }
        (0, 0) => {
            Text::new().with(Role::Good, "nothing found that would hurt learning").plain("; no action was carried out")
        }
        (0, 1) => Text::new().plain("1 thing may hurt learning, unless it is intended"),
        (0, others) => Text::new().plain(format!("{others} things may hurt learning, unless they are intended")),
        (certain, others) => {
            let more = if others > 0 { format!(", {others} more may") } else { String::new() };
            let hurts = if certain == 1 { "hurts" } else { "hurt" };
            let things = count(certain as u64, "thing");
            Text::new().with(Role::Bad, format!("{things} {hurts} learning")).plain(more)
        }
    }
}
