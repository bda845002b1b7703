//! `typelift export`.

use std::collections::BTreeMap;
use std::fs::create_dir_all;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use typelift::imagine::imagine;
use typelift::model::{ActionModel, Budget, PddlNames, Symbol, Task, strict};
use typelift::pddl::{ExportNames, ExportOptions, Exported, export};
use typelift::plan::Restrictions;
use typelift::world::{FileError, write_file};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{domain_name, keep_inputs, read_model_input, task_name};
use crate::planner_option::LevelArgument;
use crate::style::count;

/// Write a model, and a task for it, as files that other planners read
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift export kitchen.json K/tasks/T1.1.json -o lettuce
  typelift export kitchen.json K/tasks/T4.1.json --imagine --level strips -o apple
  typelift export kitchen.json -o kitchen

Writes domain.pddl, problem.pddl if there is a task, and names.json, which says
what the names in a plan stand for. Other planners read them, as

  fast-downward --alias lama-first lettuce/domain.pddl lettuce/problem.pddl
  pyperplan -H hadd -s ehs apple/domain.pddl apple/problem.pddl")]
pub(crate) struct Export {
    /// The model, as `learn` wrote it, or a PDDL domain
    model: PathBuf,
    /// A task with the state to plan from, or a PDDL problem
    task: Option<PathBuf>,
    /// The language
    #[arg(long, value_enum, default_value_t = Format::Pddl)]
    format: Format,
    /// How much of the language the planner knows
    #[arg(long, value_enum, default_value_t = LevelArgument::Adl)]
    level: LevelArgument,
    /// A file with more types
    #[arg(long, value_name = "FILE")]
    types: Option<PathBuf>,
    /// Add the actions that are imagined for the task
    #[arg(long, requires = "task")]
    imagine: bool,
    /// Let an action be used also where some of its effects hold already
    #[arg(long)]
    plain: bool,
    /// The folder to write to; made if it is not there
    #[arg(long, short, value_name = "DIR")]
    output: PathBuf,
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

impl Export {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        let Format::Pddl = self.format;
        let files = ["domain.pddl", "problem.pddl", "names.json"].map(|name| self.output.join(name));
        for file in &files {
            keep_inputs(Some(file), [&self.model].into_iter().chain(&self.task).chain(&self.types))?;
        }
        let input = read_model_input(&self.model, self.types.as_ref())?;
        let (model, task) = match &self.task {
            Some(path) => input.read_planning_task(path, quiet).map(|(model, task)| (model, Some(task)))?,
            None => (input.model().clone(), None),
        };
        let model = self.model_to_export(model, task.as_ref())?;
        let options = ExportOptions {
            domain: domain_name(&self.model),
            problem: Symbol::from(self.task.as_deref().map(task_name).unwrap_or_default()),
            level: self.level.into(),
        };
        let Exported { domain, problem, names } = export(&model, task.as_ref(), &options)?;
        self.make_folder()?;
        let [domain_file, problem_file, names_file] = &files;
        let mut out = anstream::stdout().lock();
        write_file(domain_file, domain.to_string().as_bytes())?;
        let imagined = model.actions.iter().filter(|action| action.provenance.imagined().is_some()).count();
        let imagined = if imagined == 0 { String::new() } else { format!(", {imagined} imagined") };
        let actions = count(domain.actions.len() as u64, "action");
        let predicates = count(domain.predicates.len() as u64, "predicate");
        writeln!(out, "wrote {}: {actions}{imagined}, {predicates}", domain_file.display())?;
        if let Some(problem) = problem {
            write_file(problem_file, problem.to_string().as_bytes())?;
            let objects = count((problem.objects.len() + domain.constants.len()) as u64, "object");
            let facts = count(problem.init.len() as u64, "fact");
            writeln!(out, "wrote {}: {objects}, {facts}", problem_file.display())?;
        }
        write_file(names_file, names_text(&names).as_bytes())?;
        writeln!(out, "wrote {}", names_file.display())?;
        Ok(Exit::Success)
    }

    /// The model with what is imagined for the task, strict unless that is not wanted.
    fn model_to_export(&self, model: ActionModel, task: Option<&Task>) -> Result<ActionModel, Failure> {
        let model = match task {
            Some(task) if self.imagine => {
                let nothing_failed = Restrictions::default();
                imagine(&model, task, &nothing_failed, &Default::default(), &Budget::unlimited())?.added_to(&model)
            }
            _ => model,
        };
        Ok(if self.plain { model } else { strict(&model) })
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
