//! `learn` and `show`.

use crate::common::Folder;

#[test]
fn learning_from_the_kitchen() {
    let folder = Folder::new();
    let exported = folder.run("kitchen export K");
    exported.succeeds();
    assert_eq!(exported.err, "wrote types.pddl, 8 demonstrations, 24 tasks and 12 faults to K\n");
    insta::assert_snapshot!("learn", folder.run("learn K/demos --types K/types.pddl -o kitchen.json"));
    insta::assert_snapshot!("learn-json", folder.run("learn K/demos --types K/types.pddl -o again.json --json -q"));
    assert!(folder.read("kitchen.json") == folder.read("again.json"), "equal evidence gives equal bytes");
    insta::assert_snapshot!("learn-dry-run", folder.run("learn K/demos --types K/types.pddl --dry-run"));
    let individual = folder.run("learn K/demos --types K/types.pddl --individual -o individual.json");
    assert!(individual.out.contains("\n39 individual actions\n"), "{individual}");
    assert_eq!(folder.names(), ["K", "again.json", "individual.json", "kitchen.json"]);
}

#[test]
fn a_dry_run_writes_nothing() {
    let folder = Folder::new();
    folder.run("kitchen export K").succeeds();
    folder.run("learn K/demos --types K/types.pddl --dry-run -o m.json").succeeds();
    assert_eq!(folder.names(), ["K"]);
}

#[test]
fn nothing_to_learn() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"box": "thing"}"#);
    let header = r#"{"format":"trace/1","task":"wait"}"#;
    let state = r#"{"state":{"objects":{"a":"box"},"atoms":["open(a)"]}}"#;
    folder.write("one.jsonl", format!("{header}\n{state}\n"));
    insta::assert_snapshot!("learn-nothing", folder.run("learn one.jsonl --types types.json -o m.json"));
    let action = r#"{"action":{"name":"WAIT","args":["a"]}}"#;
    folder.write("two.jsonl", format!("{header}\n{state}\n{action}\n{state}\n"));
    insta::assert_snapshot!("learn-unchanged", folder.run("learn two.jsonl --types types.json -o m.json"));
}

