//! `typelift check-env`.

use std::io::Write;
use std::path::{Path, PathBuf};

use typelift::model::{GroundAtom, GroundCall, Hierarchy, ParseConfig, Symbol};
use typelift::words::{InspectionView, inspection_lines};
use typelift::world::{BrokenOff, InspectOptions, Inspection, Reset, World, inspect, read_task, read_types};

use crate::environment::{Timeouts, start, wanted_setup, warn_of_no_reset};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Interrupt;
use crate::quantities::parse_whole;
use crate::style::painted;
use crate::waiting::Waiting;

/// Try an environment, and say what would hurt learning
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift check-env 'python3 robot.py'
  typelift check-env 'python3 robot.py' --types types.pddl --task task.json
  typelift check-env 'python3 robot.py' --act 'pick(arm_1, cup_1)'

The environment is reset twice alike, if it can be reset, and observed several
times in a row; then the actions of --act are carried out. What is compared is
what learning sees: flicker, states that have not settled, entities that come
and go, keys that are left out at times, lists where an id is meant, words with
too many values or that differ in case only, numbers with few or that the seed
does not decide, what every action changes. If it ends halfway, or is stopped,
what was found so far is said.

Exit codes: 0 nothing hurts, 12 something hurts, 31 bad input, 35 the
environment failed, 36 wrong usage. What only may hurt leaves the code as it is.")]
pub(crate) struct CheckEnv {
    /// The environment: a program that speaks env/1 on its standard input and output
    #[arg(value_name = "COMMAND", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    command: String,
    /// The types that its entities are to have: PDDL or JSON, as for `learn`
    #[arg(long, value_name = "FILE")]
    types: Option<PathBuf>,
    /// Leave out these attributes and relations, as `learn` does: NAME, or TYPE.NAME
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    ignore: Vec<String>,
    /// Set it up as this task says
    #[arg(long, value_name = "TASK")]
    task: Option<PathBuf>,
    /// The seed that it is reset with [default: the task's, or 0]
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Carry out this action; may be given several times, and they are carried out in turn
    #[arg(long, value_name = "ACTION", value_parser = parse_call)]
    act: Vec<GroundCall>,
    /// Print what was found as one JSON object
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    timeouts: Timeouts,
}

/// Reads `pick(arm_1, cup_1)`, which is written as an atom is.
fn parse_call(text: &str) -> Result<GroundCall, String> {
    let atom = GroundAtom::parse(text).map_err(|error| format!("{error}; write for example pick(arm_1, cup_1)"))?;
    Ok(GroundCall { name: atom.predicate, args: atom.args })
}

impl CheckEnv {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let interrupt = Interrupt::install()?;
        let types = self.types.as_deref().map(read_types).transpose()?;
        let hierarchy = types.as_ref().map(|types| types.extend(&Hierarchy::default())).transpose()?;
        let task = self.task.as_deref().map(read_task).transpose()?.unwrap_or_default();
        let wanted = wanted_setup(&task, self.seed);
        let options = InspectOptions {
            hierarchy,
            doubtful_parents: types.map(|types| types.doubtful_parents()).unwrap_or_default(),
            parse: ParseConfig {
                ignore: self.ignore.iter().map(|name| Symbol::new(name)).collect(),
                ..ParseConfig::default()
            },
            reset: Reset { seed: self.seed.or(task.seed).unwrap_or(0), scenario: task.scenario },
            calls: self.act.clone(),
        };
        interrupt.heeded();
        let waiting = Waiting::new(quiet).for_one_thing();
        let mut world = start(&self.command, &self.timeouts, &interrupt, waiting)?;
        if !quiet && !world.can_reset() {
            warn_of_no_reset(self.task.as_deref().unwrap_or(Path::new("--seed")), &wanted, &world.name());
        }
        let (inspection, ended) = match inspect(&mut world, &options) {
            Ok(inspection) => (inspection, world.close()),
            Err(BrokenOff { error, found }) => (*found, Err(error)),
        };
        self.print(&world.name(), world.can_reset(), &inspection)?;
        if ended.is_err() && interrupt.explains_failure() {
            return Ok(Exit::Interrupted);
        }
        ended?;
        let hurts = inspection.findings.iter().any(|finding| finding.problem.is_certain());
        Ok(if hurts { Exit::NotAchieved } else { Exit::Success })
    }

    fn print(&self, name: &str, can_reset: bool, inspection: &Inspection) -> Result<(), Failure> {
        let mut out = anstream::stdout().lock();
        if self.json {
            let view = InspectionView::of(name, can_reset, inspection);
            writeln!(out, "{}", serde_json::to_string(&view).unwrap_or_default())?;
        } else {
            for line in inspection_lines(name, can_reset, inspection) {
                writeln!(out, "{}", painted(&line))?;
            }
        }
        Ok(())
    }
}
