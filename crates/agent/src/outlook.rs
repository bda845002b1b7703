//! What is believed of the actions of a model before they are used: how risky each is with what is there, and what it needs
//! besides its preconditions.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use typelift_belief::{ActionBelief, Cause, Run};
use typelift_model::{ActionModel, ActionSchema, LiftedAtom, Literal, Observations, State, Symbol, TypeId};

use crate::blame::SETTLED;
use crate::experience::Experience;
use crate::risk::{Risk, RiskOf};

/// From what is believed of a model's actions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Outlook<'a> {
    pub(crate) model: &'a ActionModel,
    /// What the model was learned from, as far as it is known.
    pub(crate) evidence: &'a Observations,
    pub(crate) experience: &'a Experience,
    /// The number of the task.
    pub(crate) task: u64,
}

/// What is believed of actions, where anything ever failed.
#[derive(Debug, Clone, Default)]
pub(crate) struct Outlooks {
    pub(crate) risks: Vec<Risk>,
    /// What is as good as needed, though some success did without it.
    pub(crate) needs: Vec<Need>,
}

/// What a learned action as good as needs.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct Need {
    /// The action's name.
    action: Symbol,
    /// The atom, over its parameters.
    atom: LiftedAtom,
}

impl Outlook<'_> {
    /// How risky the actions are with what there is in a state of an instance, and what they need: nothing is, as long as
    /// nothing ever failed, or if risk weighs nothing. In time of the actions times the types of the hierarchy, and of the failures.
    pub(crate) fn of(&self, state: &State, instance: &Symbol, weight: u32) -> Outlooks {
        let mut outlooks = Outlooks::default();
        if weight == 0 || self.experience.failures().is_empty() && self.evidence.negatives.is_empty() {
            return outlooks;
        }
        let run = self.experience.run(self.task);
        let types: BTreeSet<TypeId> = state.objects.values().copied().collect();
        for schema in &self.model.actions {
            let belief = ActionBelief::new(schema, self.evidence, &run, self.model);
            outlooks.risks.extend(self.risks(schema, &belief, &types, &run, instance, weight));
            outlooks.needs.extend(needs(schema, &belief));
        }
        outlooks
    }

    fn risks(
        &self,
        schema: &ActionSchema,
        belief: &ActionBelief,
        types: &BTreeSet<TypeId>,
        run: &Run<'_>,
        instance: &Symbol,
        weight: u32,
    ) -> Vec<Risk> {
        let hierarchy = &self.model.hierarchy;
        let is_type = |ty: TypeId| RiskOf::Type(hierarchy.name(ty).clone());
        let mut found: BTreeMap<Vec<(u32, RiskOf)>, f64> = BTreeMap::new();
        for (cause, odds) in belief.doubts(hierarchy, types) {
            let at = match cause {
                Cause::Type(at, ty) => vec![(at as u32, is_type(ty))],
                Cause::Together(((at, ty), (other, its))) => {
                    vec![(at as u32, is_type(ty)), (other as u32, is_type(its))]
                }
                _ => continue,
            };
            found.insert(at, odds);
        }
        for failure in run.failed().iter().filter(|failed| failed.deed.instance == *instance) {
            for (cause, odds) in belief.blame(schema, failure, run, hierarchy) {
                let Cause::Object { object, .. } = cause else { continue };
                let place = failure.deed.participants.iter().position(|participant| participant.object == object);
                let Some(place) = place else { continue };
                let known = found.entry(vec![(place as u32, RiskOf::Object(object))]).or_default();
                *known = known.max(odds);
            }
        }
        found.into_iter().filter_map(|(at, odds)| Risk::of(&schema.name, at, odds, weight)).collect()
    }
}

/// What an action as good as needs besides its preconditions.
fn needs(schema: &ActionSchema, belief: &ActionBelief) -> impl Iterator<Item = Need> {
    let settled = belief.needed(schema).into_iter().filter(|(_, odds)| *odds >= SETTLED);
    settled.map(|(atom, _)| Need { action: schema.name.clone(), atom })
}

/// The model with what its actions as good as need among their preconditions.
pub(crate) fn with_needs<'a>(model: Cow<'a, ActionModel>, needs: &[Need]) -> Cow<'a, ActionModel> {
    if needs.is_empty() {
        return model;
    }
    let mut model = model.into_owned();
    for schema in &mut model.actions {
        let own = needs.iter().filter(|need| need.action == schema.name);
        schema.preconditions.extend(own.map(|need| Literal { atom: need.atom.clone(), positive: true }));
        schema.preconditions.sort_unstable();
        schema.preconditions.dedup();
    }
    Cow::Owned(model)
}