#[test]
fn failures_speak_against_merging() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"cup": "vessel", "mug": "vessel", "jar": "vessel", "vessel": "thing"}"#);
    let trace = |vessel: &str, executed: bool, after: &str| {
        let state = |atom: &str| format!(r#"{{"state":{{"objects":{{"x":"{vessel}"}},"atoms":["{atom}(x)"]}}}}"#);
        let action = format!(r#"{{"action":{{"name":"WASH","args":["x"]}},"executed":{executed}}}"#);
        format!("{{\"format\":\"trace/1\"}}\n{}\n{action}\n{}\n", state("dirty"), state(after))
    };
    folder.write("cup.jsonl", trace("cup", true, "clean"));
    folder.write("mug.jsonl", trace("mug", true, "clean"));
    folder.write("jar.jsonl", trace("jar", false, "broken"));
    folder.run("learn cup.jsonl mug.jsonl --types types.json -o merged.json -q").succeeds();
    insta::assert_snapshot!(
        "learn-failures",
        folder.run("learn cup.jsonl mug.jsonl jar.jsonl --types types.json -o m.json")
    );
    insta::assert_snapshot!("show-failures", folder.run("show m.json"));
}

/// A crane that says in words what it has done, and how often; its hook is a list now and then.
#[test]
fn a_word_that_counts_and_a_relation_of_two_forms_are_warned_of() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"crane": "thing", "crate": "thing", "pier": "thing", "ship": "thing"}"#);
    let state = |said: usize, on: &str, hook: &str| {
        let crane = format!(
            r#"{{"id":"k","type":"crane","attributes":{{"report":"done_{said}"}},"relations":{{"hook":{hook}}}}}"#
        );
        let others = r#"{"id":"p","type":"pier"},{"id":"s","type":"ship"}"#;
        format!(
            r#"{{"state":{{"entities":[{crane},{{"id":"c","type":"crate","relations":{{"on":{on}}}}},{others}]}}}}"#
        )
    };
    let mut lines = vec![r#"{"format":"trace/1"}"#.to_owned(), state(0, "\"p\"", "null")];
    for round in 0..3 {
        for (step, (name, at)) in [("grab", "p"), ("drop", "s"), ("grab", "s"), ("drop", "p")].into_iter().enumerate() {
            lines.push(format!(r#"{{"action":{{"name":"{name}","args":["k","c","{at}"]}}}}"#));
            let (on, hook) = match name {
                "grab" => ("null".to_owned(), if round == 0 { "[\"c\"]" } else { "\"c\"" }),
                _ => (format!("\"{at}\""), "null"),
            };
            lines.push(state(4 * round + step + 1, &on, hook));
        }
    }
    folder.write("crane.jsonl", lines.join("\n"));
    let learned = folder.run("learn crane.jsonl --types types.json -o m.json");
    learned.succeeds();
    let said = [
        "warning: the relation `hook` is now a list, as of k, and now an id or null, as of k\n",
        "without `report` there would be 2 kinds of effect instead of 12",
        "if it does not matter, --ignore report\n",
    ];
    assert!(said.iter().all(|said| learned.err.contains(said)), "{learned}");
    assert!(!folder.run("learn crane.jsonl --types types.json -o m.json --ignore report").err.contains("without `"));
}

#[test]
fn names_that_pddl_does_not_tell_apart_are_placed() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"lamp": "thing"}"#);
    let state = |atom: &str| format!(r#"{{"state":{{"objects":{{"l":"lamp"}},"atoms":["{atom}(l)"]}}}}"#);
    let press = r#"{"action":{"name":"press","args":["l"]}}"#;
    let lines = [r#"{"format":"trace/1"}"#, &state("lit"), press, &state("dark"), press, &state("Lit")];
    folder.write("lamp.jsonl", lines.join("\n"));
    let refused = folder.refuses(31, "learn lamp.jsonl --types types.json -o m.json");
    let hint = "hint: `Lit` is in lamp.jsonl after step 2, and `lit` is in lamp.jsonl before step 1. PDDL knows";
    assert!(refused.err.contains(hint), "{refused}");
}

/// Picking up a block and putting it down, with something more said of the states after.
fn trajectory(picked: &str, dropped: &str) -> String {
    format!(
        "((:init (table a) (table b) (free) (not (held a)) (not (held b)))\n(operator: (pick a))\n\
         (:state (held a) (not (free)) (not (held b)) {picked})\n(operator: (drop a))\n\
         (:state (table a) (free) (not (held a)) (not (held b)) {dropped}))\n"
    )
}

#[test]
fn what_is_not_listed_is_not_taken_for_false() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"block": "thing"}"#);
    folder.write("objects.json", r#"{"a": "block", "b": "block"}"#);
    let learn = "--types types.json --objects objects.json -o";
    folder.write("whole.trajectory", trajectory("(not (table a)) (table b)", "(table b)"));
    // Whether `a` is still on the table when it is held is not said.
    folder.write("part.trajectory", trajectory("(table b)", "(table b)"));
    insta::assert_snapshot!("learn-part", folder.run(&format!("learn part.trajectory {learn} part.json")));
    // What is not said of `b` does not matter.
    folder.write("elsewhere.trajectory", trajectory("(not (table a))", ""));
    folder.write("closed.trajectory", without_negations(&trajectory("(table b)", "(table b)")));
    let shown = [("whole", ""), ("elsewhere", ""), ("part", "--closed"), ("closed", "")].map(|(name, option)| {
        folder.run(&format!("learn {name}.trajectory {learn} m.json -q {option}")).succeeds();
        folder.run("show m.json").out
    });
    assert!(shown.iter().all(|other| *other == shown[0]), "{shown:#?}");
    insta::assert_snapshot!("learn-whole", shown[0]);
    // Without a single negation nothing is known to have changed.
    insta::assert_snapshot!("learn-open", folder.run(&format!("learn closed.trajectory --open {learn} open.json")));
    // Another trace lists a kind of atoms that this one does not list, and that the actions may change.
    let marked = "(marked b) (not (marked a)) (table a) (table b) (free) (not (held a)) (not (held b))";
    folder.write("marked.trajectory", format!("((:init {marked})\n(operator: (look b))\n(:state {marked}))\n"));
    insta::assert_snapshot!(
        "learn-unlisted",
        folder.run(&format!("learn whole.trajectory marked.trajectory {learn} unlisted.json"))
    );
    folder.run("learn --into unlisted.json --forget marked.trajectory -q").succeeds();
    folder.run(&format!("learn whole.trajectory {learn} m.json -q")).succeeds();
    assert_eq!(folder.read("unlisted.json"), folder.read("m.json"));
}

fn without_negations(trajectory: &str) -> String {
    let mut text = trajectory.to_owned();
    while let Some(start) = text.find("(not ") {
        let end = start + text[start..].find("))").expect("it is closed") + 2;
        text.replace_range(start..end, "");
    }
    text
}

#[test]
fn what_a_state_calls_unknown_is_not_taken_for_false() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"block": "thing", "hand": "thing"}"#);
    let trace = |unknown: &str| {
        let state = |atoms: &str, unknown: &str| {
            let objects = r#"{"a":"block","b":"block","h":"hand","g":"hand"}"#;
            format!(r#"{{"state":{{"objects":{objects},"atoms":[{atoms}],"unknown":[{unknown}]}}}}"#)
        };
        let (before, after) = (state(r#""free(h)","free(g)""#, ""), state(r#""held(h,a)","free(g)""#, unknown));
        let action = r#"{"action":{"name":"PICK","args":["h","a"]}}"#;
        format!("{{\"format\":\"trace/1\"}}\n{before}\n{action}\n{after}\n")
    };
    folder.write("known.jsonl", trace(""));
    folder.write("elsewhere.jsonl", trace(r#""held(g,b)""#));
    folder.write("near.jsonl", trace(r#""held(h,*)""#));
    // Whether `g` still holds `a` is hidden as well.
    folder.write("any.jsonl", trace(r#""held(g,*)""#));
    folder.write("every.jsonl", trace(r#""held(*,b)""#));
    let show = |name: &str| {
        folder.run(&format!("learn {name}.jsonl --types types.json -o m.json -q")).succeeds();
        folder.run("show m.json").out
    };
    assert_eq!(show("elsewhere"), show("known"));
    let near = folder.run("learn near.jsonl --types types.json -o m.json");
    insta::assert_snapshot!("learn-near", near);
    for name in ["any", "every"] {
        let hidden = folder.run(&format!("learn {name}.jsonl --types types.json -o m.json"));
        assert_eq!(hidden.out, near.out.replace("near.jsonl", &format!("{name}.jsonl")));
    }
}

#[test]
fn showing_a_model() {
    let folder = Folder::kitchen();
    insta::assert_snapshot!("show", folder.run("show kitchen.json"));
    insta::assert_snapshot!("show-action", folder.run("show kitchen.json --action USE-cutboard-food"));
    insta::assert_snapshot!("show-pddl", folder.run("show kitchen.json --pddl"));
    let wrong = folder.refuses(31, "show kitchen.json --action USE-cutboard-fod");
    assert_eq!(
        wrong.err,
        "error: the model has no action `USE-cutboard-fod`\nhint: Did you mean `USE-cutboard-food`?\n"
    );
    insta::assert_snapshot!("show-wrong-action", folder.refuses(31, "show kitchen.json --action ''"));
}
