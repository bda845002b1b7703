//! Large tasks are planned with some of their objects first: with many that do not matter besides, a task is solved exactly
//! if it is without them; what needs many of them is solved too; and however often it is stopped, the plan is the same.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use proptest::prelude::*;
use typelift_check::check;
use typelift_model::testing::{Cheapest, Tiny, all_instances, cases, cheapest, tiny};
use typelift_model::{
    ActionModel, ActionSchema, Budget, Effect, GroundAtom, Hierarchy, LiftedAtom, LiftedCall, Literal, Parameter, Plan,
    Provenance, Stop, Symbol, Task, Term,
};
use typelift_plan::{Explanation, Options, Outcome, Planner, Restrictions, Strategy};

/// Hundreds of objects more, of a type that no action takes.
fn padded(tiny: &Tiny) -> Tiny {
    let Tiny { mut model, mut task } = tiny.clone();
    let block = model.hierarchy.id("block").expect("a type");
    for parameter in model.actions.iter_mut().flat_map(|action| &mut action.parameters) {
        if parameter.ty == model.hierarchy.root() {
            parameter.ty = block;
        }
    }
    model.hierarchy = model.hierarchy.extended([("decor", "object")]).expect("a new type");
    let decor = model.hierarchy.id("decor").expect("a type");
    for number in 0..500 {
        let name = Symbol::from(format!("decor-{number}"));
        let beside = if number % 3 == 0 { Symbol::new("ada") } else { Symbol::from(format!("decor-{}", number / 2)) };
        task.init.atoms.insert(GroundAtom::new("on", vec![name.clone(), beside]));
        task.init.objects.insert(name, decor);
    }
    Tiny { model, task }
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn what_does_not_matter_changes_nothing(tiny in tiny(4), lama in any::<bool>()) {
        let large = padded(&tiny);
        let small = Tiny { model: large.model.clone(), task: tiny.task };
        let strategy = if lama { Strategy::LamaPortfolio } else { Strategy::default() };
        let options = Options { strategy, ..Options::default() };
        let (restrictions, no_limit) = (Restrictions::default(), Budget::unlimited());
        let mut planner =
            Planner::new(&large.model, &large.task, &restrictions, &options, &no_limit).expect("no limits");
        let outcome = planner.next_plan(&no_limit);
        match cheapest(&all_instances(&small.model, &small.task), &small.task, 3_000) {
            Cheapest::Cost(cost) => {
                let Outcome::Solved(mut plan) = outcome else { return Err(TestCaseError::fail("there is a plan")) };
                prop_assert!(check(&large.model, &large.task, &plan).is_ok());
                // Better and better ones come down to the cheapest, and that there is none says all objects.
                let end = loop {
                    match planner.better_plan(plan.cost(), &no_limit) {
                        Outcome::Solved(better) => plan = better,
                        end => break end,
                    }
                };
                prop_assert_eq!((plan.cost(), end), (cost, Outcome::NoMorePlans));
            }
            Cheapest::None => {
                prop_assert_eq!(outcome, Outcome::Unsolvable);
                let mut alone = Planner::new(&small.model, &small.task, &restrictions, &options, &no_limit).expect("no limits");
                prop_assert_eq!(alone.next_plan(&no_limit), Outcome::Unsolvable);
                prop_assert_eq!(planner.explain(), alone.explain());
            }
            Cheapest::TooMany => {}
        }
    }
}

/// A road of so many miles, 1,500 cans of which the first so many are full: each mile takes a full can.
fn road(miles: usize, full: usize) -> (ActionModel, Task) {
    let hierarchy = Hierarchy::from_edges([("can", "object"), ("place", "object")]).expect("a tree");
    let ty = |name: &str| hierarchy.id(name).expect("declared");
    let literal = |text: &str, positive| Literal { atom: LiftedAtom::parse(text).expect("an atom"), positive };
    let parameter = |name: &str, of: &str| Parameter { name: name.into(), ty: ty(of) };
    let mut drive = ActionSchema {
        name: "drive".into(),
        call: LiftedCall { name: "drive".into(), args: (0..3).map(Term::Param).collect() },
        parameters: vec![parameter("c", "can"), parameter("a", "place"), parameter("b", "place")],
        preconditions: ["at(?1)", "full(?0)", "next(?1, ?2)"].map(|text| literal(text, true)).into(),
        distinct: ActionSchema::all_distinct(3),
        effects: [("at(?1)", false), ("at(?2)", true), ("full(?0)", false)]
            .map(|(text, positive)| Effect::always(literal(text, positive)))
            .into(),
        cost: 1.into(),
        strict: false,
        named_by_call: true,
        provenance: Provenance::Given,
    };
    drive.preconditions.sort_unstable();
    drive.effects.sort_unstable();
    let place = |mile: usize| Symbol::from(format!("place-{mile:03}"));
    let can = |number: usize| Symbol::from(format!("can-{number:03}"));
    let mut task = Task::new(Default::default(), vec![GroundAtom::new("at", vec![place(miles)])]);
    task.init.atoms.insert(GroundAtom::new("at", vec![place(0)]));
    task.init.objects.extend((0..=miles).map(|mile| (place(mile), ty("place"))));
    task.init.objects.extend((0..1_500).map(|number| (can(number), ty("can"))));
    let next = |mile: usize| GroundAtom::new("next", vec![place(mile), place(mile + 1)]);
    task.init.atoms.extend((0..miles).map(next));
    task.init.atoms.extend((0..full).map(|number| GroundAtom::new("full", vec![can(number)])));
    (ActionModel { hierarchy, actions: vec![drive], ..ActionModel::default() }, task)
}

