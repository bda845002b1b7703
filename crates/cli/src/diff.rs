//! `typelift diff`.

use std::io::Write;
use std::path::PathBuf;

use typelift::model::strict;
use typelift::words::{ModelDifference, difference, difference_lines, evidence_difference};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{ModelInput, read_model_input};
use crate::style::{HINT, painted};

/// Say how two models differ
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift diff before.json after.json
  typelift diff kitchen.json export/domain.pddl
  typelift diff kitchen.json kitchen.pddl --not-strict    # of show --pddl

Actions of one skill are matched by their effects, whatever their parameters
are called. Before what only the first has stands -, before what only the second
has +. Models that act alike are the same, however much they were learned from,
and of whatever types their predicates are known: that is said besides.

Beside a PDDL domain, which does not say who acts, names may differ in case, and
a learned model is taken as `export` writes it: its actions need what they add
not to hold. With --not-strict it is taken as `show --pddl` writes it, and
`export --not-strict`.

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
        let plain = || difference(first.model(), second.model(), beside_pddl);
        let is_strict = beside_pddl && !self.not_strict;
        let mut found =
            if is_strict { difference(&strict(first.model()), &strict(second.model()), true) } else { plain() };
        let hint = if is_strict && !found.same { hint(&found, &plain()) } else { None };
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
        if let Some(hint) = hint.filter(|_| !quiet) {
            anstream::eprintln!("{HINT}hint{HINT:#}: {hint}");
        }
        Ok(if found.same { Exit::Success } else { Exit::NotAchieved })
    }
}

/// What to say where the models are closer to each other if the learned one's actions are not strict.
fn hint(found: &ModelDifference, plain: &ModelDifference) -> Option<String> {
    let differing = |found: &ModelDifference| found.changed.len() + found.actions.len();
    match differing(plain) {
        _ if plain.same => Some("with --not-strict they are the same: the domain is not strict.".to_owned()),
        fewer if fewer < differing(found) => Some(format!(
            "with --not-strict {} rather than {}: the domain is not strict.",
            differ(fewer),
            differing(found)
        )),
        _ => None,
    }
}

/// How many actions differ.
fn differ(actions: usize) -> String {
    match actions {
        0 => "no action differs".to_owned(),
        1 => "1 action differs".to_owned(),
        more => format!("{more} actions differ"),
    }
}
