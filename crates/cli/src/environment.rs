//! Environments in other programs: how they are started, for every command that acts in one.

use std::path::Path;
use std::time::Duration;

use clap::ValueEnum;
use typelift::bridge::{Bridge, Options};
use typelift::world::{TaskFile, WorldError};

use crate::awaited::Awaited;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Interrupt;
use crate::quantities::parse_duration;
use crate::style::WARNING;
use crate::waiting::Waiting;

/// How long to wait for an environment.
#[derive(Debug, Clone, Default, clap::Args)]
pub(crate) struct Timeouts {
    /// Wait so long for an answer: hello (10s), reset (60s), observe (10s), act (300s), close (2s)
    #[arg(long, value_name = "OP=TIME,…", value_delimiter = ',', value_parser = parse_timeout)]
    env_timeout: Vec<(Operation, Duration)>,
}

/// What an environment can be asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Operation {
    Hello,
    Reset,
    Observe,
    Act,
    Close,
}

fn parse_timeout(text: &str) -> Result<(Operation, Duration), String> {
    let (operation, time) = text.split_once('=').ok_or("write for example hello=60s,act=10m")?;
    let operation = Operation::from_str(operation, true)
        .map_err(|_| format!("there is no `{operation}`; there are hello, reset, observe, act and close"))?;
    Ok((operation, parse_duration(time)?))
}

impl Timeouts {
    fn options(&self) -> Options {
        let mut limits = Options::default();
        for &(operation, limit) in &self.env_timeout {
            match operation {
                Operation::Hello => limits.hello = limit,
                Operation::Reset => limits.reset = limit,
                Operation::Observe => limits.observe = limit,
                Operation::Act => limits.act = limit,
                Operation::Close => limits.close = limit,
            }
        }
        limits
    }
}

/// Starts the environment that this command is; what is waited for stands in this line. An interrupt ends it.
pub(crate) fn start(
    command: &str,
    timeouts: &Timeouts,
    interrupt: &Interrupt,
    waiting: Waiting,
) -> Result<Awaited<Bridge>, Failure> {
    let line = waiting.clone();
    let stderr = move |said: &str| line.aside(|| anstream::eprintln!("{said}"));
    let bridge = waiting.during("waiting for hello", || {
        Bridge::spawn_stoppable(command, timeouts.options(), stderr, |stopper| {
            interrupt.on_raised(move || stopper.stop());
        })
    });
    match bridge {
        Ok(bridge) => Ok(Awaited { waiting, world: bridge }),
        Err(_) if interrupt.explains_failure() => Err(Failure::new(Exit::Interrupted, "stopped")),
        Err(error) => Err(WorldError::from(error).into()),
    }
}

/// What of a setup a task, or `--seed`, asks for.
pub(crate) fn wanted_setup(task: &TaskFile, seed: Option<u64>) -> Vec<&'static str> {
    let wanted = [(task.scenario.is_some(), "scenario"), (task.seed.or(seed).is_some(), "seed")];
    wanted.into_iter().filter(|(is_wanted, _)| *is_wanted).map(|(_, what)| what).collect()
}

/// Warns that an environment that cannot be reset does not set up what is wanted.
pub(crate) fn warn_of_no_reset(task: &Path, wanted: &[&str], environment: &str) {
    if wanted.is_empty() {
        return;
    }
    let (task, wanted) = (task.display(), wanted.join(" and "));
    anstream::eprintln!(
        "{WARNING}warning{WARNING:#}: {task}: {environment} cannot be reset: it is taken as it is, whatever {wanted} is asked for"
    );
}
