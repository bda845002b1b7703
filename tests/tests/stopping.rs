//! A search that is stopped goes on where it was: whenever it is stopped, and however often, the first plan is that of a
//! search that never is.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use typelift::model::{Budget, MemoryLimit, MemoryProbe, Plan, Stop};
use typelift::plan::{Options, Outcome, Planner, Restrictions, Strategy};
use typelift_kitchen::{KitchenTask, tasks};
use typelift_tests::{kitchen_model, planning_task};

/// A budget that says stop at every `period`-th question, and how often it was asked.
fn stopping(period: usize) -> (Budget, Arc<AtomicUsize>) {
    let questions = Arc::new(AtomicUsize::new(0));
    let asked = questions.clone();
    let stop = move || (asked.fetch_add(1, Ordering::Relaxed) % period == period - 1).then_some(Stop::Time);
    (Budget { stop: Some(Arc::new(stop)), ..Budget::default() }, questions)
}

/// A budget of so many bytes, by the word of a probe.
fn limited(bytes: u64, probe: &MemoryProbe) -> Budget {
    Budget { memory: Some(MemoryLimit { bytes, probe: Arc::clone(probe) }), ..Budget::default() }
}

/// The first plans, and how often the search was stopped.
fn plans(planner: &mut Planner, wanted: usize, budget: &Budget) -> (Vec<Plan>, usize) {
    let (mut plans, mut stops) = (Vec::new(), 0);
    while plans.len() < wanted {
        match planner.next_plan(budget) {
            Outcome::Solved(plan) => plans.push(plan),
            Outcome::Stopped(Stop::Time | Stop::Memory) => stops += 1,
            _ => break,
        }
    }
    (plans, stops)
}

fn planner(task: &KitchenTask, budget: &Budget) -> Result<Planner, Stop> {
    planner_with(&Options::default(), task, budget)
}

fn planner_with(options: &Options, task: &KitchenTask, budget: &Budget) -> Result<Planner, Stop> {
    let model = kitchen_model(false);
    let asked = planning_task(&model, task, 0);
    Planner::new(&model, &asked, &Restrictions::default(), options, budget)
}

fn task() -> KitchenTask {
    tasks().into_iter().find(|task| task.name == "T2.4").expect("a task")
}

#[test]
fn a_search_that_is_stopped_goes_on() {
    let mut stopped = 0;
    let unlimited = || planner(&task(), &Budget::unlimited()).expect("no limits");
    // What comes before the search of a further plan is begun again where it was stopped, so that it must be granted at once.
    for (wanted, periods) in [(1, [2, 3, 5]), (3, [60, 130, 310])] {
        let (expected, _) = plans(&mut unlimited(), wanted, &Budget::unlimited());
        assert_eq!(expected.len(), wanted);
        for period in periods {
            let (found, stops) = plans(&mut unlimited(), wanted, &stopping(period).0);
            assert_eq!(found, expected, "stopped at every question number {period}");
            stopped += stops;
        }
    }
    assert!(stopped > 10, "{stopped} stops: nothing was tested");
}

#[test]
fn a_search_that_ran_out_of_memory_goes_on_with_more() {
    let mut planner = planner(&task(), &Budget::unlimited()).expect("no limits");
    // A probe to which every question is a byte.
    let questions = Arc::new(AtomicUsize::new(0));
    let probe: MemoryProbe = Arc::new(move || questions.fetch_add(1, Ordering::Relaxed) as u64);
    let mut bytes = 0;
    let mut found = Vec::new();
    let mut ends = 0;
    while found.len() < 3 {
        match planner.next_plan(&limited(bytes, &probe)) {
            Outcome::Solved(plan) => found.push(plan),
            outcome => {
                assert_eq!(outcome, Outcome::Stopped(Stop::Memory));
                ends += 1;
                bytes += 100;
            }
        }
    }
    let mut unlimited = self::planner(&task(), &Budget::unlimited()).expect("no limits");
    assert_eq!(found, plans(&mut unlimited, 3, &Budget::unlimited()).0);
    assert!(ends > 3, "nothing was tested");
}

#[test]
fn whatever_comes_before_the_search_can_be_stopped_at_every_question() {
    for strategy in Strategy::ALL {
        let options = Options { strategy, ..Options::default() };
        let (never, questions) = stopping(usize::MAX);
        planner_with(&options, &task(), &never).expect("no stop");
        let questions = questions.load(Ordering::Relaxed);
        assert!(questions > 5, "{strategy}: {questions} questions: nothing was tested");
        for number in 1..=questions {
            let ended = planner_with(&options, &task(), &stopping(number).0).map(drop);
            assert_eq!(ended, Err(Stop::Time), "{strategy}: question {number} of {questions}");
        }
    }
}

#[test]
fn grounding_asks_how_much_is_held() {
    let task = task();
    let probe: MemoryProbe = Arc::new(|| 1_000_000);
    let ends = |bytes| planner(&task, &limited(bytes, &probe)).map(drop);
    assert_eq!((ends(1_000_001), ends(1_000_000)), (Ok(()), Err(Stop::Memory)));
}
