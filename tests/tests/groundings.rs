//! How often what can be reached of a task is worked out for one proposal: once, and once more where actions were imagined,
//! which reach more.

use typelift::agent::{Options, propose};
use typelift::imagine;
use typelift::model::{Budget, Goal, Stop};
use typelift::plan::{Outcome, Reachable, Restrictions};
use typelift_kitchen::tasks;
use typelift_tests::{kitchen_model, planning_task};

#[test]
fn a_task_is_worked_out_once_and_once_more_with_what_is_imagined() {
    let (model, nothing) = (kitchen_model(false), Restrictions::default());
    let (mut once, mut twice) = (0, 0);
    for strict in [true, false] {
        let options = Options { imagine: Some(imagine::Options::default()), strict, ..Options::default() };
        for task in tasks() {
            let asked = planning_task(&model, &task, 0);
            let proposal = propose(&model, &asked, &nothing, &options, &Budget::unlimited()).expect("no limits");
            let imagined = !proposal.imagination.actions.is_empty();
            assert_eq!(proposal.report().groundings, 1 + u64::from(imagined), "{}", task.name);
            (once, twice) = (once + u64::from(!imagined), twice + u64::from(imagined));
        }
    }
    assert!(once > 10 && twice > 10, "{once} and {twice}: nothing was tested");
}

#[test]
fn what_is_given_is_what_would_be_worked_out() {
    let model = kitchen_model(false);
    for task in tasks() {
        let asked = planning_task(&model, &task, 0);
        let plan = |imagine| {
            let options = Options { imagine, ..Options::default() };
            let found = propose(&model, &asked, &Restrictions::default(), &options, &Budget::unlimited());
            let found = found.expect("no limits");
            (found.outcome.clone(), found.report(), found.imagination.actions.is_empty())
        };
        let (given, alone) = (plan(Some(imagine::Options::default())), plan(None));
        if given.2 && matches!(alone.0, Outcome::Solved(_)) {
            assert_eq!((given.0, given.1), (alone.0, alone.1), "{}", task.name);
        }
    }
}

#[test]
fn atoms_and_goals_that_are_reached() {
    let model = kitchen_model(false);
    let task = tasks().into_iter().find(|task| task.name == "T1.1").expect("a task");
    let mut asked = planning_task(&model, &task, 0);
    let nothing = Restrictions::default();
    let reachable = Reachable::of(&model, &asked, &nothing, &Budget::unlimited()).expect("no limits");
    assert!(reachable.unreached_goals().is_empty());
    let atoms = reachable.atoms_by_predicate();
    assert!(atoms.iter().all(|(predicate, atoms)| atoms.iter().all(|atom| atom.predicate == *predicate)));
    assert!(asked.init.atoms.iter().chain(&asked.goal.required).all(|atom| atoms[&atom.predicate].contains(atom)));
    // A goal that nothing adds, with one that holds.
    let mut missing = asked.goal.required[0].clone();
    missing.args.push(missing.args[0].clone());
    asked.goal = Goal { required: vec![asked.goal.required[0].clone(), missing.clone()], ..Goal::default() };
    let reachable = Reachable::of(&model, &asked, &nothing, &Budget::unlimited()).expect("no limits");
    assert_eq!(reachable.unreached_goals(), [missing.clone()]);
    assert!(!reachable.reaches(&missing));
    let cancelled = Budget { stop: Some(std::sync::Arc::new(|| Some(Stop::Cancelled))), ..Budget::default() };
    assert_eq!(Reachable::of(&model, &asked, &nothing, &cancelled).map(drop), Err(Stop::Cancelled));
}
