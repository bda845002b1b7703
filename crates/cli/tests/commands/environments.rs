//! Environments in other programs, and how they fail.
#![cfg(unix)]

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Folder, Transcript, program};

#[test]
fn the_kitchen_as_another_program() {
    let folder = Folder::kitchen();
    let serve = format!("'{} kitchen serve'", env!("CARGO_BIN_EXE_typelift"));
    let inside = folder.run("run kitchen.json K/faults/broken_cutboard_lettuce.json --kitchen --imagine");
    let outside =
        folder.run(&format!("run kitchen.json K/faults/broken_cutboard_lettuce.json --env {serve} --imagine"));
    inside.succeeds();
    assert_eq!(inside.to_string(), outside.to_string());
}

#[test]
fn environments_that_fail() {
    let folder = Folder::kitchen();
    let hello = r#"read x; echo "{\"id\":1,\"ok\":true,\"name\":\"test\",\"reset\":true}""#;
    let fixed = r#"read x; echo "{\"id\":1,\"ok\":true,\"name\":\"test\",\"reset\":false}""#;
    let scripts = [
        ("garbage.sh", "echo garbage; cat".to_owned()),
        ("dies.sh", format!("{hello}; read x; echo on my way out >&2; exit 3")),
        (
            "refuses.sh",
            format!("{hello}; read x; echo '{{\"id\":2,\"ok\":false,\"error\":\"the arm is unplugged\"}}'; cat"),
        ),
        (
            "strange.sh",
            format!(
                "{hello}; read x; echo '{{\"id\":2,\"ok\":true,\"state\":{{\"objects\":{{\"a\":\"robot\"}}}}}}'; cat"
            ),
        ),
        ("silent.sh", "cat >/dev/null".to_owned()),
        ("fixed.sh", format!("{fixed}; cat")),
    ];
    for (name, script) in scripts {
        folder.write(name, script);
    }
    folder.write("events.jsonl", "from an earlier run\n");
    let mut transcript = Transcript::default();
    for (code, options) in [
        (35, "--env no-such-program --events events.jsonl"),
        (35, "--env '\"'"),
        (35, "--env true"),
        (35, "--env 'sh garbage.sh' --events events.jsonl"),
        (35, "--env 'sh dies.sh'"),
        (35, "--env 'sh refuses.sh'"),
        (35, "--env 'sh strange.sh'"),
        (35, "--env 'sh silent.sh' --env-timeout hello=50ms"),
        (35, "--env 'sh silent.sh' --env-timeout observe=1s,hello=70ms,act=1h"),
        (31, "--env 'sh fixed.sh' --restart"),
    ] {
        let command = if options.contains('"') {
            // A quotation that is never closed cannot be written within one.
            "run kitchen.json K/tasks/T1.1.json -q --env \"".to_owned()
        } else {
            format!("run kitchen.json K/tasks/T1.1.json -q {options}")
        };
        let ended = folder.run(&command);
        assert_eq!((ended.code, ended.out.as_str()), (code, ""), "{command}: {ended}");
        transcript.add(options, &ended);
    }
    assert_eq!(folder.read("events.jsonl"), "from an earlier run\n");
    // Whoever reads JSON reads an object for this task as well.
    let ended = folder.run("run kitchen.json K/tasks/T1.1.json -q --json --env 'sh dies.sh'");
    let begins = r#"{"task":"T1.1","solved":false,"ending":"broken_off","why":""#;
    assert!(ended.code == 35 && ended.out.starts_with(begins), "{ended}");
    insta::assert_snapshot!(transcript.0);
}

/// What Ctrl-C does to a program that waits, and how soon.
fn interrupted(folder: &Folder, command: &str) -> (Option<i32>, String) {
    let mut command = program(command);
    command.current_dir(folder.path("")).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the program starts");
    // Held open, so that an answer may come yet.
    let _input = child.stdin.take();
    std::thread::sleep(Duration::from_secs(1));
    let killed = Command::new("kill").arg("-INT").arg(child.id().to_string()).status();
    assert!(killed.expect("there is kill").success());
    let begun = Instant::now();
    let ended = child.wait_with_output().expect("it ends");
    assert!(begun.elapsed() < Duration::from_secs(5), "it took {:?}", begun.elapsed());
    (ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned())
}

#[test]
fn interrupted_before_it_has_said_who_it_is() {
    let folder = Folder::kitchen();
    let ended = interrupted(&folder, "run kitchen.json K/tasks/T1.1.json --env 'sleep 30'");
    assert_eq!(ended, (Some(130), "error: stopped\n".to_owned()));
}

#[test]
fn interrupted_while_somebody_is_asked() {
    let folder = Folder::kitchen();
    let (code, said) = interrupted(&folder, "run kitchen.json K/tasks/T1.1.json --kitchen --confirm=all");
    assert_eq!(code, Some(130), "{said}");
    assert!(said.ends_with("[s]top: no answer: stopped\n"), "{said}");
}
