//! `typelift lab report`.

use std::fs::create_dir_all;
use std::io::Write;
use std::path::Path;

use typelift::world::{FileError, write_file};
use typelift_lab::report::{Environment, Judged, Results, judge, report_page};
use typelift_lab::{
    DemonstrationsOptions, FaultsOptions, LabError, LifelongOptions, RunnerOptions, TableOptions, TypeHierarchy,
    demonstrations_experiment, faults_experiment, lifelong_experiment, table,
};

use super::growth::{GrowthLimits, growth};
use super::options::{ResultOptions, Supervisor};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::style::{BAD, DIM, GOOD, HEAD, wrapped};

/// Everything on one page, and whether each of the paper's claims holds
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift lab report -o results
  typelift lab report --quick -o Q

Reads what the other experiments wrote to DIR/table, DIR/demonstrations,
DIR/faults, DIR/hierarchy, DIR/growth and DIR/lifelong, or to DIR itself, and
writes DIR/report.html, which needs no network and no other file.")]
pub(super) struct LabReport {
    #[command(flatten)]
    results: ResultOptions,
    /// First run a small part of what is missing
    #[arg(long)]
    quick: bool,
}

impl LabReport {
    pub(super) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let folder = self.results.folder();
        create_dir_all(&folder).map_err(|error| FileError::from_write(&folder, &error))?;
        let mut results = Results::read(&folder)?;
        if self.quick && !results.missing().is_empty() {
            run_missing(&folder, &results.missing(), quiet)?;
            results = Results::read(&folder)?;
        }
        let page = report_page(&results, &Environment::of_this_machine(), &folder.display().to_string());
        let path = folder.join("report.html");
        write_file(&path, page.as_bytes())?;
        let judged = judge(&results);
        self.results.print(&judged, |out| print(out, &judged))?;
        if !quiet {
            for experiment in results.missing() {
                let command = format!("typelift lab {experiment} -o {}/{experiment}", folder.display());
                anstream::eprintln!("not run yet: `{command}` makes it part of the report");
            }
            anstream::eprintln!("wrote {}", path.display());
        }
        Ok(Exit::Success)
    }
}

/// Runs a small part of each missing experiment, in the folder of its name.
fn run_missing(folder: &Path, missing: &[&str], quiet: bool) -> Result<(), Failure> {
    let supervisor = Supervisor::install(quiet)?;
    for experiment in missing {
        if !quiet {
            anstream::eprint!("{experiment}: ");
        }
        supervisor.carry_out(&folder.join(experiment), false, None, |runner| quick(experiment, runner))?;
    }
    Ok(())
}

fn quick(experiment: &str, runner: &RunnerOptions<'_>) -> Result<(), LabError> {
    match experiment {
        "table" => table(&TableOptions { runs: 1, quick: true, ..TableOptions::default() }, runner).map(drop),
        "demonstrations" => {
            let options = DemonstrationsOptions { quick: true, ..DemonstrationsOptions::default() };
            demonstrations_experiment(&options, runner).map(drop)
        }
        "faults" => {
            let options = FaultsOptions { runs: 1, quick: true, ..FaultsOptions::default() };
            faults_experiment(&options, runner).map(drop)
        }
        "lifelong" => {
            let options =
                LifelongOptions { runs: 1, tasks: LifelongOptions::QUICK, states: 0, ..LifelongOptions::default() };
            lifelong_experiment(&options, runner).map(drop)
        }
        "growth" => growth(true, GrowthLimits::default(), runner).map(drop),
        _ => {
            create_dir_all(runner.folder).map_err(|error| FileError::from_write(runner.folder, &error))?;
            runner.progress.begun(1, 1, 0);
            Ok(TypeHierarchy::of_the_kitchen().write(runner.folder).map(drop)?)
        }
    }
}

fn print(out: &mut dyn Write, judged: &[Judged]) -> Result<(), Failure> {
    for Judged { claim, finding } in judged {
        let (style, word, ours) = match finding {
            Some(finding) if finding.held => (GOOD, "held", finding.ours.as_str()),
            Some(finding) => (BAD, "not held", finding.ours.as_str()),
            None => (DIM, "not measured", ""),
        };
        writeln!(out, "{style}{word:<12}{style:#}  {}", wrapped(claim.claim.split(' '), 14, 78))?;
        if !ours.is_empty() {
            writeln!(out, "              {DIM}{}{DIM:#}", wrapped(ours.split(' '), 14, 78))?;
        }
    }
    let measured = judged.iter().filter_map(|judged| judged.finding.as_ref());
    let (held, count) = (measured.clone().filter(|finding| finding.held).count(), measured.count());
    match count {
        0 => writeln!(out, "{HEAD}None of the claims was measured.{HEAD:#}")?,
        _ => writeln!(out, "{HEAD}{held} of {count} claims that were measured held.{HEAD:#}")?,
    }
    Ok(())
}
