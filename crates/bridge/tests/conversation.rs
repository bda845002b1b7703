//! Conversations that go well.
#![cfg(unix)]

mod common;

use std::time::{Duration, Instant};

use common::{hasty, sh, shop, start};
use serde_json::json;
use typelift_bridge::Options;
use typelift_model::GroundCall;
use typelift_world::{Reset, Scene, World};

fn press() -> GroundCall {
    GroundCall { name: "press".into(), args: vec!["switch_1".into()] }
}

/// Answers everything, and says on standard error what it was asked.
const GOOD: &str = r#"
hello
while ask; do
  echo "$line" >&2
  case $line in
    *'"op":"act"'*"sw_broken"*) echo "{\"id\":$id,\"ok\":true,\"executed\":false,\"reason\":\"stuck\",$state}" ;;
    *'"op":"close"'*) echo "{\"id\":$id,\"ok\":true}"; exit 0 ;;
    *) echo; echo "{\"id\":$id,\"ok\":true,$state,\"more\":[]}" ;;
  esac
done"#;

#[test]
fn a_conversation() {
    let (bridge, said) = start(&sh(GOOD), Options::default()).expect("started");
    let mut world: Box<dyn World> = Box::new(bridge);
    assert_eq!((world.name().as_str(), world.can_reset()), ("shop", true));
    let reset = Reset { seed: 7, scenario: Some(json!({"broken": ["saw_1"]})) };
    let scene = world.reset(&reset).expect("a state");
    let Scene::Snapshot(snapshot) = &scene else { panic!("a snapshot was sent") };
    assert_eq!(snapshot.entities[0].id.as_str(), "saw_1");
    assert_eq!(world.observe().expect("a state"), scene);
    let acted = world.act(&press()).expect("acted");
    assert_eq!((acted.scene, acted.executed, acted.reason), (scene, true, None));
    let acted = world.act(&GroundCall { name: "press".into(), args: vec!["sw_broken".into()] }).expect("acted");
    assert_eq!((acted.executed, acted.reason.as_deref()), (false, Some("stuck")));
    world.close().expect("closed");
    world.close().expect("closed already");
    assert_eq!(
        world.observe().expect_err("closed").to_string(),
        "environment shop: nothing can be asked of it any more: it was closed"
    );
    drop(world);
    let expected = [
        r#"[shop] {"id":2,"op":"reset","seed":7,"scenario":{"broken":["saw_1"]}}"#,
        r#"[shop] {"id":3,"op":"observe"}"#,
        r#"[shop] {"id":4,"op":"act","action":{"name":"press","args":["switch_1"]}}"#,
        r#"[shop] {"id":5,"op":"act","action":{"name":"press","args":["sw_broken"]}}"#,
        r#"[shop] {"id":6,"op":"close"}"#,
    ];
    assert_eq!(said.iter().collect::<Vec<_>>(), expected);
}

#[test]
fn standard_error_is_passed_on_with_a_name() {
    let script = "echo starting >&2; hello; ask; echo again >&2; printf 'no end of line' >&2; sleep 5";
    let (mut bridge, said) = start(&sh(script), hasty()).expect("started");
    let error = bridge.observe().expect_err("silent").to_string();
    assert!(!error.contains("starting"), "it was told as it came: {error}");
    drop(bridge);
    // Whether its first line is read before its name was is a matter of chance.
    let said: Vec<String> = said.iter().map(|line| line.replace("[sh] ", "[shop] ")).collect();
    assert_eq!(said, ["[shop] starting", "[shop] again", "[shop] no end of line"]);
}

#[test]
fn an_answer_that_comes_too_late_is_skipped() {
    let script = r#"hello; ask; old=$id; ask
        echo "{\"id\":$old,\"ok\":true}"; echo "{\"id\":$id,\"ok\":true,$state}"; ask"#;
    let mut bridge = shop(script, Options { observe: Options::default().observe, ..hasty() });
    let error = bridge.act(&press()).expect_err("late").to_string();
    assert!(error.starts_with("environment shop: it did not answer `act` within 0.5 s\n  sent: {\"id\":2"), "{error}");
    bridge.observe().expect("the answer to the second request");
}

#[test]
fn a_malformed_answer_that_comes_too_late_is_skipped() {
    let script = r#"hello; ask; old=$id; ask
        echo "{\"id\":$old,\"ok\":true,\"state\":{}}"; echo "{\"id\":$id,\"ok\":true,$state}"; ask"#;
    let mut bridge = shop(script, Options { observe: Options::default().observe, ..hasty() });
    bridge.act(&press()).expect_err("late");
    bridge.observe().expect("the answer to the second request");
}

#[test]
fn an_environment_that_cannot_be_reset() {
    let mut bridge = shop(
        r#"ask; echo "{\"id\":$id,\"ok\":true,\"name\":\"arm\",\"reset\":false}"
           ask; echo "{\"id\":$id,\"ok\":true,$state}"; ask"#,
        Options::default(),
    );
    assert!(!bridge.can_reset());
    let error = bridge.reset(&Reset::default()).expect_err("no reset");
    assert_eq!(error.to_string(), "environment arm: it said that it cannot be reset");
    bridge.observe().expect("a state");
}

#[test]
fn an_environment_that_ends_at_close_without_a_word() {
    let mut bridge = shop("hello; ask", Options::default());
    bridge.close().expect("closed");
}

#[test]
fn an_environment_that_stays_after_close_is_killed() {
    let script = r#"hello; ask; echo "{\"id\":$id,\"ok\":true}"; sleep 100"#;
    let mut bridge = shop(script, hasty());
    let start = Instant::now();
    bridge.close().expect("closed");
    assert!(start.elapsed() < Duration::from_secs(5));
}

/// A pipe holds 64 KB or so: a large request must not keep us waiting, nor a large answer the child.
#[test]
fn large_messages() {
    let script = r#"hello; ask; echo "${#line}" >&2
        filler=$(head -c 300000 /dev/zero | tr '\0' ' '); echo "{\"id\":$id,$filler\"ok\":true,$state}"; ask"#;
    let (mut bridge, said) = start(&sh(script), Options::default()).expect("started");
    let scenario = Some(json!("x".repeat(300_000)));
    bridge.reset(&Reset { seed: 1, scenario }).expect("a state");
    drop(bridge);
    assert_eq!(said.iter().collect::<Vec<_>>(), ["[shop] 300044"]);
}
