//! `run`.

use serde_json::Value;

use crate::common::Folder;

#[test]
fn a_task_in_the_kitchen() {
    let folder = Folder::kitchen();
    insta::assert_snapshot!("run", folder.run("run kitchen.json K/tasks/T1.1.json --kitchen"));
    insta::assert_snapshot!("run-json", folder.run("run kitchen.json K/tasks/T1.1.json --kitchen --json"));
    insta::assert_snapshot!("run-quiet", folder.run("run kitchen.json K/tasks/T1.1.json --kitchen -q"));
    insta::assert_snapshot!("run-no-plan", folder.run("run kitchen.json K/tasks/T4.1.json --kitchen"));
    insta::assert_snapshot!("run-imagine", folder.run("run kitchen.json K/tasks/T4.1.json --kitchen --imagine"));
}

#[test]
fn a_fault_is_found_out_and_remembered() {
    let folder = Folder::kitchen();
    let fault = "run kitchen.json K/faults/broken_cutboard_lettuce.json --kitchen --imagine";
    insta::assert_snapshot!("fault", folder.run(fault));
    insta::assert_snapshot!("fault-restart", folder.run(&format!("{fault} --restart")));
    insta::assert_snapshot!("fault-json", folder.run(&format!("{fault} --json")));
    insta::assert_snapshot!(
        "fault-remembered",
        folder.run("run kitchen.json K/faults/exception_coconut.json K/faults/exception_coconut_lettuce.json --kitchen --instance room --imagine -q")
    );
    let without = folder.run("run kitchen.json K/faults/broken_cutboard_lettuce.json K/tasks/T1.1.json --kitchen -q");
    assert_eq!(without.code, 12, "not every goal was reached: {without}");
}

#[test]
fn everything_that_happens_is_written_as_events() {
    let folder = Folder::kitchen();
    folder.write("events.jsonl", "from an earlier run\n");
    let fault = "run kitchen.json K/faults/broken_cutboard_lettuce.json --kitchen --imagine -q --events events.jsonl";
    folder.run(fault).succeeds();
    let events: Vec<Value> =
        folder.read("events.jsonl").lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let names: Vec<&str> = events.iter().filter_map(|event| event["event"].as_str()).collect();
    assert_eq!(names.len(), events.len(), "each names itself");
    insta::assert_snapshot!("events", names.join("\n"));
}

#[test]
fn a_goal_that_holds_already_is_solved_without_acting() {
    let folder = Folder::kitchen();
    folder.changed("K/tasks/T1.1.json", "done.json", |task| task["goal"] = ["chop_state_Fresh(lettuce_1)"].into());
    let done = folder.run("run kitchen.json done.json --kitchen");
    done.succeeds();
    assert_eq!(done.out, "done  solved: the goal held already\n");
}

#[test]
fn a_task_needs_no_state_to_be_run() {
    let folder = Folder::kitchen();
    folder.changed("K/tasks/T1.1.json", "stateless.json", |task| {
        task.as_object_mut().expect("an object").remove("state");
    });
    folder.run("run kitchen.json stateless.json --kitchen").succeeds();
    let refused = folder.refuses(31, "plan kitchen.json stateless.json");
    assert_eq!(
        refused.err,
        "error: stateless.json: the task has no `state` to plan from\n\
         hint: Give it a `state`, or run it in an environment (typelift run).\n"
    );
}
