//! An episode whose budget ends something: it does nothing more, and says what was stopped and what there is not.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use typelift::agent::{Episode, Event, Options, ResortState, WhyNoOther};
use typelift::model::{ActionModel, Budget, Stop, Task};
use typelift::plan::{self, ExternalFailure, ExternalPlanner, Outcome, Planner, Restrictions};
use typelift_tests::by_hand::{ByHand, saws};

/// A budget that is used up as long as the switch is on.
fn switched() -> (Budget, Arc<AtomicBool>) {
    let switch = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&switch);
    let stop = move || asked.load(Ordering::Relaxed).then_some(Stop::Cancelled);
    (Budget { stop: Some(Arc::new(stop)), ..Budget::default() }, switch)
}

/// An episode that has proposed its first plan, and the switch of its budget.
fn asked() -> (ByHand, Arc<AtomicBool>) {
    let (budget, switch) = switched();
    let mut it = ByHand::within(Options::default(), budget);
    let whole = it.whole.clone();
    assert_eq!(it.reset(whole), "propose cut(saw_1, b)");
    (it, switch)
}

#[test]
fn what_failed_is_not_tried_again_when_it_is_to_stop() {
    let (mut it, switch) = asked();
    assert_eq!(it.approve(), "act cut(saw_1, b)");
    switch.store(true, Ordering::Relaxed);
    assert_eq!(it.refused(), "done, stopped");
    assert!(!it.events.iter().any(|event| matches!(event, Event::Retried { .. })));
    assert_eq!(it.account().actions, 1);
}

#[test]
fn a_search_for_another_plan_that_was_stopped_found_nothing_yet() {
    for saves in [false, true] {
        let (mut it, switch) = asked();
        let standing = it.command.clone();
        switch.store(true, Ordering::Relaxed);
        for _ in 0..2 {
            assert_eq!(it.another_plan(), "propose cut(saw_1, b)");
            assert_eq!(it.command, standing);
            let why = WhyNoOther::Stopped(Stop::Cancelled);
            assert_eq!(it.events.last(), Some(&Event::NoOtherPlan { proposal: 1, why }));
        }
        switch.store(false, Ordering::Relaxed);
        if saves {
            let text = it.episode.save();
            it.episode =
                Episode::restore(&text, saws().0, Options::default(), Budget::unlimited()).expect("it was saved");
        }
        assert_eq!(it.another_plan(), "propose cut(saw_2, b)", "saved: {saves}");
        assert_eq!(it.another_plan(), "propose cut(saw_2, b)");
        let why = WhyNoOther::NoMorePlans;
        assert_eq!(it.events.last(), Some(&Event::NoOtherPlan { proposal: 2, why }));
    }
}

#[test]
fn a_search_that_is_stopped_while_it_is_taken_up_again_leaves_the_proposal() {
    let (mut restored, _) = asked();
    let (budget, switch) = switched();
    let text = restored.episode.save();
    restored.episode = Episode::restore(&text, saws().0, Options::default(), budget).expect("it was saved");
    switch.store(true, Ordering::Relaxed);
    assert_eq!(restored.another_plan(), "propose cut(saw_1, b)");
    let why = WhyNoOther::Stopped(Stop::Cancelled);
    assert_eq!(restored.events.last(), Some(&Event::NoOtherPlan { proposal: 1, why }));
    switch.store(false, Ordering::Relaxed);
    assert_eq!(restored.another_plan(), "propose cut(saw_2, b)");
}

#[test]
fn where_no_more_may_be_proposed_that_is_said() {
    let mut it = ByHand::asked(Options { max_proposals: 1, ..Options::default() });
    assert_eq!(it.another_plan(), "propose cut(saw_1, b)");
    let why = WhyNoOther::ProposalLimit;
    assert_eq!(it.events.last(), Some(&Event::NoOtherPlan { proposal: 1, why }));
}

/// A planner that plans once, then finds no plan, and then is out of time.
#[derive(Debug, Default)]
struct Tiring(AtomicUsize);

impl ExternalPlanner for Tiring {
    fn plan(&self, model: &ActionModel, task: &Task, budget: &Budget) -> Result<Outcome, ExternalFailure> {
        Ok(match self.0.fetch_add(1, Ordering::Relaxed) {
            0 => Planner::new(model, task, &Restrictions::default(), &plan::Options::default(), budget)
                .map_or_else(Outcome::Stopped, |mut planner| planner.next_plan(budget)),
            1 => Outcome::Unsolvable,
            _ => Outcome::Stopped(Stop::Time),
        })
    }
}

#[test]
fn a_resort_that_the_budget_ended_is_not_taken() {
    let planner = Some(Arc::new(Tiring::default()) as Arc<dyn ExternalPlanner>);
    let mut it = ByHand::cutting(Options { planner, retries: Some(0), ..Options::default() });
    assert_eq!(it.refused(), "done, out_of_time");
    let states: Vec<_> = it.account().resorts.iter().map(|last| last.state).collect();
    let untried = ResortState::Untried;
    assert_eq!(states, [ResortState::InVain, untried, untried, untried, untried]);
    assert!(!it.account().resorts.relaxed());
    assert!(!it.events.iter().any(|event| matches!(event, Event::LastResort { .. })));
}
