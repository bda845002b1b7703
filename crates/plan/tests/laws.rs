//! What holds of every search, on tiny random problems that are solved by enumeration beside: grounding finds exactly what
//! enumeration finds; a plan is found exactly if there is one, survives the plainest replay, and is a cheapest one where
//! that is promised; further plans are different ones.

use std::collections::BTreeSet;

use proptest::prelude::*;
use typelift_check::check;
use typelift_model::testing::{
    Cheapest, Instance, Tiny, all_instances, apply, cases, cheapest, reachable_atoms, reachable_instances, tiny,
};
use typelift_model::{
    ActionModel, ActionSchema, Atom, Budget, Effect, GroundAtom, GroundCall, LiftedCall, Literal, Plan, Provenance,
    Symbol, Task,
};
use typelift_plan::{
    FactId, GroundTask, Op, OpId, Options, Outcome, Planner, Restrictions, Strategy, TieOrder, ground,
};

/// So many plans of a task are looked at.
const MOST: usize = 12;

/// The calls of a plan, whatever their order and number.
type Calls = BTreeSet<GroundCall>;

fn calls(plan: &Plan) -> Calls {
    plan.steps.iter().map(|step| step.call.clone()).collect()
}

/// The calls of every plan of at most four steps in which no state comes twice.
fn short_plans(model: &ActionModel, instances: &[Instance], task: &Task) -> BTreeSet<Calls> {
    let (mut plans, mut ways) = (BTreeSet::new(), vec![(vec![task.init.atoms.clone()], Calls::new())]);
    while let Some((states, taken)) = ways.pop() {
        let Some(state) = states.last() else { continue };
        if task.goal.literals().all(|(atom, positive)| state.contains(atom) == positive) {
            plans.insert(taken);
        } else if states.len() <= 4 {
            for instance in instances {
                if let Some(next) = apply(instance, state).filter(|next| !states.contains(next)) {
                    let mut taken = taken.clone();
                    let schema = model.action(instance.action.as_str()).expect("it was instantiated");
                    taken.insert(schema.step(instance.objects.clone(), 0).call);
                    ways.push((states.iter().cloned().chain([next]).collect(), taken));
                }
            }
        }
    }
    plans
}

fn grounded(model: &ActionModel, task: &Task) -> GroundTask {
    ground(model, task, &Restrictions::default(), TieOrder::default(), &Budget::unlimited()).expect("no limits")
}

/// A ground action of the planner in the form of the enumeration.
fn instance(task: &GroundTask, id: OpId, op: &Op) -> Instance {
    let signed = |positive: &[FactId], negative: &[FactId]| {
        let positive = positive.iter().map(|&fact| (true, task.atom(fact)));
        positive.chain(negative.iter().map(|&fact| (false, task.atom(fact)))).collect::<BTreeSet<_>>()
    };
    let always = |facts: &[FactId], adds: bool| {
        facts.iter().map(|&fact| (BTreeSet::new(), adds, task.atom(fact))).collect::<Vec<_>>()
    };
    let mut effects: BTreeSet<_> = always(&op.adds, true).into_iter().chain(always(&op.deletes, false)).collect();
    effects.extend(op.conditional.iter().map(|e| (signed(&e.positive, &e.negative), e.adds, task.atom(e.fact))));
    let step = task.step(id);
    Instance {
        action: step.action,
        objects: step.objects,
        preconditions: signed(&op.preconditions, &op.negative),
        effects,
        cost: op.cost,
    }
}

