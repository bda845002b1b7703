//! `typelift why`.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use typelift::belief::{Belief, Question};
use typelift::model::{
    ActionModel, GroundAtom, GroundCall, Hierarchy, LearnedModel, State, Symbol, TypeId, did_you_mean, json_message,
};
use typelift::words::{CallQuestion, WhyView, count, why_lines};
use typelift::world::{FileError, Parser, TraceReader, is_trace, read_text, trace_from};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{ModelInput, TaskInput, read_model_input, read_remembered};
use crate::style::{HINT, painted};

/// Say how likely a call works, and what speaks against it
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift why model.json 'USE(agent_1, cutboard_1, coconut_1)' --task task.json
  typelift why model.json 'USE(agent, cutboard, coconut)'
  typelift why robot.memory 'USE(agent, cutboard, coconut)'
  typelift why model.json --calls calls.jsonl --json

A model's demonstrations and recorded failures speak for a call, or against the
type of an object, two types together, or a literal that does not hold. An
object that the task does not have is taken for one of the type of its name,
without a number: cutboard_1 is a cutboard.

Exit codes: 0 something is known of every call, 12 not of every one, 31 bad
input, 36 wrong usage.")]
pub(crate) struct Why {
    /// A learned model, or a memory
    #[arg(required_unless_present = "memory")]
    model: Option<PathBuf>,
    /// Calls, as `PICK(agent_1, counter_3, lettuce_1)`
    #[arg(value_name = "CALL", required_unless_present_any = ["calls", "memory"])]
    call: Vec<String>,
    /// Ask what this memory has learned, instead of a MODEL
    #[arg(long, value_name = "FILE")]
    memory: Option<PathBuf>,
    /// Ask in the state of this task, or in the last one of this trace
    #[arg(long, value_name = "FILE")]
    task: Option<PathBuf>,
    /// Ask about the calls of a file of JSON Lines, each with types or a state
    #[arg(long, value_name = "FILE", conflicts_with_all = ["call", "task"])]
    calls: Option<PathBuf>,
    /// Print one JSON object a call
    #[arg(long)]
    json: bool,
}

/// Objects that are named in place of one that is not there.
const MOST_NAMED: usize = 5;

/// A call with what is said of its objects.
struct Asked {
    call: GroundCall,
    types: Vec<Option<TypeId>>,
    state: Option<State>,
}

impl Why {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let (input, calls) = self.read(quiet)?;
        let learned = self.learned(&input)?;
        let asked = match &self.calls {
            Some(file) => asked_in_file(file, learned)?,
            None => self.asked_by_name(&calls, &input, quiet)?,
        };
        let belief = Belief::of(learned);
        let mut out = anstream::stdout().lock();
        let mut all_known = true;
        for Asked { call, types, state } in asked {
            let question = Question { call: &call, types: &types, state: state.as_ref() };
            let judgement = belief.judge(&question);
            let view = WhyView::new(call, judgement);
            all_known &= !view.unknown;
            if !quiet {
                let model = &learned.model;
                match &state {
                    _ if view.unknown => say_what_is_unknown(&view.call, &types, model),
                    Some(state) => say_what_is_not_there(&view.call, &types, state, model),
                    None => {}
                }
            }
            if self.json {
                writeln!(out, "{}", serde_json::to_string(&view).unwrap_or_default())?;
            } else {
                for line in why_lines(&view) {
                    writeln!(out, "{}", painted(&line))?;
                }
            }
        }
        Ok(if all_known { Exit::Success } else { Exit::NotAchieved })
    }

    /// What is asked, and about which calls of the command line: with a memory there is no model, and the first of the words
    /// is a call.
    fn read(&self, quiet: bool) -> Result<(ModelInput, Vec<String>), Failure> {
        let Some(memory) = &self.memory else {
            let file = self.model.as_deref().unwrap_or(Path::new(""));
            return Ok((read_model_input(file, None, quiet)?, self.call.clone()));
        };
        let first = self.model.iter().map(|word| word.display().to_string());
        let calls: Vec<String> = first.chain(self.call.iter().cloned()).collect();
        let usage = |message| Err(Failure::new(Exit::Usage, message));
        match (calls.first(), &self.calls) {
            (None, None) => usage("no call: name one after --memory FILE, or a file of them with --calls"),
            (Some(_), Some(_)) => usage("--calls has the calls: name none beside it, and no model beside --memory"),
            _ => Ok((read_remembered(memory, None, quiet)?, calls)),
        }
    }

    /// The model with its evidence: a domain has none.
    fn learned<'m>(&self, input: &'m ModelInput) -> Result<&'m LearnedModel, Failure> {
        match (input, &self.model) {
            (ModelInput::Learned(learned), _) => Ok(learned),
            (ModelInput::Given(_), model) => {
                let message = "a PDDL domain says what works; only what was learned can be doubted";
                Err(FileError::new(model.as_deref().unwrap_or(Path::new("")), message).into())
            }
        }
    }

    /// The calls of the command line, in the state of the task.
    fn asked_by_name(&self, calls: &[String], input: &ModelInput, quiet: bool) -> Result<Vec<Asked>, Failure> {
        let learned = self.learned(input)?;
        let state = self.task.as_ref().map(|task| state_of(input, learned, task, quiet)).transpose()?;
        let asked = calls.iter().map(|text| {
            let atom = GroundAtom::parse(text).map_err(|error| {
                Failure::new(Exit::Usage, error).with_hint("A call is written as PICK(agent_1, counter_3, lettuce_1).")
            })?;
            let call = GroundCall { name: atom.predicate, args: atom.args };
            let hierarchy = &learned.model.hierarchy;
            let ty = |arg: &Symbol| {
                let in_state = state.as_ref().and_then(|state| state.objects.get(arg).copied());
                in_state.or_else(|| type_by_name(hierarchy, arg))
            };
            let types = call.args.iter().map(ty).collect();
            Ok(Asked { types, state: state.clone(), call })
        });
        asked.collect()
    }
}

