//! How long learning and planning take in the kitchen: reading and learning the eight demonstrations, and for each of
//! the 24 tasks grounding, imagining and planning, and a task by every strategy. The items counted are states, transitions, ground actions and
//! expansions. Run with `cargo bench -p typelift-tests`.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use typelift::agent::{Options, Proposal, propose};
use typelift::imagine::{self, imagine};
use typelift::learn::{self, evidence_of, learn};
use typelift::model::{ActionModel, Budget, Task, strict};
use typelift::plan::{self, Planner, Restrictions, Strategy, TieOrder, ground};
use typelift_kitchen::{demonstrations, tasks};
use typelift_tests::{dataset_of, kitchen_model, planning_task};

fn main() {
    divan::main();
}

fn names() -> Vec<String> {
    tasks().into_iter().map(|task| task.name).collect()
}

/// The generalized model, and a task.
fn asked(name: &str) -> (ActionModel, Task) {
    let model = kitchen_model(false);
    let task = tasks().into_iter().find(|task| task.name == name).expect("a task of this name");
    let task = planning_task(&model, &task, 0);
    (model, task)
}

#[divan::bench(max_time = 1)]
fn parse(bencher: Bencher) {
    let shown = demonstrations(0);
    let states: usize = shown.iter().map(|demonstration| demonstration.recording.scenes().count()).sum();
    bencher.counter(ItemsCount::new(states)).bench(|| dataset_of(black_box(&shown)));
}

#[divan::bench(max_time = 1)]
fn cluster(bencher: Bencher) {
    let dataset = dataset_of(&demonstrations(0));
    bencher.counter(ItemsCount::new(dataset.transitions().count())).bench(|| evidence_of(black_box(&dataset)));
}

#[divan::bench(max_time = 1)]
fn generalize(bencher: Bencher) {
    let dataset = dataset_of(&demonstrations(0));
    let evidence = evidence_of(&dataset);
    bencher
        .counter(ItemsCount::new(evidence.transitions))
        .bench(|| learn(&dataset.hierarchy, black_box(&evidence), &learn::Options::default()));
}

#[divan::bench(args = ["T1.1", "T4.4", "T6.4"], max_time = 1)]
fn imagine_actions(bencher: Bencher, name: &str) {
    let (model, task) = asked(name);
    let (restrictions, options) = (Restrictions::default(), imagine::Options::default());
    bencher.bench(|| imagine(black_box(&model), &task, &restrictions, &options, &Budget::unlimited()));
}

#[divan::bench(args = ["T1.1", "T4.4", "T6.4"], max_time = 1)]
fn ground_actions(bencher: Bencher, name: &str) {
    let (model, task) = asked(name);
    let model = strict(&model);
    let grounded =
        || ground(black_box(&model), &task, &Restrictions::default(), TieOrder::default(), &Budget::unlimited());
    let count = grounded().expect("no limits").op_count();
    bencher.counter(ItemsCount::new(count)).bench(grounded);
}

/// Everything from the task to a plan that was checked: imagination, grounding, landmarks, search, check.
#[divan::bench(args = names(), max_time = 0.5)]
fn propose_plan(bencher: Bencher, name: &str) {
    let (model, task) = asked(name);
    let options = Options { imagine: Some(imagine::Options::default()), ..Options::default() };
    let planned = || -> Proposal {
        propose(black_box(&model), &task, &Restrictions::default(), &options, &Budget::unlimited()).expect("a plan")
    };
    let expansions = planned().report().expansions;
    bencher.counter(ItemsCount::new(expansions)).bench(planned);
}

/// Every strategy on a task that all of them solve.
#[divan::bench(args = Strategy::ALL, max_time = 0.5)]
fn search(bencher: Bencher, strategy: Strategy) {
    let (model, task) = asked("T1.2");
    let options = plan::Options { strategy, ..plan::Options::default() };
    let solved = || {
        let unlimited = Budget::unlimited();
        let mut planner =
            Planner::new(black_box(&model), &task, &Restrictions::default(), &options, &unlimited).expect("no limits");
        planner.next_plan(&unlimited);
        planner.report().evaluations
    };
    let evaluations = solved();
    bencher.counter(ItemsCount::new(evaluations)).bench(solved);
}
