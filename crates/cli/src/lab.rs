//! `typelift lab`: the paper's experiments, run again.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use typelift_lab::{Conduct, LabError, Limits, Progress, Stopper};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::lab_demonstrations::LabDemonstrations;
use crate::lab_faults::LabFaults;
use crate::lab_growth::{LabGrowth, LabMeasure};
use crate::lab_hierarchy::LabHierarchy;
use crate::lab_progress::Bar;
use crate::lab_report::LabReport;
use crate::lab_table::LabTable;
use crate::limits::{Clock, Interrupt};
use crate::quantities::{parse_duration, parse_whole};
use crate::style::WARNING;

/// Run the paper's experiments again, and set ours beside the published numbers
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:
  typelift lab table --quick -o T

A run that is finished is in DIR/runs.jsonl at once and is never repeated: after
Ctrl-C, or anything worse, the same command goes on.

`typelift lab COMMAND --help` tells more.")]
pub(crate) struct Lab {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    Table(LabTable),
    Demonstrations(LabDemonstrations),
    Faults(LabFaults),
    Hierarchy(LabHierarchy),
    Growth(LabGrowth),
    Report(LabReport),
    #[command(hide = true)]
    Measure(LabMeasure),
}

impl Lab {
    pub(crate) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        match &self.command {
            Command::Table(table) => table.run(clock, quiet),
            Command::Demonstrations(demonstrations) => demonstrations.run(clock, quiet),
            Command::Faults(faults) => faults.run(clock, quiet),
            Command::Hierarchy(hierarchy) => hierarchy.run(quiet),
            Command::Growth(growth) => growth.run(clock, quiet),
            Command::Report(report) => report.run(quiet),
            Command::Measure(measure) => measure.run(),
        }
    }
}

/// What every experiment takes.
#[derive(Debug, clap::Args)]
pub(crate) struct LabOptions {
    /// The folder for the results; what is finished there is not repeated
    #[arg(long, short, value_name = "DIR", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    output: String,
    /// Runs at once; as many as there are processors if left out
    #[arg(long, value_name = "N", value_parser = parse_jobs, allow_negative_numbers = true)]
    jobs: Option<usize>,
    /// A small part of it, in seconds
    #[arg(long)]
    pub(crate) quick: bool,
    /// Begin again, and forget what is finished in the folder
    #[arg(long)]
    fresh: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

fn parse_jobs(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(jobs @ 1..=1024) => Ok(jobs),
        _ => Err("write a whole number from 1 to 1024".to_owned()),
    }
}

/// What a run may spend.
#[derive(Debug, Clone, Copy, clap::Args)]
#[command(next_help_heading = "Limits")]
pub(crate) struct LabLimits {
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

impl LabLimits {
    /// These limits, and the experiment's own where none is given.
    pub(crate) fn or(self, default: Limits) -> Limits {
        Limits {
            max_expansions: self.max_expansions.unwrap_or(default.max_expansions),
            max_proposals: self.max_proposals.unwrap_or(default.max_proposals),
            seconds: self.time_limit.map_or(default.seconds, |limit| limit.as_secs_f64()),
        }
    }
}

impl LabOptions {
    /// Carries an experiment out with a progress bar, and tells where its results are.
    pub(crate) fn carry_out<R>(
        &self,
        clock: Clock,
        quiet: bool,
        files: &str,
        experiment: impl FnOnce(&Conduct<'_>) -> Result<R, LabError>,
    ) -> Result<R, Failure> {
        let interrupt = Interrupt::install()?;
        let stopper: Stopper = Arc::new(move || interrupt.is_set());
        let bar = Bar::new(quiet);
        let folder = PathBuf::from(&self.output);
        let processors = || std::thread::available_parallelism().map_or(1, usize::from);
        let jobs = self.jobs.unwrap_or_else(processors);
        let progress: &dyn Progress = &bar;
        let result = experiment(&Conduct { folder: &folder, fresh: self.fresh, jobs, stopper, progress });
        bar.finish();
        let result = result.map_err(|error| self.failure(error))?;
        if !quiet {
            let seconds = clock.elapsed().as_secs_f64();
            anstream::eprintln!("wrote {files} to {} in {seconds:.1} s.", folder.display());
        }
        Ok(result)
    }

    fn failure(&self, error: LabError) -> Failure {
        let text = error.to_string();
        match error {
            LabError::File(error) => error.into(),
            LabError::Stopped { .. } => {
                let how = if self.fresh { "The same command without --fresh" } else { "The same command" };
                Failure::new(Exit::Interrupted, text).with_hint(format!("{how} goes on from there."))
            }
            LabError::Run { .. } | LabError::Threads(_) => Failure::new(Exit::Internal, text),
        }
    }
}

/// Warns of results that are the limits' rather than the algorithms'.
pub(crate) fn warn(out_of_time: usize, solved: bool) {
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
