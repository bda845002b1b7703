//! What was done, by whom, where; and what came of it.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use typelift_model::{ActionSchema, Hierarchy, State, Step, Symbol, Term};
use typelift_plan::Ban;

use crate::objection::Objection;

/// An object that took part in an action.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Participant {
    /// Its name, which means something in its instance only.
    pub object: Symbol,
    /// Its type's name.
    #[serde(rename = "type")]
    pub ty: Symbol,
    /// Its place among the call's arguments, from 0; none if the call does not name it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<usize>,
}

/// Who took part in what, where.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Deed {
    /// The instance of the world.
    pub instance: Symbol,
    /// The call's name.
    pub call: Symbol,
    /// The predicates of what the action was to add.
    pub adds: BTreeSet<Symbol>,
    /// Who took part, in the order of the action's parameters.
    pub participants: Vec<Participant>,
}

impl Deed {
    /// What a step is, done by this action in this state of an instance.
    pub fn of(step: &Step, schema: &ActionSchema, state: &State, instance: &Symbol, hierarchy: &Hierarchy) -> Self {
        let participants = step.objects.iter().zip(&schema.parameters).enumerate();
        let participants = participants.map(|(index, (object, parameter))| Participant {
            object: object.clone(),
            // What vanished had a type that fits.
            ty: hierarchy.name(state.objects.get(object).copied().unwrap_or(parameter.ty)).clone(),
            place: schema.call.args.iter().position(|term| *term == Term::Param(index as u32)),
        });
        Self {
            instance: instance.clone(),
            call: step.call.name.clone(),
            adds: schema.adds().map(|atom| atom.predicate.clone()).collect(),
            participants: participants.collect(),
        }
    }
}

/// A deed that worked, and how often.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Success {
    /// What was done.
    pub deed: Deed,
    /// How often it worked.
    pub count: u64,
}

/// A deed that failed, its retries too, or that a person rejected.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Failed {
    /// What was done.
    pub deed: Deed,
    /// The number of the task, from 1.
    pub task: u64,
    /// The ground action, which is not to be tried again; none if something of it had vanished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ban: Option<Ban>,
    /// Who acted: never to blame.
    pub actors: BTreeSet<Symbol>,
    /// Who the goal speaks of: not to blame alone.
    pub in_goal: BTreeSet<Symbol>,
    /// What a person said against it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub objection: Option<Objection>,
    /// Whether an object that is to blame is useless for everything (the paper), or only for calls of this name.
    pub useless: bool,
    /// Whether a person rejected it.
    #[serde(default)]
    pub rejected: bool,
    /// The failure, in words.
    pub reason: String,
}

impl Failed {
    /// The ground action, if it is not to be tried again in this task.
    pub(crate) fn banned(&self, task: u64) -> Option<&Ban> {
        match &self.objection {
            Some(Objection::While { .. }) => None,
            Some(Objection::NotNow) if self.task != task => None,
            _ => self.ban.as_ref(),
        }
    }
}
