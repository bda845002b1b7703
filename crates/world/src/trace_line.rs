//! The lines of a trace, format `trace/1`: a header, then states and actions in turn.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use typelift_model::{Goal, GroundAtom, GroundCall, Pattern, Symbol};

use crate::entity_line::EntityLine;
use crate::{Expected, Scene, Snapshot, TraceAction, TraceHeader, Verdict, WrittenGoal, goal_literals, json};

/// The format that this version reads and writes.
pub const TRACE_FORMAT: &str = "trace/1";

/// One line of a trace, as it is written.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum TraceLine<'a> {
    /// The first line.
    Header {
        /// [`TRACE_FORMAT`].
        #[cfg_attr(
            feature = "schema",
            schemars(description = "The format and its version.", extend("const" = TRACE_FORMAT))
        )]
        format: &'a str,
        /// What is done, in words.
        #[cfg_attr(feature = "schema", schemars(default))]
        task: &'a str,
        /// What is to hold in the end, and what is not.
        #[cfg_attr(feature = "schema", schemars(default))]
        goal: WrittenGoal<'a>,
    },
    /// A state; the first line after the header, and the one after each action.
    State {
        /// What is observed.
        state: &'a Scene,
    },
    /// An action, between two states.
    Action {
        /// What the environment was told.
        action: &'a GroundCall,
        /// Whether it says that it did it.
        #[serde(skip_serializing_if = "Option::is_none")]
        executed: Option<bool>,
        /// Why not, if it says so.
        #[serde(skip_serializing_if = "Option::is_none")]
        reason: Option<&'a str>,
        /// When, in seconds.
        #[serde(skip_serializing_if = "Option::is_none")]
        t: Option<f64>,
        /// What the agent meant to do, if an agent with a model acted.
        #[serde(skip_serializing_if = "Option::is_none")]
        expected: Option<&'a Expected>,
        /// What that agent judged to have come of it.
        #[serde(skip_serializing_if = "Option::is_none")]
        verdict: Option<Verdict>,
    },
}

impl<'a> From<&'a TraceHeader> for TraceLine<'a> {
    fn from(header: &'a TraceHeader) -> Self {
        Self::Header { format: TRACE_FORMAT, task: &header.task, goal: WrittenGoal(&header.goal) }
    }
}

impl<'a> From<&'a Scene> for TraceLine<'a> {
    fn from(state: &'a Scene) -> Self {
        Self::State { state }
    }
}

impl<'a> From<&'a TraceAction> for TraceLine<'a> {
    fn from(action: &'a TraceAction) -> Self {
        let TraceAction { call, executed, reason, time, expected, verdict } = action;
        Self::Action {
            action: call,
            executed: *executed,
            reason: reason.as_deref(),
            t: *time,
            expected: expected.as_ref(),
            verdict: *verdict,
        }
    }
}

/// A header, as it is read.
#[derive(Deserialize)]
pub(crate) struct HeaderLine {
    #[serde(default)]
    pub(crate) task: String,
    #[serde(default, deserialize_with = "goal_literals::deserialize")]
    pub(crate) goal: Goal,
}

/// A line after the header, as it is read.
#[derive(Deserialize)]
pub(crate) struct BodyLine {
    pub(crate) state: Option<SceneLine>,
    pub(crate) action: Option<GroundCall>,
    pub(crate) executed: Option<bool>,
    pub(crate) reason: Option<String>,
    pub(crate) t: Option<f64>,
    pub(crate) expected: Option<Expected>,
    pub(crate) verdict: Option<Verdict>,
}

impl TraceHeader {
    /// The header that the first line of a trace is; its format is taken for granted.
    ///
    /// # Errors
    /// That of the line.
    pub fn from_line(line: &str) -> serde_json::Result<Self> {
        let HeaderLine { task, goal } = serde_json::from_str(line)?;
        Ok(Self { task, goal })
    }
}

impl TraceAction {
    /// The action that a line of a trace is, if it is one.
    ///
    /// # Errors
    /// That of the line.
    pub fn from_line(line: &str) -> serde_json::Result<Option<Self>> {
        Ok(serde_json::from_str::<BodyLine>(line)?.action())
    }
}

impl BodyLine {
    /// The action of the line, if it has one.
    pub(crate) fn action(self) -> Option<TraceAction> {
        let Self { action, executed, reason, t: time, expected, verdict, .. } = self;
        Some(TraceAction { call: action?, executed, reason, time, expected, verdict })
    }
}

/// A scene of either kind, as it is read; unlike the scene itself it can say at which place it is malformed.
#[derive(Deserialize)]
#[serde(expecting = "a state")]
pub(crate) struct SceneLine {
    entities: Option<Vec<EntityLine>>,
    #[serde(default)]
    objects: Option<Objects>,
    #[serde(default)]
    atoms: BTreeSet<GroundAtom>,
    #[serde(default)]
    unknown: BTreeSet<Pattern<Symbol>>,
}

#[derive(Deserialize)]
#[serde(transparent)]
struct Objects(#[serde(deserialize_with = "json::distinct_map")] BTreeMap<Symbol, Symbol>);

impl SceneLine {
    /// The entities, if the scene lists any.
    pub(crate) fn entities(&self) -> &[EntityLine] {
        self.entities.as_deref().unwrap_or_default()
    }

    /// The scene, or what is wrong with it.
    pub(crate) fn scene(self) -> Result<Scene, &'static str> {
        match (self.entities, self.objects) {
            (Some(entities), None) => {
                let entities = entities.into_iter().map(|line| line.entity).collect();
                Ok(Scene::Snapshot(Snapshot { entities }))
            }
            (None, Some(Objects(objects))) => Ok(Scene::Symbolic { objects, atoms: self.atoms, unknown: self.unknown }),
            (None, None) => Err("this state has neither `entities` nor `objects`"),
            (Some(_), Some(_)) => Err("this state has both `entities` and `objects`"),
        }
    }
}
