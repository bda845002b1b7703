//! The episode's state machine, fed by hand: what it answers to observations, refusals, time-outs, rejections, and to
//! inputs that do not fit. A saw cuts rods and planks; there are two saws, and a beam.

use std::sync::Arc;
use typelift::agent::{
    Account, Command, CommandId, Ending, Episode, EpisodeError, Event, Experience, Input, Objection, Options,
    PlanningTerms, RestoreError, StepResult, Suspect, WhyNoOther,
};
use typelift::model::{Budget, GoalErrorKind, GroundAtom, Plan, State, Symbol};
use typelift::plan::Exclusion;
use typelift::words::{AccountView, WireCommand, wire_command};
use typelift::world::{Scene, Verdict};
use typelift_tests::by_hand::{BENCH, ByHand, bench, hands, id, saws, told};

fn failed_calls(account: &Account) -> Vec<String> {
    account.failures.iter().map(|failure| failure.call.to_string()).collect()
}

fn has_reason(ending: &Ending) -> bool {
    matches!(ending, Ending::NoPlan(why) if !why.to_string().is_empty())
}

#[test]
fn a_goal_that_holds_needs_nothing() {
    let mut it = ByHand::new(Options::default());
    let cut = it.cut.clone();
    assert_eq!(it.reset(cut), "done, solved");
    assert!(it.account().proposals == 0 && it.account().plan == Some(Plan::default()));
}

#[test]
fn a_goal_is_held_against_what_is_seen_first() {
    let (model, mut parser) = saws();
    let whole = bench(&mut parser, &BENCH, &["whole(b)"]);
    let error = |goal: &str| {
        let goal = vec![GroundAtom::parse(goal).expect("an atom")];
        let options = Options::default();
        let mut episode = Episode::new(Arc::clone(&model), goal, options, Experience::new(), Budget::unlimited());
        let reset = id(&episode.step(Input::Started, &mut ()).expect("nothing was planned"));
        let input = Input::Reset { id: reset, state: whole.clone(), instance: None };
        match episode.step(input, &mut ()) {
            Err(EpisodeError::Goal(error)) => error,
            other => panic!("{other:?}"),
        }
    };
    let near = |name: &str| Some(Symbol::new(name));
    assert!(
        matches!(error("cutt(b)").kind, GoalErrorKind::UnknownPredicate { near, .. } if near == [Symbol::new("cut")])
    );
    assert!(matches!(error("cut(b,saw_1)").kind, GoalErrorKind::Arity { expected: 1 }));
    let GoalErrorKind::UnknownObject { object, near: found, .. } = error("cut(saw_3)").kind else {
        panic!("it is not there")
    };
    assert!(object == *"saw_3" && (found == near("saw_1") || found == near("saw_2")), "{found:?}");
}

#[test]
fn a_refusal_is_tried_again_then_blamed() {
    let mut it = ByHand::cutting(Options::default());
    assert_eq!(it.refused(), "act cut(saw_1, b)", "once more");
    assert_eq!(it.refused(), "propose cut(saw_2, b)");
    assert_eq!(it.approve(), "act cut(saw_2, b)");
    let after = it.cut.clone();
    assert_eq!(it.observed(after), "done, solved");
    let account = it.account();
    assert_eq!((account.proposals, account.actions), (2, 3));
    let [failure] = account.failures.as_slice() else { panic!("{:?}", account.failures) };
    assert_eq!((failure.result, failure.reason.as_deref()), (StepResult::Tried(Verdict::Refused), Some("jammed")));
    let blamed = Suspect::Object(Exclusion { object: Symbol::new("saw_1"), call: Some(Symbol::new("cut")) });
    assert_eq!(failure.suspects, std::slice::from_ref(&blamed));
    let suspects = it.episode.experience().suspects(it.episode.instance());
    let [(suspect, why)] = suspects.as_slice() else { panic!("{suspects:?}") };
    assert_eq!(
        (suspect, why.reasons.as_slice(), why.count),
        (&blamed, &["cut(saw_1, b): \"jammed\"".to_owned()][..], 1)
    );
}

