//! What is written is as `docs/schemas` says. Saved episodes are held against their schema wherever `faults.rs` saves one.

use std::sync::Arc;

use serde_json::{Value, json};
use typelift::agent::{Experience, propose};
use typelift::learn::learn_dataset;
use typelift::model::{Budget, Goal, GroundAtom};
use typelift::words::{AnswerView, wire_event};
use typelift::world::TaskFile;
use typelift_kitchen::{demonstrations, faults};
use typelift_tests::schema::Schema;
use typelift_tests::{Watched, approve, dataset_of, kitchen_model, paper_options, planning_task, run_in};

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn traces_and_the_model_learned_from_them() {
    let shown = demonstrations(0);
    for demonstration in &shown {
        let mut text = Vec::new();
        demonstration.recording.write(&mut text).expect("written");
        for line in String::from_utf8(text).expect("text").lines() {
            assert_eq!(Schema::named("trace").check(&json(line)), Ok(()), "{}", demonstration.name);
        }
    }
    let (learned, _) = learn_dataset(&dataset_of(&shown), &Default::default()).expect("a model");
    assert_eq!(Schema::named("model").check(&json(&learned.to_json().expect("text"))), Ok(()));
}

#[test]
fn goals_of_which_a_part_must_not_hold() {
    let [cut, on] = ["cut(a)", "on(a,b)"].map(|text| GroundAtom::parse(text).expect("an atom"));
    let task = TaskFile { goal: Goal { required: vec![cut], forbidden: vec![on] }, ..TaskFile::default() };
    assert_eq!(Schema::named("task").check(&json(&task.to_json())), Ok(()));
    let said = |goal: &str| Schema::named("trace").check(&json!({"format": "trace/1", "goal": [goal]}));
    assert_eq!([said("cut(a)"), said("not cut(a)")], [Ok(()), Ok(())]);
    for wrong in ["not cut(a", "not  not cut(a)", "no cut(a)"] {
        assert!(said(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn answers_and_events() {
    let (model, options) = (Arc::new(kitchen_model(false)), paper_options(true));
    for fault in faults() {
        let task = planning_task(&model, &fault, 0);
        let budget = Budget::with_expansions(20_000);
        let proposal = propose(&model, &task, &Default::default(), &options, &budget).expect("an answer");
        let answer = AnswerView::of(&proposal, &[], &proposal.outcome, 0, 0.0);
        assert_eq!(Schema::named("answer").check(&json!(answer)), Ok(()), "{}", fault.name);
        let ran = run_in(&mut Watched::new(), &model, &fault, 0, &options, Experience::new(), &mut approve);
        for event in ran.events {
            assert_eq!(
                Schema::named("event").check(&json!(wire_event(&event, &model.hierarchy))),
                Ok(()),
                "{}",
                fault.name
            );
        }
    }
}

#[test]
fn what_is_not_as_a_schema_says_is_found() {
    let schema = Schema::named("episode-command");
    let said = |value: Value| schema.check(&value);
    assert_eq!(said(json!({"command": "observe", "id": 1})), Ok(()));
    for wrong in [
        json!({"command": "observe"}),
        json!({"command": "observe", "id": -1}),
        json!({"command": "observe", "id": 1, "more": 2}),
        json!({"command": "look", "id": 1}),
        json!([]),
    ] {
        assert!(said(wrong.clone()).is_err(), "{wrong}");
    }
}
