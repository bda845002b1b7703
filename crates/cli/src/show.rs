//! `typelift show`.

use std::io::Write;
use std::path::{Path, PathBuf};

use typelift::model::{ActionModel, ActionSchema, Evidence, LearnedModel, Source, SourceId, Symbol};
use typelift::pddl::{ExportOptions, Level, export};
use typelift::words::{Description, count, describe_action, describe_axiom};

use crate::exit::Exit;
use crate::failure::{Failure, or_one_of};
use crate::files::{ModelInput, read_model_input, read_remembered};
use crate::learn_report::refused_merges;
use crate::show_vocabulary::{list_predicates, list_types};
use crate::style::described;

/// Show what a model holds, and what each action rests on
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift show kitchen.json
  typelift show kitchen.json --action USE-cutboard-food
  typelift show kitchen.json --predicates
  typelift show robot.memory
  typelift show kitchen.json --pddl > kitchen.pddl")]
pub(crate) struct Show {
    /// The model, as `learn` wrote it, a memory, or a PDDL domain
    #[arg(required_unless_present = "memory")]
    model: Option<PathBuf>,
    /// Show what this memory has learned, instead of a MODEL
    #[arg(long, value_name = "FILE", conflicts_with = "model")]
    memory: Option<PathBuf>,
    /// Show one action with all of its evidence
    #[arg(long, value_name = "NAME", conflicts_with = "pddl")]
    action: Option<String>,
    /// List the traces that it was learned from, each with its id
    #[arg(long, conflicts_with_all = ["action", "pddl"])]
    sources: bool,
    /// List the predicates, each with the types of its arguments: what a goal may say
    #[arg(long, conflicts_with_all = ["action", "sources", "pddl"])]
    predicates: bool,
    /// List the types, each under what it is a kind of
    #[arg(long, conflicts_with_all = ["action", "sources", "pddl", "predicates"])]
    types: bool,
    /// Print the model as a PDDL domain
    #[arg(long)]
    pddl: bool,
    /// Print the same as a JSON list: a description of each action and axiom, or each trace, predicate or type
    #[arg(long, conflicts_with = "pddl")]
    json: bool,
}

impl Show {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let file = self.memory.as_ref().or(self.model.as_ref()).map(PathBuf::as_path).unwrap_or(Path::new(""));
        let input = match &self.memory {
            Some(memory) => read_remembered(memory, None, quiet)?,
            None => read_model_input(file, None, quiet)?,
        };
        let domain = input.domain_name(file);
        let learned = match input {
            ModelInput::Learned(learned) => *learned,
            ModelInput::Given(domain) => domain.model.into(),
        };
        let LearnedModel { model, evidence, .. } = &learned;
        let mut out = anstream::stdout().lock();
        if self.pddl {
            let options = ExportOptions { domain, problem: Symbol::default(), level: Level::Adl };
            write!(out, "{}", export(model, None, &options)?.domain)?;
            return Ok(Exit::Success);
        }
        if self.predicates {
            return list_predicates(&mut out, model, self.json, quiet);
        }
        if self.types {
            return list_types(&mut out, &model.hierarchy, self.json);
        }
        if self.sources {
            return self.list_sources(&mut out, evidence);
        }
        let told = match &self.action {
            None => all_told(model),
            Some(name) => {
                let action = model.action(name).ok_or_else(|| no_action(model, name))?;
                vec![describe_action(action, model, Some(evidence))]
            }
        };
        if self.json {
            writeln!(out, "{}", serde_json::to_string_pretty(&told).unwrap_or_default())?;
        } else if self.action.is_some() {
            write!(out, "{}", told.iter().map(described).collect::<Vec<_>>().join("\n"))?;
        } else {
            overview(&mut out, &learned)?;
        }
        Ok(Exit::Success)
    }

    fn list_sources(&self, out: &mut impl Write, evidence: &Evidence) -> Result<Exit, Failure> {
        let mut sources: Vec<(&SourceId, &Source)> = evidence.sources().iter().collect();
        sources.sort_by_key(|(id, source)| (&source.name, *id));
        if self.json {
            let listed = sources.iter().map(
                |(id, source)| serde_json::json!({"id": id, "name": source.name, "transitions": source.transitions}),
            );
            let listed: Vec<serde_json::Value> = listed.collect();
            writeln!(out, "{}", serde_json::to_string_pretty(&listed).unwrap_or_default())?;
            return Ok(Exit::Success);
        }
        for (id, Source { name, transitions }) in sources {
            writeln!(out, "{}  {:>16}  {name}", id.short(), count(*transitions, "transition"))?;
        }
        Ok(Exit::Success)
    }
}

/// That there is no action of this name, with those whose call has it, or that may be meant.
fn no_action(model: &ActionModel, name: &str) -> Failure {
    let named = |is_meant: &dyn Fn(&ActionSchema) -> bool| -> Vec<Symbol> {
        model.actions.iter().filter(|action| is_meant(action)).map(|action| action.name.clone()).collect()
    };
    let calling = named(&|action| action.call.name == *name);
    let hint = match calling.is_empty() {
        true => or_one_of(name, &named(&|_| true)),
        false => {
            let calling: Vec<&str> = calling.iter().map(Symbol::as_str).collect();
            format!("`{name}` is what is called by {}.", calling.join(", "))
        }
    };
    Failure::bad_input(format!("the model has no action `{name}`")).with_hint(hint)
}

/// Every action and axiom.
fn all_told(model: &ActionModel) -> Vec<Description> {
    let actions = model.actions.iter().map(|action| describe_action(action, model, None));
    actions.chain(model.axioms.iter().map(|axiom| describe_axiom(axiom, model))).collect()
}

/// All that a model holds, in short.
pub(crate) fn overview(out: &mut impl Write, learned: &LearnedModel) -> Result<(), Failure> {
    let LearnedModel { model, evidence, refused, .. } = learned;
    head(out, model, evidence)?;
    if let Some(line) = refused_merges(*refused) {
        writeln!(out, "{line}\n")?;
    }
    let texts: Vec<String> = all_told(model).iter().map(described).collect();
    write!(out, "{}", texts.join("\n"))?;
    if !texts.is_empty() {
        writeln!(out)?;
    }
    Ok(())
}

/// What the model holds, in numbers.
fn head(out: &mut impl Write, model: &ActionModel, evidence: &Evidence) -> Result<(), Failure> {
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
    Ok(())
}
