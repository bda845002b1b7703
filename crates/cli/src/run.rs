//! `typelift run`.

use std::fs::File;
use std::io::{BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use clap::ValueEnum;
use typelift::agent::{Confirmation, Ending, Episode, Experience, Options, run};
use typelift::bridge::Bridge;
use typelift::model::{ActionModel, Plan, State, Stop, Task};
use typelift::world::{FileError, Parser, Reset, Scene, TaskFile, World, WorldError};
use typelift_kitchen::Kitchen;

use crate::account::{broken_off, report, summary};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{TaskInput, keep_inputs, task_name};
use crate::goal_check::GoalCheck;
use crate::limits::{Clock, Interrupt};
use crate::narrate::Narrator;
use crate::plan_text::numbered_steps;
use crate::planning_options::PlanningOptions;
use crate::quantities::{parse_duration, parse_whole};
use crate::style::HEAD;

/// Expansions of one search, unless the user says otherwise: an agent that acts must not think for ever.
const EXPANSIONS: u64 = 200_000;

/// How often it is looked whether Ctrl-C was pressed while an answer is waited for.
const ANSWER_INTERVAL: Duration = Duration::from_millis(50);

/// Carry out tasks in an environment
#[derive(Debug, clap::Args)]
#[command(group = clap::ArgGroup::new("environment").required(true).args(["kitchen", "env"]))]
#[command(after_help = "Examples:
  typelift run kitchen.json K/tasks/T4.1.json --kitchen --imagine
  typelift run kitchen.json K/faults/*.json --kitchen --imagine --json
  typelift run model.json task.json --env 'python3 robot.py' --imagine --confirm

Tasks may be problems of a PDDL domain; the environment is then told the file,
as scenario {\"problem\": FILE}.

Each step's outcome is compared with what was expected. After a failure it
excludes, imagines, plans again and remembers, also for the tasks after it. One
search expands at most 200,000 nodes unless --max-expansions says otherwise.

Exit codes: 0 every goal was seen to hold, 12 not every one, 31 bad input,
35 the environment failed, 36 wrong usage, 38 the other planner failed, 39 its
plan is not valid.")]
pub(crate) struct Run {
    /// Tasks, in order
    #[arg(required = true, value_name = "TASK", index = 2)]
    tasks: Vec<PathBuf>,
    /// Act in the built-in kitchen simulator
    #[arg(long)]
    kitchen: bool,
    /// Act in the environment that this command is: it speaks env/1 on its standard input and output
    #[arg(long, value_name = "COMMAND", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    env: Option<String>,
    /// Wait so long for an answer: hello (10s), reset (60s), observe (10s), act (300s), close (2s)
    #[arg(long, value_name = "OP=TIME,…", value_delimiter = ',', value_parser = parse_timeout, requires = "env")]
    env_timeout: Vec<(Operation, Duration)>,
    /// The seed that the environment is reset with, instead of the task's
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// Ask before a plan is executed: only one that rests on imagined actions, or any [default: imagined]
    #[arg(long, value_name = "WHICH", num_args = 0..=1, require_equals = true, default_missing_value = "imagined")]
    confirm: Option<Which>,
    /// After a failure set the environment back and plan from the start, as the paper does
    #[arg(long)]
    restart: bool,
    /// Try a failed step again so often [default: 1, with --restart 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    retries: Option<u32>,
    /// Propose at most this many plans a task
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = parse_whole, allow_negative_numbers = true)]
    max_proposals: u64,
    /// Write everything that happens to this file, one JSON object a line
    #[arg(long, value_name = "FILE")]
    events: Option<PathBuf>,
    #[command(flatten)]
    planning: PlanningOptions,
}

/// What an environment can be asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Operation {
    Hello,
    Reset,
    Observe,
    Act,
    Close,
}

fn parse_timeout(text: &str) -> Result<(Operation, Duration), String> {
    let (operation, time) = text.split_once('=').ok_or("write for example hello=60s,act=10m")?;
    let operation = Operation::from_str(operation, true)
        .map_err(|_| format!("there is no `{operation}`; there are hello, reset, observe, act and close"))?;
    Ok((operation, parse_duration(time)?))
}

/// Which plans are to be confirmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Which {
    // Those with imagined steps.
    Imagined,
    All,
}

impl Run {
    pub(crate) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let interrupt = Interrupt::install()?;
        keep_inputs(self.events.as_deref(), self.tasks.iter().chain(self.planning.model.files()))?;
        let input = self.planning.model.read()?;
        let (learned, parse) = (Arc::new(input.model().clone()), input.parse());
        let mut tasks = Vec::with_capacity(self.tasks.len());
        for path in &self.tasks {
            tasks.push(match input.read_task(path, quiet)? {
                TaskInput::File(file) => {
                    (path, Arc::clone(&learned), self.reset(&file), Task::new(State::default(), file.goal))
                }
                TaskInput::Problem(problem) => (path, Arc::new(problem.0), self.reset_to_problem(path), problem.1),
            });
        }
        let options = self.options(input.is_given())?;
        let mut world = self.open(&interrupt)?;
        if self.restart && !world.can_reset() {
            return Err(Failure::bad_input(format!("--restart: {} cannot be reset", world.name()))
                .with_hint("Without --restart it goes on from where it is."));
        }
        // Only now, so that what an earlier run wrote there is kept when this one cannot begin.
        let events = match &self.events {
            None => None,
            Some(path) => Some(BufWriter::new(File::create(path).map_err(|e| FileError::from_write(path, &e))?)),
        };
        let mut narrator = Narrator::new(!quiet && !self.planning.json, events);
        let mut experience = Experience::new();
        let mut out = anstream::stdout().lock();
        let mut all_solved = true;
        for (path, model, reset, task) in tasks {
            let name = task_name(path);
            if narrator.aloud {
                anstream::eprintln!("{HEAD}{name}{HEAD:#}");
            }
            narrator.planning = Duration::ZERO;
            let budget = self.planning.limits.budget(clock, &interrupt, Some(EXPANSIONS));
            let mut episode =
                Episode::new(Arc::clone(&model), task.goal.clone(), options.clone(), experience.clone(), budget)
                    .with_values(task.values);
            let mut parser = Parser::new(model.hierarchy.clone(), parse.clone());
            let goal = task.goal.literals().map(|(atom, _)| atom.clone()).collect();
            let mut checked = GoalCheck { world: &mut *world, model: &model, parse: &parse, goal, error: None };
            let mut confirm = |plan: &Plan| self.confirm(plan, &model, &interrupt);
            let ran = run(&mut episode, &mut checked, &reset, &mut parser, &mut confirm, &mut narrator);
            if let Some(error) = checked.error {
                return Err(error.in_file(path, &parser).into());
            }
            if interrupt.is_set() && ran.is_err() {
                return Ok(Exit::Interrupted);
            }
            if let (true, Err(error)) = (self.planning.json, &ran) {
                writeln!(out, "{}", broken_off(&name, &error.to_string()))?;
            }
            let account = ran.map_err(|error| Failure::from(error).in_file(path))?;
            if let Some(error) = narrator.events_error.take() {
                return Err(Failure::bad_input(format!("--events: {error}")));
            }
            experience = episode.experience().clone();
            all_solved &= account.solved();
            if self.planning.json {
                let report = report(&name, &account, &experience, narrator.planning.as_secs_f64());
                writeln!(out, "{}", serde_json::to_string(&report).unwrap_or_default())?;
            } else {
                write!(out, "{}", summary(&name, &account, narrator.planning.as_millis()))?;
            }
            out.flush()?;
            if account.ending == Ending::Stopped(Stop::Cancelled) {
                world.close()?;
                return Ok(if interrupt.is_set() { Exit::Interrupted } else { Exit::NotAchieved });
            }
        }
        world.close()?;
        Ok(if all_solved { Exit::Success } else { Exit::NotAchieved })
    }

    fn open(&self, interrupt: &Interrupt) -> Result<Box<dyn World>, Failure> {
        let Some(command) = &self.env else { return Ok(Box::new(Kitchen::new())) };
        let mut limits = typelift::bridge::Options::default();
        for &(operation, limit) in &self.env_timeout {
            match operation {
                Operation::Hello => limits.hello = limit,
                Operation::Reset => limits.reset = limit,
                Operation::Observe => limits.observe = limit,
                Operation::Act => limits.act = limit,
                Operation::Close => limits.close = limit,
            }
        }
        let stderr = |line: &str| anstream::eprintln!("{line}");
        let bridge = Bridge::spawn_stoppable(command, limits, stderr, |stopper| {
            interrupt.on_raised(move || stopper.stop());
        });
        match bridge {
            Ok(bridge) => Ok(Box::new(bridge)),
            Err(_) if interrupt.is_set() => Err(Failure::new(Exit::Interrupted, "stopped")),
            Err(error) => Err(WorldError::from(error).into()),
        }
    }

    fn options(&self, is_given: bool) -> Result<Options, Failure> {
        Ok(Options {
            restart: self.restart,
            retries: self.retries,
            max_proposals: self.max_proposals,
            ..self.planning.agent_options(is_given)?
        })
    }

    /// How the environment is set up: as the task says, or, in the kitchen, from the state that it gives.
    fn reset(&self, task: &TaskFile) -> Reset {
        let from_state = || match &task.state {
            Some(state @ Scene::Snapshot(_)) if self.kitchen => Some(serde_json::json!({ "state": state })),
            _ => None,
        };
        Reset { seed: self.seed.or(task.seed).unwrap_or(0), scenario: task.scenario.clone().or_else(from_state) }
    }

    /// How the environment is set up for a PDDL problem: it is told the file.
    fn reset_to_problem(&self, path: &Path) -> Reset {
        let scenario = serde_json::json!({ "problem": path.display().to_string() });
        Reset { seed: self.seed.unwrap_or(0), scenario: Some(scenario) }
    }

    /// Asks whoever is at the terminal.
    fn confirm(&self, plan: &Plan, model: &ActionModel, interrupt: &Interrupt) -> Confirmation {
        let imagined = plan.steps.iter().position(|step| step.imagined.is_some());
        let ask = match self.confirm {
            None => false,
            Some(Which::Imagined) => imagined.is_some(),
            Some(Which::All) => true,
        };
        if !ask {
            return Confirmation::Approve;
        }
        anstream::eprint!("{}", numbered_steps(plan, &model.hierarchy));
        loop {
            anstream::eprint!("execute? [y]es, [n]o, not step N (n N), [s]top: ");
            let Some(answer) = answer(interrupt) else {
                anstream::eprintln!("no answer: stopped");
                return Confirmation::Stop;
            };
            if !std::io::stdin().is_terminal() {
                anstream::eprintln!("{}", answer.trim());
            }
            let mut words = answer.split_whitespace();
            match (words.next(), words.next().map(str::parse::<usize>)) {
                (Some("y" | "yes"), None) => return Confirmation::Approve,
                (Some("s" | "stop"), None) => return Confirmation::Stop,
                (Some("n" | "no"), step) => {
                    let step = step.unwrap_or(Ok(imagined.unwrap_or(0) + 1));
                    if let Ok(step @ 1..) = step
                        && step <= plan.len()
                    {
                        return Confirmation::Reject { step, reason: "rejected by a person".to_owned() };
                    }
                }
                _ => {}
            }
        }
    }
}

/// A line from whoever is at the terminal. None at its end, or as soon as Ctrl-C is pressed: a line is waited for in
/// another thread, since nothing else ends that.
fn answer(interrupt: &Interrupt) -> Option<String> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut line = String::new();
        let read = std::io::stdin().read_line(&mut line);
        // Nobody waits any more after Ctrl-C.
        let _ = sender.send(read.is_ok_and(|bytes| bytes > 0).then_some(line));
    });
    loop {
        match receiver.recv_timeout(ANSWER_INTERVAL) {
            _ if interrupt.is_set() => return None,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return None,
            Ok(line) => return line,
        }
    }
}
