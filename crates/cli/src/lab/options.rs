//! What the experiments' commands share: where results go, how an experiment is carried out, and in which rooms and
//! within which limits.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use clap::builder::NonEmptyStringValueParser;
use serde::Serialize;
use typelift_lab::{LabError, Limits, RunnerOptions, Stopper};

use super::progress::Bar;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::{Clock, Interrupt};
use crate::quantities::{parse_duration, parse_whole};
use crate::style::WARNING;

/// Where results go.
#[derive(Debug, clap::Args)]
pub(super) struct ResultOptions {
    /// The folder for the results; made if it is not there
    #[arg(long, short, value_name = "DIR", value_parser = NonEmptyStringValueParser::new())]
    output: String,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

impl ResultOptions {
    pub(super) fn folder(&self) -> PathBuf {
        PathBuf::from(&self.output)
    }

    /// Prints a result: as JSON for a program, or with `text` for a person.
    pub(super) fn print(
        &self,
        json: &impl Serialize,
        text: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let mut out = anstream::stdout().lock();
        if !self.json {
            return text(&mut out);
        }
        serde_json::to_writer_pretty(&mut out, json).map_err(std::io::Error::from)?;
        Ok(writeln!(out)?)
    }
}

/// How an experiment is carried out.
#[derive(Debug, clap::Args)]
pub(super) struct ExperimentOptions {
    #[command(flatten)]
    pub(super) results: ResultOptions,
    /// A small part of it, in seconds
    #[arg(long)]
    pub(super) quick: bool,
    /// Begin again, and forget what is finished in the folder
    #[arg(long)]
    fresh: bool,
}

impl ExperimentOptions {
    /// Carries an experiment out, so many runs at once, and tells where its results are.
    pub(super) fn carry_out<R>(
        &self,
        jobs: Option<usize>,
        clock: Clock,
        quiet: bool,
        files: &str,
        experiment: impl FnOnce(&RunnerOptions<'_>) -> Result<R, LabError>,
    ) -> Result<R, Failure> {
        let folder = self.results.folder();
        let result = Supervisor::install(quiet)?.carry_out(&folder, self.fresh, jobs, experiment)?;
        if !quiet {
            let seconds = clock.elapsed().as_secs_f64();
            anstream::eprintln!("wrote {files} to {} in {seconds:.1} s.", folder.display());
        }
        Ok(result)
    }
}

/// The rooms in which tasks are executed, and what a run may spend.
#[derive(Debug, clap::Args)]
pub(super) struct RoomOptions {
    /// Runs at once; as many as there are processors if left out
    #[arg(long, value_name = "N", value_parser = parse_jobs, allow_negative_numbers = true)]
    pub(super) jobs: Option<usize>,
    /// The seed of the room; further runs take the seeds after it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole, allow_negative_numbers = true)]
    pub(super) seed: u64,
    #[command(flatten)]
    pub(super) limits: LimitOptions,
}

/// The rooms of an experiment that runs everything several times.
#[derive(Debug, clap::Args)]
pub(super) struct RepeatedRoomOptions {
    /// Repeat everything N times, each time in another room; 1 with --quick
    #[arg(long, value_name = "N", value_parser = parse_runs, allow_negative_numbers = true)]
    runs: Option<u64>,
    #[command(flatten)]
    pub(super) rooms: RoomOptions,
}

impl RepeatedRoomOptions {
    /// How often everything is run: as the user says, or once where it is to be quick, or by default.
    pub(super) fn runs(&self, quick: bool, default: u64) -> u64 {
        self.runs.unwrap_or(if quick { 1 } else { default })
    }
}

/// What a run may spend.
#[derive(Debug, Clone, Copy, clap::Args)]
#[command(next_help_heading = "Limits")]
pub(super) struct LimitOptions {
    /// Expand at most this many nodes in one search
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_negative_numbers = true)]
    max_expansions: Option<u64>,
    /// Propose at most this many plans for a task
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_negative_numbers = true)]
    max_proposals: Option<u64>,
    /// Give a task up after this time, as a safety net: seconds, or 500ms, 30s, 5m
    #[arg(long, value_name = "TIME", value_parser = parse_duration, allow_negative_numbers = true)]
    time_limit: Option<Duration>,
}

impl LimitOptions {
    /// These limits, and the experiment's own where none is given.
    pub(super) fn or(self, default: Limits) -> Limits {
        Limits {
            max_expansions: self.max_expansions.unwrap_or(default.max_expansions),
            max_proposals: self.max_proposals.unwrap_or(default.max_proposals),
            seconds: self.time_limit.map_or(default.seconds, |limit| limit.as_secs_f64()),
        }
    }
}

fn parse_jobs(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(jobs @ 1..=1024) => Ok(jobs),
        _ => Err("write a whole number from 1 to 1024".to_owned()),
    }
}

/// Reads a number of runs, each in a room of its own.
fn parse_runs(text: &str) -> Result<u64, String> {
    match parse_whole(text)? {
        0 => Err("nothing would be run".to_owned()),
        runs => Ok(runs),
    }
}

/// Shows how far experiments are, and stops them at Ctrl-C.
pub(super) struct Supervisor {
    quiet: bool,
    stopper: Stopper,
}

impl Supervisor {
    /// Catches Ctrl-C from now on, which a program can do once.
    pub(super) fn install(quiet: bool) -> Result<Self, Failure> {
        let interrupt = Interrupt::install()?;
        interrupt.heeded();
        Ok(Self { quiet, stopper: Arc::new(move || interrupt.is_set()) })
    }

    /// Carries out one experiment: so many runs at once, else as many as there are processors.
    pub(super) fn carry_out<R>(
        &self,
        folder: &Path,
        fresh: bool,
        jobs: Option<usize>,
        experiment: impl FnOnce(&RunnerOptions<'_>) -> Result<R, LabError>,
    ) -> Result<R, Failure> {
        let bar = Bar::new(self.quiet);
        let jobs = jobs.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
        let runner = RunnerOptions { folder, fresh, jobs, stopper: Arc::clone(&self.stopper), progress: &bar };
        let result = experiment(&runner);
        bar.finish();
        result.map_err(|error| failure(error, fresh))
    }
}

fn failure(error: LabError, fresh: bool) -> Failure {
    match error {
        LabError::File(error) => error.into(),
        LabError::Stopped { .. } => {
            let how = if fresh { "The same command without --fresh" } else { "The same command" };
            Failure::new(Exit::Interrupted, error).with_hint(format!("{how} goes on from there."))
        }
        LabError::Run { .. } | LabError::Threads(_) => Failure::new(Exit::Internal, error),
    }
}

/// Warns of results that are the limits' rather than the algorithms', unless it is to be `quiet`.
pub(super) fn warn(out_of_time: usize, solved: bool, quiet: bool) {
    if quiet {
        return;
    }
    if out_of_time > 0 {
        let tasks = if out_of_time == 1 { "1 search".to_owned() } else { format!("{out_of_time} searches") };
        anstream::eprintln!(
            "{WARNING}warning{WARNING:#}: --time-limit ended {tasks}: on another machine the result may be another"
        );
    }
    if !solved {
        anstream::eprintln!("{WARNING}warning{WARNING:#}: nothing was solved within these limits");
    }
}
