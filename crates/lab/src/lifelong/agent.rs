//! Who lives a life.

use std::fmt;

use serde::{Deserialize, Serialize};
use typelift::agent::{BlameRule, Options};
use typelift::imagine;
use typelift::model::Symbol;

use crate::limits::Limits;

/// Who lives a life. All start from the eight demonstrations, imagine, go on from where a step failed, and try it again once.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Agent {
    /// Remembers: what was tried in earlier tasks, and the model is learned anew after each, as `run --memory` does.
    Memory,
    /// Blames in the same way, and forgets everything after each task.
    Forgetful,
    /// The paper's rule, `run --blame paper`: excludes what took part, and forgets it after the task.
    Paper,
    /// Somebody stands beside it who knows all that no state tells, but for what broke just now, and says no to a step that
    /// would fail.
    Informed,
}

impl Agent {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Memory, Self::Forgetful, Self::Paper, Self::Informed];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Memory => "memory",
            Self::Forgetful => "forgetful",
            Self::Paper => "paper",
            Self::Informed => "informed",
        }
    }

    /// The agent of this name.
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|agent| agent.name() == name)
    }

    /// How it goes about a task.
    pub(super) fn options(self, limits: Limits) -> Options {
        Options {
            imagine: Some(imagine::Options::default()),
            blame: if self == Self::Paper { BlameRule::Paper } else { BlameRule::Belief },
            max_proposals: limits.max_proposals + if self == Self::Informed { OBJECTIONS } else { 0 },
            // The tools are the same in every task, wherever they stand.
            instance: Some(Symbol::new("kitchen")),
            ..Options::default()
        }
    }
}

/// Plans of one task to which whoever knows may say no.
const OBJECTIONS: u64 = 60;

impl fmt::Display for Agent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