#[test]
fn who_acts_is_not_blamed_where_a_place_may_be_anything() {
    let (model, mut parser) = hands();
    let general = |name: &str| model.actions.iter().any(|action| action.name == *name);
    assert!(general("grasp-object-object") && general("drop-object-object"), "{:?}", model.actions);
    let objects = [("hand_1", "hand"), ("cup_1", "cup"), ("cup_2", "cup"), ("lid_1", "lid"), ("table_1", "table")];
    let state = bench(&mut parser, &objects, &["empty(hand_1)", "on(cup_1,cup_2)"]);
    let goal = vec![GroundAtom::parse("on(cup_1,lid_1)").expect("an atom")];
    let options = Options { retries: Some(0), ..Options::default() };
    let mut episode = Episode::new(model, goal, options, Experience::new(), Budget::unlimited());
    let reset = id(&episode.step(Input::Started, &mut ()).expect("nothing was planned"));
    let input = Input::Reset { id: reset, state: state.clone(), instance: None };
    let proposed = episode.step(input, &mut ()).expect("a plan");
    assert_eq!(told(&proposed), "propose grasp(hand_1, cup_1, cup_2) drop(hand_1, cup_1, lid_1)");
    let asked = episode.step(Input::Approve { id: id(&proposed) }, &mut ()).expect("approved");
    let refused = Input::Refused { id: id(&asked), reason: "stuck".to_owned(), state };
    episode.step(refused, &mut ()).expect("the planner does not err");
    let suspects = episode.experience().suspects(episode.instance());
    let blamed: Vec<String> = suspects.iter().map(|(suspect, _)| suspect.to_string()).collect();
    assert_eq!(blamed, ["cup_2 from grasp"], "neither the hand nor what the goal speaks of");
}

#[test]
fn when_every_saw_is_jammed_it_ends_with_a_reason() {
    for restart in [true, false] {
        let mut it = ByHand::cutting(Options { restart, retries: Some(0), ..Options::default() });
        let whole = it.whole.clone();
        if restart {
            assert_eq!(it.refused(), "reset");
            assert_eq!(it.reset(whole.clone()), "propose cut(saw_2, b)");
        } else {
            assert_eq!(it.refused(), "propose cut(saw_2, b)");
        }
        assert_eq!(it.approve(), "act cut(saw_2, b)");
        if restart {
            assert_eq!(it.refused(), "reset");
            assert_eq!(it.reset(whole), "done, no_plan");
        } else {
            assert_eq!(it.refused(), "done, no_plan");
        }
        assert_eq!(failed_calls(it.account()), ["cut(saw_1, b)", "cut(saw_2, b)"]);
        let Ending::NoPlan(why) = &it.account().ending else { panic!("{:?}", it.account().ending) };
        assert!(why.to_string().contains("what fits it may not be used any more"), "{why}");
    }
}

#[test]
fn the_state_is_believed_not_the_refusal() {
    let mut it = ByHand::cutting(Options::default());
    let state = it.cut.clone();
    let refused = it.answer(|id| Input::Refused { id, reason: "I think it went wrong".to_owned(), state });
    assert_eq!(refused, "done, solved");
    assert!(it.account().failures.is_empty());
    let [seen] = &it.account().seen_done[..] else { panic!("{:?}", it.account().seen_done) };
    assert_eq!((seen.reported, seen.reason.as_deref()), (Verdict::Refused, Some("I think it went wrong")));
}

