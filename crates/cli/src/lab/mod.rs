//! `typelift lab`: the paper's experiments, run again, and what is learned along a life.

mod demonstrations;
mod faults;
mod growth;
mod hierarchy;
mod lifelong;
mod options;
mod progress;
mod report;
mod table;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Clock;
use demonstrations::LabDemonstrations;
use faults::LabFaults;
use growth::{LabGrowth, LabMeasure};
use hierarchy::LabHierarchy;
use lifelong::LabLifelong;
use report::LabReport;
use table::LabTable;

/// Run the paper's experiments again, and measure what is learned along a life
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
    Lifelong(LabLifelong),
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
            Command::Lifelong(lifelong) => lifelong.run(clock, quiet),
            Command::Report(report) => report.run(quiet),
            Command::Measure(measure) => measure.run(),
        }
    }
}
