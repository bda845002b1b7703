//! What an episode believes: how likely the steps of a plan work, what explains a failure, and what else could be done. It is for
//! those who watch it; nothing of it changes what it does.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use typelift_belief::{ActionBelief, CHANCE, Culprit, Deed};
use typelift_model::{ActionModel, Budget, GroundAction, GroundCall, Plan, State, Symbol};
use typelift_plan::Outcome;

use crate::blame::Blame;
use crate::deed::{Failed, surroundings};
use crate::episode::Episode;
use crate::execution::Terms;
use crate::propose::{ProposeError, attempt};

/// What may have caused a failure, and how likely that is, of all that may have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Explanation {
    /// Of what kind it is.
    pub kind: Culprit,
    /// Its share, from 0 to 1; all together are 1.
    pub share: f64,
}

impl Episode {
    /// How likely each step of a plan works that begins in the current state, from 0 to 1, by all that was learned from and
    /// tried; none for a step that no learned action says anything of. `model` is the one that it was made with. In time of what
    /// was tried for each learned action of the plan.
    pub fn foretold(&self, plan: &Plan, model: &ActionModel) -> Vec<Option<f64>> {
        let (blame, run) = (self.blame(), self.experience.run(self.task));
        let mut beliefs: BTreeMap<Symbol, ActionBelief> = BTreeMap::new();
        let mut state = self.state.clone();
        let foretold = plan.steps.iter().map(|step| {
            let schema = model.action(step.action.as_str())?;
            let hierarchy = &model.hierarchy;
            let deed = Deed::of(step, schema, &state, &self.instance, hierarchy);
            let around = surroundings(&deed, &self.model, &state);
            if let Ok(action) = schema.instantiate(&step.objects, &state, hierarchy) {
                advance(&mut state, action);
            }
            let learned = blame.action_of(&deed)?;
            let believed = || ActionBelief::new(learned, &self.evidence, &run, &self.model);
            beliefs.entry(learned.name.clone()).or_insert_with(believed).foretold(learned, &deed, &around, hierarchy)
        });
        foretold.collect()
    }

    /// What may have caused a failure, by all that was learned from and tried, the likeliest first; nothing if no learned action
    /// says anything of it. In time of what was tried.
    pub fn explanations(&self, failed: &Failed) -> Vec<Explanation> {
        let blame = self.blame();
        let Some(schema) = blame.action_of(&failed.deed) else { return Vec::new() };
        let run = self.experience.run(self.task);
        let belief = ActionBelief::new(schema, &self.evidence, &run, &self.model);
        let causes = belief.blame(schema, &failed.tried(self.task), &run, &self.model.hierarchy);
        let by_chance = (Culprit::Chance, CHANCE / (1.0 - CHANCE));
        let mut odds: Vec<(Culprit, f64)> = causes.into_iter().map(|(cause, odds)| (cause.culprit(), odds)).collect();
        odds.push(by_chance);
        odds.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let sum: f64 = odds.iter().map(|(_, odds)| odds).sum();
        odds.into_iter().map(|(kind, odds)| Explanation { kind, share: odds / sum }).collect()
    }

    /// The plan that there would be from where it is, on the terms that it has come to, without these calls; with the model that
    /// it was made with. Nothing is counted, and nobody is told.
    ///
    /// # Errors
    /// [`ProposeError`] as for [`propose`](crate::propose()).
    pub fn plan_without(
        &self,
        calls: &BTreeSet<GroundCall>,
        budget: &Budget,
    ) -> Result<Option<(Plan, Arc<ActionModel>)>, ProposeError> {
        let Some(execution) = &self.execution else { return Ok(None) };
        let mut restrictions = execution.terms.restrictions.clone();
        restrictions.calls.extend(calls.iter().cloned());
        let (task, options) = self.asked(&execution.terms, &self.state);
        let model = self.model_on(&execution.terms);
        let Terms { loosened, risks, .. } = &execution.terms;
        let proposal = attempt(&model, &task, &restrictions, &options, loosened, risks, budget)?;
        Ok(match proposal.outcome {
            Outcome::Solved(plan) => Some((plan, proposal.model)),
            _ => None,
        })
    }

    fn blame(&self) -> Blame<'_> {
        Blame { rule: self.options.blame, model: &self.model, evidence: &self.evidence }
    }
}

/// The state after an action, as it is expected.
fn advance(state: &mut State, action: GroundAction) {
    state.atoms.retain(|atom| !action.deletes.contains(atom));
    state.atoms.extend(action.adds);
}
