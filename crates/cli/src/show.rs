//! `typelift show`.

use std::io::Write;
use std::path::PathBuf;

use typelift::model::{LearnedModel, Source, SourceId, Symbol};
use typelift::pddl::{ExportOptions, Level, export};
use typelift::words::{count, describe_action, describe_axiom};

use crate::exit::Exit;
use crate::failure::{Failure, or_one_of};
use crate::files::{ModelInput, domain_name, read_model_input};
use crate::learn::refused_merges;
use crate::style::described;

/// Show what a model holds, and what each action rests on
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift show kitchen.json
  typelift show kitchen.json --action USE-cutboard-food
  typelift show kitchen.json --pddl > kitchen.pddl")]
pub(crate) struct Show {
    /// The model, as `learn` wrote it
    model: PathBuf,
    /// Show one action with all of its evidence
    #[arg(long, value_name = "NAME", conflicts_with = "pddl")]
    action: Option<String>,
    /// List the traces that it was learned from, each with its id
    #[arg(long, conflicts_with_all = ["action", "pddl"])]
    sources: bool,
    /// Print the model as a PDDL domain
    #[arg(long)]
    pddl: bool,
}

impl Show {
    pub(crate) fn run(&self) -> Result<Exit, Failure> {
        let LearnedModel { model, evidence, refused, .. } = match read_model_input(&self.model, None)? {
            ModelInput::Learned(learned) => *learned,
            ModelInput::Given(domain) => domain.model.into(),
        };
        let mut out = anstream::stdout().lock();
        if self.pddl {
            let domain = domain_name(&self.model);
            let options = ExportOptions { domain, problem: Symbol::default(), level: Level::Adl };
            write!(out, "{}", export(&model, None, &options)?.domain)?;
            return Ok(Exit::Success);
        }
        if self.sources {
            let mut sources: Vec<(&SourceId, &Source)> = evidence.sources().iter().collect();
            sources.sort_by_key(|(id, source)| (&source.name, *id));
            for (id, Source { name, transitions }) in sources {
                writeln!(out, "{}  {:>16}  {name}", id.short(), count(*transitions, "transition"))?;
            }
            return Ok(Exit::Success);
        }
        match &self.action {
            None => {
                let h = &model.hierarchy;
                let actor = model.actor.map_or("nobody".to_owned(), |ty| h.name(ty).to_string());
                writeln!(
                    out,
                    "{}, {}, {}, from {}; {actor} acts\n",
                    count(model.actions.len() as u64, "action"),
                    count(h.len() as u64 - 1, "type"),
                    count(model.predicates.len() as u64, "predicate"),
                    count(evidence.total().transitions, "transition"),
                )?;
                if let Some(line) = refused_merges(refused) {
                    writeln!(out, "{line}\n")?;
                }
                for action in &model.actions {
                    writeln!(out, "{}", described(&describe_action(action, &model, None)))?;
                }
                for axiom in &model.axioms {
                    writeln!(out, "{}", described(&describe_axiom(axiom, &model)))?;
                }
            }
            Some(name) => {
                let action = model.action(name).ok_or_else(|| {
                    let names: Vec<Symbol> = model.actions.iter().map(|a| a.name.clone()).collect();
                    Failure::bad_input(format!("the model has no action `{name}`")).with_hint(or_one_of(name, &names))
                })?;
                write!(out, "{}", described(&describe_action(action, &model, Some(&evidence))))?;
            }
        }
        Ok(Exit::Success)
    }
}
