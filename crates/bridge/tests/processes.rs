//! No process outlives its bridge.
#![cfg(unix)]

mod common;

use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use common::{assert_gone, is_alive, sh, start};
use typelift_bridge::{Bridge, Options};
use typelift_world::World;

/// A shell that started another shell that started a third process; their ids.
fn family(rest: &str) -> (Bridge, [String; 3], Receiver<String>) {
    prepared_family(":", rest)
}

/// The same; the shell first runs `before`.
fn prepared_family(before: &str, rest: &str) -> (Bridge, [String; 3], Receiver<String>) {
    let script = format!("{before}; echo $$ >&2; sh -c 'sleep 1000 & echo $$ $! >&2; wait' & hello; {rest}");
    let (bridge, said) = start(&sh(&script), Options::default()).expect("started");
    let mut pids: Vec<String> = Vec::new();
    while pids.len() < 3 {
        let line = said.recv_timeout(Duration::from_secs(5)).expect("process ids");
        let (_, numbers) = line.split_once("] ").expect("a prefix");
        pids.extend(numbers.split(' ').map(str::to_owned));
    }
    let pids: [String; 3] = pids.try_into().expect("three");
    assert!(pids.iter().all(|pid| is_alive(pid)));
    (bridge, pids, said)
}

#[test]
fn dropping_ends_the_whole_family() {
    let (bridge, pids, _) = family("ask");
    drop(bridge);
    pids.iter().for_each(|pid| assert_gone(pid));
}

#[test]
fn even_one_that_does_not_want_to_go() {
    let (bridge, pids, _) = prepared_family("trap '' TERM INT HUP", "while :; do sleep 1; done");
    let start = Instant::now();
    drop(bridge);
    pids.iter().for_each(|pid| assert_gone(pid));
    assert!(start.elapsed() < Duration::from_secs(5));
}

#[test]
fn one_that_wants_to_go_orderly_may() {
    let (bridge, pids, said) = prepared_family("trap 'echo parked >&2; exit 0' TERM", "while :; do sleep 0.05; done");
    drop(bridge);
    pids.iter().for_each(|pid| assert_gone(pid));
    assert!(said.iter().any(|line| line == "[shop] parked"));
}

#[test]
fn closing_ends_the_whole_family() {
    let (mut bridge, pids, _) = family(r#"ask; echo "{\"id\":$id,\"ok\":true}"; exit 0"#);
    bridge.close().expect("closed");
    pids.iter().for_each(|pid| assert_gone(pid));
}

#[test]
fn a_failure_ends_the_whole_family() {
    let (mut bridge, pids, _) = family("ask; exit 1");
    bridge.observe().expect_err("dead");
    pids.iter().for_each(|pid| assert_gone(pid));
    drop(bridge);
}

#[test]
fn a_program_that_is_no_environment_is_ended_too() {
    let (lines, said) = std::sync::mpsc::channel();
    let sink = move |line: &str| lines.send(line.to_owned()).expect("received");
    let script = sh("echo $$ >&2; ask; echo nonsense; sleep 1000");
    Bridge::spawn(&script, Options::default(), sink).expect_err("no environment");
    let line = said.recv().expect("a process id");
    assert_gone(line.trim_start_matches("[sh] "));
}

#[test]
fn another_thread_can_stop_it() {
    let (mut bridge, pids, _) = family("ask; sleep 1000");
    let stopper = bridge.stopper();
    let stopping = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_millis(50));
        stopper.stop();
    });
    let error = bridge.observe().expect_err("stopped").to_string();
    assert!(error.contains("nothing can be asked of it any more: it was stopped"), "{error}");
    stopping.join().expect("stopped");
    pids.iter().for_each(|pid| assert_gone(pid));
}
