//! The environment protocol `env/1`: JSON Lines over a program's standard input and output.
//!
//! Each request carries an `id` that its answer echoes. An `act` is answered when the world has settled.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use typelift_model::{GroundCall, Symbol};

use crate::Scene;
use crate::entity_line::{UnreadKey, unread_keys};
use crate::trace_line::SceneLine;

/// The protocol's name and version.
pub const PROTOCOL: &str = "env/1";

/// A request to an environment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Request {
    /// Echoed by the answer.
    pub id: u64,
    /// What is asked.
    #[serde(flatten)]
    pub body: RequestBody,
}

/// What is asked of an environment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "op", rename_all = "lowercase")]
pub enum RequestBody {
    /// Who are you? Answered by `name` and `reset`.
    Hello {
        /// [`PROTOCOL`].
        #[cfg_attr(
            feature = "schema",
            schemars(description = "The protocol and its version.", extend("const" = PROTOCOL))
        )]
        protocol: String,
    },
    /// Set yourself to an initial state; answered by `state`.
    Reset {
        /// The seed of whatever is left to chance.
        seed: u64,
        /// What to set up, in the environment's own terms.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        scenario: Option<serde_json::Value>,
    },
    /// What is the state? Answered by `state`.
    Observe,
    /// Do this; answered by `state`, `executed` and perhaps `reason`.
    Act {
        /// The action.
        action: GroundCall,
    },
    /// End.
    Close,
}

impl RequestBody {
    /// The operation's name, as it is sent.
    pub fn op(&self) -> &'static str {
        match self {
            Self::Hello { .. } => "hello",
            Self::Reset { .. } => "reset",
            Self::Observe => "observe",
            Self::Act { .. } => "act",
            Self::Close => "close",
        }
    }
}

/// An environment's answer; which fields are there depends on what was asked.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Answer {
    /// The request's.
    pub id: u64,
    /// Whether the request could be carried out.
    pub ok: bool,
    /// Why not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// To `hello`: what the environment calls itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// To `hello`: whether it can be reset.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reset: Option<bool>,
    /// To `hello`, `reset`: the instance of the world; as long as it is the same, names mean the same things.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instance: Option<Symbol>,
    /// To `reset`, `observe`, `act`: what is observed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<Scene>,
    /// To `act`: whether it was done.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub executed: Option<bool>,
    /// To `act`: why not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The keys that nothing reads in the state of an answer of `env/1`, each where it is met first; none where the text is no
/// such answer. In time of reading it.
pub fn unread_keys_of_answer(text: &str) -> Vec<UnreadKey> {
    #[derive(Deserialize)]
    struct Answered {
        state: Option<SceneLine>,
    }
    let Ok(Answered { state: Some(state) }) = serde_json::from_str(text) else { return Vec::new() };
    unread_keys(state.entities(), &mut BTreeSet::new())
}
