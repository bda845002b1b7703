//! `export`.

use std::path::Path;

use serde_json::Value;

use crate::common::{Folder, Transcript, names};

/// What an export left behind.
fn written(folder: &Folder, name: &str) -> Vec<String> {
    names(&folder.path(name))
}

/// The steps of a plan in the model's names, as `names.json` has them.
fn translated(folder: &Folder, exported: &str, plan: &str) -> Vec<String> {
    let names = folder.json(&format!("{exported}/names.json"));
    let name = |kind: &str, name: &str| match &names[kind][name] {
        Value::String(name) => name.clone(),
        _ => panic!("there is no {kind} {name}"),
    };
    let steps = plan.lines().filter(|line| line.starts_with('(')).map(|line| {
        let step = &line[1..line.find(')').expect("a step")];
        let mut words = step.split(' ');
        let action = name("actions", words.next().expect("an action"));
        let objects: Vec<String> = words.map(|object| name("objects", object)).collect();
        format!("{action}({})", objects.join(", "))
    });
    steps.collect()
}

#[test]
fn a_model_with_a_task() {
    let folder = Folder::kitchen();
    insta::assert_snapshot!("export", folder.run("export kitchen.json K/tasks/T2.1.json -o bread"));
    assert_eq!(written(&folder, "bread"), ["domain.pddl", "names.json", "problem.pddl"]);
    insta::assert_snapshot!("export-domain", folder.read("bread/domain.pddl"));
    insta::assert_snapshot!("export-problem", folder.read("bread/problem.pddl"));
    folder.run("plan kitchen.json K/tasks/T2.1.json -o bread.plan").succeeds();
    assert_eq!(
        translated(&folder, "bread", &folder.read("bread.plan"))[..2],
        ["PICK-station-food(agent_1, counter_14, bread_1)", "PLACE-tool-food(agent_1, cutboard_1, bread_1)"]
    );
}

#[test]
fn imagined_actions_are_marked_and_strips_has_no_negation() {
    let folder = Folder::kitchen();
    let command = "export kitchen.json K/tasks/T4.1.json --imagine --level strips -o apple";
    insta::assert_snapshot!("export-strips", folder.run(command));
    let domain = folder.read("apple/domain.pddl");
    insta::assert_snapshot!("export-strips-domain", domain);
    insta::assert_snapshot!("export-strips-problem", folder.read("apple/problem.pddl"));
    assert!(domain.contains("; imagined: food for carrot, from USE-blender-carrot\n"));
    for line in domain.lines().filter(|line| line.contains("(not ")) {
        assert!(line.starts_with("      (not ("), "{line}");
    }
    // The same again gives the same, over what is there.
    let before = folder.read("apple/problem.pddl");
    folder.run(command).succeeds();
    assert!(folder.read("apple/problem.pddl") == before && folder.read("apple/domain.pddl") == domain);
}

#[test]
fn a_model_alone_and_without_strictness() {
    let folder = Folder::kitchen();
    insta::assert_snapshot!("export-alone", folder.run("export kitchen.json -o alone"));
    assert_eq!(written(&folder, "alone"), ["domain.pddl", "names.json"]);
    folder.run("export kitchen.json --not-strict --level adl -o deep/er/plain").succeeds();
    let plain = folder.read("deep/er/plain/domain.pddl");
    assert!(folder.read("alone/domain.pddl").contains("(not (holding_holds ?x0 ?x2))\n      (movable"));
    assert!(
        plain.contains("(:requirements :strips :typing :negative-preconditions :equality)\n"),
        "inequality is left"
    );
    assert_eq!(plain, folder.run("show kitchen.json --pddl").out, "the same exporter");
    folder.run("export kitchen.json --plain -o older").succeeds();
    assert_eq!(plain, folder.read("older/domain.pddl"), "the option's former name");
}

#[test]
fn the_domain_has_the_name_that_it_is_given() {
    let folder = Folder::kitchen();
    folder.run("export kitchen.json K/tasks/T1.1.json --name our_Kitchen-2 -o named").succeeds();
    assert!(folder.read("named/domain.pddl").contains("(define (domain our_kitchen-2)\n"));
    assert!(folder.read("named/problem.pddl").contains("(:domain our_kitchen-2)\n"));
    folder.run("pddl check named/domain.pddl named/problem.pddl").succeeds();
}

