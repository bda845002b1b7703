//! What a person says of what is proposed.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use typelift_model::{GroundCall, Symbol};

/// What a person said of a proposed plan, or of a step of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Said {
    /// What, in short.
    pub reply: Reply,
    /// The instance of the world in which it was said; empty if it has no name.
    pub instance: Symbol,
    /// The step that it is about; none if it is about the whole plan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub call: Option<GroundCall>,
    /// Why, in words.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub because: String,
    /// What follows from it, as an agent's experience keeps it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub experience: Option<Value>,
}

/// What a person answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reply {
    /// The plan may be executed.
    Yes,
    /// A step is not to be taken.
    No,
    /// Another plan is wanted, though nothing speaks against this one.
    Another,
    /// They showed what to do instead.
    Shown,
}