/// Says why nothing is known of a call: of its name, its number of arguments, or the type of one of them.
fn say_what_is_unknown(call: &GroundCall, types: &[Option<TypeId>], model: &ActionModel) {
    let mut of_name = model.actions.iter().map(|schema| &schema.call).filter(|known| known.name == call.name);
    let hint = match (of_name.next(), types.iter().position(Option::is_none)) {
        (None, _) => {
            let names: BTreeSet<&Symbol> = model.actions.iter().map(|schema| &schema.call.name).collect();
            let near = did_you_mean(call.name.as_str(), names.iter().copied());
            near.unwrap_or_else(|| {
                let names: Vec<&str> = names.iter().map(|name| name.as_str()).collect();
                format!("The calls of this model are {}.", names.join(", "))
            })
        }
        (Some(known), _) if known.args.len() != call.args.len() => {
            format!("{} takes {}.", call.name, count(known.args.len() as u64, "argument"))
        }
        (Some(_), Some(at)) => {
            let (name, hierarchy) = (call.args[at].as_str(), &model.hierarchy);
            let near = did_you_mean(name, hierarchy.types().map(|ty| hierarchy.name(ty)));
            let near = near.map(|near| format!(" {near}")).unwrap_or_default();
            format!("Nothing says of which type `{name}` is: name a type, or a task that has it with --task.{near}")
        }
        (Some(_), None) => return,
    };
    anstream::eprintln!("{HINT}hint{HINT:#}: {hint}");
}

/// Says of which arguments of a call nothing is known, since the state does not have them: they were taken for things of
/// the types of their names.
fn say_what_is_not_there(call: &GroundCall, types: &[Option<TypeId>], state: &State, model: &ActionModel) {
    let hierarchy = &model.hierarchy;
    let missing = call
        .args
        .iter()
        .zip(types)
        .filter(|(arg, _)| !state.objects.contains_key(*arg) && !model.constants.contains_key(*arg));
    for (arg, ty) in missing.filter_map(|(arg, ty)| Some((arg, (*ty)?))) {
        let of_type = state.objects.iter().filter(|(_, other)| hierarchy.is_a(**other, ty));
        let names: Vec<&str> = of_type.map(|(name, _)| name.as_str()).take(MOST_NAMED).collect();
        let ty = hierarchy.name(ty);
        let there = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        anstream::eprintln!(
            "{HINT}hint{HINT:#}: `{arg}` is not in the state, so nothing that holds of it is known; of type {ty} there: {there}"
        );
    }
}

fn state_of(input: &ModelInput, learned: &LearnedModel, task: &Path, quiet: bool) -> Result<State, Failure> {
    let text = read_text(task)?;
    let mut parser =
        Parser::new(learned.model.hierarchy.clone(), learned.parse.clone()).knowing(&learned.model.predicates);
    if is_trace(&text) {
        let read = TraceReader::new(task, text.as_bytes()).and_then(|reader| trace_from(task, reader, &mut parser))?;
        // A trace that was read has a state.
        return Ok(read.states.into_iter().next_back().unwrap_or_default());
    }
    match input.task_from_text(task, &text, quiet)? {
        TaskInput::Problem(problem) => Ok(problem.1.init),
        TaskInput::File(file) => {
            let task_read = file.task(&mut parser, &learned.model.predicates);
            task_read.map(|task| task.init).map_err(|error| Failure::from(error.in_file(task, &parser)))
        }
    }
}

/// The type that an object's name says: itself, or itself without a number.
fn type_by_name(hierarchy: &Hierarchy, object: &Symbol) -> Option<TypeId> {
    let name = object.as_str();
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let stem = if stem.len() < name.len() { stem.trim_end_matches(['_', '-']) } else { name };
    hierarchy.id(name).or_else(|| hierarchy.id(stem))
}

/// The calls of a file, a line each.
fn asked_in_file(path: &Path, learned: &LearnedModel) -> Result<Vec<Asked>, Failure> {
    let text = read_text(path)?;
    let hierarchy = &learned.model.hierarchy;
    let mut parser = Parser::new(hierarchy.clone(), learned.parse.clone()).knowing(&learned.model.predicates);
    let mut asked = Vec::new();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let question: CallQuestion =
            serde_json::from_str(line).map_err(|error| FileError::at_line(path, number + 1, json_message(&error)))?;
        let state = question.state.as_ref().map(|scene| parser.parse(scene)).transpose();
        let state = state.map_err(|error| FileError::at_line(path, number + 1, error.to_string()))?;
        let ty = |arg: &Symbol| match question.types.get(arg) {
            Some(ty) => hierarchy.id(ty.as_str()),
            None => state.as_ref().and_then(|state| state.objects.get(arg).copied()),
        };
        let types = question.call.args.iter().map(ty).collect();
        asked.push(Asked { types, state, call: question.call });
    }
    Ok(asked)
}
