//! `run --memory` and `plan --memory`: what was seen once is known from then on.

use serde_json::Value;
use typelift::world::source_of_file;

use crate::common::{Ended, Folder};

const APPLE: &str = "K/tasks/T4.1.json";

/// The accounts of a run's tasks; what they measured is left out.
fn accounts(ended: &Ended) -> Vec<Value> {
    ended.out.lines().map(|line| serde_json::from_str(&line.replace(":N", ":0")).expect("JSON")).collect()
}

/// How many of each task's steps were imagined.
fn imagined(ended: &Ended) -> Vec<i64> {
    let steps = |account: &Value| {
        assert_eq!(account["solved"], true, "{ended}");
        account["imagined_steps"].as_i64().expect("a number")
    };
    accounts(ended).iter().map(steps).collect()
}

#[test]
fn nothing_is_imagined_twice() {
    let folder = Folder::kitchen();
    let model = folder.read("kitchen.json");
    let first = folder.run(&format!("run kitchen.json {APPLE} {APPLE} --kitchen --imagine --memory m --json"));
    let found = imagined(&first);
    assert!(found[0] > 0 && found[1] == 0, "{first}");
    assert_eq!(first.err, "began m with 8 demonstrations of kitchen.json\n");
    let again = folder.run(&format!("run {APPLE} --kitchen --memory m --json"));
    assert_eq!((imagined(&again), again.err.as_str()), (vec![0], ""));
    let planned = folder.run(&format!("plan --memory m {APPLE}"));
    planned.succeeds();
    assert!(!planned.out.contains("imagined"), "{planned}");
    assert_eq!(folder.run(&format!("plan kitchen.json {APPLE}")).code, 11, "it was not demonstrated");
    assert_eq!(folder.read("kitchen.json"), model, "the model is never written");
    let names = folder.names();
    assert!(names.iter().all(|name| ["K", "kitchen.json", "m"].contains(&name.as_str())), "{names:?}");
}

#[test]
fn what_failed_in_one_process_is_not_tried_in_the_next() {
    let folder = Folder::kitchen();
    let fault = "K/faults/broken_cutboard_breadslicer_lettuce.json";
    let outcome = |ended: &Ended| {
        let account = accounts(ended).remove(0);
        (account["solved"] == true, account["proposals"].as_i64(), account["failures"].as_array().map(Vec::len))
    };
    let run = || folder.run(&format!("run kitchen.json {fault} --kitchen --imagine --memory m --json"));
    assert_eq!(outcome(&run()), (true, Some(3), Some(2)), "two tools are out of order");
    assert_eq!(outcome(&run()), (true, Some(1), Some(0)));
    // In another place things of these names are other things.
    let elsewhere = folder.run(&format!("run {fault} --kitchen --imagine --memory m --json --instance there --risk 0"));
    assert_ne!(outcome(&elsewhere).2, Some(0), "{elsewhere}");
}

#[test]
fn a_memory_and_a_record_are_the_same() {
    let folder = Folder::kitchen();
    let fault = "K/faults/broken_cutboard_lettuce.json";
    folder.run(&format!("run kitchen.json {fault} --kitchen --imagine --memory m --record R -q")).succeeds();
    let source = source_of_file(&folder.path("R/broken_cutboard_lettuce.jsonl")).expect("a trace").to_string();
    let recorded = folder.run("learn --into kitchen.json R -o both.json");
    recorded.succeeds();
    let began = folder.run(&format!("run both.json {APPLE} --kitchen --imagine --memory other -q"));
    began.succeeds();
    // The model of both files knows the same sources.
    let went_on = folder.run(&format!("run both.json {APPLE} --kitchen --imagine --memory m"));
    assert!(went_on.err.contains("went on with m with 1 demonstration of both.json"), "{went_on}");
    assert!(folder.read("both.json").contains(&source));
}

#[test]
fn problems_in_pddl_are_posed_with_what_was_learned() {
    let folder = Folder::kitchen();
    folder.run(&format!("export kitchen.json {APPLE} -o E -q")).succeeds();
    let problem = folder.run("plan kitchen.json E/problem.pddl --imagine");
    assert_eq!(problem.code, 0, "{problem}");
    folder.run(&format!("run kitchen.json {APPLE} --kitchen --imagine --memory m -q")).succeeds();
    let planned = folder.run("plan --memory m E/problem.pddl");
    planned.succeeds();
    assert!(!planned.out.contains("imagined"), "{planned}");
}

