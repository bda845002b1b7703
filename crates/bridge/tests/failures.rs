//! Every way in which an environment can fail, and what is said about it.
#![cfg(unix)]

mod common;

use std::io;
use std::time::{Duration, Instant};

use common::{hasty, sh, shop, start};
use typelift_bridge::{BridgeError, Failure, Options};
use typelift_model::GroundCall;
use typelift_world::{Reset, World, WorldError};

fn not_started(command_line: &str) -> BridgeError {
    start(command_line, Options::default()).expect_err("an error")
}

/// What is said if this is the answer to the first request after `hello`.
fn answered(answer: &str) -> String {
    let script = format!("hello; ask; {answer}\nask; sleep 1");
    let error = shop(&script, Options::default()).observe().expect_err("an error").to_string();
    let rest = error.strip_prefix("environment shop: ").expect("the environment");
    rest.replace("\n  sent: {\"id\":2,\"op\":\"observe\"}", "")
}

#[test]
fn command_lines() {
    assert_eq!(
        not_started("python3 'x").to_string(),
        "environment python3 'x: the command line `python3 'x` ends within a quotation"
    );
    assert!(matches!(*not_started("  ").failure, Failure::CommandLine { problem: "names no program", .. }));
}

#[test]
fn programs_that_cannot_be_started() {
    let error = not_started("no-such-program-here --fast");
    assert!(matches!(*error.failure, Failure::NotStarted { kind: io::ErrorKind::NotFound, .. }));
    let text = WorldError::from(error).to_string();
    assert!(text.starts_with("environment no-such-program-here --fast: `no-such-program-here` could not be started: "));
    assert!(text.ends_with("\n  Is `no-such-program-here` installed, and in a folder of the PATH?"), "{text}");
    let hint = |command_line| not_started(command_line).hint().expect("a hint");
    assert!(hint("./no-such-folder/x").starts_with("Is it there, seen from /"));
    assert!(hint("SEED=1 python3 x").contains("`env NAME=VALUE program`"));
    assert!(hint("/").starts_with("Is it executable?"));
}

