//! Restrictions as literals say what restrictions say: the same ground actions, the same plan, in the kitchen and where
//! parameters may be equal and effects depend on the state.

use std::collections::BTreeSet;

use proptest::prelude::*;
use typelift::agent::{Options, propose};
use typelift::imagine;
use typelift::model::{ActionModel, Budget, Step, Symbol, Task};
use typelift::plan::{
    Ban, Exclusion, Options as PlanOptions, Outcome, Planner, Restrictions, TieOrder, TypeExclusion, ground,
};
use typelift_kitchen::tasks;
use typelift_model::testing::cases;
use typelift_tests::{kitchen_model, planning_task};

/// Enough for every kitchen task; both searches stop at the same place.
const EXPANSIONS: u64 = 2_000;

fn steps(model: &ActionModel, task: &Task, restrictions: &Restrictions) -> BTreeSet<(Symbol, Vec<Symbol>)> {
    let ground = ground(model, task, restrictions, TieOrder::default(), &Budget::unlimited()).expect("no limits");
    ground.ops().map(|(id, _)| ground.step(id)).map(|step: Step| (step.action, step.objects)).collect()
}

fn outcome(model: &ActionModel, task: &Task, restrictions: &Restrictions) -> Outcome {
    let budget = Budget::with_expansions(EXPANSIONS);
    let mut planner = Planner::new(model, task, restrictions, &PlanOptions::default(), &budget).expect("no limits");
    planner.next_plan(&budget)
}

/// Bans, calls and exclusions picked by numbers: actions by their place among the ground actions, objects by theirs.
fn restrictions(
    model: &ActionModel,
    task: &Task,
    bans: &[usize],
    calls: &[usize],
    excluded: &[(usize, usize)],
) -> Restrictions {
    let all: Vec<_> = steps(model, task, &Restrictions::default()).into_iter().collect();
    let objects: Vec<&Symbol> = task.init.objects.keys().collect();
    let mut restrictions = Restrictions::default();
    if all.is_empty() {
        return restrictions;
    }
    let picked = |pick: &usize| {
        let (action, chosen) = &all[pick % all.len()];
        let schema = model.action(action.as_str()).expect("an action of the model");
        schema.instantiate(chosen, &task.init, &model.hierarchy).expect("it fits")
    };
    restrictions.banned = bans.iter().map(|pick| Ban::of(&picked(pick))).collect();
    restrictions.calls = calls.iter().map(|pick| picked(pick).call).collect();
    for (object, call) in excluded {
        // One number past the calls is all of them.
        let call = model.actions.get(call % (model.actions.len() + 1)).map(|action| action.call.name.clone());
        restrictions.excluded.insert(Exclusion { object: objects[object % objects.len()].clone(), call });
    }
    restrictions
}

/// Types excluded by numbers: an action by its place, one or two of its call's arguments, an object of the type.
fn type_exclusions(model: &ActionModel, task: &Task, picks: &[(usize, usize, bool)]) -> BTreeSet<TypeExclusion> {
    let objects: Vec<&Symbol> = task.init.objects.keys().collect();
    let exclusion = |&(action, object, by_effect): &(usize, usize, bool)| {
        let schema = &model.actions[action % model.actions.len()];
        let places = (0..schema.call.args.len()).filter(|place| place % 2 == object % 2 || action % 3 == 0);
        let ty = |place: usize| model.hierarchy.name(task.init.objects[objects[(object + place) % objects.len()]]);
        TypeExclusion {
            call: schema.call.name.clone(),
            adds: schema.adds().take(usize::from(by_effect)).map(|atom| atom.predicate.clone()).collect(),
            types: places.take(2).map(|place| (place, ty(place).clone())).collect(),
        }
    };
    picks.iter().map(exclusion).filter(|exclusion| !exclusion.types.is_empty()).collect()
}

/// The same ground actions and the same outcome.
fn assert_same(model: &ActionModel, task: &Task, restrictions: &Restrictions) -> Outcome {
    let (compiled, stated) = restrictions.compiled_into(model, task);
    assert_eq!(steps(model, task, restrictions), steps(&compiled, &stated, &Restrictions::default()));
    let found = outcome(model, task, restrictions);
    assert_eq!(found, outcome(&compiled, &stated, &Restrictions::default()), "{restrictions:?}");
    found
}

#[test]
fn plans_of_the_kitchen_are_the_same() {
    let model = kitchen_model(false);
    let options = Options { imagine: Some(imagine::Options::default()), ..Options::default() };
    let (mut solved, mut lost) = (0, 0);
    for (number, task) in tasks().iter().enumerate() {
        let asked = planning_task(&model, task, 0);
        let nothing = Restrictions::default();
        let proposal = propose(&model, &asked, &nothing, &options, &Budget::unlimited()).expect("a plan");
        let Outcome::Solved(plan) = &proposal.outcome else { panic!("{}: no plan", task.name) };
        let model = &proposal.model;
        let mut restrictions =
            restrictions(model, &asked, &[number * 97, number * 31 + 5], &[number * 53], &[(number * 13 + 1, number)]);
        restrictions.types = type_exclusions(model, &asked, &[(number * 7, number * 5, number % 2 == 0)]);
        let found = assert_same(model, &asked, &restrictions);
        solved += usize::from(matches!(found, Outcome::Solved(_)));
        // Mostly, nothing else leads to the goal than what the plan rests on.
        let step = &plan.steps[number % plan.len()];
        let schema = model.action(step.action.as_str()).expect("an action of the model");
        let action = schema.instantiate(&step.objects, &asked.init, &model.hierarchy).expect("it fits");
        match number % 2 {
            0 => restrictions.banned.insert(Ban::of(&action)),
            _ => restrictions.calls.insert(action.call),
        };
        let found = assert_same(model, &asked, &restrictions);
        assert_ne!(found, Outcome::Solved(plan.clone()), "{}", task.name);
        lost += usize::from(found == Outcome::Unsolvable);
    }
    assert!(solved >= 12 && lost >= 6, "{solved} solved, {lost} unsolvable: the restrictions are not varied enough");
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn plans_of_tiny_problems_are_the_same(
        tiny in typelift_model::testing::tiny(2),
        bans in prop::collection::vec(any::<usize>(), 0..4),
        calls in prop::collection::vec(any::<usize>(), 0..3),
        excluded in prop::collection::vec((any::<usize>(), any::<usize>()), 0..3),
        types in prop::collection::vec(any::<(usize, usize, bool)>(), 0..3),
    ) {
        let mut restrictions = restrictions(&tiny.model, &tiny.task, &bans, &calls, &excluded);
        restrictions.types = type_exclusions(&tiny.model, &tiny.task, &types);
        assert_same(&tiny.model, &tiny.task, &restrictions);
    }
}
