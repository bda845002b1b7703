//! Environments as shell scripts, so that the tests need no other language.
#![allow(dead_code, unreachable_pub)] // Each test file uses some of it.

use std::path::Path;
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

use typelift_bridge::{Bridge, BridgeError, Options};

/// `ask` reads a request: `$line` is what was asked, `$id` its id. `hello` answers as an environment named `shop`.
const PRELUDE: &str = r#"
ask() { IFS= read -r line || exit 0; id=${line#*'"id":'}; id=${id%%[,\}]*}; }
hello() { ask; echo "{\"id\":$id,\"ok\":true,\"name\":\"shop\",\"reset\":true}"; }
state='"state":{"entities":[{"id":"saw_1","type":"saw","attributes":{"on":true}}]}'
"#;

/// The command line that runs a script after the prelude.
pub fn sh(script: &str) -> String {
    let script = format!("{PRELUDE}\n{script}");
    format!("sh -c {}", shlex::try_quote(&script).expect("no zero bytes"))
}

/// Short times, for tests that wait for their end.
pub fn hasty() -> Options {
    let short = Duration::from_millis(500);
    Options { reset: short, observe: short, act: short, close: short, ..Options::default() }
}

/// An environment, and the lines of its standard error.
pub fn start(command_line: &str, options: Options) -> Result<(Bridge, Receiver<String>), BridgeError> {
    let (lines, heard) = mpsc::channel();
    let sink = move |line: &str| {
        let _ = lines.send(line.to_owned());
    };
    Ok((Bridge::spawn(command_line, options, sink)?, heard))
}

/// An environment run by a script.
pub fn shop(script: &str, options: Options) -> Bridge {
    start(&sh(script), options).expect("started").0
}

/// Waits until a process is gone. A zombie, which waits for whoever adopted it, is.
pub fn assert_gone(pid: &str) {
    let start = Instant::now();
    while is_alive(pid) {
        assert!(start.elapsed() < Duration::from_secs(5), "process {pid} is still there");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Whether a process is there.
pub fn is_alive(pid: &str) -> bool {
    if Path::new("/proc/self/stat").exists() {
        let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
        return stat.rsplit_once(") ").is_some_and(|(_, rest)| !rest.starts_with('Z'));
    }
    let pid = pid.parse().ok().and_then(rustix::process::Pid::from_raw).expect("a process id");
    rustix::process::test_kill_process(pid).is_ok()
}