#[test]
fn what_was_written_as_data() {
    let folder = Folder::kitchen();
    let ended = folder.run("export kitchen.json K/tasks/T4.1.json --imagine --json -o apple");
    ended.succeeds();
    let report: Value = serde_json::from_str(&ended.out).expect("JSON");
    assert_eq!(report["files"], serde_json::json!(["apple/domain.pddl", "apple/problem.pddl", "apple/names.json"]));
    assert_eq!(report["imagined_actions"], 1);
    let alone = folder.run("export kitchen.json --json -o alone");
    let report: Value = serde_json::from_str(&alone.out).expect("JSON");
    assert_eq!((&report["actions"], &report["objects"]), (&13.into(), &Value::Null));
}

#[test]
fn types_can_be_added() {
    let folder = Folder::kitchen();
    let text = folder.read("K/tasks/T1.1.json").replace("lettuce_1", "durian_1").replace("\"lettuce\"", "\"durian\"");
    folder.write("durian.json", text);
    folder.write("more.pddl", "(:types durian - food)");
    folder.run("export kitchen.json durian.json --types more.pddl -o out").succeeds();
    assert!(folder.read("out/problem.pddl").contains("durian_1 lettuce_2 - durian)\n"));
    assert!(folder.read("out/domain.pddl").contains("durian"));
}

#[test]
fn what_is_refused() {
    let folder = Folder::kitchen();
    folder.write("file", "");
    folder
        .changed("K/tasks/T1.1.json", "goal.json", |task| drop(task.as_object_mut().expect("a task").remove("state")));
    folder.changed("K/tasks/T1.1.json", "twins.json", |task| {
        let text = task.to_string().replace("tomato_1", "Onion_1");
        *task = serde_json::from_str(&text).expect("JSON");
    });
    let mut transcript = Transcript::default();
    for (code, command) in [
        (36, "export kitchen.json K/tasks/T1.1.json"),
        (36, "export kitchen.json --imagine -o out"),
        (36, "export kitchen.json --level pddl3 -o out"),
        (36, "export kitchen.json --format sas -o out"),
        (36, "export -o out"),
        (31, "export kitchen.json goal.json -o out"),
        (31, "export kitchen.json twins.json -o out"),
        (31, "export kitchen.json K/tasks/T1.1.json -o file"),
        (31, "export kitchen.json K/tasks/T1.1.json -o file/out"),
        (31, "export kitchen.json K/tasks/T1.1.json -o /proc/out"),
        (31, "export none.json -o out"),
        (31, "export K/tasks/T1.1.json kitchen.json -o out"),
    ] {
        transcript.add(command, &folder.refuses(code, command));
    }
    insta::assert_snapshot!("export-refused", transcript.0);
    assert!(!Path::new(&folder.path("out")).exists());
}

#[test]
fn what_is_read_is_not_written_over() {
    let folder = Folder::new();
    let kitchen = Folder::kitchen();
    folder.write("names.json", kitchen.read("kitchen.json"));
    let refused = folder.refuses(31, "export names.json -o .");
    assert!(refused.err.starts_with("error: ./names.json is read, and would be written over\n"), "{refused}");
}

#[test]
fn strips_is_refused_where_it_has_no_words() {
    let folder = Folder::kitchen();
    // A kitchen in which far too many things, most of them described as counters are, may lie on far too many others.
    folder.changed("K/tasks/T1.1.json", "many.json", |task| {
        let entities = task["state"]["entities"].as_array_mut().expect("entities");
        let counter = entities.iter().find(|entity| entity["type"] == "counter").expect("a counter").clone();
        for number in 0..2600 {
            for ty in ["counter", "tomato"] {
                let mut more = counter.clone();
                more["id"] = format!("more_{ty}_{number}").into();
                more["type"] = ty.into();
                more["relations"] = Value::Object(Default::default());
                entities.push(more);
            }
        }
    });
    let refused = folder.refuses(34, "export kitchen.json many.json --level strips -o out -q");
    assert!(refused.err.starts_with("error: in STRIPS, every case in which `"), "{refused}");
    assert!(refused.err.ends_with("\nhint: --level adl needs none of this.\n"), "{refused}");
    folder.run("export kitchen.json many.json -o out").succeeds();
}