#[test]
fn after_a_time_out_it_looks() {
    // It had worked.
    let mut it = ByHand::cutting(Options::default());
    assert_eq!(it.timed_out(), "observe");
    assert_eq!(it.timed_out(), "observe", "until something is seen");
    let cut_state = it.cut.clone();
    assert_eq!(it.observed(cut_state), "done, solved");
    let seen: Vec<(u64, usize, Verdict)> =
        it.account().seen_done.iter().map(|seen| (seen.proposal, seen.step, seen.reported)).collect();
    assert_eq!(seen, [(1, 1, Verdict::TimedOut)]);

    // It had not: tried again, then blamed.
    let mut it = ByHand::cutting(Options::default());
    let whole = it.whole.clone();
    assert_eq!(it.timed_out(), "observe");
    assert_eq!(it.observed(whole.clone()), "act cut(saw_1, b)");
    assert_eq!(it.timed_out(), "observe");
    assert_eq!(it.observed(whole), "propose cut(saw_2, b)");
    assert_eq!(it.input(Input::Stop), "done, stopped");
    assert_eq!(
        it.account().failures.iter().map(|f| f.result).collect::<Vec<_>>(),
        [StepResult::Tried(Verdict::TimedOut)]
    );
    assert_eq!(it.account().actions, 2);
    assert!(it.account().seen_done.is_empty());
}

#[test]
fn where_it_was_stopped_is_in_the_account() {
    let place = |it: &ByHand| {
        let at = it.account().stopped_at.as_ref();
        at.map(|at| (at.proposal, at.step, at.steps, at.call.to_string(), at.begun))
    };
    let step = |begun| Some((1, 1, 1, "cut(saw_1, b)".to_owned(), begun));
    let mut approved = ByHand::cutting(Options::default());
    approved.input(Input::Stop);
    assert_eq!(place(&approved), step(true), "nobody knows what came of it");
    let mut late = ByHand::cutting(Options::default());
    late.timed_out();
    late.input(Input::Stop);
    assert_eq!(place(&late), step(true));
    let mut asked = ByHand::cutting(Options::default());
    asked.refused();
    asked.refused();
    asked.input(Input::Stop);
    assert_eq!(place(&asked), Some((2, 1, 1, "cut(saw_2, b)".to_owned(), false)), "it was proposed only");
    let mut resetting = ByHand::cutting(Options { restart: true, ..Options::default() });
    resetting.refused();
    resetting.input(Input::Stop);
    assert_eq!(place(&resetting), None, "no step was under way");
}

#[test]
fn where_nothing_is_left_it_is_said_what_is_excluded_and_why() {
    let mut it = ByHand::cutting(Options { retries: Some(0), ..Options::default() });
    it.refused();
    assert_eq!(it.reject(1, Some(Objection::Broken { objects: Vec::new() })), "done, no_plan");
    let avoided: Vec<(bool, &str, Vec<String>)> = it
        .account()
        .avoided
        .iter()
        .map(|avoided| {
            let suspects = avoided.suspects.iter().map(ToString::to_string).collect();
            (avoided.by_person, avoided.reason.as_str(), suspects)
        })
        .collect();
    assert_eq!(
        avoided,
        [
            (true, "cut(saw_2, b) was rejected: blunt", vec!["saw_2 from cut".to_owned()]),
            (false, "cut(saw_1, b): \"jammed\"", vec!["saw_1 from cut".to_owned()]),
        ]
    );
}

#[test]
fn a_rejection_before_anything_was_done_needs_no_reset() {
    for restart in [true, false] {
        let mut it = ByHand::asked(Options { restart, ..Options::default() });
        // A step that there is not counts as the nearest that there is.
        assert_eq!(it.reject(99, None), "propose cut(saw_2, b)");
        assert_eq!(it.reject(0, None), "done, no_plan");
        assert!(has_reason(&it.account().ending));
        assert_eq!((it.account().actions, it.account().failures.len()), (0, 2));
    }
}

