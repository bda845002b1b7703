//! Goals of which a part must not hold in the end.

use serde_json::json;

use crate::common::{Folder, Transcript};

/// The lettuce, chopped and taken away again, which its first three steps do not do.
#[test]
fn planned_judged_carried_out_and_recorded() {
    let folder = Folder::kitchen();
    let goal = json!(["chop_state_Chopped(lettuce_1)", "not content_holds(cutboard_1,lettuce_1)"]);
    folder.changed("K/tasks/T1.1.json", "cleared.json", |task| task["goal"] = goal.clone());
    let mut transcript = Transcript::default();
    transcript.add("plan", &folder.run("plan kitchen.json cleared.json -o cleared.plan"));
    let plan = folder.read("cleared.plan");
    let lines: Vec<&str> = plan.lines().take(3).collect();
    folder.write("left.plan", lines.join("\n"));
    transcript.add("validate", &folder.run("validate kitchen.json cleared.json cleared.plan left.plan"));
    transcript.add("run", &folder.run("run kitchen.json cleared.json --kitchen --record runs"));
    folder.changed("cleared.json", "never.json", |task| task["goal"] = json!(["not content_holds(plate_1,lettuce_1)"]));
    transcript.add("nothing to be done", &folder.run("plan kitchen.json never.json"));
    folder.changed("cleared.json", "fixed.json", |task| task["goal"] = json!(["not movable(lettuce_1)"]));
    transcript.add("what cannot be", &folder.run("plan kitchen.json fixed.json"));
    insta::assert_snapshot!(transcript.0);
    let recorded = folder.read("runs/cleared.jsonl");
    let header: serde_json::Value = serde_json::from_str(recorded.lines().next().expect("a header")).expect("JSON");
    assert_eq!(header["goal"], goal);
    folder.run("learn --into kitchen.json runs/cleared.jsonl").succeeds();
}

/// A garden in which roses can be watered, and only with a can that is full.
#[test]
fn what_comes_nearest_to_deleting_is_said() {
    let folder = Folder::new();
    folder.write(
        "garden.pddl",
        "(define (domain garden) (:types plant tool - object rose tulip - plant)
           (:predicates (thirsty ?p - plant) (full ?t - tool) (old ?p - plant))
           (:action water :parameters (?t - tool ?r - rose) :precondition (full ?t) :effect (not (thirsty ?r))))",
    );
    let state = |atoms: &str| {
        format!(
            r#"{{"objects":{{"rose_1":"rose","tulip_1":"tulip","can_1":"tool"}},
                "atoms":["thirsty(rose_1)","thirsty(tulip_1)","old(rose_1)"{atoms}]}}"#
        )
    };
    let plan = |goal: &str, atoms: &str| {
        folder.write("task.json", format!(r#"{{"format":"task/1","goal":["{goal}"],"state":{}}}"#, state(atoms)));
        folder.run("plan garden.pddl task.json -o found")
    };
    let full = r#","full(can_1)""#;
    for (goal, atoms, why) in [
        (
            "not thirsty(tulip_1)",
            full,
            "and cannot be deleted: the nearest action is water, but tulip_1 is of type tulip, not rose",
        ),
        (
            "not thirsty(rose_1)",
            "",
            "and cannot be deleted: the nearest action is water, but it needs full(any tool), which cannot be reached",
        ),
        ("not old(rose_1)", full, "but no action can delete it"),
    ] {
        let ended = plan(goal, atoms);
        // What a wider action would delete can be imagined for, as what it would add.
        let hint = match goal {
            "not thirsty(tulip_1)" => "hint: --imagine finds a plan of 1 step resting on 1 imagined action\n",
            _ => "",
        };
        let said = format!("no plan: {} must not hold in the end, {why}\n{hint}", goal.trim_start_matches("not "));
        assert_eq!((ended.code, ended.err), (11, said), "{goal}");
    }
    let note = "note: in the goal not thirsty(can_1): in this model, argument 1 of `thirsty` is of type plant; can_1 is of \
                type tool\n";
    let held = plan("not thirsty(can_1)", full);
    assert!(held.code == 0 && held.err.contains(note), "what never holds may be a slip: {held}");
    assert!(!plan("not thirsty(rose_1)", full).err.contains("note"));
}
