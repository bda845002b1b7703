//! `learn --into`: demonstrations are added to a model, and taken out again.

use crate::common::{Folder, Transcript, names};

/// A model of two demonstrations in `part.json`; the names of all eight.
fn part() -> (Folder, Vec<String>) {
    let folder = Folder::kitchen();
    let demos = names(&folder.path("K/demos"));
    let [first, second] = [&demos[5], &demos[2]];
    folder.run(&format!("learn K/demos/{first} K/demos/{second} --types K/types.pddl -o part.json -q")).succeeds();
    (folder, demos)
}

#[test]
fn adding_is_learning_from_all_at_once() {
    let (folder, demos) = part();
    let before = folder.read("part.json");
    let rest: Vec<String> =
        demos.iter().enumerate().filter(|(i, _)| ![2, 5].contains(i)).map(|(_, d)| d.clone()).collect();
    let paths: Vec<String> = rest.iter().rev().map(|demo| format!("K/demos/{demo}")).collect();
    let (some, others) = paths.split_at(3);
    let added = folder.run(&format!("learn --into part.json {} -o more.json", some.join(" ")));
    added.succeeds();
    assert!(folder.read("part.json") == before, "-o leaves the model as it is");
    folder.run(&format!("learn --into more.json {} -q", others.join(" "))).succeeds();
    assert!(folder.read("more.json") == folder.read("kitchen.json"), "the bytes of learning from all at once");
    assert!(added.out.contains("from 5 demonstrations"), "{added}");
    folder.run("learn --into part.json K/demos --dry-run").succeeds();
    assert!(folder.read("part.json") == before, "a dry run writes nothing");
    // What was asked of learning is asked again.
    folder.run(&format!("learn {} --types K/types.pddl --individual -o i.json -q", paths.join(" "))).succeeds();
    folder.run("learn --into i.json K/demos -q").succeeds();
    folder.run("learn K/demos --types K/types.pddl --individual -o individual.json -q").succeeds();
    assert!(folder.read("i.json") == folder.read("individual.json"));
}

#[test]
fn types_are_given_or_those_of_a_model() {
    let folder = Folder::kitchen();
    assert_eq!(
        folder.refuses(36, "learn K/demos -o m.json").err,
        "error: no types: say --types FILE\n\
         hint: Or say which model to add to, with --into MODEL: then its types hold.\n"
    );
}

