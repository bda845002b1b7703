//! `typelift plan`.

use std::collections::BTreeSet;
use std::io::Write;
use std::mem::ManuallyDrop;
use std::path::{Path, PathBuf};
use std::time::Duration;

use typelift::agent::{Proposal, ProposeError, propose};
use typelift::model::{ActionModel, Budget, Plan as FoundPlan, Stop, Symbol, Task};
use typelift::plan::{Outcome, Restrictions};
use typelift::words::{AnswerView, count, ending, given_up_notes, numbered_steps, plan_size, why_none};
use typelift::world::write_file;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::read_remembered;
use crate::limits::{Clock, Interrupt, Limits, what_to_try};
use crate::no_plan::{for_task, say_hint, say_undemonstrated};
use crate::overwriting::{Output, keep_inputs, numbered};
use crate::plan_file::plan_file;
use crate::planning_options::PlanningOptions;
use crate::resident::memory_held_from_now;
use crate::style::{BAD, HEAD, HINT, WARNING, painted};
use crate::waiting::Waiting;
use crate::watchdog::watched;

/// Where the plan of a PDDL domain is written unless the user says otherwise, as Fast Downward does.
const DEFAULT_OUTPUT: &str = "sas_plan";

/// What takes its time, as it is said on a terminal.
const PLANNING: &str = "planning";

/// Plans that may be asked for.
const MOST_PLANS: u64 = 1000;

/// The expansions that looking for another plan may take, if the user sets no limit.
const EXPANSIONS_FOR_ANOTHER: u64 = 200_000;

/// Plan a task with a learned model, or a PDDL problem
#[derive(Debug, clap::Args)]
#[command(override_usage = "typelift plan [OPTIONS] <MODEL> <TASK>
       typelift plan [OPTIONS] --memory <FILE> <TASK>")]
#[command(after_help = "Examples:
  typelift plan kitchen.json K/tasks/T2.1.json
  typelift plan kitchen.json K/tasks/T4.1.json --imagine -o apple.plan
  typelift plan kitchen.json K/tasks/T1.4.json --plans 3
  typelift plan domain.pddl problem.pddl --better --time-limit 30s
  typelift plan model.json problem.pddl
  typelift plan --memory robot.memory K/tasks/T4.1.json
  typelift plan kitchen.json K/tasks/T1.1.json --planner \
    'fast-downward --alias lama-first --plan-file {plan} {domain} {problem}'

Exit codes: 0 a plan was found, 11 there is none in this model, 12 gave up at a
limit, 22 out of memory, 23 out of time, 31 bad input, 34 unsupported PDDL,
36 wrong usage, 38 the other planner failed, 39 its plan is not valid.")]
pub(crate) struct Plan {
    /// The task: a goal and a state to start from; or a PDDL problem
    #[arg(index = 2, required_unless_present = "memory", conflicts_with = "memory")]
    task: Option<PathBuf>,
    /// Plan with what this memory has learned, instead of a MODEL
    #[arg(long, value_name = "FILE")]
    memory: Option<PathBuf>,
    /// Find N plans: each leaves out at least one action of every plan before it
    #[arg(long, value_name = "N", default_value_t = 1, allow_negative_numbers = true,
        value_parser = parse_plans, conflicts_with = "planner")]
    plans: u64,
    /// Go on looking for cheaper plans until there is none, a limit is met, or Ctrl-C is pressed
    #[arg(long, conflicts_with_all = ["plans", "planner"])]
    better: bool,
    /// Write the plan to this file; several to FILE.1, FILE.2, … [default: none, and sas_plan for a PDDL domain]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    planning: PlanningOptions,
}

/// What there is when the first search has ended.
struct FirstAnswer {
    model: ActionModel,
    task: Task,
    output: Option<PathBuf>,
    /// What stands already where plans are written without being asked to.
    existing: Vec<PathBuf>,
    /// The predicates that the model has from its domain alone.
    undemonstrated: BTreeSet<Symbol>,
    /// When all was read.
    read: Duration,
    proposal: Result<Proposal, Stop>,
}