#[test]
fn what_cannot_be_a_memory_is_refused() {
    let folder = Folder::kitchen();
    folder.run(&format!("run kitchen.json {APPLE} --kitchen --imagine --memory m -q")).succeeds();
    folder.write("text", "not a database, but long enough to be looked at as if it were one ".repeat(20));
    folder.write("cut", &std::fs::read(folder.path("m")).expect("a memory")[..20_000]);
    let mut newer = std::fs::read(folder.path("m")).expect("a memory");
    newer[63] = 9;
    folder.write("newer", newer);
    folder.changed("kitchen.json", "other.json", |model| {
        model["types"].as_array_mut().expect("a list").push(serde_json::json!(["spork", "object"]));
    });
    folder.write("domain.pddl", "(define (domain d) (:predicates (on)) (:action press :parameters () :effect (on)))");
    let mut transcript = crate::common::Transcript::default();
    for command in [
        "run K/tasks/T1.1.json --kitchen --memory missing",
        "plan --memory missing K/tasks/T1.1.json",
        "run K/tasks/T1.1.json --kitchen --memory text",
        "run K/tasks/T1.1.json --kitchen --memory K",
        "run kitchen.json K/tasks/T1.1.json --kitchen --memory no/where",
        "run K/tasks/T1.1.json --kitchen --memory newer",
        "run K/tasks/T1.1.json --kitchen --memory cut",
        "run other.json K/tasks/T1.1.json --kitchen --memory m",
        "run kitchen.json K/tasks/T1.1.json --kitchen --memory kitchen.json",
        "run kitchen.json domain.pddl --kitchen --memory m",
    ] {
        transcript.add(command, &folder.refuses(31, command));
    }
    transcript.add("two files", &folder.refuses(36, "plan --memory m kitchen.json K/tasks/T1.1.json"));
    transcript.add("no file", &folder.refuses(36, "run --kitchen --memory m"));
    insta::assert_snapshot!("refused-memories", transcript.0);
}

#[test]
fn what_a_memory_knows_is_told_and_taken_back() {
    let folder = Folder::kitchen();
    let fault = "K/faults/broken_cutboard_lettuce.json";
    folder.run("run kitchen.json K/tasks/T1.1.json --kitchen --memory m -q").succeeds();
    folder.run("memory export m -o before.json -q").succeeds();
    folder.run(&format!("run {fault} --kitchen --imagine --memory m --record R -q")).succeeds();
    insta::assert_snapshot!("memory-log", folder.run("memory log m"));
    let shown = folder.run("memory show m");
    assert!(shown.out.starts_with("8 demonstrations, 2 episodes, 14 steps\n"), "{shown}");
    let checked = folder.run("memory check m");
    assert_eq!((checked.code, checked.out.as_str()), (0, "22 entries can be read\n"), "{checked}");
    let exported = folder.run("memory export m --traces T -o after.json");
    exported.succeeds();
    assert_eq!(exported.err, "wrote 2 traces to T\nwrote after.json\n");
    let name = "broken_cutboard_lettuce.jsonl";
    assert_eq!(folder.read(&format!("T/{name}")), folder.read(&format!("R/{name}")));
    folder.run("learn --into kitchen.json T -o learned.json -q").succeeds();
    assert_eq!(folder.read("after.json"), folder.read("learned.json"), "as if all had been learned at once");
    let forgotten = folder.run(&format!("memory forget m {name}"));
    forgotten.succeeds();
    assert!(forgotten.err.starts_with(&format!("took back {name} (")), "{forgotten}");
    folder.run("memory export m -o forgotten.json -q").succeeds();
    assert_eq!(folder.read("forgotten.json"), folder.read("before.json"), "as if it had never been");
    let again = folder.refuses(31, &format!("memory forget m {name}"));
    assert!(again.err.contains(&format!("{name}: nothing was learned from it")), "{again}");
    folder.refuses(31, "memory export m -o m");
}