#[test]
fn the_same_trace_counts_once() {
    let (folder, demos) = part();
    folder.write("z.jsonl", folder.read(&format!("K/demos/{}", demos[3])));
    let twice = folder.run("learn K/demos z.jsonl --types K/types.pddl -o twice.json");
    assert!(folder.read("twice.json") == folder.read("kitchen.json"));
    let modified = || folder.path("kitchen.json").metadata().and_then(|data| data.modified()).expect("a time");
    let before = modified();
    let again = folder.run("learn --into kitchen.json z.jsonl");
    assert!(again.err.contains("kitchen.json stays as it is: there is nothing new\n"), "{again}");
    assert_eq!(before, modified(), "it is not written anew");
    assert!(folder.read("twice.json") == folder.read("kitchen.json"));
    let mut transcript = Transcript::default();
    transcript.add("twice in one command", &twice);
    transcript.add("in the model already", &again);
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn what_is_forgotten_was_never_learned() {
    let (folder, demos) = part();
    let model = folder.read("kitchen.json");
    let listed = folder.run("show kitchen.json --sources");
    let id = listed.out.lines().find(|line| line.ends_with(&demos[4])).and_then(|line| line.split(' ').next());
    let id = id.expect("it is listed");
    let rest: Vec<String> =
        demos.iter().enumerate().filter(|(i, _)| *i != 4).map(|(_, demo)| format!("K/demos/{demo}")).collect();
    folder.run(&format!("learn {} --types K/types.pddl -o rest.json -q", rest.join(" "))).succeeds();
    folder.write("copy.jsonl", folder.read(&format!("K/demos/{}", demos[4])));
    for source in [demos[4].as_str(), "copy.jsonl", id] {
        folder.write("m.json", &model);
        folder.run(&format!("learn --into m.json --forget {source} -q")).succeeds();
        assert!(folder.read("m.json") == folder.read("rest.json"), "{source}");
    }
    let mut transcript = Transcript::default();
    transcript.add("the sources", &listed);
    transcript.add("not learned from", &folder.refuses(31, "learn --into rest.json --forget copy.jsonl"));
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn what_does_not_add_up_is_refused() {
    let (folder, demos) = part();
    let mut transcript = Transcript::default();
    folder.run("learn --into part.json --compact -o compact.json -q").succeeds();
    folder.run("learn K/demos --types K/types.pddl --compact -o all.json -q").succeeds();
    let rest: Vec<String> =
        demos.iter().enumerate().filter(|(i, _)| ![2, 5].contains(i)).map(|(_, d)| format!("K/demos/{d}")).collect();
    folder.run(&format!("learn --into compact.json {} -o sum.json -q", rest.join(" "))).succeeds();
    assert!(folder.read("sum.json") == folder.read("all.json"), "what is compact adds up as well");
    folder.write("types.pddl", folder.read("K/types.pddl").replace("lettuce", "cabbage"));
    folder.write("old.json", include_str!("../../../../fuzz/seeds/model/learned.json"));
    let state = r#"{"state":{"objects":{"a":"arm"},"atoms":["free(a)"]}}"#;
    folder.write("one.jsonl", format!("{{\"format\":\"trace/1\"}}\n{state}\n"));
    for (title, command) in [
        ("compact, and what it has already", format!("learn --into compact.json K/demos/{}", demos[5])),
        ("compact, and something is to go", format!("learn --into compact.json --forget {}", demos[5])),
        ("other types", "learn --into part.json K/demos --types types.pddl".to_owned()),
        ("something else is ignored", "learn --into part.json K/demos --ignore free".to_owned()),
        ("what it was learned from is unknown", "learn --into old.json --forget a.jsonl".to_owned()),
        ("nor can anything be added to it", "learn --into old.json one.jsonl".to_owned()),
        ("a domain", "learn --into K/types.pddl K/demos".to_owned()),
    ] {
        transcript.add(title, &folder.refuses(31, &command));
    }
    insta::assert_snapshot!(transcript.0);
}

#[test]
fn models_of_the_format_before_are_read() {
    let folder = Folder::new();
    folder.write("old.json", include_str!("../../../../fuzz/seeds/model/learned.json"));
    let mut transcript = Transcript::default();
    transcript.add("show", &folder.run("show old.json"));
    transcript.add("as a domain", &folder.run("show old.json --pddl"));
    insta::assert_snapshot!(transcript.0);
    // Nothing is added, so nothing can count twice: the model is learned again, and written in the format of today.
    for (option, name) in [("", "new.json"), ("--compact", "compact.json")] {
        folder.run(&format!("learn --into old.json {option} -o {name} -q")).succeeds();
        let new = folder.read(name);
        assert!(new.contains("\"format\": \"model/2\""), "{new}");
        folder.run(&format!("learn --into {name} -q")).succeeds();
        assert_eq!(folder.read(name), new);
    }
}

/// A gripper takes a thing and lays it down; with other types a person does, and hands what it has to the gripper.
fn trace_of(who: &str, thing: &str) -> String {
    let state = |atom: &str| {
        let objects = format!(r#"{{"w":"{who}","t":"{thing}","p":"place","g":"gripper"}}"#);
        format!(r#"{{"state":{{"objects":{objects},"atoms":["{atom}"]}}}}"#)
    };
    let action = |name: &str, args: &str| format!(r#"{{"action":{{"name":"{name}","args":[{args}]}}}}"#);
    let lines = [
        r#"{"format":"trace/1"}"#.to_owned(),
        state("lies(t,p)"),
        action("take", r#""w","t""#),
        state("holds(w,t)"),
        action("lay", r#""w","t","p""#),
        state("lies(t,p)"),
    ];
    lines.join("\n") + "\n"
}

#[test]
fn what_types_take_too_far_is_said() {
    let folder = Folder::new();
    folder
        .write("flat.json", r#"{"gripper":"object","person":"object","cup":"object","lid":"object","place":"object"}"#);
    folder.write("deep.json", r#"{"gripper":"agent","person":"agent","agent":"object","cup":"item","lid":"item","place":"object","item":"object"}"#);
    folder.write(
        "odd.json",
        r#"{"gripper":"thing","person":"thing","cup":"thing","lid":"thing","thing":"object","place":"object"}"#,
    );
    for (who, thing) in [("gripper", "cup"), ("gripper", "lid"), ("person", "cup")] {
        folder.write(&format!("{who}-{thing}.jsonl"), trace_of(who, thing));
    }
    let all = "gripper-cup.jsonl gripper-lid.jsonl person-cup.jsonl";
    let mut transcript = Transcript::default();
    transcript.add(
        "types that meet below the top",
        &folder.run(&format!("learn {all} --types deep.json -o deep-model.json")),
    );
    transcript.add("types that meet at the top", &folder.run(&format!("learn {all} --types flat.json --dry-run")));
    transcript
        .add("types that meet with others", &folder.run(&format!("learn {all} --types odd.json -o odd-model.json")));
    let own = folder.read("flat.json").replace("object", "thing").replace('{', r#"{"thing":"object","#);
    folder.write("own.json", own);
    transcript.add(
        "types that meet at a top of one's own",
        &folder.run("learn gripper-cup.jsonl gripper-lid.jsonl --types own.json -o own-model.json"),
    );
    transcript
        .add("one acts", &folder.run("learn gripper-cup.jsonl gripper-lid.jsonl --types flat.json -o flat-model.json"));
    transcript.add("another acts too", &folder.run("learn --into flat-model.json person-cup.jsonl --json"));
    transcript.add("somebody is said to act", &folder.run("learn --into flat-model.json --actor person"));
    folder.run("learn gripper-cup.jsonl gripper-lid.jsonl --types flat.json -o flat-model.json -q").succeeds();
    folder.write("acted-on.jsonl", trace_of("gripper", "gripper"));
    transcript.add("what acts is acted on", &folder.run("learn --into flat-model.json acted-on.jsonl"));
    transcript.add("from the start", &folder.run("learn gripper-cup.jsonl acted-on.jsonl --types flat.json --dry-run"));
    insta::assert_snapshot!(transcript.0);
}

/// A room in which a bell rings at every second step, whatever is done.
#[test]
fn what_changes_every_time_is_said() {
    let folder = Folder::new();
    folder.write("types.json", r#"{"robot":"object","cup":"object","bell":"object"}"#);
    let trace = |calls: &[&str], rings: fn(usize) -> bool| {
        let state = |at: usize| {
            let objects = r#"{"r":"robot","c":"cup","b":"bell"}"#;
            let held = if at % 2 == 1 { r#""holds(r,c)""# } else { r#""free(r)""# };
            let rings = if rings(at) { r#","rings(b)""# } else { "" };
            format!(r#"{{"state":{{"objects":{objects},"atoms":[{held}{rings}]}}}}"#)
        };
        let mut lines = vec![r#"{"format":"trace/1"}"#.to_owned(), state(0)];
        for (at, call) in calls.iter().enumerate() {
            lines.extend([format!(r#"{{"action":{{"name":"{call}","args":["r","c"]}}}}"#), state(at + 1)]);
        }
        lines.join("\n") + "\n"
    };
    let told = |trace: String| {
        folder.write("trace.jsonl", trace);
        let ended = folder.run("learn trace.jsonl --types types.json -o m.json");
        ended.succeeds();
        ended.err
    };
    let (calls, is_odd) = (["take", "lay", "grab", "give", "lay", "take"], |at| at % 2 == 1);
    assert_eq!(
        told(trace(&calls, is_odd)),
        "wrote m.json\nwarning: rings changes every time, whatever the action\n\
         hint: it makes one action look like several; if no action needs it, --ignore rings\n",
        "laying now makes it ring and now makes it stop"
    );
    for (told, why) in [
        (told(trace(&["take", "lay", "take", "lay"], is_odd)), "taking may make it ring, and laying make it stop"),
        (told(trace(&calls, |at| at == 1 || at == 5)), "it does not change every time"),
    ] {
        assert!(!told.contains("every time"), "{why}: {told}");
    }
}

/// A trace in which a robot presses a pump, which is switched or not: its mode, and how another thing hums.
fn pressing(is_switched: bool, names: &[(&str, &str)]) -> String {
    let state = |on: &str, other: &str, hum: &str| {
        format!(
            r#"{{"state":{{"entities":[{{"id":"robot_1","type":"robot"}},
               {{"id":"pump_1","type":"pump","attributes":{{{on}"mode":"{other}"}}}},
               {{"id":"fan_1","type":"fan","attributes":{{"hum":"{hum}"}}}}]}}}}"#
        )
        .replace('\n', "")
    };
    let mut lines = vec![r#"{"format":"trace/1"}"#.to_owned()];
    for (i, (mode, hum)) in names.iter().enumerate() {
        if i > 0 {
            lines.push(r#"{"action":{"name":"press","args":["robot_1","pump_1"]}}"#.to_owned());
        }
        let on = if is_switched { format!(r#""on":{},"#, i % 2 == 1) } else { String::new() };
        lines.push(state(&on, mode, hum));
    }
    lines.join("\n")
}

#[test]
fn only_what_changes_by_itself_is_advised_to_be_ignored() {
    let folder = Folder::new();
    folder.write("t.json", r#"{"robot": "thing", "pump": "thing", "fan": "thing"}"#);
    folder.write(
        "fan.jsonl",
        pressing(true, &[("A", "Low"), ("A", "Mid"), ("A", "High"), ("A", "Top"), ("A", "Max"), ("A", "Low")]),
    );
    folder.write(
        "pump.jsonl",
        pressing(false, &[("A", "Low"), ("B", "Low"), ("C", "Low"), ("D", "Low"), ("A", "Low"), ("B", "Low")]),
    );
    let ended = folder.run("learn fan.jsonl --types t.json --dry-run");
    ended.succeeds();
    assert!(ended.err.contains("if it does not matter, --ignore hum\n"), "{ended}");
    let ended = folder.run("learn pump.jsonl --types t.json --dry-run");
    ended.succeeds();
    assert!(ended.err.contains("most is kept apart by `mode`, which is all that some action changes"), "{ended}");
    assert!(!ended.err.contains("--ignore"), "{ended}");
    let ended = folder.run("learn pump.jsonl --types t.json --ignore mode --dry-run");
    ended.succeeds();
    let lost = "warning: no action is learned of press: it changed nothing but what is ignored, or nothing at all\n";
    assert!(ended.err.contains(lost), "{ended}");
    let ended = folder.run("learn fan.jsonl --types t.json --ignore hum --dry-run");
    ended.succeeds();
    assert!(!ended.err.contains("no action is learned"), "{ended}");
}
