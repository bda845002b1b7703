//! A planner in a child process: task and model are written as PDDL, its plan is read.
//!
//! It implements [`ExternalPlanner`], which the agent is handed in its options: so the agent needs to know nothing of
//! processes.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;
use thiserror::Error;
use typelift_model::{ActionModel, Budget, Plan, Step, Stop, Symbol, Task};
use typelift_pddl::{ExportNames, ExportOptions, Exported, Level, PlanLine, UnknownName, export, read_plan};
use typelift_plan::{ExternalFailure, ExternalPlanner, Outcome, PlanDefect, StepDefect};

use crate::error::shorten;
use crate::process::Process;
use crate::shell::shell_hint;

/// How long a planner may take to end when it is asked to.
const GRACE: Duration = Duration::from_secs(1);

/// How often it is looked whether the planner has ended.
const INTERVAL: Duration = Duration::from_millis(20);

/// How much later than the planner the budget may tell of a signal that was sent to both.
const LATENESS: Duration = Duration::from_millis(250);

/// Lines of what the planner printed that are told when it fails.
const TOLD: usize = 5;

/// Bytes at the end of what the planner printed in which those lines are looked for.
const LAST_BYTES: u64 = 64 << 10;

/// Bytes that a plan file may have: hundreds of thousands of steps.
const PLAN_LIMIT: u64 = 16 << 20;

/// Bytes that are held, at most, for each byte of a plan file while it is read.
const HELD_FOR_A_BYTE: u64 = 32;

/// How the names of the folders of requests begin: should this program be killed, they tell whose they are.
const FOLDER: &str = "typelift-planner-";

/// The file in such a folder that is locked as long as the folder is in use.
const LOCK: &str = ".lock";

/// A command that plans: `fast-downward --alias lama-first --plan-file {plan} {domain} {problem}`.
///
/// The command runs in an empty folder. The plan is read from `{plan}`; if that is not there, from the last of
/// `{plan}.1`, `{plan}.2`, …, or from what it left beside the problem, `sas_plan` or `problem.pddl.soln`.
#[derive(Debug, Clone)]
pub struct PlannerCommand {
    /// As it was given.
    command_line: String,
    words: Vec<String>,
    level: Level,
}

/// The files of one request.
struct Exchange {
    folder: TempDir,
    /// Held as long as the folder is in use.
    _lock: File,
    names: ExportNames,
}

/// Why a command line is none of a planner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum PlannerCommandError {
    /// A quotation mark has no partner.
    #[error("the command ends within a quotation")]
    OpenQuotation,
    /// It is empty.
    #[error("the command names no program")]
    NoProgram,
    /// The planner could not find one of the files that it needs.
    #[error("the command says nowhere where the planner finds {place}")]
    NoPlace {
        /// What stands for the file: `{domain}` or `{problem}`.
        place: &'static str,
    },
}

impl PlannerCommand {
    /// Reads a command line, with quotation marks as in a shell.
    ///
    /// # Errors
    /// [`PlannerCommandError`]
    pub fn new(command_line: &str, level: Level) -> Result<Self, PlannerCommandError> {
        let words = shlex::split(command_line).ok_or(PlannerCommandError::OpenQuotation)?;
        if words.is_empty() {
            return Err(PlannerCommandError::NoProgram);
        }
        for place in ["{domain}", "{problem}"] {
            if !words.iter().any(|word| word.contains(place)) {
                return Err(PlannerCommandError::NoPlace { place });
            }
        }
        // The command runs elsewhere. Links stay: a virtual environment's interpreter is known by the place of its link.
        let here = |word: String| match std::path::absolute(&word) {
            Ok(path) if word.contains('/') && path.exists() => path.to_string_lossy().into_owned(),
            _ => word,
        };
        let command_line = command_line.to_owned();
        Ok(Self { command_line, words: words.into_iter().map(here).collect(), level })
    }

    fn program(&self) -> String {
        self.words[0].rsplit('/').next().unwrap_or_default().to_owned()
    }