#[test]
fn inputs_that_do_not_fit_change_nothing() {
    let mut it = ByHand::new(Options::default());
    let (whole, after) = (it.whole.clone(), it.cut.clone());
    assert_eq!(it.observed(after.clone()), "reset", "only what was reset is an initial state");
    assert_eq!(it.approve(), "reset");
    assert_eq!(it.timed_out(), "reset", "a slow reset is no initial state");
    let proposal = it.reset(whole.clone());
    assert_eq!(it.observed(after.clone()), proposal);
    assert_eq!(it.reset(whole), proposal);
    assert_eq!(it.timed_out(), proposal);
    assert_eq!(it.approve(), "act cut(saw_1, b)");
    assert_eq!(it.approve(), "await cut(saw_1, b)", "approved twice is not executed twice");
    assert_eq!(it.input(Input::Started), "await cut(saw_1, b)", "nor is it begun again for whoever asks what stands");
    assert_eq!(it.observed(after), "done, solved");
    let account = it.account().clone();
    assert_eq!(account.actions, 1);
    let over = CommandId::default();
    for input in [Input::Started, Input::Approve { id: over }, Input::TimedOut { id: over }] {
        assert_eq!(it.input(input), "done, solved");
        assert_eq!(*it.account(), account, "what is over stays over");
    }
}

#[test]
fn an_approval_counts_for_the_plan_that_was_shown() {
    let mut it = ByHand::asked(Options::default());
    let shown = id(&it.command);
    // On another page somebody says no, and the next plan is proposed.
    let proposal = it.reject(1, None);
    assert_eq!(proposal, "propose cut(saw_2, b)");
    let standing = it.command.clone();
    for stale in [
        Input::Approve { id: shown },
        Input::AnotherPlan { id: shown },
        Input::Reject { id: shown, step: 1, objection: None, reason: "blunt".to_owned() },
    ] {
        assert_eq!(it.input(stale), proposal);
        assert_eq!(it.command, standing);
    }
    assert_eq!(it.approve(), "act cut(saw_2, b)");
    assert_eq!(it.episode.experience().failures().len(), 1);
}

#[test]
fn a_result_counts_for_the_action_that_it_answers() {
    let mut it = ByHand::cutting(Options::default());
    let (first, whole, after) = (id(&it.command), it.whole.clone(), it.cut.clone());
    let late = |state: &State| Input::Observation { id: first, state: state.clone() };
    assert_eq!(it.timed_out(), "observe");
    // What was on its way when the time was up is not what is seen now.
    assert_eq!(it.input(late(&after)), "observe");
    assert_eq!(it.observed(whole), "act cut(saw_1, b)", "once more");
    let standing = id(&it.command);
    assert_eq!(it.input(late(&after)), "await cut(saw_1, b)", "nor the result of the second try");
    assert_eq!(it.input(Input::TimedOut { id: first }), "await cut(saw_1, b)");
    assert_eq!(id(&it.command), standing);
    assert_eq!(it.observed(after), "done, solved");
    assert_eq!(it.account().actions, 2);
}

#[test]
fn events_tell_on_what_terms_is_planned_and_how_it_ended() {
    let mut it = ByHand::asked(Options::default());
    assert_eq!(it.another_plan(), "propose cut(saw_2, b)");
    assert_eq!(it.approve(), "act cut(saw_2, b)");
    let after = it.cut.clone();
    assert_eq!(it.observed(after), "done, solved");
    let terms = it.events.iter().filter_map(|event| match event {
        Event::PlanningStarted { terms, .. } => Some(*terms),
        _ => None,
    });
    assert_eq!(terms.collect::<Vec<_>>(), [PlanningTerms::Usual, PlanningTerms::AsBefore]);
    assert_eq!(it.events.last(), Some(&Event::Ended { solved: true, ending: "solved" }));
    // Nothing but the one saw is left, and then not even that: the resorts are told, and how it ended.
    let mut it = ByHand::asked(Options::default());
    it.reject(1, None);
    it.reject(1, None);
    let told = it
        .events
        .iter()
        .filter(|event| matches!(event, Event::PlanningStarted { terms: PlanningTerms::WithResort(_), .. }));
    assert!(told.count() > 0, "{:?}", it.events);
    assert_eq!(it.events.last(), Some(&Event::Ended { solved: false, ending: "no_plan" }));
}