proptest! {
    #![proptest_config(cases(4_000))]

    #[test]
    fn grounding_is_enumeration(Tiny { model, task } in tiny(4)) {
        let all = all_instances(&model, &task);
        let reachable = reachable_atoms(&all, &task);
        let expected = reachable_instances(&all, &reachable);
        let ground = grounded(&model, &task);
        let reached: BTreeSet<GroundAtom> = ground.reached_facts().map(|fact| ground.atom(fact)).collect();
        prop_assert_eq!(&reached, &reachable);
        prop_assert_eq!(ground.op_count_with_duplicates(), expected.len());
        let found: BTreeSet<Instance> = ground.ops().map(|(id, op)| instance(&ground, id, op)).collect();
        prop_assert_eq!(found, expected.into_iter().collect());
        let unreachable: Vec<_> = task.goal.required.iter().filter(|goal| !reachable.contains(goal)).cloned().collect();
        prop_assert_eq!(ground.unreachable_goals(), unreachable);
    }

    #[test]
    fn a_plan_is_found_exactly_if_there_is_one(Tiny { model, task } in tiny(3)) {
        let cheapest = cheapest(&all_instances(&model, &task), &task, 5_000);
        prop_assume!(cheapest != Cheapest::TooMany);
        let solvable = cheapest != Cheapest::None;
        let planner = |tie_order| {
            let options = Options { tie_order, ..Options::default() };
            Planner::new(&model, &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits")
        };
        if !solvable {
            let mut planner = planner(TieOrder::default());
            prop_assert_eq!(planner.next_plan(&Budget::unlimited()), Outcome::Unsolvable);
            prop_assert!(!planner.explain().to_string().is_empty());
        }
        // In every order; asked for better plans, it ends with the cheapest.
        for tie_order in [TieOrder::SpecificFirst, TieOrder::GeneralFirst, TieOrder::Name] {
            let mut planner = planner(tie_order);
            let mut outcome = planner.next_plan(&Budget::unlimited());
            let mut cost = None;
            while let Outcome::Solved(plan) = &outcome {
                prop_assert_eq!(check(&model, &task, plan).err(), None);
                prop_assert!(cost.is_none_or(|known| plan.cost() < known), "no better");
                cost = Some(plan.cost());
                outcome = planner.better_plan(plan.cost(), &Budget::unlimited());
            }
            match cheapest {
                Cheapest::Cost(least) => prop_assert_eq!((cost, outcome), (Some(least), Outcome::NoMorePlans)),
                _ => prop_assert_eq!((cost, outcome), (None, Outcome::Unsolvable)),
            }
        }
    }

    #[test]
    fn every_strategy_finds_plans_exactly_if_there_are_any(Tiny { model, task } in tiny(3)) {
        let cheapest = cheapest(&all_instances(&model, &task), &task, 5_000);
        prop_assume!(cheapest != Cheapest::TooMany);
        for strategy in Strategy::ALL {
            let options = Options { strategy, ..Options::default() };
            let planner =
                || Planner::new(&model, &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits");
            // Asked for better plans, it ends with the cheapest; an optimal one begins with it.
            let mut asked = planner();
            let mut outcome = asked.next_plan(&Budget::unlimited());
            let mut costs = Vec::new();
            while let Outcome::Solved(plan) = &outcome {
                prop_assert_eq!(check(&model, &task, plan).err(), None, "{}", strategy);
                prop_assert!(costs.last().is_none_or(|known| plan.cost() < *known), "{}: no better", strategy);
                costs.push(plan.cost());
                outcome = asked.better_plan(plan.cost(), &Budget::unlimited());
            }
            match cheapest {
                Cheapest::Cost(least) => {
                    prop_assert_eq!((costs.last(), outcome), (Some(&least), Outcome::NoMorePlans), "{}", strategy);
                    prop_assert!(!strategy.is_optimal() || costs.len() == 1, "{}: {:?}", strategy, costs);
                }
                _ => prop_assert_eq!((costs.last(), outcome), (None, Outcome::Unsolvable), "{}", strategy),
            }
        }
    }

    #[test]
    fn further_plans_are_all_that_do_not_contain_another(Tiny { model, task } in tiny(3)) {
        let instances = all_instances(&model, &task);
        prop_assume!(cheapest(&instances, &task, 5_000) != Cheapest::TooMany);
        let short = short_plans(&model, &instances, &task);
        for strategy in Strategy::ALL {
            let options = Options { strategy, ..Options::default() };
            let mut planner =
                Planner::new(&model, &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits");
            let (mut given, mut costs): (Vec<Calls>, Vec<u64>) = (Vec::new(), Vec::new());
            let mut outcome = planner.next_plan(&Budget::unlimited());
            while let Outcome::Solved(plan) = &outcome {
                prop_assert_eq!(check(&model, &task, plan).err(), None, "{}", strategy);
                let calls = calls(plan);
                prop_assert!(!given.iter().any(|known| known.is_subset(&calls)), "{}: {:?} is no other", strategy, calls);
                if !given.is_empty() {
                    for step in 0..plan.len() {
                        let mut steps = plan.steps.clone();
                        steps.remove(step);
                        prop_assert!(check(&model, &task, &Plan { steps }).is_err(), "{}: step {} is useless", strategy, step);
                    }
                }
                given.push(calls);
                costs.push(plan.cost());
                if given.len() == MOST {
                    break;
                }
                outcome = planner.next_plan(&Budget::unlimited());
            }
            prop_assert!(!strategy.is_optimal() || costs.is_sorted(), "{}: {:?}", strategy, costs);
            if given.len() < MOST {
                let missed = short.iter().find(|plan| !given.iter().any(|known| known.is_subset(plan)));
                prop_assert_eq!(missed, None, "{}: {:?}", strategy, given);
            }
        }
    }
}

#[test]
fn a_plan_with_a_step_more_is_no_other_plan() {
    let action = |name: &str, add: &str| ActionSchema {
        name: Symbol::new(name),
        call: LiftedCall { name: Symbol::new(name), args: Vec::new() },
        parameters: Vec::new(),
        preconditions: Vec::new(),
        distinct: Vec::new(),
        effects: vec![Effect::always(Literal::positive(Atom::new(add, Vec::new())))],
        cost: 1.into(),
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    };
    let planner = |names: &[(&str, &str)]| {
        let mut actions: Vec<_> = names.iter().map(|(name, add)| action(name, add)).collect();
        actions.sort_by(|a, b| a.name.cmp(&b.name));
        let model = ActionModel { actions, ..ActionModel::default() };
        let task = Task::new(Default::default(), vec![GroundAtom::new("done", Vec::new())]);
        Planner::new(&model, &task, &Restrictions::default(), &Options::default(), &Budget::unlimited())
            .expect("no limits")
    };
    let plans = |mut planner: Planner| {
        let mut plans = Vec::new();
        loop {
            match planner.next_plan(&Budget::unlimited()) {
                Outcome::Solved(plan) => {
                    plans.push(plan.steps.iter().map(|s| s.action.to_string()).collect::<Vec<_>>());
                }
                end => {
                    // Asked again and again, it says the same.
                    assert!((0..70).all(|_| planner.next_plan(&Budget::unlimited()) == end));
                    break (plans, end);
                }
            }
        }
    };
    for detour in ["a", "z"] {
        assert_eq!(
            plans(planner(&[(detour, "noise"), ("b", "done")])),
            (vec![vec!["b".to_owned()]], Outcome::NoMorePlans)
        );
    }
    let both = vec![vec!["b".to_owned()], vec!["c".to_owned()]];
    assert_eq!(plans(planner(&[("a", "noise"), ("b", "done"), ("c", "done")])), (both, Outcome::NoMorePlans));
}
