//! `typelift run`.

use std::fs::File;
use std::io::{BufRead, BufWriter, IsTerminal, Write};
use std::path::PathBuf;
use std::sync::Arc;

use clap::ValueEnum;
use serde::Serialize;
use typelift::agent::{Account, Confirmation, Ending, Episode, Experience, Options, run};
use typelift::bridge::Bridge;
use typelift::imagine;
use typelift::model::{ActionModel, GroundCall, Plan};
use typelift::plan::Exclusion;
use typelift::world::{Acted, FileError, Parser, Reset, Scene, TaskError, TaskFile, World, WorldError, check_goal};
use typelift_kitchen::Kitchen;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{read_model, read_run_task, task_name};
use crate::limits::{Clock, Interrupt, Limits};
use crate::narrate::Narrator;
use crate::plan_text::{numbered_steps, plan_size};
use crate::style::{BAD, DIM, GOOD, HEAD, count};

/// Expansions of one search, unless the user says otherwise: an agent that acts must not think for ever.
const EXPANSIONS: u64 = 200_000;

/// Carry out tasks in an environment
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift run kitchen.json K/tasks/T4.1.json --kitchen --imagine
  typelift run kitchen.json K/faults/*.json --kitchen --imagine --json
  typelift run model.json task.json --env 'python3 my_robot.py' --imagine --confirm

Each step's outcome is compared with what was expected. After a failure it excludes,
imagines, plans again and remembers, also for the tasks after it. One search expands at
most 200,000 nodes unless --max-expansions says otherwise.

Exit codes: 0 every goal was seen to hold, 12 not every one, 31 bad input,
35 the environment failed, 36 wrong usage.")]
pub(crate) struct Run {
    /// The model, as `learn` wrote it
    model: PathBuf,
    /// Tasks, in order
    #[arg(required = true, value_name = "TASK")]
    tasks: Vec<PathBuf>,
    /// Act in the built-in kitchen simulator
    #[arg(long, required_unless_present = "env", conflicts_with = "env")]
    kitchen: bool,
    /// Act in the environment that this command is: it speaks env/1 on its standard input and output
    #[arg(long, value_name = "COMMAND")]
    env: Option<String>,
    /// Add the types of this file to the model's
    #[arg(long, value_name = "FILE")]
    types: Option<PathBuf>,
    /// The seed that the environment is reset with, instead of the task's
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Imagine actions for goals that cannot be reached with the learned ones
    #[arg(long)]
    imagine: bool,
    /// Ask before a plan is executed: one that rests on imagined actions, or every one
    #[arg(long, value_name = "WHICH", num_args = 0..=1, default_missing_value = "imagined")]
    confirm: Option<Which>,
    /// After a failure set the environment back and plan from the start, as the paper does
    #[arg(long)]
    restart: bool,
    /// Try a failed step again so often [default: 1, with --restart 0]
    #[arg(long, value_name = "N")]
    retries: Option<u32>,
    /// Propose at most this many plans a task
    #[arg(long, value_name = "N", default_value_t = 12)]
    max_proposals: u64,
    /// Use an action also where some of its effects hold already
    #[arg(long)]
    plain: bool,
    /// Write everything that happens to this file, one JSON object a line
    #[arg(long, value_name = "FILE")]
    events: Option<PathBuf>,
    /// Print one JSON object a task instead
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    limits: Limits,
}

/// Which plans are to be confirmed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Which {
    /// Those with imagined steps
    Imagined,
    /// All
    All,
}

/// What is printed of a task with `--json`.
#[derive(Serialize)]
struct TaskReport<'a> {
    task: &'a str,
    solved: bool,
    ending: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<String>,
    proposals: u64,
    actions: u64,
    plan_length: Option<usize>,
    imagined_steps: Option<usize>,
    planning_seconds: f64,
    expansions: u64,
    ground_actions: u64,
    failures: Vec<FailureReport>,
    excluded: Vec<ExclusionReport>,
}

#[derive(Serialize)]
struct FailureReport {
    proposal: u64,
    step: usize,
    action: String,
    call: GroundCall,
    result: typelift::agent::StepResult,
    reason: Option<String>,
    imagined: bool,
}

#[derive(Serialize)]
struct ExclusionReport {
    object: String,
    from: Option<String>,
    reason: String,
    count: u64,
}

impl Run {
    pub(crate) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let interrupt = Interrupt::install()?;
        let model = Arc::new(read_model(&self.model, self.types.as_ref())?);
        let mut tasks = Vec::with_capacity(self.tasks.len());
        for path in &self.tasks {
            tasks.push((path, read_run_task(path)?));
        }
        let events = match &self.events {
            None => None,
            Some(path) => Some(BufWriter::new(File::create(path).map_err(|e| FileError::from_io(path, &e))?)),
        };
        let mut world = self.open(&interrupt)?;
        if self.restart && !world.can_reset() {
            return Err(Failure::bad_input(format!("--restart: {} cannot be reset", world.name()))
                .with_hint("without --restart it goes on from where it is"));
        }
        let mut narrator = Narrator::new(!quiet && !self.json, events);
        let mut experience = Experience::new();
        let mut out = anstream::stdout().lock();
        let mut all_solved = true;
        for (path, task) in tasks {
            let name = task_name(path);
            if narrator.aloud {
                anstream::eprintln!("{HEAD}{name}{HEAD:#}");
            }
            narrator.planning = std::time::Duration::ZERO;
            let budget = self.limits.with_default_expansions(EXPANSIONS).budget(clock, &interrupt);
            let mut episode =
                Episode::new(Arc::clone(&model), task.goal.clone(), self.options(), experience.clone(), budget);
            let mut parser = Parser::new(model.hierarchy.clone(), model.parse.clone());
            let mut checked = GoalCheck { world: &mut *world, model: &model, task: &task, error: None };
            let mut confirm = |plan: &Plan| self.confirm(plan, &model, &interrupt);
            let ran = run(&mut episode, &mut checked, &self.reset(&task), &mut parser, &mut confirm, &mut narrator);
            if let Some(error) = checked.error {
                return Err(error.in_file(path, &parser).into());
            }
            if interrupt.is_set() && ran.is_err() {
                return Ok(Exit::Interrupted);
            }
            let account = ran?;
            if let Some(error) = narrator.events_error.take() {
                return Err(Failure::bad_input(format!("--events: {error}")));
            }
            experience = episode.experience().clone();
            all_solved &= account.solved();
            if self.json {
                let report = report(&name, &account, &experience, narrator.planning.as_secs_f64());
                writeln!(out, "{}", serde_json::to_string(&report).unwrap_or_default())?;
            } else {
                write!(out, "{}", summary(&name, &account, narrator.planning.as_millis()))?;
            }
            out.flush()?;
            if account.ending == Ending::Stopped {
                world.close()?;
                return Ok(if interrupt.is_set() { Exit::Interrupted } else { Exit::NotAchieved });
            }
        }
        world.close()?;
        Ok(if all_solved { Exit::Success } else { Exit::NotAchieved })
    }

    fn open(&self, interrupt: &Interrupt) -> Result<Box<dyn World>, Failure> {
        let Some(command) = &self.env else { return Ok(Box::new(Kitchen::new())) };
        let bridge = Bridge::spawn(command, typelift::bridge::Options::default(), |line| anstream::eprintln!("{line}"));
        let bridge = bridge.map_err(WorldError::from)?;
        let stopper = bridge.stopper();
        interrupt.on_raised(move || stopper.stop());
        Ok(Box::new(bridge))
    }

    fn options(&self) -> Options {
        Options {
            imagine: self.imagine.then(imagine::Options::default),
            strict: !self.plain,
            restart: self.restart,
            retries: self.retries,
            max_proposals: self.max_proposals,
            ..Options::default()
        }
    }

    /// How the environment is set up: as the task says, or, in the kitchen, from the state that it gives.
    fn reset(&self, task: &TaskFile) -> Reset {
        let from_state = || match &task.state {
            Some(state @ Scene::Snapshot(_)) if self.kitchen => Some(serde_json::json!({ "state": state })),
            _ => None,
        };
        Reset { seed: self.seed.or(task.seed).unwrap_or(0), scenario: task.scenario.clone().or_else(from_state) }
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
        let mut input = std::io::stdin().lock();
        loop {
            anstream::eprint!("execute? [y]es, [n]o, not step N (n N), [s]top: ");
            let mut answer = String::new();
            if !matches!(input.read_line(&mut answer), Ok(read) if read > 0) || interrupt.is_set() {
                anstream::eprintln!("no answer: stopped");
                return Confirmation::Stop;
            }
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

/// A world whose first state is held against the task's goal.
struct GoalCheck<'a> {
    world: &'a mut dyn World,
    model: &'a ActionModel,
    task: &'a TaskFile,
    error: Option<TaskError>,
}

impl GoalCheck<'_> {
    fn checked(&mut self, scene: Scene) -> Result<Scene, WorldError> {
        let mut parser = Parser::new(self.model.hierarchy.clone(), self.model.parse.clone());
        // A scene that cannot be parsed is reported by whoever parses it next.
        if let Ok(state) = parser.parse(&scene)
            && let Err(error) = check_goal(&self.task.goal, &state, &self.model.predicates)
        {
            let message = error.to_string();
            self.error = Some(error);
            return Err(WorldError::new(message));
        }
        Ok(scene)
    }
}

impl World for GoalCheck<'_> {
    fn name(&self) -> String {
        self.world.name()
    }

    fn can_reset(&self) -> bool {
        self.world.can_reset()
    }

    fn reset(&mut self, reset: &Reset) -> Result<Scene, WorldError> {
        let scene = self.world.reset(reset)?;
        self.checked(scene)
    }

    fn observe(&mut self) -> Result<Scene, WorldError> {
        self.world.observe()
    }

    fn act(&mut self, call: &GroundCall) -> Result<Acted, WorldError> {
        self.world.act(call)
    }
}

/// How an episode ended, as a word and, if it is not solved, in words.
fn ending(account: &Account) -> (&'static str, Option<String>) {
    match &account.ending {
        Ending::Solved => ("solved", None),
        Ending::NoPlan(explanation) => ("no_plan", Some(format!("nothing left to try: {explanation}"))),
        Ending::ProposalLimit(n) => ("proposal_limit", Some(format!("gave up after {}", count(*n, "proposal")))),
        Ending::GaveUp => ("gave_up", Some("planning gave up at the limit of expansions".to_owned())),
        Ending::OutOfTime => ("out_of_time", Some("out of time".to_owned())),
        Ending::OutOfMemory => ("out_of_memory", Some("out of memory".to_owned())),
        Ending::Stopped => ("stopped", Some("stopped".to_owned())),
    }
}

fn exclusion_text(exclusion: &Exclusion) -> String {
    match &exclusion.call {
        None => exclusion.object.to_string(),
        Some(call) => format!("{} from {call}", exclusion.object),
    }
}

/// The account of a task, for people.
pub(crate) fn summary(name: &str, account: &Account, planning_ms: u128) -> String {
    let (_, why) = ending(account);
    let proposals = count(account.proposals, "proposal");
    let actions = count(account.actions, "action");
    let mut text = match &account.plan {
        Some(plan) if account.solved() && account.proposals == 0 && plan.is_empty() => {
            format!("{HEAD}{name}{HEAD:#}  {GOOD}solved{GOOD:#}: the goal held already\n")
        }
        Some(plan) if account.solved() => format!(
            "{HEAD}{name}{HEAD:#}  {GOOD}solved{GOOD:#}: {}, {proposals}, {actions} executed, planned in {planning_ms} ms\n",
            plan_size(plan)
        ),
        _ => format!(
            "{HEAD}{name}{HEAD:#}  {BAD}not solved{BAD:#}: {proposals}, {actions} executed, planned in {planning_ms} ms\n"
        ),
    };
    for failure in &account.failures {
        let reason = failure.reason.as_ref().map(|reason| format!(" ({reason})")).unwrap_or_default();
        text += &format!(
            "  {DIM}proposal {}, step {}{DIM:#}  {}: {}{reason}\n",
            failure.proposal,
            failure.step,
            failure.call,
            failure.result.phrase()
        );
        for exclusion in &failure.excluded {
            text += &format!("    excluded {}\n", exclusion_text(exclusion));
        }
    }
    if account.lifted {
        text += "  exclusions of earlier tasks were lifted, since nothing else was left\n";
    }
    if account.relaxed {
        text += "  actions were used although some of their effects held already, since nothing else was left\n";
    }
    for line in why.iter().flat_map(|why| why.lines()) {
        text += &format!("  {line}\n");
    }
    text
}

fn report<'a>(name: &'a str, account: &Account, experience: &Experience, seconds: f64) -> TaskReport<'a> {
    let (word, why) = ending(account);
    let plan = account.plan.as_ref().filter(|_| account.solved());
    TaskReport {
        task: name,
        solved: account.solved(),
        ending: word,
        why,
        proposals: account.proposals,
        actions: account.actions,
        plan_length: plan.map(Plan::len),
        imagined_steps: plan.map(|plan| plan.steps.iter().filter(|step| step.imagined.is_some()).count()),
        planning_seconds: seconds,
        expansions: account.expansions,
        ground_actions: account.ground_actions,
        failures: account
            .failures
            .iter()
            .map(|failure| FailureReport {
                proposal: failure.proposal,
                step: failure.step,
                action: failure.action.to_string(),
                call: failure.call.clone(),
                result: failure.result,
                reason: failure.reason.clone(),
                imagined: failure.imagined,
            })
            .collect(),
        excluded: experience
            .exclusions()
            .map(|(exclusion, remembered)| ExclusionReport {
                object: exclusion.object.to_string(),
                from: exclusion.call.as_ref().map(ToString::to_string),
                reason: remembered.reason.clone(),
                count: remembered.count,
            })
            .collect(),
    }
}
