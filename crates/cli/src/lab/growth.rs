//! `typelift lab growth`.

use std::io::{Read, Write};
use std::process::{Command, Stdio};
use std::time::Duration;
use typelift::words::count;

use typelift_lab::{
    Allowance, Growth, GrowthResult, LabError, Measurement, Point, RunnerOptions, Stopper, carry_out, measure,
};

use super::options::ExperimentOptions;
use crate::columns::Columns;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Clock;
use crate::quantities::{parse_bytes, parse_duration};
use crate::resident::memory_held_from_now;
use crate::style::{HEAD, wrapped};

/// How time and memory grow with objects, goals and demonstrations
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift lab growth -o G
  typelift lab growth --quick -o Q

Plans with 32 to 10,000 objects, in a kitchen with a larger storeroom and where
tools and plates grow too; with 1 to 20 goal foods; learns from 100 to 1,000,000
transitions. Each point is measured in a process of its own, one at a
time. Writes growth.csv, growth_fits.csv, growth.json and a log-log plot of each
quantity with its exponent. With the default limits it takes some ten minutes.")]
pub(super) struct LabGrowth {
    #[command(flatten)]
    experiment: ExperimentOptions,
    #[command(flatten)]
    allowance: GrowthLimits,
}

/// What a point may spend.
#[derive(Debug, Clone, Copy, clap::Args)]
#[command(next_help_heading = "Limits")]
pub(super) struct GrowthLimits {
    /// Cut a point after this time: seconds, or 500ms, 30s, 5m
    #[arg(long, value_name = "TIME", default_value = "60s", value_parser = parse_duration, allow_negative_numbers = true)]
    time_limit: Duration,
    /// Cut a point when it holds so much memory more than at its start: mebibytes, or 500M, 2G
    #[arg(long, value_name = "SIZE", default_value = "2G", value_parser = parse_bytes, allow_negative_numbers = true)]
    memory_limit: u64,
}

impl Default for GrowthLimits {
    fn default() -> Self {
        Self { time_limit: Duration::from_secs(60), memory_limit: 2 << 30 }
    }
}

impl GrowthLimits {
    fn allowance(self) -> Allowance {
        Allowance { seconds: self.time_limit.as_secs_f64(), bytes: self.memory_limit }
    }
}

impl LabGrowth {
    pub(super) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let files = "growth.csv, growth_fits.csv, growth.json and the figures";
        let (quick, allowance) = (self.experiment.quick, self.allowance);
        let result = self.experiment.carry_out(None, clock, quiet, files, |runner| growth(quick, allowance, runner))?;
        self.experiment.results.print(&result, |out| print(out, &result))?;
        Ok(Exit::Success)
    }
}

/// Measures every point and writes the results.
pub(super) fn growth(quick: bool, limits: GrowthLimits, runner: &RunnerOptions<'_>) -> Result<GrowthResult, LabError> {
    let allowance = limits.allowance();
    let experiment = Growth { quick, allowance, measure: &measure_apart };
    // Two at once would be in each other's way.
    let measured = carry_out(&experiment, &RunnerOptions { jobs: 1, ..runner.clone() })?;
    let result = GrowthResult::new(quick, allowance, measured);
    result.write(runner.folder)?;
    Ok(result)
}

/// Measures a point in a process of its own; nothing if it was stopped.
fn measure_apart(point: Point, allowance: Allowance, stopper: &Stopper) -> Result<Option<Measurement>, LabError> {
    let failed = |message: String| LabError::Run { run: point.to_string(), message };
    let program = std::env::current_exe().map_err(|error| failed(error.to_string()))?;
    let mut child = Command::new(program)
        .args(["lab", "measure", &point.to_string().replace(' ', ":")])
        .args([allowance.seconds.to_string(), allowance.bytes.to_string()])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| failed(error.to_string()))?;
    let status = loop {
        if stopper() {
            // It may have ended by itself; there is nothing to be learned from either.
            let _ = child.kill();
            let _ = child.wait();
            return Ok(None);
        }
        match child.try_wait() {
            Ok(Some(status)) => break status,
            Ok(None) => std::thread::sleep(Duration::from_millis(5)),
            Err(error) => return Err(failed(error.to_string())),
        }
    };
    let mut text = String::new();
    if let Some(mut output) = child.stdout.take() {
        output.read_to_string(&mut text).map_err(|error| failed(error.to_string()))?;
    }
    if stopper() {
        return Ok(None);
    }
    if !status.success() {
        return Err(failed(format!("its process ended with {status}; a smaller --memory-limit may help")));
    }
    serde_json::from_str(&text).map(Some).map_err(|error| failed(error.to_string()))
}

fn print(out: &mut dyn Write, result: &GrowthResult) -> Result<(), Failure> {
    let cut = result.points.iter().filter(|measured| measured.measurement.end != typelift_lab::End::Finished).count();
    let legend = format!(
        "Power laws fitted to what was measured: it grows as the size to the power of the exponent. {} of {} were cut, \
         at {} s or {} MiB, and are no part of a fit.",
        cut,
        count(result.points.len() as u64, "point"),
        result.seconds_allowed,
        result.bytes_allowed >> 20
    );
    writeln!(out, "{}\n", wrapped(legend.split(' '), 0, 78))?;
    let mut columns = Columns::with_right(&[2, 3, 4]);
    columns.styled(["series", "quantity", "exponent", "R²", "points"].map(|text| (text.to_owned(), HEAD)));
    for fit in &result.fits {
        let [exponent, r_squared] = [fit.exponent, fit.r_squared].map(|number| format!("{number:.2}"));
        columns.row([fit.series.name().to_owned(), fit.quantity.clone(), exponent, r_squared, fit.points.to_string()]);
    }
    write!(out, "{}", columns.text(0))?;
    Ok(())
}

/// Measure one point of growth in this process, and print it as JSON
#[derive(Debug, clap::Args)]
pub(super) struct LabMeasure {
    /// `storeroom:320`
    point: Point,
    /// What it may spend: seconds
    seconds: f64,
    /// What it may spend: bytes
    bytes: u64,
}

impl LabMeasure {
    pub(super) fn run(&self) -> Result<Exit, Failure> {
        let allowance = Allowance { seconds: self.seconds, bytes: self.bytes };
        let measured = measure(self.point, allowance, &memory_held_from_now());
        let mut out = std::io::stdout().lock();
        serde_json::to_writer(&mut out, &measured).map_err(std::io::Error::from)?;
        writeln!(out)?;
        Ok(Exit::Success)
    }
}
