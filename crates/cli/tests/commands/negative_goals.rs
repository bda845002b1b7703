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