#[test]
fn no_hello() {
    let short = Options { hello: Duration::from_millis(300), ..Options::default() };
    let silent = start(&sh("ask; sleep 100"), short).expect_err("an error");
    assert!(matches!(*silent.failure, Failure::TimedOut { op: "hello", .. }));
    let failure = |script: &str| *start(&sh(script), Options::default()).expect_err("an error").failure;
    assert!(matches!(failure("echo Hello; ask"), Failure::NotJson { op: "hello", .. }));
    let answer = |fields: &str| failure(&format!("ask; echo \"{{\\\"id\\\":$id,\\\"ok\\\":true{fields}}}\"; sleep 1"));
    assert_eq!(answer(""), Failure::Missing { op: "hello", field: "name" });
    assert_eq!(answer(r#",\"name\":\"x\""#), Failure::Missing { op: "hello", field: "reset" });
    let other = answer(r#",\"name\":\"x\",\"reset\":true,\"protocol\":\"env/2\""#);
    assert_eq!(other, Failure::Protocol("env/2".to_owned()));
    assert_eq!(other.to_string(), "it speaks `env/2`, not `env/1`");
}

#[test]
fn it_died() {
    let error = not_started(&sh("echo 'Traceback:' >&2; echo 'no module named pygame' >&2; exit 3"));
    let text = error.to_string();
    let end = "it ended by itself (exit status: 3) when it was to answer `hello`\n  sent: \
               {\"id\":1,\"op\":\"hello\",\"protocol\":\"env/1\"}";
    assert!(text.ends_with(end), "{text}");
    let mut bridge = shop("hello; ask; kill -9 $$", Options::default());
    let text = bridge.observe().expect_err("dead").to_string();
    assert!(text.contains("it ended by itself (signal: 9 (SIGKILL)) when it was to answer `observe`"), "{text}");
    let again = bridge.observe().expect_err("dead").to_string();
    assert!(again.contains("nothing can be asked of it any more: it ended by itself (signal: 9"), "{again}");
    bridge.close().expect("nothing to close");
}

/// Its child keeps the output open.
#[test]
fn it_died_but_left_a_child() {
    let mut bridge = shop("hello; sleep 100 & ask; exit 4", hasty());
    let text = bridge.observe().expect_err("dead").to_string();
    assert!(text.contains("it ended by itself (exit status: 4)"), "{text}");
}

#[test]
fn it_closed_a_pipe() {
    let text = answered("exec >&-; sleep 100");
    assert_eq!(text, "it closed its output when it was to answer `observe`, and went on running");
    let mut bridge = shop("hello; exec <&-; sleep 100", Options::default());
    std::thread::sleep(Duration::from_millis(100));
    let text = bridge.observe().expect_err("deaf").to_string();
    assert!(text.contains("it closed its input when it was to answer `observe`, and went on running"), "{text}");
}

#[test]
fn it_hangs() {
    let mut bridge = shop("hello; ask; sleep 100", hasty());
    let call = GroundCall { name: "press".into(), args: vec!["x".repeat(400).as_str().into()] };
    let text = bridge.act(&call).expect_err("hangs").to_string();
    let sent = "{\"id\":2,\"op\":\"act\",\"action\":{\"name\":\"press\",\"args\":[\"";
    assert!(text.starts_with(&format!("environment shop: it did not answer `act` within 0.5 s\n  sent: {sent}")));
    assert!(text.ends_with("x… (457 bytes)"), "{text}");
}

#[test]
fn it_does_not_read() {
    let mut bridge = shop("hello; sleep 100", hasty());
    let start = Instant::now();
    let scenario = Some(serde_json::json!("x".repeat(10 << 20)));
    let text = bridge.reset(&Reset { seed: 1, scenario }).expect_err("deaf").to_string();
    assert!(text.contains("it did not answer `reset` within 0.5 s"), "{text}");
    drop(bridge);
    assert!(start.elapsed() < Duration::from_secs(5));
}

#[test]
fn it_answers_nonsense() {
    let json = answered(r"echo 'pygame 2.6, hello from the community'");
    assert_eq!(
        json,
        "it answered `observe` with something that is not JSON (expected value at column 1)\n  came back: pygame 2.6, \
         hello from the community\n  Its standard output is for answers only, one a line; what it wants to tell goes to \
         standard error."
    );
    assert_eq!(
        answered(r#"echo '{"id":2,"state":{}}'"#),
        "its answer to `observe` is malformed: it has no `ok`\n  came back: {\"id\":2,\"state\":{}}"
    );
    assert_eq!(
        answered(r#"echo '{"id":9,"ok":true}'"#),
        "it answered `observe` with id 9 instead of 2\n  came back: {\"id\":9,\"ok\":true}\n  An answer repeats the `id` \
         of its request."
    );
    assert_eq!(
        answered(r#"echo '{"id":2,"ok":true}'"#),
        "its answer to `observe` has no `state`\n  came back: {\"id\":2,\"ok\":true}"
    );
    let scene = answered(r#"echo '{"id":2,"ok":true,"state":{"entities":[{"id":"saw_1"}]}}'"#);
    assert!(scene.starts_with(
        "its answer to `observe` is malformed: in the state, entity saw_1: `type` is missing\n  came back: {\"id\":2"
    ));
}

#[test]
fn it_refuses() {
    assert_eq!(
        answered(r#"echo '{"id":2,"ok":false,"error":"no camera"}'"#),
        "it failed at `observe`: no camera\n  came back: {\"id\":2,\"ok\":false,\"error\":\"no camera\"}"
    );
    assert!(answered(r#"echo '{"id":2,"ok":false}'"#).starts_with("it failed at `observe`: it gave no reason"));
}

#[test]
fn it_sends_an_endless_line() {
    let text = answered(r"tr '\0' x < /dev/zero");
    assert!(text.starts_with("it sent a line that is longer than 64 MB\n  came back: xxx"), "{text}");
}

#[test]
fn one_failure_does_not_end_the_conversation() {
    let script = r#"hello; ask; echo nonsense; ask; echo "{\"id\":$id,\"ok\":false}"
                    ask; echo "{\"id\":$id,\"ok\":true,$state}"; ask"#;
    let mut bridge = shop(script, Options::default());
    bridge.observe().expect_err("nonsense");
    bridge.observe().expect_err("refused");
    bridge.observe().expect("a state");
}
