//! What holds of every search, on tiny random problems that are solved by enumeration beside: grounding finds exactly what
//! enumeration finds; a plan is found exactly if there is one, survives the plainest replay, and is a cheapest one where
//! that is promised; further plans are different ones.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use typelift_check::check;
use typelift_model::testing::{
    Cheapest, Instance, Tiny, all_instances, cases, cheapest, reachable_atoms, reachable_instances, tiny,
};
use typelift_model::{
    ActionModel, ActionSchema, Atom, Budget, Effect, GroundAtom, LiftedCall, Literal, Plan, Provenance, Symbol, Task,
};
use typelift_plan::{
    FactId, GroundTask, Op, OpId, Options, Outcome, Planner, Restrictions, Strategy, TieOrder, ground,
};

/// Enough for every problem that is solved at all.
const EXPANSIONS: u64 = 20_000;

/// The actions of a plan with their number, whatever their order.
fn multiset(plan: &Plan) -> BTreeMap<(Symbol, Vec<Symbol>), usize> {
    let mut actions = BTreeMap::new();
    for step in &plan.steps {
        *actions.entry((step.action.clone(), step.objects.clone())).or_default() += 1;
    }
    actions
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
        let planner = |tie_order, plans| {
            let options = Options { tie_order, plans, ..Options::default() };
            Planner::new(&model, &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits")
        };
        // Several ways to each node.
        let mut several = planner(TieOrder::default(), 3);
        let mut plans = Vec::new();
        while let Outcome::Solved(plan) = several.next_plan(&Budget::with_expansions(EXPANSIONS)) {
            prop_assert_eq!(check(&model, &task, &plan).err(), None);
            plans.push(multiset(&plan));
            if plans.len() == 4 {
                break;
            }
        }
        prop_assert_eq!(!plans.is_empty(), solvable);
        prop_assert_eq!(plans.iter().collect::<BTreeSet<_>>().len(), plans.len());
        if !solvable {
            prop_assert_eq!(several.next_plan(&Budget::unlimited()), Outcome::Unsolvable);
            prop_assert!(!several.explain().to_string().is_empty());
        }
        // The plain search, in every order; asked for better plans, it ends with the cheapest.
        for tie_order in [TieOrder::SpecificFirst, TieOrder::GeneralFirst, TieOrder::Name] {
            let mut planner = planner(tie_order, 1);
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
            // Further plans are different ones.
            let mut asked = planner();
            let mut plans = Vec::new();
            while let Outcome::Solved(plan) = asked.next_plan(&Budget::with_expansions(EXPANSIONS)) {
                prop_assert_eq!(check(&model, &task, &plan).err(), None, "{}", strategy);
                plans.push(multiset(&plan));
                if plans.len() == 3 {
                    break;
                }
            }
            prop_assert_eq!(plans.iter().collect::<BTreeSet<_>>().len(), plans.len(), "{}", strategy);
        }
    }
}

#[test]
fn a_further_plan_may_differ_in_any_action() {
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
    for detour in ["a", "z"] {
        let mut actions = vec![action(detour, "noise"), action("b", "done")];
        actions.sort_by(|a, b| a.name.cmp(&b.name));
        let model = ActionModel { actions, ..ActionModel::default() };
        let task = Task::new(Default::default(), vec![GroundAtom::new("done", Vec::new())]);
        let options = Options { plans: 2, ..Options::default() };
        let mut planner =
            Planner::new(&model, &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits");
        let lengths = [(); 2].map(|()| match planner.next_plan(&Budget::unlimited()) {
            Outcome::Solved(plan) => plan.len(),
            other => panic!("{detour}: {other:?}"),
        });
        assert_eq!(lengths, [1, 2]);
    }
}
