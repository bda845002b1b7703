//! `typelift diff`.

use std::io::Write;
use std::path::PathBuf;

use typelift::model::strict;
use typelift::words::{difference, difference_lines, evidence_difference};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{ModelInput, read_model_input};
use crate::style::painted;

/// Say how two models differ
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift diff before.json after.json
  typelift diff kitchen.json kitchen.pddl

Actions of one skill are matched by their effects, whatever their parameters
are called. Before what only the first has stands -, before what only the second
has +. Models that act alike are the same, however much they were learned from;
of two learned ones that is said last. Beside a PDDL domain, which does not say
who acts, names may differ in case, and a learned model is taken as `export`
writes it: its actions need what they add not to hold. With --not-strict it is
taken as `show --pddl` writes it, and `export --not-strict`.

Exit codes: 0 the same, 12 different, 31 bad input, 36 wrong usage.")]
pub(crate) struct Diff {
    /// A model, a memory, or a PDDL domain
    first: PathBuf,
    /// Another one
    second: PathBuf,
    /// Beside a PDDL domain, take a learned model's actions as usable where some of their effects hold already
    #[arg(long)]
    not_strict: bool,
    /// Print the difference as one JSON object
    #[arg(long)]
    json: bool,
}

impl Diff {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let (first, second) =
            (read_model_input(&self.first, None, quiet)?, read_model_input(&self.second, None, quiet)?);
        let beside_pddl = first.is_given() || second.is_given();
        let mut found = if beside_pddl && !self.not_strict {
            difference(&strict(first.model()), &strict(second.model()), true)
        } else {
            difference(first.model(), second.model(), beside_pddl)
        };
        if let (ModelInput::Learned(first), ModelInput::Learned(second)) = (&first, &second) {
            found.evidence = evidence_difference(&first.evidence, &second.evidence);
        }
        let mut out = anstream::stdout().lock();
        if self.json {
            writeln!(out, "{}", serde_json::to_string(&found).unwrap_or_default())?;
        } else {
            let [one, other] = [&self.first, &self.second].map(|file| file.display().to_string());
            for line in difference_lines(&found, [&one, &other]) {
                writeln!(out, "{}", painted(&line))?;
            }
        }
        Ok(if found.same { Exit::Success } else { Exit::NotAchieved })
    }
}
