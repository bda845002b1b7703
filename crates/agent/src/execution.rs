//! The plan that is proposed or carried out, and how far it is.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use typelift_imagine::Loosening;
use typelift_model::{ActionModel, ActionSchema, GroundAction, Plan, State, Step, Symbol};
use typelift_plan::Restrictions;

use crate::outlook::Need;
use crate::risk::Risk;
use crate::suspect::Conditions;

/// On what terms a plan is made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct Terms {
    /// What is avoided.
    pub(crate) restrictions: Restrictions,
    /// What keeps actions from being used.
    pub(crate) conditions: Conditions,
    /// Actions are used although some of their effects hold already, whatever the options say.
    pub(crate) relaxed: bool,
    /// What failed may be tried where what held around it then does not.
    #[serde(default)]
    pub(crate) elsewhere: bool,
    /// The preconditions that are done without.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) loosened: Vec<Loosening>,
    /// What actions as good as need besides their preconditions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) needs: Vec<Need>,
    /// How risky steps are.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) risks: Vec<Risk>,
}

/// A plan that is proposed or carried out.
#[derive(Debug, Clone)]
pub(crate) struct Execution {
    pub(crate) plan: Plan,
    /// The model that it was made with: imagined actions added, strict if it is.
    pub(crate) model: Arc<ActionModel>,
    pub(crate) terms: Terms,
    /// The state that it was made for.
    pub(crate) made_for: State,
    /// How many plans the planner has given for this state and on these terms, this one included.
    pub(crate) plans_given: usize,
    pub(crate) next_step: usize,
    /// How many steps were executed.
    pub(crate) taken: usize,
    /// How often the next step was tried again.
    pub(crate) retries: u32,
}

impl Execution {
    /// The next step; none at the end.
    pub(crate) fn step(&self) -> Option<&Step> {
        self.plan.steps.get(self.next_step)
    }

    /// The action of the next step.
    pub(crate) fn schema(&self) -> Option<&ActionSchema> {
        self.model.action(self.step()?.action.as_str())
    }

    /// The next step as it is expected in this state.
    pub(crate) fn expected(&self, state: &State) -> Option<GroundAction> {
        self.schema()?.instantiate(&self.step()?.objects, state, &self.model.hierarchy).ok()
    }

    /// What keeps the next step from being taken in this state, if something does: a precondition, or an entity that is
    /// there no more.
    pub(crate) fn missing_precondition(&self, state: &State) -> Option<String> {
        let Some(action) = self.expected(state) else {
            let objects = &self.step()?.objects;
            let gone = objects.iter().find(|object| !state.objects.contains_key(*object)).or(objects.first())?;
            return Some(gone.to_string());
        };
        let state = self.model.with_derived(state);
        let (atom, positive) = action.unmet(&state).next()?;
        Some(format!("{}{atom}", if *positive { "" } else { "not " }))
    }

    /// Whether every effect of the next step must be a change: in a relaxed plan not every one will be.
    pub(crate) fn expects_changes(&self) -> bool {
        !self.terms.relaxed && self.schema().is_some_and(|action| action.strict)
    }

    /// The steps as they are told apart: action and objects.
    pub(crate) fn steps(&self) -> Steps {
        steps(&self.plan)
    }
}

/// The steps of a plan as they are told apart: action and objects.
pub(crate) type Steps = Vec<(Symbol, Vec<Symbol>)>;

pub(crate) fn steps(plan: &Plan) -> Steps {
    plan.steps.iter().map(|step| (step.action.clone(), step.objects.clone())).collect()
}
