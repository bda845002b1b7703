//! A running episode as JSON text, and back: everything but what the driver hands in again (model, evidence, options,
//! budget) and what can be computed again (imagined actions, and the search, which is only taken up where another plan is wanted).

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use thiserror::Error;
use typelift_model::{
    ActionModel, Budget, Goal, GroundAtom, GroundCall, Hierarchy, Pattern, Plan, State, Symbol, Unknown, json_message,
};

use crate::account::Account;
use crate::episode::{Episode, Phase};
use crate::execution::{Execution, Steps, Terms};
use crate::experience::Experience;
use crate::options::Options;
use crate::outlook::Outlooks;
use crate::propose::ProposeError;
use crate::turn::CommandId;

/// The format that this version saves and restores.
pub const EPISODE_FORMAT: &str = "episode/1";

/// Why an episode could not be restored.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum RestoreError {
    /// The text is no saved episode.
    #[error("this is no saved episode: {0}")]
    Unreadable(String),
    /// It was saved in another format.
    #[error("the episode was saved in the format `{found}`; this version reads {EPISODE_FORMAT}")]
    Format {
        /// The other format.
        found: String,
    },
    /// With this model and these options it cannot have been saved: something that it mentions is not there.
    #[error("the episode was saved with another model or other options: {0}")]
    OtherModel(String),
    /// What it says does not go together: it was changed after it was saved.
    #[error("the saved episode contradicts itself: {0}")]
    Contradiction(&'static str),
    /// What was imagined could not be imagined again.
    #[error(transparent)]
    Propose(#[from] ProposeError),
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct SavedEpisode {
    /// The format and its version.
    #[cfg_attr(feature = "schema", schemars(extend("const" = EPISODE_FORMAT)))]
    format: String,
    /// What is to be achieved.
    goal: Goal,
    /// The values of the functions that costs mention.
    values: Vec<(GroundAtom, u32)>,
    /// What was tried, in this task and the ones before it.
    experience: Experience,
    /// The number of this task in the experience.
    task: u64,
    /// The instance of the world that names belong to.
    instance: Symbol,
    /// What the episode waits for.
    phase: Phase,
    /// The command that stands.
    standing: CommandId,
    /// What was observed last.
    state: SavedState,
    /// The plan that is proposed or carried out; none before the first.
    execution: Option<SavedExecution>,
    /// Plans that went as expected to their end and did not lead to the goal, with the states they were made for.
    in_vain: Vec<(SavedState, Steps)>,
    /// What has happened so far; how it ended counts only once it is over.
    account: Account,
}

/// A saved episode as a type, for its JSON Schema.
#[cfg(feature = "schema")]
impl schemars::JsonSchema for Episode {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Episode".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        SavedEpisode::json_schema(generator)
    }
}

/// The plan that is proposed or carried out, and how far it is.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct SavedExecution {
    /// The plan's steps.
    steps: Vec<SavedStep>,
    /// On what terms it was made.
    terms: Terms,
    /// The state that it was made for.
    made_for: SavedState,
    /// How many plans the planner has given for this state and on these terms, this one included.
    plans_given: usize,
    /// The next step, from 0.
    next_step: usize,
    /// How many steps were executed.
    taken: usize,
    /// How often the next step was tried again.
    retries: u32,
}

/// A step of a plan.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct SavedStep {
    /// The action's name, in the model that the plan was made with.
    action: Symbol,
    /// An object for each of its parameters.
    objects: Vec<Symbol>,
    /// What the environment is told.
    call: GroundCall,
    /// What the step costs.
    cost: u32,
}

/// A state with its types by name.
#[derive(Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct SavedState {
    /// The objects, with their types.
    objects: BTreeMap<Symbol, Symbol>,
    /// The atoms that hold.
    atoms: BTreeSet<GroundAtom>,
    /// Of a closed state: the atoms that may hold for all that is known.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    unknown: BTreeSet<Pattern<Symbol>>,
    /// Of an open state: the atoms that are known to be false.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    known_false: Option<BTreeSet<GroundAtom>>,
}

impl SavedState {
    fn of(state: &State, hierarchy: &Hierarchy) -> Self {
        let (unknown, known_false) = match &state.unknown {
            Unknown::Matching(patterns) => (patterns.clone(), None),
            Unknown::AllBut(atoms) => (BTreeSet::new(), Some(atoms.clone())),
        };
        let objects = state.objects.iter().map(|(name, ty)| (name.clone(), hierarchy.name(*ty).clone()));
        Self { objects: objects.collect(), atoms: state.atoms.clone(), unknown, known_false }
    }

    fn restored(self, hierarchy: &Hierarchy) -> Result<State, RestoreError> {
        let typed = |(name, ty): (Symbol, Symbol)| match hierarchy.id(ty.as_str()) {
            Some(ty) => Ok((name, ty)),
            None => Err(RestoreError::OtherModel(format!("there is no type `{ty}`"))),
        };
        let unknown = self.known_false.map_or(Unknown::Matching(self.unknown), Unknown::AllBut);
        Ok(State {
            objects: self.objects.into_iter().map(typed).collect::<Result<_, _>>()?,
            atoms: self.atoms,
            unknown,
        })
    }
}