#[test]
fn another_plan_says_nothing_against_the_first() {
    let mut it = ByHand::asked(Options::default());
    assert_eq!(it.another_plan(), "propose cut(saw_2, b)");
    let stands = it.command.clone();
    assert_eq!(it.another_plan(), "propose cut(saw_2, b)");
    assert_eq!(it.command, stands, "there is no third one, and the second stands");
    assert_eq!(it.events.last(), Some(&Event::NoOtherPlan { proposal: 2, why: WhyNoOther::NoMorePlans }));
    // Every search is told as planning, and what it took is in the account.
    let planning = |event: &Event| match event {
        Event::PlanningStarted { proposal, .. } => Some(format!("{proposal}?")),
        Event::PlanningEnded { found, .. } => Some(found.to_string()),
        _ => None,
    };
    assert_eq!(it.events.iter().filter_map(planning).collect::<Vec<_>>(), ["1?", "true", "2?", "true", "3?", "false"]);
    let expanded = it.events.iter().map(|event| match event {
        Event::PlanningEnded { expansions, .. } => *expansions,
        _ => 0,
    });
    let expanded: u64 = expanded.sum();
    assert_eq!(it.approve(), "act cut(saw_2, b)");
    let after = it.cut.clone();
    assert_eq!(it.observed(after), "done, solved");
    assert_eq!(it.account().expansions, expanded);
    assert!(it.account().failures.is_empty() && it.episode.experience().failures().is_empty());
}

#[test]
fn what_a_person_objects_to_is_what_is_avoided() {
    let saw_1 = || vec![Symbol::new("saw_1")];
    let suspects = |it: &ByHand| -> Vec<String> {
        let suspects = it.episode.experience().suspects(it.episode.instance());
        suspects.iter().map(|(suspect, _)| suspect.to_string()).collect()
    };
    let mut it = ByHand::asked(Options::default());
    assert_eq!(it.reject(1, Some(Objection::Broken { objects: saw_1() })), "propose cut(saw_2, b)");
    assert_eq!(suspects(&it), ["saw_1 from cut"]);
    // No kind of saw: nothing is left, and it is not lifted either.
    let mut it = ByHand::asked(Options::default());
    assert_eq!(it.reject(1, Some(Objection::WrongKind { objects: saw_1() })), "done, no_plan");
    assert_eq!(suspects(&it), ["any saw from cut for cut"]);
    // Not while it is whole: then it cannot be cut at all.
    let mut it = ByHand::asked(Options::default());
    let atom = GroundAtom::parse("whole(b)").expect("an atom");
    assert_eq!(it.reject(1, Some(Objection::While { atom })), "done, no_plan");
    assert_eq!(suspects(&it), ["cut while whole(b)"]);
    // Only not now.
    let mut it = ByHand::asked(Options::default());
    assert_eq!(it.reject(1, Some(Objection::NotNow)), "propose cut(saw_2, b)");
    assert!(suspects(&it).is_empty());
    let later = it.episode.experience().clone();
    let goal = vec![GroundAtom::parse("cut(b)").expect("an atom")];
    let mut next = Episode::new(saws().0, goal, Options::default(), later, Budget::unlimited());
    let reset = id(&next.step(Input::Started, &mut ()).expect("nothing was planned"));
    let begun = Input::Reset { id: reset, state: it.whole.clone(), instance: None };
    assert_eq!(told(&next.step(begun, &mut ()).expect("a plan")), "propose cut(saw_1, b)");
}

