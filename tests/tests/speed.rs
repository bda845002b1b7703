//! Fast enough, by generous bounds: learning from the eight demonstrations, and planning each of the 24 tasks with
//! imagination. Only a release build is held to them (`cargo test --release -p typelift-tests --test speed`); any
//! build prints the figures with `--nocapture`. Each figure is the best of a few, so that a busy machine does not
//! fail the test.

use std::time::{Duration, Instant};

use typelift::agent::{Options, propose};
use typelift::imagine;
use typelift::learn::{self, learn_dataset};
use typelift::model::Budget;
use typelift::plan::{Outcome, Restrictions};
use typelift_kitchen::{demonstrations, tasks};
use typelift_tests::{dataset_of, kitchen_model, planning_task};

const LEARNING: Duration = Duration::from_millis(20);
const PLANNING: Duration = Duration::from_millis(100);

/// The shortest of three times.
fn best<T>(mut work: impl FnMut() -> T) -> (Duration, T) {
    let mut timed = || {
        let start = Instant::now();
        let result = work();
        (start.elapsed(), result)
    };
    let (first, second, (last, result)) = (timed().0, timed().0, timed());
    (first.min(second).min(last), result)
}

/// Bounds hold in a release build.
fn assert_below(took: Duration, bound: Duration, what: &str) {
    assert!(cfg!(debug_assertions) || took < bound, "{what} took {took:?}, more than {bound:?}");
}

#[test]
fn learning_is_fast() {
    let shown = demonstrations(0);
    let (parsing, dataset) = best(|| dataset_of(&shown));
    let (learning, (learned, report)) = best(|| learn_dataset(&dataset, &learn::Options::default()).expect("a model"));
    println!("{} transitions parsed in {parsing:?}, learned in {learning:?}", report.transitions);
    assert_eq!((report.transitions, learned.model.actions.len()), (68, 13));
    assert_below(parsing + learning, LEARNING, "learning");
}

#[test]
fn planning_is_fast() {
    let model = kitchen_model(false);
    let options = Options { imagine: Some(imagine::Options::default()), ..Options::default() };
    let mut total = Duration::ZERO;
    for task in tasks() {
        let asked = planning_task(&model, &task, 0);
        let (took, proposal) =
            best(|| propose(&model, &asked, &Restrictions::default(), &options, &Budget::unlimited()).expect("a plan"));
        let Outcome::Solved(plan) = &proposal.outcome else { panic!("{}: {:?}", task.name, proposal.outcome) };
        let report = proposal.report();
        println!(
            "{}: {} steps in {took:?}, {} expansions, {} ground actions, {} actions imagined",
            task.name,
            plan.len(),
            report.expansions,
            report.ground_actions,
            proposal.imagination.actions.len()
        );
        assert_below(took, PLANNING, &task.name);
        total += took;
    }
    println!("all of them in {total:?}");
}