    fn write(&self, model: &ActionModel, task: &Task) -> Result<Exchange, ExternalFailure> {
        let failed = |error: &dyn std::fmt::Display| ExternalFailure::NotAsked { reason: error.to_string() };
        let options = ExportOptions { domain: "model".into(), problem: "task".into(), level: self.level };
        let Exported { domain, problem, names } = export(model, Some(task), &options).map_err(|e| failed(&e))?;
        let (folder, lock) = new_folder().map_err(|e| failed(&e))?;
        let write = |name: &str, text: String| fs::write(folder.path().join(name), text).map_err(|e| failed(&e));
        write("domain.pddl", domain.to_string())?;
        write("problem.pddl", problem.map(|problem| problem.to_string()).unwrap_or_default())?;
        Ok(Exchange { folder, _lock: lock, names })
    }

    fn start(&self, exchange: &Exchange) -> io::Result<Process> {
        let path = |name: &str| exchange.path(name).to_string_lossy().into_owned();
        let filled = |word: &String| {
            word.replace("{domain}", &path("domain.pddl"))
                .replace("{problem}", &path("problem.pddl"))
                .replace("{plan}", &path("plan"))
        };
        let words: Vec<String> = self.words.iter().map(filled).collect();
        let log = File::create(exchange.path("log"))?;
        let mut command = Command::new(&words[0]);
        command.args(&words[1..]).current_dir(exchange.folder.path());
        command.stdin(Stdio::null()).stdout(log.try_clone()?).stderr(log);
        Process::start_alone(&mut command)
    }

    /// The plan that the planner left, read within the limits.
    fn plan_left(
        &self,
        exchange: &Exchange,
        file: &Path,
        (model, task): (&ActionModel, &Task),
        budget: &Budget,
    ) -> Result<Outcome, ExternalFailure> {
        let unusable = |defect| ExternalFailure::UnusablePlan { program: self.program(), defect };
        let length = fs::metadata(file).map_or(0, |data| data.len());
        if length > PLAN_LIMIT {
            let reason = format!("it is longer than {} MB", PLAN_LIMIT >> 20);
            return Err(unusable(PlanDefect::Unreadable { reason }));
        }
        if let Some(limit) = &budget.memory
            && (limit.probe)().saturating_add(length * HELD_FOR_A_BYTE) > limit.bytes
        {
            return Ok(Stop::Memory.into());
        }
        exchange.read(file, model, task).map(Outcome::Solved).map_err(unusable)
    }

    /// Why the planner left no plan.
    fn reason(
        &self,
        exchange: &Exchange,
        status: Option<ExitStatus>,
        stopped: Option<Stop>,
    ) -> Result<Outcome, ExternalFailure> {
        if let Some(stop) = stopped {
            return Ok(stop.into());
        }
        // Fast Downward's exit codes, which others have taken over.
        match status.and_then(|status| status.code()) {
            Some(10 | 11) => Ok(Outcome::Unsolvable),
            Some(12) => Ok(Outcome::Stopped(Stop::Expansions)),
            Some(20 | 22) => Ok(Outcome::Stopped(Stop::Memory)),
            Some(21 | 23) => Ok(Outcome::Stopped(Stop::Time)),
            _ => Err(ExternalFailure::NoAnswer { program: self.program(), status, last_words: exchange.last_words() }),
        }
    }
}

impl ExternalPlanner for PlannerCommand {
    fn plan(&self, model: &ActionModel, task: &Task, budget: &Budget) -> Result<Outcome, ExternalFailure> {
        let exchange = self.write(model, task)?;
        let process = self.start(&exchange).map_err(|error| ExternalFailure::NotStarted {
            program: self.words[0].clone(),
            reason: error.to_string(),
            hint: shell_hint(&self.command_line),
        })?;
        let mut stopped = None;
        while !process.wait(INTERVAL) {
            stopped = budget.stopped();
            if stopped.is_some() {
                break;
            }
        }
        let status = process.end(if stopped.is_some() { GRACE } else { Duration::ZERO });
        if let Some(file) = exchange.plan_file() {
            return self.plan_left(&exchange, &file, (model, task), budget);
        }
        match self.reason(&exchange, status, stopped) {
            Err(ExternalFailure::NoAnswer { .. }) if is_stopped_within(budget, LATENESS) => {
                Ok(Outcome::Stopped(Stop::Cancelled))
            }
            reason => reason,
        }
    }
}

/// A new folder for a request, with the lock in it; folders of programs that were killed are removed.
fn new_folder() -> io::Result<(TempDir, File)> {
    remove_left_behind(&std::env::temp_dir());
    let folder = tempfile::Builder::new().prefix(FOLDER).tempdir()?;
    let lock = File::create(folder.path().join(LOCK))?;
    // Not every file system knows locks; where there are none, nothing is taken for left behind.
    let _ = lock.lock();
    Ok((folder, lock))
}

