//! `typelift show`.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;

use typelift::model::{
    ActionModel, ActionSchema, Literal, Provenance, Source, Symbol, Term, describe_replacements, schema_name,
};
use typelift::pddl::{ExportOptions, Level, export};

use crate::exit::Exit;
use crate::failure::{Failure, or_one_of};
use crate::files::{domain_name, read_model};
use crate::style::{DIM, HEAD, count, wrapped};

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
    /// Print the model as a PDDL domain
    #[arg(long)]
    pddl: bool,
}

impl Show {
    pub(crate) fn run(&self) -> Result<Exit, Failure> {
        let model = read_model(&self.model, None)?;
        let mut out = anstream::stdout().lock();
        if self.pddl {
            let domain = domain_name(&self.model);
            let options = ExportOptions { domain, problem: Symbol::default(), level: Level::Adl };
            write!(out, "{}", export(&model, None, &options)?.domain)?;
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
                    count(model.evidence.transitions, "transition"),
                )?;
                for action in &model.actions {
                    writeln!(out, "{}", describe(action, &model, false))?;
                }
            }
            Some(name) => {
                let action = model.action(name).ok_or_else(|| {
                    let names: Vec<Symbol> = model.actions.iter().map(|a| a.name.clone()).collect();
                    Failure::bad_input(format!("the model has no action `{name}`")).with_hint(or_one_of(name, &names))
                })?;
                write!(out, "{}", describe(action, &model, true))?;
            }
        }
        Ok(Exit::Success)
    }
}

/// An action in words: parameters, what the environment is told, preconditions, effects, evidence.
pub(crate) fn describe(action: &ActionSchema, model: &ActionModel, in_full: bool) -> String {
    let h = &model.hierarchy;
    let mut text = format!("{HEAD}{}{HEAD:#}  {}\n", action.name, headline(action, model));
    let parameters: Vec<String> = action.parameters.iter().map(|p| format!("?{} - {}", p.name, h.name(p.ty))).collect();
    row(&mut text, "parameters", &parameters);
    let term = |t: &Term| match t {
        Term::Param(i) => format!("?{}", action.parameters[*i as usize].name),
        Term::Const(name) => name.to_string(),
    };
    let args: Vec<String> = action.call.args.iter().map(term).collect();
    row(&mut text, "call", &[format!("{}({})", action.call.name, args.join(", "))]);
    let literal = |l: &Literal| {
        let args: Vec<String> = l.atom.args.iter().map(term).collect();
        format!("{}{}({})", if l.positive { "" } else { "not " }, l.atom.predicate, args.join(","))
    };
    row(&mut text, "needs", &action.preconditions.iter().map(literal).collect::<Vec<_>>());
    for (label, adds) in [("adds", true), ("deletes", false)] {
        let effects = action.effects.iter().filter(|e| e.literal.positive == adds);
        let written = effects.map(|e| literal(&Literal::positive(e.literal.atom.clone())));
        row(&mut text, label, &written.collect::<Vec<_>>());
    }
    let sources = action.provenance.sources();
    let rests: Vec<String> =
        sources.iter().map(|s| format!("{} {}", source_name(s, model), support(s, model))).collect();
    if sources.len() > 1 {
        row(&mut text, "merged", &rests);
        row(&mut text, "because", &because(action, model));
    }
    if in_full {
        for source in sources {
            let witnesses = model.evidence.clusters.get(&source.cluster).map(|c| &c.witnesses);
            let places = witnesses.into_iter().flatten().map(|w| format!("{} step {}", w.file, w.step));
            let places: Vec<String> = places.collect();
            row(&mut text, "seen", &[format!("{}: {}", source_name(source, model), places.join(", "))]);
        }
    }
    text
}

/// A labelled line; nothing if there are no words.
fn row(text: &mut String, label: &str, words: &[String]) {
    if words.is_empty() {
        return;
    }
    let body = wrapped(words.iter().map(String::as_str), 14, 80);
    text.push_str(&format!("  {DIM}{label:<12}{DIM:#}{body}\n"));
}

/// Where an action comes from, in one line.
pub(crate) fn headline(action: &ActionSchema, model: &ActionModel) -> String {
    let observations = count(model.observations(action), "observation");
    match &action.provenance {
        Provenance::Given => "given".to_owned(),
        Provenance::Demonstrated(_) => observations,
        Provenance::Generalized(sources) => {
            format!("{observations} of {}", count(sources.len() as u64, "individual action"))
        }
        Provenance::Imagined { from, replaced, goal, .. } => format!(
            "imagined for {goal}: {}, from {from}, {observations}",
            describe_replacements(replaced, &model.hierarchy)
        ),
        Provenance::Substituted { from, replaced, following, .. } => format!(
            "follows {following}: {}, from {from}, {observations}",
            describe_replacements(replaced, &model.hierarchy)
        ),
    }
}

/// The name that an individual action over this cluster has.
pub(crate) fn source_name(source: &Source, model: &ActionModel) -> String {
    let key = &source.cluster;
    let is_actor = |name: &Symbol| model.hierarchy.id(name.as_str()).is_some_and(|ty| model.is_actor(ty));
    schema_name(&key.action, key.types.iter().map(|name| (name, is_actor(name))))
}

fn support(source: &Source, model: &ActionModel) -> u64 {
    model.evidence.clusters.get(&source.cluster).map_or(0, |cluster| cluster.count)
}

/// Why individual actions were merged: the same effect, and where their types meet.
fn because(action: &ActionSchema, model: &ActionModel) -> Vec<String> {
    let mut reasons = vec!["all have this effect;".to_owned()];
    for (i, parameter) in action.parameters.iter().enumerate() {
        let mut met: BTreeMap<&Symbol, ()> = BTreeMap::new();
        for source in action.provenance.sources() {
            if let Some(own) = source.map.iter().position(|&p| p as usize == i) {
                met.insert(&source.cluster.types[own], ());
            }
        }
        if met.len() > 1 {
            let names: Vec<&str> = met.keys().map(|name| name.as_str()).collect();
            reasons.push(format!("{} meet in {};", names.join(", "), model.hierarchy.name(parameter.ty)));
        }
    }
    if let Some(last) = reasons.last_mut() {
        last.pop();
    }
    reasons
}
