//! `typelift lab faults`.

use std::collections::BTreeSet;
use std::io::Write;

use typelift_lab::{FaultRow, FaultsOptions, FaultsResult, faults_experiment};

use super::options::{ExperimentOptions, RepeatedRoomOptions, warn};
use crate::columns::Columns;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Clock;
use crate::style::{BAD, DIM, GOOD, HEAD, wrapped};

/// Broken tools and exceptions to what was learned, with restart and without
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift lab faults -o F
  typelift lab faults --quick -o Q

Every tool broken in turn, and every pair; food that not every tool cuts; a
chopped carrot in the blender. Each is a task and a later one that knows what
failed in the first. Writes faults.csv, faults.json and faults.md.

Limits, unless told otherwise: 200,000 expansions a search, 12 proposals and
120 s a task.")]
pub(super) struct LabFaults {
    #[command(flatten)]
    experiment: ExperimentOptions,
    #[command(flatten)]
    repeated: RepeatedRoomOptions,
}

impl LabFaults {
    pub(super) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let default = FaultsOptions::default();
        let quick = self.experiment.quick;
        let options = FaultsOptions {
            runs: self.repeated.runs(quick, default.runs),
            seed: self.repeated.rooms.seed,
            limits: self.repeated.rooms.limits.or(default.limits),
            quick,
        };
        let files = "faults.csv, faults.json and faults.md";
        let result = self
            .experiment
            .carry_out(self.repeated.rooms.jobs, clock, quiet, files, |runner| faults_experiment(&options, runner))?;
        self.experiment.results.print(&result.json(), |out| print(out, &result))?;
        let outcomes = || result.records.values().flat_map(|record| [&record.first, &record.later]);
        let out_of_time = outcomes().filter(|outcome| typelift_lab::is_out_of_time(&outcome.ending)).count();
        warn(out_of_time, outcomes().any(typelift_lab::Outcome::solved), quiet);
        Ok(Exit::Success)
    }
}

fn print(out: &mut dyn Write, result: &FaultsResult) -> Result<(), Failure> {
    let FaultsOptions { runs, seed, limits, .. } = result.options;
    let legend = format!(
        "Runs solved, and plans proposed; the same of a later task that knows what failed; known mistakes repeated in \
         it. Runs of each scenario: {runs}, rooms from seed {seed} on; {limits}."
    );
    writeln!(
        out,
        "{}
",
        wrapped(legend.split(' '), 0, 78)
    )?;
    let rows = result.rows();
    let mut columns = Columns::with_right(&[2, 3, 4, 5, 6]);
    let head = ["scenario", "restart", "solved", "#p", "later", "#p", "repeated"];
    columns.styled(head.map(|text| (text.to_owned(), HEAD)));
    for row in &rows {
        let name = if row.restart { row.scenario.name.clone() } else { String::new() };
        let restart = if row.restart { "yes" } else { "no" };
        let solved = format!("{}/{}", row.solved(), row.records.len());
        let later = format!("{}/{}", row.later_solved(), row.records.len());
        let plain = anstyle::Style::new();
        columns.styled([
            (name, HEAD),
            (restart.to_owned(), plain),
            (solved, if row.solved() > 0 { GOOD } else { DIM }),
            (row.proposals().to_string(), plain),
            (later, plain),
            (row.later_proposals().to_string(), plain),
            (row.repeated().to_string(), if row.repeated() > 0 { BAD } else { plain }),
        ]);
    }
    write!(out, "{}", columns.text(0))?;
    writeln!(out, "\n{HEAD}Excluded, and imagined{HEAD:#} (with restart)")?;
    for row in rows.iter().filter(|row| row.restart && !row.excluded().is_empty()) {
        writeln!(out, "  {}", story(row))?;
    }
    writeln!(out, "\n{HEAD}{}{HEAD:#}", wrapped(result.summary().split(' '), 0, 78))?;
    Ok(())
}

/// `coconut: without cutboard_1; imagined USE-machete-food`.
fn story(row: &FaultRow<'_>) -> String {
    let joined = |words: BTreeSet<&str>| words.into_iter().collect::<Vec<_>>().join(", ");
    let mut text = format!("{}: without {}", row.scenario.name, joined(row.excluded()));
    if !row.imagined().is_empty() {
        text += &format!("; imagined {}", joined(row.imagined()));
    }
    if let Some(why) = row.why() {
        text += &format!("; then {why}");
    }
    wrapped(text.split(' '), 4, 78)
}
