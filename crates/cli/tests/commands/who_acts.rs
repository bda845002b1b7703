//! Who acts: as demonstrations show it, as a person says it, and as two models differ in it.

use crate::common::{Folder, Transcript};

const TYPES: &str = r#"{"fork": "object", "box": "object", "dock": "object", "lorry": "object"}"#;

/// A yard of one fork, one box and one dock, where each call leaves the box in another condition.
fn trace(calls: &[(&str, &str)]) -> String {
    let state = |atom: &str| {
        format!(r#"{{"state":{{"objects":{{"fork_1":"fork","box_1":"box","dock_1":"dock"}},"atoms":["{atom}"]}}}}"#)
    };
    let mut lines = vec![r#"{"format":"trace/1"}"#.to_owned(), state("stands(box_1)")];
    for (call, after) in calls {
        let (name, args) = call.trim_end_matches(')').split_once('(').expect("a call");
        let args: Vec<String> = args.split(',').map(|arg| format!("\"{arg}\"")).collect();
        lines.push(format!(r#"{{"action":{{"name":"{name}","args":[{}]}}}}"#, args.join(",")));
        lines.push(state(after));
    }
    lines.join("\n") + "\n"
}

fn yard() -> Folder {
    let folder = Folder::new();
    folder.write("types.json", TYPES);
    let lift = [("lift(fork_1,box_1)", "hangs(box_1)"), ("lower(fork_1,box_1,dock_1)", "on(box_1,dock_1)")];
    folder.write("lift.jsonl", trace(&lift));
    folder.write("seal.jsonl", trace(&[lift[0], lift[1], ("seal(dock_1,box_1)", "sealed(box_1)")]));
    folder.write("again.jsonl", trace(&[lift[0]]));
    folder
}

#[test]
fn the_call_that_hides_who_acts_is_named() {
    let folder = yard();
    let mut transcript = Transcript::default();
    for command in [
        "learn lift.jsonl --types types.json -o before.json",
        "learn seal.jsonl --types types.json -o sealing.json",
        "learn --into before.json seal.jsonl -o after.json",
        "learn --into after.json --actor fork",
    ] {
        let ended = folder.run(command);
        ended.succeeds();
        transcript.add(command, &ended);
    }
    insta::assert_snapshot!(transcript.0);
}

/// One of two drives begins with the dock.
#[test]
fn what_acts_nearly_always_is_named() {
    let folder = yard();
    folder.write(
        "drive.jsonl",
        trace(&[
            ("lift(fork_1,box_1)", "hangs(box_1)"),
            ("turn(fork_1,box_1)", "turned(box_1)"),
            ("turn(dock_1,box_1)", "hangs(box_1)"),
            ("turn(box_1,dock_1)", "on(box_1,dock_1)"),
        ]),
    );
    let learned = folder.run("learn drive.jsonl --types types.json -o m.json");
    learned.succeeds();
    let note = "there is no default actor: fork acts in calls of every name, but turn is done by box at times\n";
    assert!(learned.out.ends_with(note) && learned.err.ends_with("hint: --actor fork says who acts\n"), "{learned}");
}

#[test]
fn a_type_that_does_not_act_is_doubted_and_one_that_takes_no_part_is_refused() {
    let folder = yard();
    let doubted = folder.run("learn lift.jsonl --types types.json --actor box -o m.json");
    doubted.succeeds();
    assert_eq!(
        doubted.err,
        "wrote m.json\n\
         warning: --actor box: who acts is argument 0 of an action, and no box ever was\n\
         hint: Argument 0 of the actions is of type fork.\n"
    );
    let refused = folder.refuses(31, "learn lift.jsonl --types types.json --actor lorry -o m.json");
    assert_eq!(
        refused.err,
        "error: --actor lorry: nothing of that type takes part in any action\n\
         hint: Argument 0 of the actions is of type fork. Or say `none`.\n"
    );
    let acts = folder.run("learn seal.jsonl --types types.json --actor dock -o m.json");
    assert!(!acts.err.contains("warning"), "it does in one action: {acts}");
}

#[test]
fn models_differ_in_who_acts_and_not_in_how_often_it_was_seen() {
    let folder = yard();
    folder.run("learn lift.jsonl --types types.json -o before.json -q").succeeds();
    folder.run("learn --into before.json --actor none -o nobody.json -q").succeeds();
    let ended = folder.run("diff before.json nobody.json");
    // What acts is not in the names of actions.
    let differs = "- before.json\n+ nobody.json\nactor\n  - fork\n  + none\nlift-box / lift-fork-box\n  only the name differs\n\
                   lower-box-dock / lower-fork-box-dock\n  only the name differs\n";
    assert_eq!((ended.code, ended.out.as_str()), (12, differs), "{ended}");
    folder.run("learn --into before.json again.jsonl -o more.json -q").succeeds();
    let ended = folder.run("diff before.json more.json");
    assert_eq!(
        (ended.code, ended.out.as_str()),
        (
            0,
            "- before.json\n+ more.json\nthe same\n\
             learned from\n  - 1 demonstration\n  - 2 transitions\n  + 2 demonstrations\n  + 3 transitions\n"
        ),
        "{ended}"
    );
    let failed = folder
        .read("again.jsonl")
        .replace(r#""args":["fork_1","box_1"]"#, r#""args":["fork_1","box_1"],"executed":false"#)
        .replace("hangs", "stands");
    folder.write("failed.jsonl", failed);
    folder.run("learn --into before.json failed.jsonl -o failed.json -q").succeeds();
    let ended = folder.run("diff before.json failed.json");
    assert!(
        ended.code == 0 && ended.out.contains("  - 0 failures\n") && ended.out.contains("  + 1 failure\n"),
        "{ended}"
    );
}

/// A yard in snapshots, of which the fork's load is left out where it has none.
#[test]
fn what_is_left_out_at_times_is_warned_of_once() {
    let folder = yard();
    let state = |load: &str, seen: bool| {
        format!(
            r#"{{"state":{{"entities":[{{"id":"fork_1","type":"fork","relations":{{{load}}}}},
               {{"id":"box_1","type":"box","attributes":{{"seen":{seen}}}}}]}}}}"#
        )
        .replace('\n', "")
    };
    let action = |name: &str| format!(r#"{{"action":{{"name":"{name}","args":["fork_1","box_1"]}}}}"#);
    let lines = [
        r#"{"format":"trace/1"}"#.to_owned(),
        state("", false),
        action("lift"),
        state(r#""load":"box_1""#, false),
        action("look"),
        state(r#""load":"box_1""#, true),
    ];
    folder.write("load.jsonl", lines.join("\n") + "\n");
    let warning = "warning: the relation `load` of fork_1 is left out in some states, and in others it is there\n";
    for (code, options) in [(0, ""), (0, "--json"), (0, "--dry-run"), (31, "--actor lorry")] {
        let ended = folder.run(&format!("learn load.jsonl --types types.json -o m.json {options}"));
        assert_eq!((ended.code, ended.err.matches(warning).count()), (code, 1), "{options}: {ended}");
    }
}