/// Removes the folders of requests in `parent` that are in use no longer. If that fails they stay, which does no harm.
fn remove_left_behind(parent: &Path) {
    for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
        if !entry.file_name().to_string_lossy().starts_with(FOLDER) {
            continue;
        }
        if File::open(entry.path().join(LOCK)).is_ok_and(|lock| lock.try_lock().is_ok()) {
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

/// Whether somebody asks to stop, now or soon.
fn is_stopped_within(budget: &Budget, limit: Duration) -> bool {
    let begun = Instant::now();
    loop {
        if budget.stopped() == Some(Stop::Cancelled) {
            return true;
        }
        if begun.elapsed() >= limit {
            return false;
        }
        std::thread::sleep(INTERVAL);
    }
}

impl Exchange {
    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Where the plan is: of several, the last is the best.
    fn plan_file(&self) -> Option<PathBuf> {
        let is_there = |name: &str| Some(self.path(name)).filter(|path| path.is_file());
        let last_of = |name: &str| (1..).map_while(|n| is_there(&format!("{name}.{n}"))).last();
        let one_of = |name: &str| last_of(name).or_else(|| is_there(name));
        one_of("plan").or_else(|| one_of("sas_plan")).or_else(|| is_there("problem.pddl.soln"))
    }

    fn read(&self, file: &Path, model: &ActionModel, task: &Task) -> Result<Plan, PlanDefect> {
        let unreadable = |error: &dyn std::fmt::Display| PlanDefect::Unreadable { reason: error.to_string() };
        let text = fs::read_to_string(file).map_err(|error| unreadable(&error))?;
        let lines = read_plan(&text).map_err(|error| unreadable(&error))?;
        let step = |(i, line)| self.step(line, model, task).map_err(|defect| PlanDefect::Step { step: i + 1, defect });
        Ok(Plan { steps: lines.iter().enumerate().map(step).collect::<Result<_, _>>()? })
    }

    /// The step that a line stands for.
    fn step(&self, line: &PlanLine, model: &ActionModel, task: &Task) -> Result<Step, StepDefect> {
        let unknown = |kind, name: &str| StepDefect::UnknownName { kind, name: name.to_owned() };
        let args = line.args.iter().map(Symbol::as_str);
        let named = self.names.step(line.name.as_str(), args);
        let (action, objects) = named.map_err(|UnknownName { kind, name }| unknown(kind, &name))?;
        let schema = model.action(action.as_str()).ok_or_else(|| unknown("action", action.as_str()))?;
        if schema.parameters.len() != objects.len() {
            return Err(StepDefect::Arguments { action, expected: schema.parameters.len(), found: objects.len() });
        }
        let cost = schema.cost.of(&objects, &task.values).ok_or(StepDefect::NoCost { action })?;
        Ok(schema.step(objects, cost))
    }

    /// The last lines that the planner printed.
    fn last_words(&self) -> Vec<String> {
        // If the log cannot be read, there is nothing to tell.
        let mut log = Vec::new();
        let _ = File::open(self.path("log")).and_then(|mut file| {
            let length = file.metadata()?.len();
            file.seek(SeekFrom::Start(length.saturating_sub(LAST_BYTES)))?;
            file.take(LAST_BYTES).read_to_end(&mut log)
        });
        let text = String::from_utf8_lossy(&log);
        let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
        lines[lines.len().saturating_sub(TOLD)..].iter().map(|line| shorten(line)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_of_killed_programs_are_removed_and_no_others() {
        let parent = tempfile::tempdir().expect("a folder");
        let made = |name: &str, lock: bool| {
            let path = parent.path().join(name);
            fs::create_dir(&path).expect("a folder");
            (lock.then(|| File::create(path.join(LOCK)).expect("a file")), path)
        };
        let (in_use, used) = made("typelift-planner-a", true);
        in_use.as_ref().expect("a lock").lock().expect("locked");
        let left = made("typelift-planner-b", true).1;
        let kept = [used, made("typelift-planner-c", false).1, made("another-planner", true).1];
        remove_left_behind(parent.path());
        assert!(!left.exists());
        assert!(kept.iter().all(|path| path.exists()));
    }
}
