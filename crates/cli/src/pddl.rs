//! `typelift pddl`: checks PDDL files, and lays them out.

use std::path::PathBuf;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::pddl_check::check;

/// Check PDDL files, and lay them out
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  typelift pddl check domain.pddl p*.pddl\n\n`typelift pddl COMMAND --help` tells more."
)]
pub(crate) struct Pddl {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Say what is wrong with domains and problems
    #[command(after_help = "Examples:
  typelift pddl check domain.pddl p01.pddl p02.pddl
  typelift pddl check problems/*.pddl --json

A problem is checked against the domain among the files whose name it gives;
else against domain.pddl beside it; else against the only domain of that name
in its folder, or in the folder above. Requirements that are used but not
declared are warned of.
Exit codes: 0 all are right, 31 one is wrong, 34 one uses what is not supported.")]
    Check {
        /// Domains, problems and trajectories, in any order
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
        /// Print one JSON object per file
        #[arg(long)]
        json: bool,
    },
}

impl Pddl {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        match &self.command {
            Command::Check { files, json } => check(files, *json, quiet),
        }
    }
}
