//! Who plans, and how: `--search`, or an external planner with `--planner`.

use std::sync::Arc;

use typelift::bridge::PlannerCommand;
use typelift::pddl::Level;
use typelift::plan::{ExternalPlanner, Strategy};

use crate::exit::Exit;
use crate::failure::Failure;

/// Which planner plans.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct PlannerOption {
    /// Search like this: ordered-first, ordered-landmarks, lama, lazy-ff, lazy-landmarks, bfws, or for an optimal plan
    /// astar-lmcut, astar-blind [default: ordered-first for learned models, lama for PDDL]
    #[arg(long, value_name = "SEARCH", conflicts_with = "planner")]
    search: Option<Strategy>,
    /// Plan with another planner: {domain}, {problem} and {plan} stand for the paths of what it reads and writes
    #[arg(long, value_name = "COMMAND")]
    planner: Option<String>,
    /// How much of PDDL that planner knows
    #[arg(long, value_enum, default_value_t = LevelArgument::Adl, requires = "planner")]
    planner_level: LevelArgument,
}

/// How much of PDDL a planner knows.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub(crate) enum LevelArgument {
    /// Types and positive preconditions only; costs are left out
    Strips,
    /// All that the model has: negation, inequality, conditional effects, costs
    Adl,
}

impl From<LevelArgument> for Level {
    fn from(level: LevelArgument) -> Self {
        match level {
            LevelArgument::Strips => Self::Strips,
            LevelArgument::Adl => Self::Adl,
        }
    }
}

impl PlannerOption {
    /// Whether there is one.
    pub(crate) fn is_given(&self) -> bool {
        self.planner.is_some()
    }

    /// How typelift's own planner searches, with a model that was given as PDDL or one that was learned.
    pub(crate) fn strategy(&self, is_given: bool) -> Strategy {
        self.search.unwrap_or(if is_given { Strategy::LamaPortfolio } else { Strategy::OrderedFirst })
    }

    /// The planner, if there is one.
    pub(crate) fn open(&self) -> Result<Option<Arc<dyn ExternalPlanner>>, Failure> {
        let Some(command) = &self.planner else { return Ok(None) };
        match PlannerCommand::new(command, self.planner_level.into()) {
            Ok(planner) => Ok(Some(Arc::new(planner))),
            Err(message) => Err(Failure::new(Exit::Usage, format!("--planner '{command}': {message}"))
                .with_hint("Write for example --planner 'fast-downward --plan-file {plan} {domain} {problem} --search \"astar(lmcut())\"'")),
        }
    }
}
