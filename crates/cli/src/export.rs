//! `typelift export`.

use std::collections::BTreeMap;
use std::fs::create_dir_all;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use typelift::model::{PddlNames, Symbol};
use typelift::pddl::{ExportNames, ExportOptions, Exported, export};
use typelift::words::count;
use typelift::world::{FileError, write_file};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::task_name;
use crate::limits::{Clock, Interrupt, Limits};
use crate::overwriting::{Output, keep_inputs};
use crate::planner_option::LevelArgument;
use crate::planning_options::ModelArguments;
use crate::watchdog::within;

/// Write a model, and a task for it, as files that other planners read
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift export kitchen.json K/tasks/T1.1.json -o lettuce
  typelift export kitchen.json K/tasks/T4.1.json --imagine --level strips -o A
  typelift export kitchen.json --name my-kitchen -o kitchen

Writes domain.pddl, problem.pddl if there is a task, and names.json, which says
what the names in a plan stand for. Other planners read them, as

  fast-downward --alias lama-first lettuce/domain.pddl lettuce/problem.pddl
  pyperplan -H hadd -s ehs A/domain.pddl A/problem.pddl

Exit codes: 0 done, 22 out of memory, 23 out of time, 31 bad input,
34 the planner's language cannot say it, 36 wrong usage.")]
pub(crate) struct Export {
    #[command(flatten)]
    model: ModelArguments,
    /// A task with the state to plan from, or a PDDL problem
    #[arg(index = 2)]
    task: Option<PathBuf>,
    /// The name of the exported domain [default: that of a PDDL domain, or else the file's]
    #[arg(long, value_parser = parse_domain_name)]
    name: Option<Symbol>,
    /// The language
    #[arg(long, value_enum, default_value_t = Format::Pddl)]
    format: Format,
    /// How much of the language the planner knows
    #[arg(long, value_enum, default_value_t = LevelArgument::Adl)]
    level: LevelArgument,
    /// The folder to write to; made if it is not there
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    limits: Limits,
}

/// Reads a name that a domain may have.
fn parse_domain_name(text: &str) -> Result<Symbol, String> {
    let is_name = text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
    if is_name { Ok(Symbol::new(text)) } else { Err("write a letter, then letters, digits, - and _".to_owned()) }
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Format {
    /// A domain and a problem in PDDL
    Pddl,
}

/// What `names.json` holds: for each name in PDDL the model's.
#[derive(Serialize)]
struct NamesFile<'a> {
    format: &'static str,
    actions: BTreeMap<&'a Symbol, &'a Symbol>,
    objects: BTreeMap<&'a Symbol, &'a Symbol>,
}

/// What is printed with `--json`.
#[derive(Serialize)]
struct Report {
    files: Vec<String>,
    #[serde(flatten)]
    counts: Counts,
}

/// How much was exported.
#[derive(Serialize)]
struct Counts {
    actions: usize,
    imagined_actions: usize,
    predicates: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    objects: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    facts: Option<usize>,
}

impl Counts {
    fn new(exported: &Exported, imagined_actions: usize) -> Self {
        let Exported { domain, problem, .. } = exported;
        let problem = problem.as_ref();
        Self {
            actions: domain.actions.len(),
            imagined_actions,
            predicates: domain.predicates.len(),
            objects: problem.map(|problem| problem.objects.len() + domain.constants.len()),
            facts: problem.map(|problem| problem.init.len()),
        }
    }

    /// What is said of each file that is written, in their order.
    fn texts(&self) -> Vec<String> {
        let count = |n: usize, singular: &str| count(n as u64, singular);
        let imagined = match self.imagined_actions {
            0 => String::new(),
            imagined => format!(", {imagined} imagined"),
        };
        let (actions, predicates) = (count(self.actions, "action"), count(self.predicates, "predicate"));
        let mut texts = vec![format!(": {actions}{imagined}, {predicates}")];
        if let (Some(objects), Some(facts)) = (self.objects, self.facts) {
            texts.push(format!(": {}, {}", count(objects, "object"), count(facts, "fact")));
        }
        texts.push(String::new());
        texts
    }
}

impl Export {
    pub(crate) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let Format::Pddl = self.format;
        if self.model.imagine && self.task.is_none() {
            return Err(Failure::new(Exit::Usage, "--imagine: there is no task to imagine actions for"));
        }
        let files = ["domain.pddl", "problem.pddl", "names.json"].map(|name| self.output.join(name));
        keep_inputs(files.iter().map(|file| Output::File(file)), self.model.files().chain(&self.task))?;
        let (exported, imagined) = within(clock, self.limits, || self.export(clock, quiet))?;
        self.make_folder()?;
        let mut written = vec![(&files[0], exported.domain.to_string())];
        if let Some(problem) = &exported.problem {
            written.push((&files[1], problem.to_string()));
        }
        written.push((&files[2], names_text(&exported.names)));
        for (path, text) in &written {
            write_file(path, text.as_bytes())?;
        }
        let counts = Counts::new(&exported, imagined);
        let files: Vec<String> = written.iter().map(|(path, _)| path.display().to_string()).collect();
        let mut out = anstream::stdout().lock();
        if self.json {
            writeln!(out, "{}", serde_json::to_string_pretty(&Report { files, counts }).unwrap_or_default())?;
            return Ok(Exit::Success);
        }
        for (file, counts) in files.iter().zip(counts.texts()) {
            writeln!(out, "wrote {file}{counts}")?;
        }
        Ok(Exit::Success)
    }

    /// What is to be written, and how many actions of it are imagined.
    fn export(&self, clock: Clock, quiet: bool) -> Result<(Exported, usize), Failure> {
        let input = self.model.read(quiet)?;
        let name = || input.domain_name(&self.model.model);
        let domain = self.name.clone().unwrap_or_else(name);
        let (model, task) = match &self.task {
            Some(path) => input.read_planning_task(path, quiet).map(|(model, task)| (model, Some(task)))?,
            None => (input.model().clone(), None),
        };
        let budget = self.limits.budget(clock, &Interrupt::default());
        let model = self.model.as_used(model, task.as_ref(), &budget)?;
        let options = ExportOptions {
            domain,
            problem: Symbol::from(self.task.as_deref().map(task_name).unwrap_or_default()),
            level: self.level.into(),
        };
        let imagined = model.actions.iter().filter(|action| action.provenance.imagined().is_some()).count();
        Ok((export(&model, task.as_ref(), &options)?, imagined))
    }

    fn make_folder(&self) -> Result<(), Failure> {
        let folder: &Path = &self.output;
        if folder.exists() && !folder.is_dir() {
            return Err(FileError::new(folder, "this is a file, not a folder").into());
        }
        create_dir_all(folder).map_err(|error| FileError::from_write(folder, &error).into())
    }
}

fn names_text(names: &ExportNames) -> String {
    fn inverse(names: &PddlNames) -> BTreeMap<&Symbol, &Symbol> {
        names.iter().map(|(name, pddl)| (pddl, name)).collect()
    }
    let file = NamesFile { format: "names/1", actions: inverse(&names.actions), objects: inverse(&names.objects) };
    // Names are text, which always becomes JSON.
    let mut text = serde_json::to_string_pretty(&file).unwrap_or_default();
    text.push('\n');
    text
}
