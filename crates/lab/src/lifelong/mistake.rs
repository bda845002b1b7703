//! Mistakes that are repeated: a step is taken that was thought unlikely to work, although another plan was thought likelier to.

use std::collections::BTreeSet;

use typelift::agent::Episode;
use typelift::model::{Budget, Plan};

/// A step that is less likely to work is a mistake if there is a better plan.
pub(super) const UNLIKELY: f64 = 0.1;

/// Other plans that are looked for.
const OTHERS: usize = 5;

/// What is believed of a plan.
#[derive(Debug, Clone, Default)]
pub(super) struct Foresight {
    /// How likely each step works; none where nothing is believed.
    pub(super) works: Vec<Option<f64>>,
    /// How likely another plan works that is likelier to than this one, if one was looked for, since a step is unlikely to work,
    /// and found.
    pub(super) better: Option<f64>,
}

/// What an episode believes of the plan that it proposes.
pub(super) fn foresee(episode: &Episode, plan: &Plan, budget: &Budget) -> Foresight {
    let Some(model) = episode.planned_with() else { return Foresight::default() };
    let works = episode.foretold(plan, model);
    let mut calls = BTreeSet::new();
    let (mut steps, mut better) = ((plan.clone(), works.clone()), None);
    for _ in 0..OTHERS {
        let unlikely = steps.0.steps.iter().zip(&steps.1).filter(|(_, p)| p.is_some_and(|p| p < UNLIKELY));
        let known = calls.len();
        calls.extend(unlikely.map(|(step, _)| step.call.clone()));
        if calls.len() == known {
            break;
        }
        // A search that was stopped found none.
        let Ok(Some((other, model))) = episode.plan_without(&calls, budget) else { break };
        let of_other = episode.foretold(&other, &model);
        if of_plan(&of_other) > of_plan(&works) {
            better = Some(of_plan(&of_other).max(better.unwrap_or_default()));
        }
        steps = (other, of_other);
    }
    Foresight { works, better }
}

/// How likely all steps work.
fn of_plan(works: &[Option<f64>]) -> f64 {
    works.iter().flatten().product()
}