fn planner(of: &(ActionModel, Task), strategy: Strategy) -> Planner {
    let options = Options { strategy, ..Options::default() };
    Planner::new(&of.0, &of.1, &Restrictions::default(), &options, &Budget::unlimited()).expect("no limits")
}

const STRATEGIES: [Strategy; 3] = [Strategy::OrderedLandmarks, Strategy::LamaPortfolio, Strategy::LazyFf];

#[test]
fn objects_are_added_until_there_are_enough() {
    let (road, no_limit) = (road(5, 1_500), Budget::unlimited());
    for strategy in STRATEGIES {
        let mut planner = planner(&road, strategy);
        let Outcome::Solved(plan) = planner.next_plan(&no_limit) else { panic!("{strategy}: there is a plan") };
        assert!(check(&road.0, &road.1, &plan).is_ok() && plan.steps.len() == 5);
        // With 1, 2, 4 and 8 cans; all would be 7,500.
        assert!(planner.report().ground_actions <= 5 * (1 + 2 + 4 + 8), "{strategy}");
    }
}

#[test]
fn that_nothing_is_better_is_said_of_all_objects() {
    let (road, no_limit) = (road(5, 8), Budget::unlimited());
    for strategy in STRATEGIES {
        let mut planner = planner(&road, strategy);
        let Outcome::Solved(plan) = planner.next_plan(&no_limit) else { panic!("{strategy}: there is a plan") };
        let before = planner.report().facts;
        assert_eq!(planner.better_plan(plan.cost(), &no_limit), Outcome::NoMorePlans, "{strategy}");
        assert!(planner.report().facts > before + 20, "{strategy}: with no more objects");
    }
}

#[test]
fn what_cannot_be_done_is_said_of_all_objects() {
    let (short, no_limit) = (road(5, 4), Budget::unlimited());
    for strategy in STRATEGIES {
        let mut planner = planner(&short, strategy);
        assert_eq!(planner.next_plan(&no_limit), Outcome::Unsolvable, "{strategy}");
        assert!(matches!(planner.explain(), Explanation::NotTogether { .. }));
        assert_eq!(planner.ground_task().op_count(), 20);
    }
    let mut nowhere = road(5, 4);
    nowhere.1.goal.required.push(GroundAtom::new("at", vec!["can-001".into()]));
    let mut planner = planner(&nowhere, Strategy::default());
    assert_eq!(planner.next_plan(&no_limit), Outcome::Unsolvable);
    let Explanation::Unreachable(goals) = planner.explain() else { panic!("a can is no place") };
    assert_eq!(goals.len(), 1);
}

#[test]
fn further_plans_are_different_to_the_end() {
    let road = road(2, 12);
    let (mut planner, mut found) = (planner(&road, Strategy::default()), BTreeSet::new());
    let end = loop {
        match planner.next_plan(&Budget::unlimited()) {
            Outcome::Solved(plan) => {
                assert!(check(&road.0, &road.1, &plan).is_ok());
                let mut steps: Vec<_> = plan.steps.iter().map(|step| step.objects.clone()).collect();
                steps.sort_unstable();
                assert!(found.insert(steps), "the same again");
            }
            end => break end,
        }
    };
    assert_eq!(end, Outcome::NoMorePlans);
    assert!(!found.is_empty());
}

/// Asked again and again, each time being allowed a little more.
fn with_patience(road: &(ActionModel, Task), strategy: Strategy) -> (Plan, Planner, usize) {
    let budget = |questions: usize| {
        let asked = Arc::new(AtomicUsize::new(0));
        let stop = move || (asked.fetch_add(1, Ordering::Relaxed) >= questions).then_some(Stop::Time);
        Budget { stop: Some(Arc::new(stop)), ..Budget::default() }
    };
    let options = Options { strategy, ..Options::default() };
    let mut begun = (0..).map(|n| Planner::new(&road.0, &road.1, &Restrictions::default(), &options, &budget(n)));
    let mut planner = begun.find_map(Result::ok).expect("enough in the end");
    for stops in 0.. {
        match planner.next_plan(&budget(stops)) {
            Outcome::Solved(plan) => return (plan, planner, stops),
            outcome => assert_eq!(outcome, Outcome::Stopped(Stop::Time)),
        }
    }
    unreachable!("it ends")
}

#[test]
fn however_often_it_is_stopped_the_plan_is_the_same() {
    let road = road(5, 1_500);
    for strategy in STRATEGIES {
        let mut unlimited = planner(&road, strategy);
        let Outcome::Solved(expected) = unlimited.next_plan(&Budget::unlimited()) else { panic!("there is a plan") };
        let (plan, patient, stops) = with_patience(&road, strategy);
        assert!(stops > 5, "{stops} stops: nothing was tested");
        assert_eq!(plan, expected, "{strategy}");
        assert_eq!(patient.report().ground_actions, unlimited.report().ground_actions, "{strategy}");
        let mut step_by_step = planner(&road, strategy);
        let plan = loop {
            match step_by_step.next_plan(&Budget::with_expansions(1)) {
                Outcome::Solved(plan) => break plan,
                outcome => assert_eq!(outcome, Outcome::Stopped(Stop::Expansions)),
            }
        };
        assert_eq!((plan, step_by_step.report()), (expected, unlimited.report()), "{strategy}");
    }
}
