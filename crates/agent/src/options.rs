//! How an episode goes about its task.

use std::sync::Arc;

use typelift_model::Symbol;
use typelift_plan::ExternalPlanner;

use crate::blame::BlameRule;

/// How an episode goes about its task.
#[derive(Debug, Clone)]
pub struct Options {
    /// Imagine actions for goals that cannot be reached (Algorithm 2).
    pub imagine: Option<typelift_imagine::Options>,
    /// Use an action only where all of its effects would be changes.
    pub strict: bool,
    /// How plans are looked for.
    pub plan: typelift_plan::Options,
    /// Who plans instead of typelift's own planner.
    pub planner: Option<Arc<dyn ExternalPlanner>>,
    /// Set the world back after a failure, and plan from the initial state.
    pub restart: bool,
    /// How often a failed step is tried again; by default once, and never with `restart`.
    pub retries: Option<u32>,
    /// Whom a failure is blamed on.
    pub blame: BlameRule,
    /// How many steps of a detour it is worth to be e times as likely to succeed; 0 ignores risk.
    pub risk: u32,
    /// Plans proposed at most.
    pub max_proposals: u64,
    /// The instance of the world that names belong to, whatever the world says.
    pub instance: Option<Symbol>,
    /// Take an object that the task mentions for the one that the world calls so but for upper and lower case, which PDDL
    /// does not tell apart.
    pub ignores_case: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            imagine: None,
            strict: true,
            plan: typelift_plan::Options::default(),
            planner: None,
            restart: false,
            retries: None,
            blame: BlameRule::default(),
            risk: 10,
            max_proposals: 12,
            instance: None,
            ignores_case: false,
        }
    }
}

impl Options {
    /// Whether preconditions may be done without. Only typelift's own planner is asked again and again.
    pub(crate) fn loosens(&self) -> bool {
        self.planner.is_none() && self.imagine.is_some_and(|imagining| imagining.loosen)
    }

    /// How often a failed step is tried again.
    pub(crate) fn retries(&self) -> u32 {
        self.retries.unwrap_or(u32::from(!self.restart))
    }
}
