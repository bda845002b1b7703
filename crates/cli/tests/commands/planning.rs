//! `plan`.

use crate::common::Folder;

#[test]
fn plans_of_the_kitchen() {
    let folder = Folder::kitchen();
    insta::assert_snapshot!("plan", folder.run("plan kitchen.json K/tasks/T2.1.json -o t.plan"));
    insta::assert_snapshot!("plan-file", folder.read("t.plan"));
    insta::assert_snapshot!("plan-json", folder.run("plan kitchen.json K/tasks/T1.1.json --json"));
    insta::assert_snapshot!("plan-three", folder.run("plan kitchen.json K/tasks/T2.4.json --plans 3 -o three"));
    insta::assert_snapshot!("plan-better", folder.run("plan kitchen.json K/tasks/T1.1.json --better -o best"));
    assert_eq!(folder.names(), ["K", "best", "best.1", "kitchen.json", "t.plan", "three.1", "three.2", "three.3"]);
    assert_eq!(folder.run("plan kitchen.json K/tasks/T2.4.json -o one").code, 0);
    assert!(folder.read("three.1") == folder.read("one"), "the first of three is the one");
    insta::assert_snapshot!(
        "plan-no-further",
        folder.run("plan kitchen.json K/tasks/T1.1.json --plans 2 --max-expansions 5000")
    );
}

#[test]
fn no_plan_says_why_and_whether_imagining_helps() {
    let folder = Folder::kitchen();
    insta::assert_snapshot!("no-plan-with-hint", folder.run("plan kitchen.json K/tasks/T4.1.json -o none.plan"));
    insta::assert_snapshot!("no-plan-json", folder.run("plan kitchen.json K/tasks/T4.1.json --json"));
    folder.changed("K/tasks/T1.1.json", "plate.json", |task| {
        task["goal"] = ["holding_holds(agent_1,blender_1)"].into();
    });
    let none = folder.run("plan kitchen.json plate.json");
    assert_eq!(none.code, 11);
    assert!(!none.err.contains("hint:"), "imagining does not help here: {none}");
    insta::assert_snapshot!("no-plan-without-hint", none);
    assert_eq!(folder.run("plan kitchen.json plate.json --imagine").code, 11);
    assert_eq!(folder.names(), ["K", "kitchen.json", "plate.json"], "there is no plan to write");
}

#[test]
fn a_goal_beyond_all_types_is_noted_where_there_is_no_plan() {
    let folder = Folder::kitchen();
    let goals = ["content_holds(plate_1,agent_1)", "holding_holds(lettuce_1,agent_1)"];
    let change = |task: &mut serde_json::Value| task["goal"] = goals.as_slice().into();
    folder.changed("K/tasks/T1.1.json", "odd.json", change);
    insta::assert_snapshot!("no-plan-with-note", folder.run("plan kitchen.json odd.json"));
    let run = folder.run("run kitchen.json odd.json --kitchen --imagine");
    assert_eq!(run.code, 12);
    insta::assert_snapshot!("run-no-plan-with-note", run);
    let told = folder.run("run kitchen.json odd.json --kitchen --json");
    assert!(told.out.contains(r#""notes":["in the goal content_holds(plate_1,agent_1): "#), "{told}");
    let helped = folder.run("plan kitchen.json K/tasks/T4.1.json");
    assert!(helped.err.contains("hint: --imagine") && !helped.err.contains("note:"), "imagining is the way: {helped}");
}

#[test]
fn imagined_steps_are_marked() {
    let folder = Folder::kitchen();
    insta::assert_snapshot!("imagine", folder.run("plan kitchen.json K/tasks/T4.1.json --imagine -o apple.plan"));
    insta::assert_snapshot!("imagine-file", folder.read("apple.plan"));
    insta::assert_snapshot!("imagine-json", folder.run("plan kitchen.json K/tasks/T4.1.json --imagine --json"));
}

#[test]
fn a_goal_that_holds_already_takes_no_step() {
    let folder = Folder::kitchen();
    for goal in [vec!["chop_state_Fresh(lettuce_1)"], vec![]] {
        folder.changed("K/tasks/T1.1.json", "done.json", |task| task["goal"] = goal.into());
        let plan = folder.run("plan kitchen.json done.json -o done.plan");
        plan.succeeds();
        assert_eq!(plan.out, "");
        assert!(plan.err.contains("the goal holds already: nothing is to be done\n"), "{plan}");
        assert_eq!(folder.read("done.plan"), "; cost = 0 (unit cost)\n");
    }
}

#[test]
fn a_type_that_was_never_declared_is_planned_with_after_adding_it() {
    let folder = Folder::kitchen();
    let text = folder.read("K/tasks/T1.1.json").replace("lettuce_1", "durian_1").replace("\"lettuce\"", "\"durian\"");
    folder.write("durian.json", text);
    let unknown = folder.refuses(31, "plan kitchen.json durian.json");
    assert_eq!(
        unknown.err,
        "error: durian.json: in the state: entity durian_1: the model does not know the type `durian`\n\
         hint: Is it another model that this belongs to? --types FILE adds types to a learned model.\n"
    );
    folder.write("more.pddl", "(:types durian - food)");
    insta::assert_snapshot!("durian", folder.run("plan kitchen.json durian.json --types more.pddl"));
    folder.write("other.json", r#"{"durian": "plate"}"#);
    assert_eq!(folder.run("plan kitchen.json durian.json --types other.json").code, 11, "a plate is not chopped");
}
