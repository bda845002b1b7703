//! What learning makes: a model with what it was learned from.

use crate::{ActionModel, Evidence, ParseConfig};

/// A model, how the states it speaks of were read, and the evidence it rests on. Plans need the
/// [model](Self::model) alone; the rest is for reading more states and for learning more.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LearnedModel {
    /// What plans are made with.
    pub model: ActionModel,
    /// How snapshots are read.
    pub parse: ParseConfig,
    /// What the actions rest on.
    pub evidence: Evidence,
}

impl From<ActionModel> for LearnedModel {
    /// A model that was stated, and rests on nothing.
    fn from(model: ActionModel) -> Self {
        Self { model, ..Self::default() }
    }
}