#[test]
fn another_object_is_wanted_instead() {
    let instead = |object: Option<&str>, with: &str| {
        Some(Objection::Instead { object: object.map(Symbol::new), with: with.into() })
    };
    let mut it = ByHand::asked(Options::default());
    assert_eq!(it.reject(1, instead(None, "saw_2")), "propose cut(saw_2, b)");
    // Of two words that contradict each other the later counts.
    let broken = Some(Objection::Broken { objects: vec!["saw_2".into()] });
    assert_eq!(it.reject(1, broken), "propose cut(saw_1, b)");
    let said = it.events.iter().filter_map(|event| match event {
        Event::Overruled { reason } => Some(reason.as_str()),
        _ => None,
    });
    assert_eq!(said.collect::<Vec<_>>(), ["cut(saw_1, b) was rejected: blunt"]);
    assert_eq!(it.reject(1, instead(Some("saw_1"), "saw_2")), "propose cut(saw_2, b)");
    // What is not there, or takes part already, or stands for nothing of the step, is not understood.
    for objection in [instead(None, "saw_9"), instead(None, "saw_2"), instead(Some("saw_1"), "saw_1")] {
        assert_eq!(it.reject(1, objection), "propose cut(saw_2, b)");
    }
}

#[test]
fn what_a_person_shows_is_planned_from() {
    let mut it = ByHand::asked(Options::default());
    let (whole, cut) = (it.whole.clone(), it.cut.clone());
    let shown = |it: &mut ByHand, state| it.answer(|id| Input::Shown { id, state });
    assert_eq!(shown(&mut it, whole), "propose cut(saw_1, b)");
    assert_eq!(shown(&mut it, cut), "done, solved");
    assert_eq!(it.account().proposals, 2);
}

#[test]
fn an_objection_that_is_not_about_the_step_changes_nothing() {
    let mut it = ByHand::asked(Options::default());
    let (other, unknown) = (vec![Symbol::new("saw_2")], GroundAtom::parse("rusty(b)").expect("an atom"));
    for objection in [Objection::Broken { objects: other }, Objection::While { atom: unknown }] {
        assert_eq!(it.reject(1, Some(objection)), "propose cut(saw_1, b)");
    }
    assert!(it.episode.experience().failures().is_empty());
}

#[test]
fn objects_come_and_go() {
    let mut it = ByHand::cutting(Options::default());
    // The saw at work vanishes, a cat arrives.
    let objects = [("saw_2", "saw"), ("b", "beam"), ("cat_1", "cat")];
    let state = bench(&mut it.parser, &objects, &["whole(b)"]);
    assert_eq!(it.observed(state), "propose cut(saw_2, b)");
    assert_eq!(it.approve(), "act cut(saw_2, b)");
    // Then the beam does.
    let state = bench(&mut it.parser, &[("saw_2", "saw")], &[]);
    assert_eq!(it.observed(state), "done, no_plan");
    assert!(has_reason(&it.account().ending), "{:?}", it.account().ending);
}

#[test]
fn what_vanished_is_not_acted_on_whatever_the_mode() {
    for restart in [false, true] {
        let objects = [("saw_1", "saw"), ("saw_2", "saw"), ("b", "beam"), ("c", "beam")];
        let options = Options { restart, ..Options::default() };
        let mut it = ByHand::at(&objects, &["b", "c"], options, Budget::unlimited());
        let whole = it.whole.clone();
        assert_eq!(it.reset(whole.clone()), "propose cut(saw_1, b) cut(saw_1, c)");
        assert_eq!(it.approve(), "act cut(saw_1, b)");
        // The saw does its work, and is taken away.
        let state = bench(&mut it.parser, &objects[1..], &["cut(b)", "whole(c)"]);
        if restart {
            assert_eq!(it.observed(state), "reset");
            assert_eq!(it.reset(whole), "propose cut(saw_1, b) cut(saw_1, c)");
        } else {
            assert_eq!(it.observed(state), "propose cut(saw_2, c)");
        }
        assert!(it.events.iter().any(|event| matches!(event, Event::Drifted { step: 2, .. })));
        assert!(it.episode.experience().failures().is_empty());
    }
}

#[test]
fn the_number_of_proposals_is_limited() {
    let mut it = ByHand::cutting(Options { max_proposals: 1, retries: Some(0), ..Options::default() });
    it.refused();
    assert_eq!(it.account().ending, Ending::ProposalLimit(1));
}

