//! A child process and everything that it started.
//!
//! The child leads a process group of its own, so that one signal reaches it and its children: wrappers such as
//! `uv run` or `sh -c` start the actual program as a child of theirs. The group keeps its number as long as the child
//! has not been reaped; therefore whether it ended is asked without reaping, and the group is always signalled first.

use std::io;
use std::process::{Child, Command, ExitStatus};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How long a killed child may take to vanish. Only a process stuck in the kernel needs any of it.
const REAPING: Duration = Duration::from_secs(2);

/// The longest pause between two looks at a child.
const PAUSE: Duration = Duration::from_millis(10);

#[derive(Debug)]
pub(crate) struct Process {
    child: Mutex<Reaped>,
    stopped: AtomicBool,
}

#[derive(Debug)]
struct Reaped {
    child: Child,
    reaped: bool,
    status: Option<ExitStatus>,
}

impl Process {
    /// Starts the command as the leader of a new group.
    pub(crate) fn start(command: &mut Command) -> io::Result<(Self, Pipes)> {
        let mut child = spawn(command)?;
        let missing = || io::Error::other("a pipe is missing");
        let pipes = Pipes {
            stdin: child.stdin.take().ok_or_else(missing)?,
            stdout: child.stdout.take().ok_or_else(missing)?,
            stderr: child.stderr.take().ok_or_else(missing)?,
        };
        Ok((Self::of(child), pipes))
    }

    /// Starts a command whose input and output are no pipes.
    pub(crate) fn start_alone(command: &mut Command) -> io::Result<Self> {
        spawn(command).map(Self::of)
    }

    fn of(child: Child) -> Self {
        let child = Mutex::new(Reaped { child, reaped: false, status: None });
        Self { child, stopped: AtomicBool::new(false) }
    }

    fn lock(&self) -> MutexGuard<'_, Reaped> {
        self.child.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether somebody asked to stop it.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::SeqCst)
    }

    /// Notes that it is stopped on purpose, and ends it.
    pub(crate) fn stop(&self, grace: Duration) {
        self.stopped.store(true, Ordering::SeqCst);
        self.end(grace);
    }

    /// Waits until the child has ended, at most so long; whether it has.
    pub(crate) fn wait(&self, limit: Duration) -> bool {
        wait_until(limit, || self.lock().has_ended())
    }

    /// Ends the child and its group: asks them to end if there is a grace period, then kills what is left, and reaps
    /// the child. Its exit status, if it could be had.
    pub(crate) fn end(&self, grace: Duration) -> Option<ExitStatus> {
        if !grace.is_zero() && !self.lock().has_ended() {
            self.lock().signal(false);
            self.wait(grace);
        }
        let mut child = self.lock();
        if !child.reaped {
            child.signal(true);
            wait_until(REAPING, || child.reap());
            child.reaped = true;
        }
        child.status
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.end(Duration::ZERO);
    }
}

fn spawn(command: &mut Command) -> io::Result<Child> {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    command.spawn()
}

fn wait_until(limit: Duration, mut done: impl FnMut() -> bool) -> bool {
    let start = Instant::now();
    let mut pause = Duration::from_micros(200);
    loop {
        if done() {
            return true;
        }
        let left = limit.saturating_sub(start.elapsed());
        if left.is_zero() {
            return false;
        }
        thread::sleep(pause.min(left));
        pause = (pause * 2).min(PAUSE);
    }
}

impl Reaped {
    /// Takes note of the child's end; whether it has ended.
    fn reap(&mut self) -> bool {
        match self.child.try_wait() {
            Ok(None) => false,
            Ok(status) => {
                self.status = status;
                true
            }
            Err(_) => true,
        }
    }

    #[cfg(unix)]
    fn has_ended(&mut self) -> bool {
        use rustix::process::{WaitId, WaitIdOptions, waitid};
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        self.reaped || self.pid().is_none_or(|pid| !matches!(waitid(WaitId::Pid(pid), options), Ok(None)))
    }

    #[cfg(unix)]
    fn signal(&mut self, kill: bool) {
        use rustix::process::{Signal, kill_process_group};
        let signal = if kill { Signal::KILL } else { Signal::TERM };
        if let Some(pid) = self.pid().filter(|_| !self.reaped) {
            // It fails if no process is left in the group, which is what is wanted.
            let _ = kill_process_group(pid, signal);
        }
    }

    #[cfg(unix)]
    fn pid(&self) -> Option<rustix::process::Pid> {
        i32::try_from(self.child.id()).ok().and_then(rustix::process::Pid::from_raw)
    }

    #[cfg(not(unix))]
    fn has_ended(&mut self) -> bool {
        self.reaped || self.reap()
    }

    #[cfg(not(unix))]
    fn signal(&mut self, kill: bool) {
        if kill && !self.reaped {
            let _ = self.child.kill();
        }
    }
}

/// The parent's ends of a child's pipes.
#[derive(Debug)]
pub(crate) struct Pipes {
    pub(crate) stdin: std::process::ChildStdin,
    pub(crate) stdout: std::process::ChildStdout,
    pub(crate) stderr: std::process::ChildStderr,
}
