//! `typelift run`.

use std::fs::{File, create_dir_all};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use clap::ValueEnum;
use typelift::agent::{BlameRule, Command, Ending, Episode, EpisodeError, Experience, Input, Options, RunError, run};
use typelift::model::{ActionModel, Observations, State, Stop, Symbol, Task};
use typelift::words::{AccountView, BrokenOffView, broken_off, summary};
use typelift::world::{
    FileError, Parser, RecordSink, Recorder, Reset, Scene, TaskFile, TraceHeader, UnreadKey, World, read_text,
};
use typelift_kitchen::Kitchen;
use typelift_memory::{Memory, looks_like_memory};

use crate::confirm::{Asked, Which};
use crate::environment::{Timeouts, start, wanted_setup, warn_of_no_reset};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{ModelInput, TaskInput, task_name};
use crate::limits::{Clock, Interrupt, what_to_try};
use crate::narrate::Narrator;
use crate::no_plan::{for_episode, say_hint, say_undemonstrated};
use crate::overwriting::{Output, keep_inputs};
use crate::planning_options::PlanningOptions;
use crate::quantities::parse_whole;
use crate::remembered::{Remembered, is_task, recall};
use crate::style::{HEAD, HINT, WARNING, painted};
use crate::waiting::Waiting;

/// Expansions of one search, unless the user says otherwise: an agent that acts must not think for ever.
const EXPANSIONS: u64 = 200_000;

/// Carry out tasks in an environment
#[derive(Debug, clap::Args)]
#[command(mut_arg("env_timeout", |timeout| timeout.requires("env")))]
#[command(group = clap::ArgGroup::new("environment").required(true).args(["kitchen", "env"]))]
#[command(override_usage = "typelift run [OPTIONS] <--kitchen|--env <COMMAND>> <MODEL> <TASK>...
       typelift run [OPTIONS] <--kitchen|--env <COMMAND>> --memory <FILE>
           [MODEL] <TASK>...")]