#[test]
fn a_changed_mind_about_the_ending_is_not_recorded() {
    let mut it = ByHand::cutting(Options::default());
    let after = it.cut.clone();
    assert_eq!(it.observed(after), "done, solved");
    assert_eq!(it.input(Input::Stop), "done, solved", "stopping what is solved does not unsolve it");
}

#[test]
fn commands_and_inputs_go_over_a_wire() {
    let mut it = ByHand::asked(Options::default());
    let hierarchy = saws().0.hierarchy.clone();
    let wire = |command: &Command, episode: &Episode| {
        let command =
            wire_command(command.clone(), &hierarchy, |account| AccountView::of("saw", account, episode, 0.5));
        let text = serde_json::to_string(&command).expect("JSON");
        assert_eq!(serde_json::from_str::<WireCommand>(&text).expect("a command"), command);
        text
    };
    let plan = r#"{"cost":1,"steps":[{"action":"cut-saw-piece","name":"cut","args":["saw_1","b"]}]}"#;
    assert_eq!(wire(&it.command, &it.episode), format!(r#"{{"command":"propose","id":2,"plan":{plan}}}"#));
    let mut parser = it.parser.clone();
    let mut read = |text: &str| {
        let input: Input<Scene> = serde_json::from_str(text).expect("an input");
        assert_eq!(
            serde_json::from_str::<Input<Scene>>(&serde_json::to_string(&input).expect("JSON")).ok(),
            Some(input.clone())
        );
        input.parsed(&mut parser).expect("a state")
    };
    assert_eq!(it.input(read(r#"{"input":"approve","id":1}"#)), "propose cut(saw_1, b)", "that is another command");
    assert_eq!(it.input(read(r#"{"input":"approve","id":2}"#)), "act cut(saw_1, b)");
    assert_eq!(
        wire(&it.command, &it.episode),
        r#"{"command":"act","id":3,"call":{"name":"cut","args":["saw_1","b"]}}"#
    );
    let state = r#"{"objects":{"saw_1":"saw","saw_2":"saw","b":"beam"},"atoms":["cut(b)"]}"#;
    let observed = format!(r#"{{"input":"observation","id":3,"state":{state}}}"#);
    assert_eq!(it.input(read(&observed)), "done, solved");
    let told = wire(&it.command, &it.episode);
    let done =
        r#"{"command":"done","task":"saw","solved":true,"ending":"solved","proposals":1,"actions":1,"plan_length":1"#;
    assert!(told.starts_with(done), "{told}");
    assert!(told.ends_with(r#""failures":[],"excluded":[]}"#), "{told}");
    let no = r#"{"input":"reject","id":2,"step":1,"objection":{"because":"while","atom":"wet(b)"},"reason":"wet"}"#;
    assert!(matches!(read(no), Input::Reject { objection: Some(Objection::While { .. }), .. }));
}

#[test]
fn a_saved_episode_that_contradicts_itself_is_refused() {
    let refused = |it: &ByHand, change: fn(&mut serde_json::Value)| {
        let mut saved = serde_json::from_str(&it.episode.save()).expect("JSON");
        change(&mut saved);
        let restored = Episode::restore(&saved.to_string(), saws().0, Options::default(), Budget::unlimited());
        matches!(restored, Err(RestoreError::Contradiction(_)))
    };
    let asked = ByHand::asked(Options::default());
    let cutting = ByHand::cutting(Options::default());
    let mut late = ByHand::cutting(Options::default());
    late.timed_out();
    for it in [&asked, &cutting, &late] {
        assert!(!refused(it, |_| {}), "as it was saved");
        assert!(refused(it, |saved| saved["execution"]["steps"] = serde_json::json!([])));
        assert!(refused(it, |saved| saved["execution"] = serde_json::Value::Null));
        assert!(refused(it, |saved| saved["execution"]["next_step"] = 1.into()), "there is one step only");
        assert!(refused(it, |saved| saved["execution"]["taken"] = 2.into()));
    }
    assert!(refused(&asked, |saved| saved["execution"]["taken"] = 1.into()), "it was not approved");
}
