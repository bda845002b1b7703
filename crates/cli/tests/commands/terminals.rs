//! What stands on a terminal while something takes its time.
#![cfg(target_os = "linux")]

use std::fs::{File, OpenOptions};
use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

use crate::common::{Folder, program};

/// A program whose standard error is a terminal.
struct OnTerminal {
    child: Child,
    shown: String,
    more: Receiver<String>,
}

impl OnTerminal {
    fn start(folder: &Folder, command: &str) -> Self {
        let ours = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
        grantpt(&ours).expect("granted");
        unlockpt(&ours).expect("unlocked");
        let name = ptsname(&ours, Vec::new()).expect("a name").into_string().expect("in ASCII");
        let theirs = OpenOptions::new().read(true).write(true).open(name).expect("its other side");
        let mut command = program(command);
        command.current_dir(folder.path("")).stdout(Stdio::piped()).stderr(theirs).env("TERM", "xterm");
        let child = command.spawn().expect("the program starts");
        let (sender, more) = channel();
        thread::spawn(move || {
            let mut ours = File::from(ours);
            let mut bytes = [0; 1024];
            // Once the program has ended, reading fails.
            while let Ok(read @ 1..) = ours.read(&mut bytes) {
                if sender.send(String::from_utf8_lossy(&bytes[..read]).into_owned()).is_err() {
                    break;
                }
            }
        });
        Self { child, shown: String::new(), more }
    }

    /// Waits until this is shown, and forgets what was until then.
    #[track_caller]
    fn shows(&mut self, text: &str) {
        let begun = Instant::now();
        while !self.shown.contains(text) {
            let left = Duration::from_secs(30).saturating_sub(begun.elapsed());
            match self.more.recv_timeout(left) {
                Ok(more) => self.shown.push_str(&more),
                Err(_) => panic!("`{text}` is not shown, but {:?}", self.shown),
            }
        }
        let end = self.shown.find(text).expect("shown") + text.len();
        self.shown.drain(..end);
    }

    fn interrupt(&self) {
        let killed = Command::new("kill").arg("-INT").arg(self.child.id().to_string()).status();
        assert!(killed.expect("there is kill").success());
    }

    /// How it ended, and what it printed.
    fn ended(self) -> (Option<i32>, String) {
        let output = self.child.wait_with_output().expect("it ends");
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    }
}

/// A lamp that takes its time for the requests that begin so, talks meanwhile, and is switched on.
fn lamp(folder: &Folder, slow: &str, seconds: &str) {
    folder.write("types.json", r#"{"lamp":"object","robot":"object"}"#);
    let state = |lit: bool| {
        format!(
            r#"{{"entities":[{{"id":"lamp_1","type":"lamp","attributes":{{"lit":{lit}}}}},{{"id":"robot_1","type":"robot"}}]}}"#
        )
    };
    folder.write("off.json", state(false));
    folder.write("on.json", state(true));
    folder.write(
        "lamp.jsonl",
        format!(
            "{{\"format\":\"trace/1\"}}\n{{\"state\":{}}}\n{{\"action\":{{\"name\":\"light\",\"args\":[\"robot_1\",\"lamp_1\"]}}}}\n{{\"state\":{}}}\n",
            state(false),
            state(true)
        ),
    );
    folder.write("task.json", r#"{"format":"task/1","goal":["lit(lamp_1)"]}"#);
    folder.write(
        "lamp.sh",
        format!(
            r#"n=0; state=off.json
while read -r request; do
  case "$request" in *'"op":"reset"'*) state=off.json;; esac
  n=$((n+1))
  case "$request" in *'"op":"{slow}'*) sleep {seconds}; echo "the {slow} was slow" >&2; sleep {seconds};; esac
  case "$request" in *'"op":"act"'*) state=on.json;; esac
  case "$request" in
    *'"hello"'*) echo "{{\"id\":$n,\"ok\":true,\"name\":\"lamp\",\"reset\":true}}";;
    *'"close"'*) echo "{{\"id\":$n,\"ok\":true}}";;
    *) echo "{{\"id\":$n,\"ok\":true,\"executed\":true,\"state\":$(cat $state)}}";;
  esac
done
"#
        ),
    );
    folder.run("learn lamp.jsonl --types types.json -o model.json -q").succeeds();
}

