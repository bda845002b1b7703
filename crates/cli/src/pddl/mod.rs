//! `typelift pddl`: checks PDDL files, and lays them out.

mod check;
mod domains;

use std::io::Write;
use std::path::{Path, PathBuf};

use typelift::pddl::format;
use typelift::world::{FileError, read_text, write_file};

use crate::exit::Exit;
use crate::failure::Failure;
use check::check;

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
        /// Domains, problems, trajectories and plans (.plan), in any order
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
        /// Print one JSON object per file
        #[arg(long)]
        json: bool,
    },
    /// Lay out a file anew: line breaks and indentation; names and comments stay
    #[command(after_help = "Examples:
  typelift pddl format domain.pddl
  typelift pddl format domain.pddl -o domain.pddl
  typelift pddl format domain.pddl --check

Exit codes: 0 done, or laid out like this already; 12 not so, with --check;
31 the parentheses do not match.")]
    Format {
        /// A domain, a problem, or anything else in parentheses
        file: PathBuf,
        /// Where to write it, which may be the same file; else it is printed
        #[arg(short, long, value_name = "OUT")]
        output: Option<PathBuf>,
        /// Write nothing; only say whether it is laid out like this already
        #[arg(long, conflicts_with = "output")]
        check: bool,
    },
}

impl Pddl {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        match &self.command {
            Command::Check { files, json } => check(files, *json, quiet),
            Command::Format { file, output, check } => lay_out(file, output.as_deref(), *check, quiet),
        }
    }
}

fn lay_out(file: &Path, output: Option<&Path>, check: bool, quiet: bool) -> Result<Exit, Failure> {
    let text = read_text(file)?;
    let formatted = format(&text).map_err(|error| FileError::from_pddl(file, &text, error))?;
    if check {
        if formatted == text {
            return Ok(Exit::Success);
        }
        if !quiet {
            anstream::eprintln!("{} would be laid out differently", file.display());
        }
        return Ok(Exit::NotAchieved);
    }
    match output {
        Some(output) => write_file(output, formatted.as_bytes())?,
        None => anstream::stdout().write_all(formatted.as_bytes())?,
    }
    Ok(Exit::Success)
}
