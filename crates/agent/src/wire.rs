//! Commands as they go over a wire, to a page or a robot's own loop: nothing in them needs a model to be read.
//!
//! Inputs need no other form: an [`Input`](crate::Input) over a [`Scene`](typelift_world::Scene) is one.

use serde::{Deserialize, Serialize};
use typelift_model::{GroundCall, Hierarchy};

use crate::event::PlanSummary;
use crate::turn::{Command, CommandId};

/// A [`Command`], as JSON tells it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "command", rename_all = "snake_case")]
pub enum WireCommand {
    /// Set the world to its initial state; answered by `reset`.
    Reset {
        /// The answer names it.
        id: CommandId,
    },
    /// Observe; answered by `observation`.
    Observe {
        /// The answer names it.
        id: CommandId,
    },
    /// Have this plan approved; answered by `approve`, `reject` or `another_plan`.
    Propose {
        /// The answer names it.
        id: CommandId,
        /// The plan.
        plan: PlanSummary,
    },
    /// Execute this; answered by `observation`, `refused` or `timed_out`.
    Act {
        /// The answer names it.
        id: CommandId,
        /// The action.
        call: GroundCall,
    },
    /// This was commanded, and its result is awaited: not to be executed again.
    Await {
        /// The id of the command to execute it.
        id: CommandId,
        /// The action.
        call: GroundCall,
    },
    /// It is over.
    Done {
        /// How it ended, in a word.
        ending: String,
        /// Plans proposed.
        proposals: u64,
        /// Actions executed, retries included.
        actions: u64,
    },
}

impl Command {
    /// The command as it goes over a wire; types have the names that the hierarchy gives them.
    pub fn to_wire(&self, hierarchy: &Hierarchy) -> WireCommand {
        match self {
            Self::Reset { id } => WireCommand::Reset { id: *id },
            Self::Observe { id } => WireCommand::Observe { id: *id },
            Self::Propose { id, plan } => WireCommand::Propose { id: *id, plan: PlanSummary::of(plan, hierarchy) },
            Self::Act { id, call } => WireCommand::Act { id: *id, call: call.clone() },
            Self::Await { id, call } => WireCommand::Await { id: *id, call: call.clone() },
            Self::Done(account) => WireCommand::Done {
                ending: account.ending.word().to_owned(),
                proposals: account.proposals,
                actions: account.actions,
            },
        }
    }
}