impl SavedExecution {
    fn of(execution: &Execution) -> Self {
        let steps = execution.plan.steps.iter().map(|step| SavedStep {
            action: step.action.clone(),
            objects: step.objects.clone(),
            call: step.call.clone(),
            cost: step.cost,
        });
        Self {
            steps: steps.collect(),
            terms: execution.terms.clone(),
            made_for: SavedState::of(&execution.made_for, &execution.model.hierarchy),
            plans_given: execution.plans_given,
            next_step: execution.next_step,
            taken: execution.taken,
            retries: execution.retries,
        }
    }

    fn restored(self, made_for: State, model: Arc<ActionModel>) -> Result<Execution, RestoreError> {
        let step = |saved: SavedStep| {
            let schema = model.action(saved.action.as_str());
            let schema = schema.filter(|schema| schema.parameters.len() == saved.objects.len());
            let step = schema.map(|schema| schema.step(saved.objects, saved.cost));
            let other =
                || RestoreError::OtherModel(format!("there is no action `{}` for {}", saved.action, saved.call));
            step.filter(|step| step.call == saved.call).ok_or_else(other)
        };
        let plan = Plan { steps: self.steps.into_iter().map(step).collect::<Result<_, _>>()? };
        if self.next_step > plan.len() || self.taken > plan.len() {
            return Err(RestoreError::Contradiction("it is further than its plan is long"));
        }
        Ok(Execution {
            taken: self.taken,
            plan,
            terms: self.terms,
            made_for,
            plans_given: self.plans_given,
            next_step: self.next_step,
            retries: self.retries,
            model,
        })
    }
}

impl Episode {
    /// The episode as JSON text, from which [`restore`](Self::restore) makes one that goes on in the same way.
    pub fn save(&self) -> String {
        let hierarchy = &self.model.hierarchy;
        let in_vain = self.in_vain.iter().map(|(state, steps)| (SavedState::of(state, hierarchy), steps.clone()));
        let saved = SavedEpisode {
            format: EPISODE_FORMAT.to_owned(),
            goal: self.goal.clone(),
            values: self.values.iter().map(|(function, value)| (function.clone(), *value)).collect(),
            experience: self.experience.clone(),
            task: self.task,
            instance: self.instance.clone(),
            phase: self.phase,
            standing: self.standing,
            state: SavedState::of(&self.state, hierarchy),
            execution: self.execution.as_ref().map(SavedExecution::of),
            in_vain: in_vain.collect(),
            account: self.account.clone(),
        };
        // Only a map whose keys are no text can fail here, and the only map has names as keys.
        serde_json::to_string(&saved).unwrap_or_default()
    }

    /// The episode that was saved, with the same model and options; what stands is asked for by
    /// [`Input::Started`](crate::Input::Started). The same inputs lead to the same commands as without saving, as far as
    /// the budget allows: what was spent before is not counted.
    ///
    /// [Evidence](Self::with_evidence) is handed in again as well, if there was some.
    ///
    /// The cost is that of imagining once, where imagination is allowed.
    ///
    /// # Errors
    /// [`RestoreError`] if the text is no saved episode, was saved with another model or other options, or contradicts
    /// itself.
    pub fn restore(
        text: &str,
        model: Arc<ActionModel>,
        options: Options,
        budget: Budget,
    ) -> Result<Self, RestoreError> {
        #[derive(Deserialize)]
        struct Envelope {
            format: String,
        }
        let unreadable = |error: serde_json::Error| RestoreError::Unreadable(json_message(&error));
        let Envelope { format } = serde_json::from_str(text).map_err(unreadable)?;
        if format != EPISODE_FORMAT {
            return Err(RestoreError::Format { found: format });
        }
        let saved: SavedEpisode = serde_json::from_str(text).map_err(unreadable)?;
        let hierarchy = &model.hierarchy;
        let in_vain = saved.in_vain.into_iter().map(|(state, steps)| Ok((state.restored(hierarchy)?, steps)));
        let mut episode = Self {
            in_vain: in_vain.collect::<Result<_, RestoreError>>()?,
            state: saved.state.restored(hierarchy)?,
            model,
            evidence: Arc::default(),
            goal: saved.goal,
            values: saved.values.into_iter().collect(),
            options,
            budget,
            experience: saved.experience,
            outlooks: Outlooks::default(),
            task: saved.task,
            instance: saved.instance,
            phase: saved.phase,
            standing: saved.standing,
            execution: None,
            proposal: None,
            account: saved.account,
        };
        episode.name_objects_as_in(&episode.state.clone());
        if let Some(mut execution) = saved.execution {
            let made_for = std::mem::take(&mut execution.made_for).restored(&episode.model.hierarchy)?;
            let planned_with = episode.planned_on(&execution.terms, &made_for)?;
            episode.execution = Some(execution.restored(made_for, planned_with)?);
        }
        episode.check_phase()?;
        if episode.account.solved() {
            episode.account.plan = Some(episode.plan_taken());
        }
        Ok(episode)
    }

    /// That what the episode waits for can come.
    fn check_phase(&self) -> Result<(), RestoreError> {
        let has_step = self.execution.as_ref().is_some_and(|execution| execution.step().is_some());
        let has_begun = self.execution.as_ref().is_some_and(|execution| execution.next_step > 0 || execution.taken > 0);
        match self.phase {
            Phase::AwaitingApproval if !has_step => Err(RestoreError::Contradiction("there is no plan to approve")),
            Phase::AwaitingApproval if has_begun => Err(RestoreError::Contradiction("a plan has begun unapproved")),
            Phase::AwaitingResult | Phase::AwaitingLateState if !has_step => {
                Err(RestoreError::Contradiction("there is no step whose result could come"))
            }
            _ => Ok(()),
        }
    }
}
