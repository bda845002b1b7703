//! `validate`.

use crate::common::Folder;
use crate::given::{TOUR, roads};

#[test]
fn each_verdict_in_the_words_of_val() {
    let folder = roads();
    folder.write("good", "; a tour\n0.0: (FILL-UP v) [1]\n1.0: (drive V home inn)\n(fill-up v)(drive v inn mill)\n");
    folder.write("short", "(fill-up v)\n(drive v home inn)\n");
    folder.write("dry", "(fill-up v)\n(drive v home inn)\n(drive v inn mill)\n");
    folder.write("far", "(fill-up v)\n(drive v home mill)\n");
    folder.write("stranded", "(fill-up v)\n(drive v home inn)\n(fill-up v)\n(drive v inn mill)\n(fill-up v)\n");
    folder.write("typed", "(fill-up inn)\n");
    folder.write("unknown", "(fly v home inn)\n");
    folder.write("arity", "(fill-up v home)\n");
    folder.write("nobody", "(fill-up w)\n");
    folder.write("empty", "");
    insta::assert_snapshot!("validate", folder.run("validate domain.pddl tour.pddl good short good"));
    insta::assert_snapshot!(
        "validate-failing",
        folder.run("validate domain.pddl tour.pddl dry far stranded typed unknown arity nobody empty")
    );
    insta::assert_snapshot!("validate-json", folder.run("validate domain.pddl tour.pddl good short dry --json"));
}

#[test]
fn without_a_metric_the_value_is_the_number_of_steps() {
    let folder = roads();
    folder.write("plain.pddl", TOUR.replace("(:metric minimize (total-cost))", ""));
    folder.write("good", "(fill-up v)\n(drive v home inn)\n(fill-up v)\n(drive v inn mill)\n");
    for (problem, value) in [("tour", 16), ("plain", 4)] {
        let verdict = folder.run(&format!("validate domain.pddl {problem}.pddl good"));
        verdict.succeeds();
        assert!(verdict.out.contains(&format!("Final value: {value}\n")), "{verdict}");
    }
}

#[test]
fn plans_of_learned_models() {
    let folder = Folder::kitchen();
    folder.run("plan kitchen.json K/tasks/T1.1.json -o lettuce.plan -q").succeeds();
    folder.run("plan kitchen.json K/tasks/T4.1.json --imagine -o apple.plan -q").succeeds();
    insta::assert_snapshot!("validate-learned", folder.run("validate kitchen.json K/tasks/T1.1.json lettuce.plan"));
    let strict = folder.run("validate kitchen.json K/tasks/T4.1.json apple.plan lettuce.plan");
    assert_eq!(strict.code, 12, "it is not in the model");
    assert_eq!(strict.err, "hint: apple.plan is valid with imagined actions: --imagine allows them\n");
    folder.run("validate kitchen.json K/tasks/T4.1.json apple.plan --imagine").succeeds();
}

#[test]
fn plans_that_cannot_be_read_are_refused() {
    let folder = roads();
    folder.write("open", "(fill-up v)\n(drive v home");
    folder.write("words", "fill-up v\n");
    folder.write("nested", "((fill-up v))\n");
    let mut all = String::new();
    for plan in ["open", "words", "nested", "missing"] {
        all.push_str(&folder.refuses(31, &format!("validate domain.pddl tour.pddl {plan}")).err);
    }
    insta::assert_snapshot!("validate-unreadable", all);
}