#[command(after_help = "Examples:
  typelift run kitchen.json K/tasks/T4.1.json --kitchen --imagine
  typelift run kitchen.json K/faults/*.json --kitchen --imagine --json
  typelift run model.json task.json --env 'python3 robot.py' --imagine --confirm
  typelift run model.json task.json --env 'python3 robot.py' --record runs
  typelift run kitchen.json K/tasks/T4.1.json --kitchen --imagine --memory m.db
  typelift run K/tasks/T4.1.json --kitchen --memory m.db

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
    #[arg(required_unless_present = "memory", value_name = "TASK", index = 2)]
    tasks: Vec<PathBuf>,
    /// Act in the built-in kitchen simulator
    #[arg(long)]
    kitchen: bool,
    /// Start this command as the environment: it speaks env/1 on its standard input and output; there is no shell
    #[arg(long, value_name = "COMMAND", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    env: Option<String>,
    #[command(flatten)]
    timeouts: Timeouts,
    /// The seed that the environment is reset with, instead of the task's
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_negative_numbers = true)]
    seed: Option<u64>,
    /// The name of the place that is acted in: what fails there is avoided in later tasks of the same place
    /// [default: as the environment says, or one for each scenario and seed]
    #[arg(long, value_name = "NAME")]
    instance: Option<String>,
    /// Ask before a plan is executed: only one that rests on imagined actions, or any [default: imagined]
    #[arg(long, value_name = "WHICH", num_args = 0..=1, require_equals = true, default_missing_value = "imagined")]
    confirm: Option<Which>,
    /// After a failure set the environment back and plan from the start, as the paper does
    #[arg(long)]
    restart: bool,
    /// Whom failures are blamed on
    #[arg(long, value_name = "RULE", default_value = "belief")]
    blame: Blame,
    /// How many steps of a detour it is worth to be e times as likely to succeed, once anything failed; 0 ignores risk
    #[arg(long, value_name = "R", default_value_t = Options::default().risk, allow_negative_numbers = true,
        value_parser = clap::value_parser!(u32).range(0..=1000))]
    risk: u32,
    /// Try a failed step again N times [default: 1, until that was five times in vain; with --restart 0]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    retries: Option<u32>,
    /// Propose at most this many plans a task
    #[arg(long, value_name = "N", default_value_t = 12, value_parser = parse_whole, allow_negative_numbers = true)]
    max_proposals: u64,
    /// Record what is done and observed, failures too, as a trace a task in this folder, to `learn` from
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// Keep what is done and observed in this file, and learn from it after each task; it is made if it is not there,
    /// and from then on MODEL may be left out
    #[arg(long, value_name = "FILE")]
    memory: Option<PathBuf>,
    /// Write everything that happens to this file, one JSON object a line
    #[arg(long, value_name = "FILE")]
    events: Option<PathBuf>,
    #[command(flatten)]
    planning: PlanningOptions,
}

/// A task, as it was read.
struct ToDo<'a> {
    path: &'a Path,
    what: TaskInput,
    reset: Reset,
    /// What of a setup is asked for that an environment may be unable to give.
    wants: Vec<&'static str>,
}

/// What there is to act with, and what is to be done.
struct Given<'a> {
    input: ModelInput,
    remembered: Option<Remembered>,
    tasks: Vec<ToDo<'a>>,
}

/// Whom failures are blamed on.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Blame {
    /// What is likelier at fault than not, by all that was learned and tried
    Belief,
    /// Every object that took part and neither acts nor is in the goal
    Paper,
}

/// What goes on from task to task.
struct Session<'a> {
    clock: Clock,
    interrupt: &'a Interrupt,
    quiet: bool,
    /// What was learned from before anything was done.
    evidence: Arc<Observations>,
    /// What was learned up to now, and the model of it.
    input: ModelInput,
    model: Arc<ActionModel>,
    memory: Option<Memory>,
    options: Options,
    world: Box<dyn World>,
    narrator: Narrator,
    experience: Experience,
    /// How many keys that nothing reads were told of.
    told_keys: usize,
}

impl Session<'_> {
    /// A task with the model for it, as it is by now.
    fn pose(&self, path: &Path, what: TaskInput) -> Result<(Arc<ActionModel>, Task), Failure> {
        let what = match (what, &self.memory) {
            // It was read with the model as it was then.
            (TaskInput::Problem(_), Some(_)) => self.input.read_task(path, true)?,
            (what, _) => what,
        };
        Ok(match what {
            TaskInput::File(file) => (Arc::clone(&self.model), Task::new(State::default(), file.goal)),
            TaskInput::Problem(problem) => {
                let (model, task) = *problem;
                (Arc::new(model), task)
            }
        })
    }

    /// Learns from what happened, if there is a memory.
    fn learn(&mut self) -> Result<(), Failure> {
        if let Some(memory) = &mut self.memory {
            memory.refresh()?;
            self.input = ModelInput::Learned(Box::new(memory.learned().clone()));
            self.model = Arc::new(self.input.model().clone());
        }
        Ok(())
    }
}

impl Run {
    pub(crate) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let interrupt = Interrupt::install()?;
        self.check_confirm()?;
        let inputs = self.tasks.iter().chain(self.planning.model.files());
        keep_inputs(self.events.as_deref().map(Output::File), inputs.chain(&self.memory))?;
        let Given { mut input, remembered, tasks } = self.read(quiet)?;
        let options = self.options(input.is_given())?;
        interrupt.heeded();
        let waiting = Waiting::new(quiet);
        let world = self.open(&interrupt, &waiting)?;
        if self.restart && !world.can_reset() {
            return Err(Failure::bad_input(format!("--restart: {} cannot be reset", world.name()))
                .with_hint("Without --restart it goes on from where it is."));
        }
        if !quiet && !world.can_reset() {
            tasks.iter().for_each(|to_do| warn_of_no_reset(to_do.path, &to_do.wants, &world.name()));
        }
        // Only now, so that what an earlier run wrote there is kept when this one cannot begin.
        let events = match &self.events {
            None => None,
            Some(path) => {
                let file = interrupt.unheeded(|| File::create(path));
                Some(BufWriter::new(file.map_err(|error| FileError::from_write(path, &error))?))
            }
        };
        if let Some(folder) = &self.record {
            create_dir_all(folder).map_err(|error| FileError::from_write(folder, &error))?;
        }
        let memory = remembered.map(|remembered| remembered.begin(quiet)).transpose()?;
        if let Some(memory) = &memory {
            input = ModelInput::Learned(Box::new(memory.learned().clone()));
        }
        let mut narrator = Narrator::new(!quiet && !self.planning.json, events, waiting);
        narrator.familiar = (!quiet).then(|| input.familiar());
        let (interrupt, model) = (&interrupt, Arc::new(input.model().clone()));
        let (evidence, experience) = match &memory {
            Some(memory) => recall(memory)?,
            None => (input.evidence(), Experience::new()),
        };
        let mut session = Session {
            clock,
            interrupt,
            quiet,
            evidence: Arc::new(evidence),
            input,
            model,
            memory,
            options,
            world,
            narrator,
            experience,
            told_keys: 0,
        };
        let mut all_solved = true;
        for to_do in tasks {
            let Some(ending) = self.carry_out(to_do, &mut session)? else { return Ok(Exit::Interrupted) };
            all_solved &= ending == Ending::Solved;
            if ending == Ending::Stopped(Stop::Cancelled) {
                break;
            }
        }
        let closed = session.world.close();
        // An interrupt stops the environment, which then cannot be closed any more.
        if interrupt.is_set() || closed.is_err() && interrupt.explains_failure() {
            return Ok(Exit::Interrupted);
        }
        closed?;
        Ok(if all_solved { Exit::Success } else { Exit::NotAchieved })
    }

    /// Carries out a task and tells of it; how it ended, or nothing if it was interrupted and the environment ended.
    fn carry_out(&self, to_do: ToDo<'_>, session: &mut Session<'_>) -> Result<Option<Ending>, Failure> {
        let ToDo { path, what, reset, .. } = to_do;
        // PDDL does not tell upper from lower case.
        let ignores_case = matches!(what, TaskInput::Problem(_));
        let (model, task) = session.pose(path, what)?;
        let Session {
            clock,
            interrupt,
            quiet,
            input,
            evidence,
            memory,
            options,
            world,
            narrator,
            experience,
            told_keys,
            ..
        } = session;
        let name = task_name(path);
        if narrator.aloud {
            anstream::eprintln!("{HEAD}{name}{HEAD:#}");
        }
        narrator.planning = Duration::ZERO;
        narrator.hierarchy = model.hierarchy.clone();
        let budget = narrator.bounds(self.planning.limits.budget(*clock, interrupt, Some(EXPANSIONS)));
        let options = Options { ignores_case, ..options.clone() };
        let mut episode =
            Episode::new(Arc::clone(&model), task.goal.clone(), options, experience.clone(), budget.clone())
                .with_values(task.values)
                .with_evidence(Arc::clone(evidence));
        let mut parser = Parser::new(model.hierarchy.clone(), input.parse()).knowing(&model.predicates);
        let mut asked = Asked { which: self.confirm, model: &model, interrupt };
        let header = TraceHeader { task: name.clone(), goal: task.goal };
        let mut remembering = memory.as_mut().map(|memory| memory.episode(header.clone()));
        let mut recorder = self.record.as_ref().map(|folder| Recorder::new(folder, &name, header));
        let kept = remembering.as_mut().map(|sink| sink as &mut dyn RecordSink);
        let recorded = recorder.as_mut().map(|sink| sink as &mut dyn RecordSink);
        let mut sinks: Vec<&mut dyn RecordSink> = kept.into_iter().chain(recorded).collect();
        let mut ran = run(&mut episode, &mut **world, &reset, &mut parser, &mut asked, narrator, &mut sinks);
        for file in recorder.iter().flat_map(Recorder::files).filter(|_| !*quiet) {
            anstream::eprintln!("recorded {}", file.display());
        }
        if !*quiet {
            warn_of_unread_keys(&world.unread_keys()[*told_keys..]);
            *told_keys = world.unread_keys().len();
        }
        let was_interrupted = match &ran {
            Ok(_) => false,
            Err(RunError::World(_)) => interrupt.explains_failure(),
            Err(_) => interrupt.is_set(),
        };
        if was_interrupted && let Ok(Command::Done(account)) = episode.step(Input::Stop, narrator) {
            ran = Ok(*account);
        }
        let how = ran.as_ref().map_or("broken_off", |account| account.ending.word());
        let remembered = remembering.map_or(Ok(()), |episode| episode.end(how));
        if let (Some(error), Some(path)) = (narrator.events_error.take(), &self.events) {
            return Err(FileError::from_write(path, &error).into());
        }
        let mut out = anstream::stdout().lock();
        let is_bad_input = matches!(ran, Err(RunError::Episode(EpisodeError::Goal(_))));
        if let (false, Err(error)) = (is_bad_input, &ran)
            && let Ok(Command::Done(account)) = episode.step(Input::Stop, narrator)
        {
            if self.planning.json {
                let view = BrokenOffView::of(&name, error.to_string(), &account);
                writeln!(out, "{}", serde_json::to_string(&view).unwrap_or_default())?;
            } else if account.proposals > 0 {
                for line in broken_off(&name, &account, narrator.planning.as_millis(), narrator.aloud) {
                    writeln!(out, "{}", painted(&line))?;
                }
            }
        }
        let account = ran.map_err(|error| Failure::from(error).in_file(path))?;
        remembered?;
        *experience = episode.experience().clone();
        if self.planning.json {
            let view = AccountView::of(&name, &account, &episode, narrator.planning.as_secs_f64());
            writeln!(out, "{}", serde_json::to_string(&view).unwrap_or_default())?;
        } else {
            for line in summary(&name, &account, narrator.planning.as_millis(), narrator.aloud) {
                writeln!(out, "{}", painted(&line))?;
            }
        }
        out.flush()?;
        if let (Ending::Stopped(stop), false) = (&account.ending, *quiet || self.planning.planner.is_given())
            && let Some(advice) = what_to_try(*stop)
        {
            anstream::eprintln!("{HINT}hint{HINT:#}: {advice}");
        }
        if let (Ending::NoPlan(_), false) = (&account.ending, *quiet || self.planning.json) {
            let imagining = self.planning.model.imagining_options();
            let hint = narrator.while_planning(|| for_episode(&episode, imagining, &account.given_up, &budget));
            hint.iter().for_each(say_hint);
            say_undemonstrated(&input.undemonstrated(), &model, episode.goal(), episode.state());
        }
        session.learn()?;
        Ok((!was_interrupted).then_some(account.ending))
    }

    /// `--confirm all` names a file: the choice stands behind an equals sign.
    fn check_confirm(&self) -> Result<(), Failure> {
        let is_choice = |path: &&PathBuf| {
            let word = path.to_str().unwrap_or_default();
            Which::from_str(word, false).is_ok() && !path.exists()
        };
        let mut files = self.planning.model.files().chain(&self.tasks);
        let Some(word) = files.find(is_choice).filter(|_| self.confirm.is_some()) else { return Ok(()) };
        let word = word.display();
        let failure = Failure::new(Exit::Usage, format!("--confirm {word}: `{word}` is taken for a file here"));
        Err(failure.with_hint(format!("Write --confirm={word}.")))
    }

    /// Reads the model, opens the memory, and reads the tasks.
    fn read(&self, quiet: bool) -> Result<Given<'_>, Failure> {
        let arguments = &self.planning.model;
        let Some(file) = &self.memory else {
            let input = arguments.read(quiet)?;
            if !quiet && looks_like_memory(&arguments.model) {
                anstream::eprintln!("{HINT}hint{HINT:#}: nothing of this run is kept; --memory FILE keeps it");
            }
            let tasks = self.tasks.iter().map(|path| self.to_do(path, input.read_task(path, quiet)?));
            return Ok(Given { tasks: tasks.collect::<Result<_, _>>()?, input, remembered: None });
        };
        // The first file is a model, or else a task.
        let first = &arguments.model;
        if looks_like_memory(first) {
            let failure = Failure::bad_input(format!("{}: this is a memory, and --memory names one", first.display()));
            return Err(
                failure.with_hint("Leave out one of the two; `typelift memory merge` makes one memory of several.")
            );
        }
        let text = read_text(first)?;
        let is_task = self.tasks.is_empty() || is_task(&text);
        let (model, text) = match is_task {
            true => (None, Some(text)),
            false => (Some((first.as_path(), arguments.input_of(text)?)), None),
        };
        let remembered = Remembered::open(file, model, arguments.types.as_ref(), quiet)?;
        let input = remembered.input();
        let first = text.map(|text| self.to_do(first, input.task_from_text(first, &text, quiet)?));
        let others = self.tasks.iter().map(|path| self.to_do(path, input.read_task(path, quiet)?));
        let tasks = first.into_iter().chain(others).collect::<Result<_, _>>()?;
        Ok(Given { input, remembered: Some(remembered), tasks })
    }

    fn to_do<'a>(&self, path: &'a Path, what: TaskInput) -> Result<ToDo<'a>, Failure> {
        let (reset, wants) = match &what {
            TaskInput::File(file) => (self.reset(file), wanted_setup(file, self.seed)),
            TaskInput::Problem(_) => (self.reset_to_problem(path)?, Vec::new()),
        };
        Ok(ToDo { path, what, reset, wants })
    }

    fn open(&self, interrupt: &Interrupt, waiting: &Waiting) -> Result<Box<dyn World>, Failure> {
        Ok(match &self.env {
            None => Box::new(Kitchen::new()),
            Some(command) => Box::new(start(command, &self.timeouts, interrupt, waiting.clone())?),
        })
    }

    fn options(&self, is_given: bool) -> Result<Options, Failure> {
        Ok(Options {
            restart: self.restart,
            blame: match self.blame {
                Blame::Belief => BlameRule::Belief,
                Blame::Paper => BlameRule::Paper,
            },
            retries: self.retries,
            risk: self.risk,
            max_proposals: self.max_proposals,
            instance: self.instance.as_deref().map(Symbol::new),
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
    fn reset_to_problem(&self, path: &Path) -> Result<Reset, Failure> {
        if !path.is_file() {
            let error = FileError::new(path, "the environment is told this file, and would find it read already");
            return Err(error.with_hint("A problem to act on cannot come through a pipe.".to_owned()).into());
        }
        let scenario = serde_json::json!({ "problem": path.display().to_string() });
        Ok(Reset { seed: self.seed.unwrap_or(0), scenario: Some(scenario) })
    }
}

/// Says which keys of entities nothing reads.
fn warn_of_unread_keys(keys: &[UnreadKey]) {
    for UnreadKey { entity, key, near } in keys {
        anstream::eprintln!(
            "{WARNING}warning{WARNING:#}: the environment's state: entity {entity}: `{key}` is not read"
        );
        anstream::eprintln!("{HINT}hint{HINT:#}: Did you mean `{near}`?");
    }
}