impl Plan {
    pub(crate) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let interrupt = Interrupt::install()?;
        let waiting = Waiting::new(quiet);
        let line = waiting.clone();
        interrupt.on_raised(move || line.end());
        let memory = memory_held_from_now();
        let budget = self.planning.limits.budget(clock, &interrupt, None);
        let FirstAnswer { model, task, output, existing, undemonstrated, read, proposal } =
            self.begin_watched(clock, &budget, &interrupt, &waiting, quiet)?;
        // The answer need not wait for the memory to be freed.
        let mut proposal = match proposal {
            Ok(proposal) => ManuallyDrop::new(proposal),
            Err(cut) => return say_stop(cut, self.planning.json, clock.elapsed() - read),
        };
        let mut out = anstream::stdout().lock();
        let mut plans: Vec<FoundPlan> = Vec::new();
        // That there is no other plan can take for ever to find out.
        let for_another = Budget { expansions: budget.expansions.or(Some(EXPANSIONS_FOR_ANOTHER)), ..budget.clone() };
        let last = loop {
            let outcome = proposal.outcome.clone();
            let Outcome::Solved(plan) = outcome else { break outcome };
            let number = plans.len() + 1;
            plans.push(plan.clone());
            if self.better {
                // What is found is safe, however the search ends.
                self.write_plans(output.as_deref(), &plans, &proposal.model, &task, &interrupt)?;
            }
            if plan.is_empty() && !self.planning.json {
                say_that_it_holds(quiet);
            } else if !self.planning.json {
                let took = clock.elapsed() - read;
                if let Err(failure) = self.print(&mut out, number, &plan, &proposal, &model, took) {
                    // Standard output is closed; the file is wanted all the same.
                    self.write_plans(output.as_deref(), &plans, &proposal.model, &task, &interrupt)?;
                    return Err(failure);
                }
            }
            if !self.better && plans.len() as u64 == self.plans {
                break proposal.outcome.clone();
            }
            proposal.outcome = waiting.during(PLANNING, || match self.better {
                true => proposal.better_plan(plans.last().map_or(0, FoundPlan::cost), &budget),
                false => proposal.next_plan(&for_another),
            })?;
        };
        self.write_plans(output.as_deref(), &plans, &proposal.model, &task, &interrupt)?;
        if let Some(file) = output.as_deref().filter(|_| !quiet) {
            self.say_replaced(&existing, file, plans.len());
        }
        let exit = match &last {
            // Whoever stops it while it looks for more is told so; what was found is kept.
            Outcome::Stopped(Stop::Cancelled) => Exit::Interrupted,
            _ if !plans.is_empty() => Exit::Success,
            Outcome::Stopped(stop) => (*stop).into(),
            _ => Exit::Unsolvable,
        };
        if self.planning.json {
            let seconds = (clock.elapsed() - read).as_secs_f64();
            let answer = AnswerView::of(&proposal, &plans, &last, memory(), seconds);
            writeln!(out, "{}", serde_json::to_string_pretty(&answer).unwrap_or_default())?;
            return Ok(exit);
        }
        out.flush()?;
        if plans.is_empty() {
            self.report_none(&last, &proposal, &model, &task, &budget, &waiting);
            say_undemonstrated(&undemonstrated, &model, &task.goal, &task.init);
        } else if !quiet {
            // It never holds, so that a slip in it would pass for a goal that is reached.
            for mismatch in proposal.goal_type_mismatches().iter().filter(|mismatch| !mismatch.positive) {
                anstream::eprintln!("{WARNING}note{WARNING:#}: {mismatch}");
            }
            let limited = if self.better { &budget } else { &for_another };
            self.report_end(&last, plans.len(), limited.expansions);
        }
        Ok(exit)
    }

    /// Reads, grounds, and searches for the first plan. A watchdog ends the program if reading takes more than is allowed;
    /// an external planner is ended by what started it.
    fn begin_watched(
        &self,
        clock: Clock,
        budget: &Budget,
        interrupt: &Interrupt,
        waiting: &Waiting,
        quiet: bool,
    ) -> Result<FirstAnswer, Failure> {
        let json = self.planning.json;
        let limits = if self.planning.planner.is_given() { Limits::default() } else { self.planning.limits.limits };
        let line = waiting.clone();
        let last_words = move |stop| {
            line.end();
            // If printing fails, that cannot be printed either.
            say_stop(stop, json, clock.elapsed()).unwrap_or(stop.into())
        };
        watched(clock, limits, last_words, || self.begin(clock, budget, interrupt, waiting, quiet))
    }

    fn begin(
        &self,
        clock: Clock,
        budget: &Budget,
        interrupt: &Interrupt,
        waiting: &Waiting,
        quiet: bool,
    ) -> Result<FirstAnswer, Failure> {
        let model = &self.planning.model;
        let input = match &self.memory {
            None => model.read(quiet)?,
            Some(file) => read_remembered(file, model.types.as_ref(), quiet)?,
        };
        // With a memory there is no model, and the task is the first file.
        let task = self.task.as_ref().unwrap_or(&model.model);
        let is_given = input.is_given();
        let default_output = is_given.then(|| PathBuf::from(DEFAULT_OUTPUT));
        let output = self.output.clone().or(default_output);
        keep_inputs(output.as_deref().map(|file| self.written(file)), model.files().chain([task]).chain(&self.memory))?;
        let unasked = output.as_deref().filter(|_| self.output.is_none());
        let existing = unasked.map(|file| self.written(file).existing()).unwrap_or_default();
        let undemonstrated = input.undemonstrated();
        let (model, task) = input.read_planning_task(task, quiet)?;
        interrupt.heeded();
        let read = clock.elapsed();
        let options = self.planning.agent_options(is_given)?;
        let proposed = waiting.during(PLANNING, || propose(&model, &task, &Restrictions::default(), &options, budget));
        let proposal = match proposed {
            Err(ProposeError::Stopped(stop)) => Err(stop),
            proposal => Ok(proposal?),
        };
        Ok(FirstAnswer { model, task, output, existing, undemonstrated, read, proposal })
    }

    /// What is written where the plans are to go to this file.
    fn written<'a>(&self, file: &'a Path) -> Output<'a> {
        match (self.better, self.plans) {
            (true, _) => Output::Numbered { file, most: u64::MAX },
            (false, 1) => Output::File(file),
            (false, most) => Output::Numbered { file, most },
        }
    }

    fn print(
        &self,
        out: &mut impl Write,
        number: usize,
        plan: &FoundPlan,
        proposal: &Proposal,
        model: &ActionModel,
        took: Duration,
    ) -> Result<(), Failure> {
        let head = match (number, self.better, self.plans) {
            (1, true, _) | (_, false, 1) => String::new(),
            (_, true, _) => "better: ".to_owned(),
            (_, false, _) => format!("plan {number}: "),
        };
        let expansions = match self.planning.planner.is_given() {
            true => String::new(),
            false => format!(", {}", count(proposal.report().expansions, "expansion")),
        };
        let size = plan_size(plan);
        writeln!(out, "{HEAD}{head}{size}, {} ms{expansions}{HEAD:#}", took.as_millis())?;
        for line in numbered_steps(plan, &model.hierarchy) {
            writeln!(out, "{}", painted(&line))?;
        }
        Ok(())
    }

    /// One plan is written to the file itself; several to the file with a number each, the best of `--better` to the file
    /// itself as well.
    fn write_plans(
        &self,
        output: Option<&Path>,
        plans: &[FoundPlan],
        model: &ActionModel,
        task: &Task,
        interrupt: &Interrupt,
    ) -> Result<(), Failure> {
        let (Some(path), Some(last)) = (output, plans.last()) else { return Ok(()) };
        let write = |path: &Path, plan: &FoundPlan| -> Result<(), Failure> {
            let text = plan_file(plan, model, &task.init)?;
            let write = || write_file(path, text.as_bytes());
            // A pipe may never be read; a file is at once written whole, and is not to be left in part.
            let is_pipe = path.metadata().is_ok_and(|data| !data.is_file());
            Ok(if is_pipe { interrupt.unheeded(write) } else { write() }?)
        };
        if self.better || plans.len() == 1 {
            write(path, last)?;
        }
        if self.better || plans.len() > 1 {
            // With --better all but the last are there already.
            let new = if self.better { plans.len() - 1 } else { 0 };
            for (number, plan) in (1..).zip(plans).skip(new) {
                write(&numbered(path, number), plan)?;
            }
        }
        Ok(())
    }

    /// Says which of the files that were there already these plans stand in now.
    fn say_replaced(&self, existing: &[PathBuf], file: &Path, plans: usize) {
        let is_replaced = |path: &&PathBuf| match *path == file {
            true => self.better && plans > 0 || plans == 1,
            false => (self.better || plans > 1) && (1..).take(plans).any(|number| numbered(file, number) == **path),
        };
        let mut replaced = existing.iter().filter(is_replaced);
        let Some(first) = replaced.next() else { return };
        let others = match replaced.count() {
            0 => String::new(),
            more => format!(" (and {more} more)"),
        };
        let first = first.display();
        anstream::eprintln!(
            "{WARNING}note{WARNING:#}: {first}{others} was there already, and is replaced; -o writes elsewhere"
        );
    }

    /// Says why there is no plan, and whether imagination would help; if not, what may be wrong with the goal.
    fn report_none(
        &self,
        outcome: &Outcome,
        proposal: &Proposal,
        model: &ActionModel,
        task: &Task,
        budget: &Budget,
        waiting: &Waiting,
    ) {
        let ending = match outcome {
            Outcome::Stopped(Stop::Expansions) if self.planning.planner.is_given() => "the planner gave up".to_owned(),
            outcome => ending(outcome),
        };
        let explanation = why_none(proposal, outcome);
        let why = explanation.as_ref().map_or(ending, ToString::to_string);
        for line in why.lines() {
            anstream::eprintln!("{BAD}no plan{BAD:#}: {line}");
        }
        if let Outcome::Stopped(stop) = outcome
            && !self.planning.planner.is_given()
            && let Some(advice) = what_to_try(*stop)
        {
            anstream::eprintln!("{HINT}hint{HINT:#}: {advice}");
        }
        if explanation.is_none() {
            return;
        }
        let given_up = &proposal.imagination.given_up;
        for refused in given_up_notes(given_up) {
            anstream::eprintln!("{WARNING}note{WARNING:#}: {refused}");
        }
        if *outcome == Outcome::Unsolvable
            && let Ok(options) = self.planning.agent_options(false)
            && let Some(hint) = waiting.during(PLANNING, || for_task(model, task, options, given_up, budget))
        {
            say_hint(&hint);
            return;
        }
        for mismatch in proposal.goal_type_mismatches() {
            anstream::eprintln!("{WARNING}note{WARNING:#}: {mismatch}");
        }
    }

    /// Says why there are no more plans, where more were wanted, and at most so many expansions were allowed.
    fn report_end(&self, outcome: &Outcome, found: usize, allowed: Option<u64>) {
        if self.better || (found as u64) < self.plans {
            let why = match (outcome, allowed) {
                (Outcome::Stopped(Stop::Expansions), Some(allowed)) => {
                    format!("gave up at the limit of {}", count(allowed, "expansion"))
                }
                (Outcome::NoMorePlans, _) if !self.better => {
                    "any other takes the steps of one of these in another order, or adds to them".to_owned()
                }
                _ => ending(outcome),
            };
            let what = if self.better { "no better plan" } else { "no further plan" };
            anstream::eprintln!("{what}: {why}");
            if let Outcome::Stopped(stop) = outcome
                && let Some(advice) = what_to_try(*stop)
            {
                anstream::eprintln!("{HINT}hint{HINT:#}: {advice}");
            }
        }
    }
}

/// Says that nothing is to be done.
fn say_that_it_holds(quiet: bool) {
    if !quiet {
        anstream::eprintln!("the goal holds already: nothing is to be done");
    }
}

/// Reads how many plans are wanted.
fn parse_plans(text: &str) -> Result<u64, String> {
    let number = text.parse().ok().filter(|number| (1..=MOST_PLANS).contains(number));
    number.ok_or_else(|| format!("write a whole number from 1 to {MOST_PLANS}"))
}

/// Says that the search did not even begin.
fn say_stop(stop: Stop, json: bool, took: Duration) -> Result<Exit, Failure> {
    if json {
        let answer = AnswerView::stopped(stop, took.as_secs_f64());
        writeln!(anstream::stdout(), "{}", serde_json::to_string_pretty(&answer).unwrap_or_default())?;
    } else {
        anstream::eprintln!("{BAD}no plan{BAD:#}: {}", ProposeError::Stopped(stop));
    }
    Ok(stop.into())
}
