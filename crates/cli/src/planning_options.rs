//! What several commands are asked alike: `plan`, `run`, `export` and `validate` about the model, `plan` and `run` about
//! planning.

use std::path::PathBuf;
use std::sync::Arc;

use clap::ValueEnum;
use typelift::agent::{Options, allowed, widened};
use typelift::imagine;
use typelift::model::{ActionModel, Budget, Task, strict};
use typelift::plan::Restrictions;

use crate::failure::Failure;
use crate::files::{ModelInput, model_input_from_text, read_model_input};
use crate::limits::SearchLimits;
use crate::planner_option::PlannerOption;

/// A model, and how it may be used.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct ModelArguments {
    /// The model, as `learn` wrote it, a memory, or a PDDL domain
    #[arg(index = 1)]
    pub(crate) model: PathBuf,
    /// Add the types of this file to a learned model's
    #[arg(long, value_name = "FILE")]
    pub(crate) types: Option<PathBuf>,
    /// Imagine actions for goals that cannot be reached with the learned ones
    #[arg(long)]
    pub(crate) imagine: bool,
    /// Refuse imagined actions that would mix up who does what with what, or refuse none
    #[arg(long, value_name = "RULE", default_value = "roles", requires = "imagine")]
    guard: GuardRule,
    /// Use a learned action also where some of its effects hold already
    #[arg(long, alias = "plain")]
    not_strict: bool,
}

/// Which imagined actions are refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum GuardRule {
    // Those that would mix up their roles.
    Roles,
    // None.
    Off,
}

impl ModelArguments {
    /// How actions are imagined, if they are.
    pub(crate) fn imagining_options(&self) -> Option<imagine::Options> {
        let guard = match self.guard {
            GuardRule::Roles => imagine::Guard::Roles,
            GuardRule::Off => imagine::Guard::Off,
        };
        self.imagine.then_some(imagine::Options { guard, loosen: true })
    }

    /// Reads the model.
    pub(crate) fn read(&self, quiet: bool) -> Result<ModelInput, Failure> {
        read_model_input(&self.model, self.types.as_ref(), quiet)
    }

    /// As [`read`](Self::read), from the text of the model or domain.
    pub(crate) fn input_of(&self, text: String) -> Result<ModelInput, Failure> {
        model_input_from_text(&self.model, text, self.types.as_ref())
    }

    /// Whether it is used as its file has it, if that is a PDDL domain.
    pub(crate) fn is_as_stated(&self) -> bool {
        self.types.is_none() && !self.imagine
    }

    /// The same, with actions imagined.
    pub(crate) fn imagining(&self) -> Self {
        Self { imagine: true, ..self.clone() }
    }

    /// The files that are read.
    pub(crate) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.model].into_iter().chain(&self.types)
    }

    /// The model as it may be used for this task: with what is imagined for it if that is allowed, and strict unless that
    /// is not wanted.
    pub(crate) fn as_used(
        &self,
        model: ActionModel,
        task: Option<&Task>,
        budget: &Budget,
    ) -> Result<ActionModel, Failure> {
        let Some(task) = task else { return Ok(if self.not_strict { model } else { strict(&model) }) };
        let nothing_failed = Restrictions::default();
        let widened = widened(&model, task, &nothing_failed, &self.agent_options(), budget)?;
        Ok(Arc::unwrap_or_clone(widened.model))
    }

    /// The model that plans for this task are judged by: whatever `plan` finds with the same options is one of its plans.
    pub(crate) fn as_judged(&self, model: &ActionModel, task: &Task, budget: &Budget) -> Result<ActionModel, Failure> {
        let nothing_failed = Restrictions::default();
        Ok(Arc::unwrap_or_clone(allowed(model, task, &nothing_failed, &self.agent_options(), budget)?))
    }

    /// How an episode may use the model.
    fn agent_options(&self) -> Options {
        Options { imagine: self.imagining_options(), strict: !self.not_strict, ..Options::default() }
    }
}

/// Which model plans, how, and within which limits.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct PlanningOptions {
    #[command(flatten)]
    pub(crate) model: ModelArguments,
    /// Print JSON instead, one object for each task
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) planner: PlannerOption,
    #[command(flatten)]
    pub(crate) limits: SearchLimits,
}

impl PlanningOptions {
    /// How plans are made, with a model that was given as PDDL or one that was learned.
    pub(crate) fn agent_options(&self, is_given: bool) -> Result<Options, Failure> {
        Ok(Options {
            plan: typelift::plan::Options { strategy: self.planner.strategy(is_given), ..Default::default() },
            planner: self.planner.open()?,
            ..self.model.agent_options()
        })
    }
}
