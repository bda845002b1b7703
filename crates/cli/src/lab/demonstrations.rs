//! `typelift lab demonstrations`.

use std::io::Write;

use typelift_lab::{
    DemonstrationsOptions, DemonstrationsResult, Subset, Variant, demonstrations_experiment, published,
};

use super::options::{ExperimentOptions, RoomOptions, warn};
use crate::columns::Columns;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Clock;
use crate::style::{HEAD, wrapped};

/// A model from every subset of 2 to 8 demonstrations, tested on all 24 tasks
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift lab demonstrations --variant generalized+imagined -o D
  typelift lab demonstrations --quick -o Q

Writes violins.svg, demonstrations.csv (a row a subset: what the violins are
made of), sizes.csv, gains.csv, demonstrations.json and demonstrations.md.
Nothing in them depends on the machine, unless --time-limit ended a search.

Limits, unless told otherwise: 4,000 expansions a search, 4 proposals and
120 s a task.")]
pub(super) struct LabDemonstrations {
    #[command(flatten)]
    experiment: ExperimentOptions,
    /// Only this variant; may be repeated
    #[arg(long, value_name = "NAME", value_parser = parse_variant)]
    variant: Vec<Variant>,
    #[command(flatten)]
    rooms: RoomOptions,
}

fn parse_variant(name: &str) -> Result<Variant, String> {
    Variant::parse(name).ok_or_else(|| format!("there are {}", Variant::ALL.map(Variant::name).join(", ")))
}

impl LabDemonstrations {
    pub(super) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let default = DemonstrationsOptions::default();
        let chosen = |variant: &Variant| self.variant.is_empty() || self.variant.contains(variant);
        let options = DemonstrationsOptions {
            variants: default.variants.into_iter().filter(chosen).collect(),
            seed: self.rooms.seed,
            limits: self.rooms.limits.or(default.limits),
            quick: self.experiment.quick,
        };
        let files = "violins.svg, demonstrations.csv, sizes.csv, gains.csv, demonstrations.json and demonstrations.md";
        let result = self
            .experiment
            .carry_out(self.rooms.jobs, clock, quiet, files, |runner| demonstrations_experiment(&options, runner))?;
        self.experiment.results.print(&result.json(), |out| print(out, &result))?;
        warn(result.out_of_time(), result.records.values().any(|record| !record.solved.is_empty()), quiet);
        Ok(Exit::Success)
    }
}

fn print(out: &mut dyn Write, result: &DemonstrationsResult) -> Result<(), Failure> {
    let DemonstrationsOptions { seed, limits, variants, .. } = &result.options;
    let tasks = result.tasks;
    let legend = format!(
        "Tasks solved of {tasks}, by the number of demonstrations learned from. Rooms of seed {seed}; {limits}."
    );
    writeln!(out, "{}", wrapped(legend.split(' '), 0, 78))?;
    for variant in variants {
        writeln!(out, "\n{HEAD}{variant}{HEAD:#}")?;
        let mut columns = Columns::with_right(&[0, 1, 2, 3, 4, 5]);
        columns.row(["demonstrations", "subsets", "least", "median", "most", "subsets that solve all"]);
        for size in result.sizes(*variant) {
            let [least, most] = [size.solved.first(), size.solved.last()].map(|end| end.copied().unwrap_or_default());
            columns.row([
                size.size.to_string(),
                size.solved.len().to_string(),
                least.to_string(),
                size.median().to_string(),
                most.to_string(),
                result.complete(&size).to_string(),
            ]);
        }
        write!(out, "{}", columns.text(2))?;
        let smallest = named(&result.smallest_complete(*variant));
        let smallest = format!("smallest that solve all: {smallest}");
        writeln!(out, "  {}", wrapped(smallest.split(' '), 4, 78))?;
        if let Some(gain) = result.gains(*variant).first().filter(|gain| gain.pairs > 0) {
            writeln!(
                out,
                "  matters most: {} {}, {:+.2} tasks on average when added",
                gain.number, gain.title, gain.mean
            )?;
        }
    }
    let paper = published().demonstrations;
    let ([from, to], complete) = (paper.jump, paper.complete_from);
    let said = format!(
        "The paper, of generalized+imagined: a big jump from {from} to {to} demonstrations, and some subsets of \
         {complete} already solve every task."
    );
    writeln!(
        out,
        "
{}",
        wrapped(said.split(' '), 0, 78)
    )?;
    Ok(())
}

/// `4,5,6,8; 1,2,3,4`.
fn named(subsets: &[&Subset]) -> String {
    if subsets.is_empty() {
        return "none".to_owned();
    }
    subsets.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}
