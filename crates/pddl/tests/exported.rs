//! What is exported for planners that know no negation says what was meant: the same states can be reached. Conditions
//! that others imply are left out there; that they are implied is what this holds.

use std::collections::BTreeSet;

use proptest::prelude::*;
use typelift_model::testing::{Tiny, all_instances, apply, cases, tiny};
use typelift_model::{ActionModel, GroundAtom, Task, strict};
use typelift_pddl::{ExportOptions, Exported, Level, compile_domain, compile_problem, export};

/// More states than these are not enumerated.
const MOST: usize = 3_000;

/// Every state that can be reached, without the atoms of other predicates than `model`'s; none if there are too many.
fn reachable(model: &ActionModel, task: &Task, shown: &ActionModel) -> Option<BTreeSet<BTreeSet<GroundAtom>>> {
    let instances = all_instances(model, task);
    let mut states = BTreeSet::from([task.init.atoms.clone()]);
    let mut open = vec![task.init.atoms.clone()];
    while let Some(state) = open.pop() {
        for after in instances.iter().filter_map(|instance| apply(instance, &state)) {
            if states.insert(after.clone()) {
                open.push(after);
            }
        }
        if states.len() > MOST {
            return None;
        }
    }
    let is_shown = |atom: &GroundAtom| shown.predicates.contains_key(&atom.predicate);
    Some(states.into_iter().map(|state| state.into_iter().filter(is_shown).collect()).collect())
}

/// Without conditional effects, and strict: that is where conditions imply others.
fn plain(tiny: &Tiny) -> ActionModel {
    let mut model = tiny.model.clone();
    for action in &mut model.actions {
        action.cost = 1.into();
        for effect in &mut action.effects {
            effect.condition.clear();
        }
    }
    strict(&model)
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn the_same_states_can_be_reached(tiny in tiny(3)) {
        let model = plain(&tiny);
        let options = ExportOptions { domain: "d".into(), problem: "p".into(), level: Level::Strips };
        // Some add what they delete, which STRIPS cannot say.
        let Ok(Exported { domain, problem, .. }) = export(&model, Some(&tiny.task), &options) else { return Ok(()) };
        let mut read = compile_domain(&domain).expect("a domain");
        let task = compile_problem(&problem.expect("a problem"), &mut read).expect("a problem");
        let (meant, said) = (reachable(&model, &tiny.task, &model), reachable(&read, &task, &model));
        if meant.is_some() && said.is_some() {
            prop_assert_eq!(meant, said, "{}", domain);
        }
    }
}