#[test]
fn a_damaged_memory_is_told_of() {
    let folder = Folder::kitchen();
    folder.run("run kitchen.json K/tasks/T1.1.json K/tasks/T1.2.json --kitchen --memory m -q").succeeds();
    let mut bytes = std::fs::read(folder.path("m")).expect("a memory");
    let step = b"\"verdict\":\"as-expected\"";
    let at = bytes.windows(step.len()).rposition(|window| window == step).expect("a step");
    bytes[at + step.len() - 3] = b'X';
    folder.write("m", bytes);
    let checked = folder.run("memory check m");
    assert_eq!(checked.code, 12, "{checked}");
    insta::assert_snapshot!("memory-damaged", checked);
}

/// Whatever moment the program is killed at, what it had told of is remembered, and the next run goes on from there.
/// `TYPELIFT_KILLS` says how often to try.
#[cfg(unix)]
#[test]
fn a_killed_run_remembers_every_step_that_it_told_of() {
    use std::process::Stdio;
    use std::thread::sleep;
    use std::time::Instant;

    use typelift_memory::{Access, Memory, MemoryErrorKind, What};

    let folder = Folder::kitchen();
    let kills: u32 = std::env::var("TYPELIFT_KILLS").map_or(6, |number| number.parse().expect("a number"));
    let start = |memory: &str, number: u32| {
        let tasks = (1..=6).map(|task| format!("K/tasks/T{task}.1.json")).collect::<Vec<_>>().join(" ");
        let command = format!("run kitchen.json {tasks} --kitchen --imagine -q --memory {memory} --events E{number}");
        let mut program = crate::common::program(&command);
        program.current_dir(folder.path("")).stdout(Stdio::null()).stderr(Stdio::null());
        program.spawn().expect("the program starts")
    };
    let steps = |memory: &str| match Memory::open(&folder.path(memory), Access::Read) {
        Err(error) if error.kind == MemoryErrorKind::Missing => 0,
        opened => {
            let memory = opened.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(memory.unread(), []);
            let entries = memory.entries().unwrap_or_else(|error| panic!("{error}"));
            entries.iter().filter(|entry| matches!(entry.what, What::Stepped(_))).count()
        }
    };
    let started = Instant::now();
    assert!(start("whole", 0).wait().expect("it ends").success());
    let whole = started.elapsed();
    assert!(steps("whole") > 30);
    for number in 1..=kills {
        // A memory of its own, or one that was left behind by all the kills before.
        let memory = if number % 2 == 0 { "m".to_owned() } else { format!("m{number}") };
        let before = steps(&memory);
        let mut running = start(&memory, number);
        sleep(whole * number / (kills + 1));
        running.kill().expect("killed");
        running.wait().expect("it ends");
        let events = std::fs::read_to_string(folder.path(&format!("E{number}"))).unwrap_or_default();
        let told =
            events.split_inclusive('\n').filter(|line| line.contains(r#""event":"stepped""#) && line.ends_with('\n'));
        let (told, remembered) = (told.count(), steps(&memory) - before);
        assert!(remembered == told || remembered == told + 1, "kill {number}: told of {told}, remembered {remembered}");
        folder.run(&format!("run kitchen.json K/tasks/T1.1.json --kitchen -q --memory {memory}")).succeeds();
        folder.run(&format!("memory check {memory}")).succeeds();
    }
}

#[test]
fn demonstrations_are_learned_into_a_memory() {
    let folder = Folder::kitchen();
    let missing = folder.refuses(36, "learn K/demos --memory m");
    assert!(missing.err.contains("There is no m yet"), "{missing}");
    let first = folder.run("learn K/demos/cut_lettuce.jsonl --types K/types.pddl --memory m");
    first.succeeds();
    assert!(first.err.contains("added 1 demonstration to m\n"), "{first}");
    let dry = folder.run("learn K/demos --memory m --dry-run");
    dry.succeeds();
    assert!(dry.out.contains("13 generalized actions") && !dry.err.contains("added"), "{dry}");
    let others = folder.run("learn K/demos --memory m -o learned.json");
    others.succeeds();
    assert!(others.err.starts_with("wrote learned.json\nadded 7 demonstrations to m\nwarning: "), "{others}");
    assert!(others.err.contains("is in the memory already; it counts once"), "{others}");
    assert_eq!(folder.read("learned.json"), folder.read("kitchen.json"), "as if all had been learned at once");
    folder.run("memory export m -o exported.json -q").succeeds();
    assert_eq!(folder.read("exported.json"), folder.read("kitchen.json"));
    let other = folder.refuses(31, "learn K/demos --memory m --individual");
    assert!(other.err.contains("it was learned with other options"), "{other}");
    // What was taken back and is shown again counts again.
    folder.run("memory forget m cut_lettuce.jsonl -q").succeeds();
    folder.run("learn K/demos/cut_lettuce.jsonl --memory m -q").succeeds();
    assert_eq!(folder.run("diff m kitchen.json").out, "the same\n");
}

#[test]
fn a_memory_stands_where_a_model_stands() {
    let folder = Folder::kitchen();
    folder.run("learn K/demos --types K/types.pddl --memory m -q").succeeds();
    let why = "'USE(agent_1, cutboard_1, coconut_1)'";
    for (of_memory, of_model) in [
        ("show m".to_owned(), "show kitchen.json".to_owned()),
        ("show --memory m --sources".to_owned(), "show kitchen.json --sources".to_owned()),
        (format!("why m {why}"), format!("why kitchen.json {why}")),
        (format!("why --memory m {why}"), format!("why kitchen.json {why}")),
        ("plan m K/tasks/T1.1.json".to_owned(), "plan kitchen.json K/tasks/T1.1.json".to_owned()),
        (
            "run m K/tasks/T1.1.json --kitchen -q".to_owned(),
            "run kitchen.json K/tasks/T1.1.json --kitchen -q".to_owned(),
        ),
    ] {
        let (found, expected) = (folder.run(&of_memory), folder.run(&of_model));
        expected.succeeds();
        assert_eq!((found.out, found.err), (expected.out, expected.err), "{of_memory}");
    }
    let kept = folder.run("run m K/tasks/T1.1.json --kitchen");
    assert!(kept.err.starts_with("hint: nothing of this run is kept; --memory FILE keeps it\n"), "{kept}");
    let mut transcript = crate::common::Transcript::default();
    for command in ["learn --into m K/demos", "run m K/tasks/T1.1.json --kitchen --memory m"] {
        transcript.add(command, &folder.refuses(31, command));
    }
    for command in ["why --memory m", "why --memory m 'USE(a)' --calls calls.jsonl", "show --memory m kitchen.json"] {
        transcript.add(command, &folder.refuses(36, command));
    }
    insta::assert_snapshot!("memories-as-models", transcript.0);
}

#[test]
fn two_memories_become_one() {
    let folder = Folder::kitchen();
    folder.run(&format!("run kitchen.json {APPLE} --kitchen --imagine --memory m -q")).succeeds();
    std::fs::copy(folder.path("m"), folder.path("n")).expect("copied");
    folder.run("run K/tasks/T1.1.json --kitchen --memory m --record R -q").succeeds();
    folder.run("run K/tasks/T2.1.json --kitchen --memory n --record R -q").succeeds();
    folder.run(&format!("run kitchen.json {APPLE} --kitchen --imagine --record R -q")).succeeds();
    let merged = folder.run("memory merge m n -o both");
    merged.succeeds();
    assert_eq!(merged.err, "wrote both with 25 entries, 9 of them in more than one\n");
    folder.run("memory merge n m -o again -q").succeeds();
    folder.run("learn --into kitchen.json R -o learned.json -q").succeeds();
    for memory in ["both", "again"] {
        assert_eq!(folder.run(&format!("memory check {memory}")).out, "25 entries can be read\n");
        folder.run(&format!("memory export {memory} -o {memory}.json -q")).succeeds();
        assert_eq!(folder.read(&format!("{memory}.json")), folder.read("learned.json"), "as if learned from both");
    }
    folder.run("learn K/demos --types K/types.pddl --ignore open --memory other -q").succeeds();
    let mut transcript = crate::common::Transcript::default();
    for command in ["memory merge m other -o new", "memory merge m n -o both", "memory merge m kitchen.json -o new"] {
        transcript.add(command, &folder.refuses(31, command));
    }
    transcript.add("one alone", &folder.refuses(36, "memory merge m -o new"));
    insta::assert_snapshot!("refused-merges", transcript.0);
    assert!(!folder.path("new").exists());
}

#[test]
fn of_a_damaged_memory_is_saved_what_can_be_read() {
    let folder = Folder::kitchen();
    folder.run("run kitchen.json K/tasks/T1.1.json K/tasks/T2.1.json --kitchen --memory m -q").succeeds();
    let whole = std::fs::read(folder.path("m")).expect("a memory");
    let step = b"\"verdict\":\"as-expected\"";
    let at = whole.windows(step.len()).rposition(|window| window == step).expect("a step");
    let mut damaged = whole.clone();
    damaged[at + 1..at + 4].fill(0);
    folder.write("m", &damaged);
    folder.write("cut", &whole[..whole.len() / 2]);
    let mut transcript = crate::common::Transcript::default();
    let commands =
        ["memory rescue m -o saved", "memory log saved", "memory rescue saved -o again", "memory rescue cut -o new"];
    for command in ["memory check m", "memory log m", "memory check cut"].into_iter().chain(commands) {
        transcript.add(command, &folder.run(command));
    }
    let hint = "saves what can be read";
    for command in ["show", "plan --memory", "memory merge m", "run K/tasks/T1.1.json --kitchen --memory"] {
        let end = if command.starts_with("memory") { " -o new" } else { " K/tasks/T1.1.json" };
        let end = if command == "show" { "" } else { end };
        let refused = folder.refuses(31, &format!("{command} cut{end}"));
        assert!(refused.err.contains(hint), "{refused}");
    }
    insta::assert_snapshot!("rescued-memories", transcript.0);
    assert!(std::fs::read(folder.path("m")).expect("a memory") == damaged, "the damaged one stays as it is");
    folder.run("run K/tasks/T1.1.json --kitchen --memory saved -q").succeeds();
}

/// Where a file may grow to 340 KiB and no further: as on a disk that is full.
#[cfg(target_os = "linux")]
#[test]
fn what_was_kept_before_the_disk_was_full_is_there() {
    use std::process::Command;

    let folder = Folder::kitchen();
    folder.run("learn K/demos --types K/types.pddl --memory m -q").succeeds();
    let size = folder.path("m").metadata().expect("a memory").len();
    let mut kept = 0;
    for more in [0, 20, 60] {
        let command = format!(
            "trap '' XFSZ; ulimit -f {}; exec {} run K/tasks/T1.1.json K/tasks/T2.1.json --kitchen --memory m -q",
            size.div_ceil(512) + more,
            env!("CARGO_BIN_EXE_typelift")
        );
        let ended = Command::new("sh").args(["-c", &command]).current_dir(folder.path("")).output().expect("a shell");
        let said = String::from_utf8_lossy(&ended.stderr);
        assert!(matches!(ended.status.code(), Some(0 | 31)), "{said}");
        assert!(ended.status.success() || said.contains("What was kept until then is there."), "{said}");
        let entries = folder.run("memory log m").out.lines().count();
        assert!(entries >= kept, "nothing is lost");
        kept = entries;
        folder.run("memory check m").succeeds();
    }
    folder.run("run K/tasks/T1.1.json --kitchen --memory m -q").succeeds();
    assert!(folder.run("memory log m").out.lines().count() >= kept + 7);
}

#[cfg(unix)]
#[test]
fn a_memory_that_cannot_be_written_can_be_read() {
    use std::fs::set_permissions;
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    use std::os::unix::process::CommandExt;

    let folder = Folder::kitchen();
    folder.run("learn K/demos --types K/types.pddl --memory m -q").succeeds();
    let forbid = |name: &str, mode| set_permissions(folder.path(name), PermissionsExt::from_mode(mode)).expect("set");
    let is_root = folder.path("m").metadata().expect("a memory").uid() == 0;
    let run = |command: &str| {
        let mut program = crate::common::program(command);
        if is_root {
            // Root may write everywhere.
            program.uid(65534);
        }
        let ended = program.current_dir(folder.path("")).output().ok()?;
        Some((ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned()))
    };
    forbid("m", 0o444);
    forbid("", 0o555);
    let read = [
        "show m",
        "plan m K/tasks/T1.1.json",
        "memory log m",
        "memory check m",
        "why m 'USE(agent, cutboard, lettuce)'",
    ];
    for command in read {
        // The program may lie where nobody else may look.
        let Some((code, said)) = run(command) else { return forbid("", 0o755) };
        assert_eq!((code, said.as_str()), (Some(0), ""), "{command}");
    }
    let write = [
        "run K/tasks/T1.1.json --kitchen --memory m",
        "memory forget m cut_lettuce.jsonl",
        "learn K/demos --memory m -q",
    ];
    for command in write {
        let (code, said) = run(command).expect("it ran before");
        assert_eq!(code, Some(31), "{command}: {said}");
        assert!(said.contains("m: it cannot be written to\nhint: Let it be written, or copy it"), "{said}");
    }
    forbid("", 0o755);
}

#[test]
fn what_a_person_said_counts_in_the_next_run() {
    let folder = Folder::kitchen();
    let run = |model: &str, answers: &str| {
        let command = format!("run {model} {APPLE} --kitchen --imagine --memory m --confirm=all --instance here");
        folder.run_with_input(&command, answers)
    };
    let first = run("kitchen.json", "n 3 kind blender_1\nn 2 broken breadslicer_1\nn 2 now\na\ns\n");
    assert_eq!(first.code, 12, "{first}");
    let next = run("", "s\n");
    let proposed = |ended: &Ended, object: &str| ended.err.contains(&format!("PLACE(agent_1, {object}, apple_1)"));
    assert!(!proposed(&next, "blender_1") && !proposed(&next, "breadslicer_1"), "{next}");
    assert!(proposed(&next, "contactgrill_1"), "what was not wanted in one task may be wanted in another: {next}");
    insta::assert_snapshot!("memory-words", folder.run("memory log m"));
    let shown = folder.run("memory show m");
    let said = "8 demonstrations, 0 episodes, 0 steps, 4 words of a person\n\
                a person said no to USE(agent_1, blender_1, apple_1): wrong kind  (entry 3)\n\
                a person said no to PLACE(agent_1, breadslicer_1, apple_1): broken  (entry 5)\n";
    assert!(shown.out.starts_with(said), "{shown}");
    // Elsewhere a thing of that name is another one; a kind is the same.
    let elsewhere = folder
        .run_with_input(&format!("run {APPLE} --kitchen --imagine --memory m --confirm=all --instance there"), "s\n");
    assert!(proposed(&elsewhere, "breadslicer_1") && !proposed(&elsewhere, "blender_1"), "{elsewhere}");
    let taken_back = folder.run("memory forget m --word 3 --word 5");
    assert_eq!((taken_back.code, taken_back.err.as_str()), (0, "took back entry 3\ntook back entry 5\n"));
    assert!(proposed(&run("", "s\n"), "blender_1"), "as if it had never been said");
    for entry in [3, 1, 999] {
        folder.refuses(31, &format!("memory forget m --word {entry}"));
    }
    folder.run("memory check m").succeeds();
    // The model is of what was seen.
    folder.run("memory export m -o m.json -q").succeeds();
    assert_eq!(folder.read("m.json"), folder.read("kitchen.json"));
}

#[test]
fn an_object_is_taken_back_with_what_was_said_of_it() {
    let folder = Folder::kitchen();
    let run = |model: &str, instance: &str, answers: &str| {
        let command = format!("run {model} {APPLE} --kitchen --imagine --memory m --confirm=all --instance {instance}");
        folder.run_with_input(&command, answers)
    };
    run("kitchen.json", "here", "n 3 broken blender_1\ns\n");
    run("", "there", "y\n").succeeds();
    let forgotten = folder.run("memory forget m --object blender_1 --instance here");
    assert_eq!((forgotten.code, forgotten.err.as_str()), (0, "took back blender_1: 0 episodes, 1 word\n"));
    let next = run("", "here", "s\n");
    assert!(next.err.contains("USE(agent_1, blender_1, apple_1)"), "as if nothing had been said of it: {next}");
    let forgotten = folder.run("memory forget m --object blender_1");
    assert_eq!((forgotten.code, forgotten.err.as_str()), (0, "took back blender_1: 1 episode, 0 words\n"));
    folder.run("memory export m -o m.json -q").succeeds();
    assert_eq!(folder.read("m.json"), folder.read("kitchen.json"), "as if it had never been there");
    let refused = folder.refuses(31, "memory forget m --object blender_9");
    assert!(refused.err.contains("nothing was done with blender_9 that is known"), "{refused}");
    let log = folder.run("memory log m");
    assert!(log.out.contains("  entry 3 is taken back with blender_1\n"), "{log}");
    folder.run("memory check m").succeeds();
}
