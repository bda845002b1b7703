//! `typelift lab table`.

use std::io::Write;

use typelift_lab::{Cell, Comparison, TableOptions, TableResult, Variant, published, table};

use super::options::{ExperimentOptions, RepeatedRoomOptions, warn};
use crate::columns::Columns;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Clock;
use crate::style::{BAD, DIM, GOOD, HEAD, wrapped};

/// Table I: 24 tasks, four variants, ours beside the paper's
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift lab table -o T
  typelift lab table --quick -o Q

Writes table.csv, table.json and table.md. Planning times are the only thing in
them that differs from run to run; --no-times leaves them out.

Limits, unless told otherwise: 200,000 expansions a search, 12 proposals and
120 s a task.")]
pub(super) struct LabTable {
    #[command(flatten)]
    experiment: ExperimentOptions,
    /// Do not measure planning times
    #[arg(long)]
    no_times: bool,
    #[command(flatten)]
    repeated: RepeatedRoomOptions,
}

impl LabTable {
    pub(super) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let default = TableOptions::default();
        let quick = self.experiment.quick;
        let options = TableOptions {
            runs: self.repeated.runs(quick, default.runs),
            seed: self.repeated.rooms.seed,
            limits: self.repeated.rooms.limits.or(default.limits),
            times: !self.no_times,
            quick,
        };
        let files = "table.csv, table.json and table.md";
        let result = self
            .experiment
            .carry_out(self.repeated.rooms.jobs, clock, quiet, files, |runner| table(&options, runner))?;
        self.experiment.results.print(&result.json(), |out| print(out, &result))?;
        let out_of_time = result.cells.iter().map(|cell| cell.out_of_time).sum();
        warn(out_of_time, result.cells.iter().any(|cell| cell.solved > 0), quiet);
        Ok(Exit::Success)
    }
}

fn print(out: &mut dyn Write, result: &TableResult) -> Result<(), Failure> {
    let TableOptions { runs, seed, limits, times, .. } = result.options;
    let time = if times { ", mean planning time" } else { "" };
    let legend = format!(
        "#p/|p|: plans proposed until one succeeded, and its length, medians{time}; in brackets the paper's where ours \
         differs; - if none succeeded. Runs of each cell: {runs}, rooms from seed {seed} on; {limits}."
    );
    writeln!(out, "{}\n", wrapped(legend.split(' '), 0, 78))?;
    let mut columns = Columns::default();
    let head = ["task"].into_iter().chain(Variant::ALL.map(Variant::name));
    columns.styled(head.map(|name| (name.to_owned(), HEAD)));
    for (task, row) in result.rows() {
        let cells = row.iter().map(|cell| (cell_text(cell), cell_style(cell)));
        columns.styled([(task.to_owned(), HEAD)].into_iter().chain(cells));
    }
    write!(out, "{}", columns.text(0))?;

    let learning = published().learning;
    writeln!(out, "\n{} transitions (the paper: {})\n", result.transitions, learning.transitions)?;
    let mut columns = Columns::with_right(&[1, 2, 3]);
    columns
        .styled(["variant", "actions learned", "paper", "ground actions, median"].map(|text| (text.to_owned(), HEAD)));
    for variant in Variant::ALL {
        let paper = if variant.individual() { learning.individual } else { learning.generalized };
        let (learned, ground) = (result.actions[&variant].to_string(), result.ground_actions(variant).to_string());
        columns.row([variant.to_string(), learned, paper.to_string(), ground]);
    }
    writeln!(out, "{}", columns.text(0))?;
    writeln!(out, "{HEAD}{}{HEAD:#}", result.summary())?;
    Ok(())
}

fn cell_text(cell: &Cell) -> String {
    let mut text = cell.text();
    if cell.comparison() != Comparison::Equal {
        text += &format!(" ({})", cell.published_text());
    }
    match cell.seconds {
        Some((mean, _)) if mean >= 0.9995 => text += &format!(" {mean:.1} s"),
        Some((mean, _)) => text += &format!(" {:.0} ms", mean * 1e3),
        None => {}
    }
    text
}

fn cell_style(cell: &Cell) -> anstyle::Style {
    match cell.comparison() {
        Comparison::Equal if cell.solved == 0 => DIM,
        Comparison::Equal => anstyle::Style::new(),
        Comparison::Better => GOOD,
        Comparison::Worse => BAD,
    }
}