#[test]
fn a_step_that_takes_its_time_is_spoken_of_and_what_the_environment_says_stands_above() {
    let folder = Folder::new();
    lamp(&folder, "act", "1.5");
    let mut run = OnTerminal::start(&folder, "run model.json task.json --env 'sh lamp.sh'");
    run.shows("waiting for light(robot_1, lamp_1) … 1 s");
    run.shows("the act was slow");
    run.shows("waiting for light(robot_1, lamp_1) … 2 s");
    run.shows("light(robot_1, lamp_1)");
    let (code, out) = run.ended();
    assert_eq!(code, Some(0), "{out}");
}

/// A program reads standard output; a person still waits at the terminal.
#[test]
fn what_takes_its_time_is_spoken_of_with_json_too() {
    let folder = Folder::new();
    lamp(&folder, "act", "1.5");
    folder.write("state.json", r#"{"format":"task/1","goal":["lit(lamp_1)"],"state":{"entities":[{"id":"lamp_1","type":"lamp"},{"id":"robot_1","type":"robot"}]}}"#);
    folder.write("slow.sh", "sleep 2");
    let fifo = Command::new("mkfifo").arg(folder.path("slow.jsonl")).status();
    assert!(fifo.expect("there is mkfifo").success());
    for (command, spoken) in [
        ("run model.json task.json --env 'sh lamp.sh' --json", "waiting for light(robot_1, lamp_1) … 1 s"),
        ("plan model.json state.json --planner 'sh ./slow.sh {domain} {problem} {plan}' --json", "planning … 1 s"),
        ("learn lamp.jsonl slow.jsonl --types types.json --dry-run --json", "reading trace 2 of 2 … 1 s"),
    ] {
        let mut shown = OnTerminal::start(&folder, command);
        shown.shows(spoken);
        if command.starts_with("learn") {
            std::fs::copy(folder.path("lamp.jsonl"), folder.path("slow.jsonl")).expect("written");
        }
        let (_, out) = shown.ended();
        // This planner finds nothing.
        assert!(out.is_empty() == command.starts_with("plan"), "{command}: {out}");
        assert!(out.is_empty() || serde_json::from_str::<serde_json::Value>(&out).is_ok(), "{command}: {out}");
    }
}

#[test]
fn an_environment_that_does_not_say_hello_is_waited_for() {
    let folder = Folder::new();
    lamp(&folder, "hello", "30");
    let mut run = OnTerminal::start(&folder, "run model.json task.json --env 'sh lamp.sh'");
    run.shows("waiting for hello … 1 s");
    run.interrupt();
    assert_eq!(run.ended(), (Some(130), String::new()));
}

/// Each request takes less than is worth a word; all of them do not.
#[test]
fn trying_an_environment_is_spoken_of_as_one_thing() {
    let folder = Folder::new();
    lamp(&folder, "", "0.2");
    let mut check = OnTerminal::start(&folder, "check-env 'sh lamp.sh' --act 'light(robot_1, lamp_1)'");
    check.shows("waiting for ");
    check.shows("waiting for observe … 0 s");
    check.shows("waiting for light(robot_1, lamp_1) … 0 s");
    let (code, out) = check.ended();
    assert!(code == Some(0) && out.contains("light(robot_1, lamp_1)  +lit(lamp_1)\n"), "{out}");
}

#[test]
fn an_interrupted_trial_says_what_was_found_so_far() {
    let folder = Folder::new();
    lamp(&folder, "act", "30");
    for option in ["", "--json"] {
        let command = format!("check-env 'sh lamp.sh' {option} --act 'light(robot_2, lamp_1)'");
        let mut check = OnTerminal::start(&folder, &command);
        check.shows("waiting for light(robot_2, lamp_1) … 1 s");
        check.interrupt();
        let (code, out) = check.ended();
        assert_eq!(code, Some(130), "{out}");
        if option.is_empty() {
            assert_eq!(
                out,
                "lamp: can be reset; 2 entities, 2 types, 0 predicates\n\
                 may hurt  light(robot_2, lamp_1): there is no entity `robot_2`\n  Did you mean `robot_1`?\n\
                 broken off  at light(robot_2, lamp_1): it was not answered\n\
                 1 thing may hurt learning, unless it is intended\n"
            );
        } else {
            assert!(out.contains(r#""broken_off":"light(robot_2, lamp_1)""#), "{out}");
        }
    }
}

#[test]
fn what_is_done_at_once_is_not_spoken_of() {
    let folder = Folder::new();
    lamp(&folder, "nothing", "30");
    let run = OnTerminal::start(&folder, "check-env 'sh lamp.sh'");
    let more = run.more;
    let ended = run.child.wait_with_output().expect("it ends");
    let shown: String = more.iter().collect();
    assert!(ended.status.success() && !shown.contains("waiting"), "{shown}");
}
