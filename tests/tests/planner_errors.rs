//! A planner that errs once, whenever that is: nothing that was judged or rejected is judged or rejected again, no step is
//! commanded that nobody approved, and the episode goes on from what is observed then.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use typelift::agent::{Command, EpisodeError, Event, Input, Objection, Options, ProposeError};
use typelift::model::{ActionModel, Budget, Plan, Symbol, Task};
use typelift::plan::{self, ExternalFailure, ExternalPlanner, Outcome, Planner, Restrictions};
use typelift_tests::by_hand::{ByHand, bench, id};

/// A planner that errs when it is asked for this time, counted from 1, and else plans.
#[derive(Debug)]
struct ErrsOnce {
    at: usize,
    asked: AtomicUsize,
    /// Whether it gives a plan that is none, instead of no answer.
    talks_nonsense: bool,
}

impl ExternalPlanner for ErrsOnce {
    fn plan(&self, model: &ActionModel, task: &Task, budget: &Budget) -> Result<Outcome, ExternalFailure> {
        if self.asked.fetch_add(1, Ordering::Relaxed) + 1 == self.at {
            return match self.talks_nonsense {
                true => Ok(Outcome::Solved(Plan::default())),
                false => Err(ExternalFailure::NotAsked { reason: "it is asleep".to_owned() }),
            };
        }
        let planned = Planner::new(model, task, &Restrictions::default(), &plan::Options::default(), budget);
        Ok(planned.map_or_else(Outcome::Stopped, |mut planner| planner.next_plan(budget)))
    }
}

const TWO_BEAMS: [(&str, &str); 4] = [("saw_1", "saw"), ("saw_2", "saw"), ("b", "beam"), ("c", "beam")];

/// An episode that has proposed to cut two beams and whose planner errs when it is asked for the second time, with either
/// error, and with or without restart.
fn asked_to_cut_two() -> impl Iterator<Item = ByHand> {
    [(false, false), (false, true), (true, false), (true, true)].into_iter().map(|(talks_nonsense, restart)| {
        let planner = ErrsOnce { at: 2, asked: AtomicUsize::new(0), talks_nonsense };
        let options = Options { planner: Some(Arc::new(planner)), retries: Some(0), restart, ..Options::default() };
        let mut it = ByHand::at(&TWO_BEAMS, &["b", "c"], options, Budget::unlimited());
        let whole = it.whole.clone();
        assert_eq!(it.reset(whole), "propose cut(saw_1, b) cut(saw_1, c)");
        it
    })
}

/// Gives an input at which the planner errs; what stands then.
fn err(it: &mut ByHand, input: Input) -> String {
    match it.episode.step(input, &mut it.events) {
        Err(EpisodeError::Propose(ProposeError::External(_) | ProposeError::ExternalPlan { .. })) => {}
        other => panic!("{other:?}"),
    }
    it.input(Input::Started)
}

#[test]
fn a_plan_of_which_a_step_was_rejected_is_not_approved_any_more() {
    for mut it in asked_to_cut_two() {
        let proposal = id(&it.command);
        let saw = Objection::Broken { objects: vec![Symbol::new("saw_1")] };
        let no = Input::Reject { id: proposal, step: 2, objection: Some(saw), reason: "blunt".to_owned() };
        assert_eq!(err(&mut it, no), "observe");
        assert_eq!(it.input(Input::Approve { id: proposal }), "observe");
        assert_eq!(it.approve(), "observe", "there is nothing to approve");
        let whole = it.whole.clone();
        assert_eq!(it.observed(whole), "propose cut(saw_2, b) cut(saw_2, c)");
        assert_eq!(it.approve(), "act cut(saw_2, b)");
        assert_eq!(it.episode.experience().failures().len(), 1);
    }
}

#[test]
fn a_result_is_judged_once() {
    for mut it in asked_to_cut_two() {
        assert_eq!(it.approve(), "act cut(saw_1, b)");
        let (action, whole) = (id(&it.command), it.whole.clone());
        let refused = Input::Refused { id: action, reason: "jammed".to_owned(), state: whole.clone() };
        // Where the world is set back, planning comes after that.
        let stands = match it.episode.step(refused.clone(), &mut it.events) {
            Ok(Command::Reset { id }) => err(&mut it, Input::Reset { id, state: whole.clone(), instance: None }),
            Err(_) => it.input(Input::Started),
            other => panic!("{other:?}"),
        };
        assert_eq!(stands, "observe");
        assert_eq!(it.input(refused), "observe");
        assert_eq!(it.observed(whole), "propose cut(saw_2, b) cut(saw_2, c)");
        assert_eq!(it.input(Input::Stop), "done, stopped");
        assert_eq!((it.account().actions, it.account().failures.len()), (1, 1));
        assert_eq!(it.events.iter().filter(|event| matches!(event, Event::Stepped { .. })).count(), 1);
    }
}

#[test]
fn a_step_that_the_world_made_impossible_is_not_waited_for() {
    let mut it = asked_to_cut_two().next().expect("one without restart");
    assert_eq!(it.approve(), "act cut(saw_1, b)");
    let vanished = bench(&mut it.parser, &TWO_BEAMS[1..], &["cut(b)", "whole(c)"]);
    let done = Input::Observation { id: id(&it.command), state: vanished.clone() };
    assert_eq!(err(&mut it, done), "observe", "the second step was never commanded");
    assert_eq!(it.observed(vanished), "propose cut(saw_2, c)");
    assert_eq!(it.approve(), "act cut(saw_2, c)");
    let after = bench(&mut it.parser, &TWO_BEAMS[1..], &["cut(b)", "cut(c)"]);
    assert_eq!(it.observed(after), "done, solved");
    assert_eq!(it.account().actions, 2);
}

#[test]
fn the_goal_may_hold_by_then() {
    for mut it in asked_to_cut_two() {
        let no = Input::Reject { id: id(&it.command), step: 1, objection: None, reason: "blunt".to_owned() };
        assert_eq!(err(&mut it, no), "observe");
        let cut = it.cut.clone();
        assert_eq!(it.observed(cut), "done, solved");
    }
}
