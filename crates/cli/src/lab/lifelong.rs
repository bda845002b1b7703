//! `typelift lab lifelong`.

use std::io::Write;

use typelift::belief::Culprit;
use typelift::words::count;
use typelift_lab::{Agent, LifelongOptions, LifelongResult, lifelong_experiment};

use super::options::{ExperimentOptions, RepeatedRoomOptions, warn};
use crate::columns::Columns;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Clock;
use crate::quantities::parse_whole;
use crate::style::{BAD, GOOD, HEAD, wrapped};

/// What is learned along a life of 200 tasks, in which tools break and are mended
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  typelift lab lifelong -o L
  typelift lab lifelong --quick -o Q
  typelift lab lifelong --runs 2 --agent memory --agent paper -o M --explain

A life is drawn by its seed: its tasks and rooms, when which tool breaks (it is
mended after ten tasks), six foods that do not go with a tool, and a hidden
rule. It is lived by an agent with a memory, by one that forgets after each
task, by the paper's rule, and by one that is told all but what broke just now.
Writes lifelong.csv (a row a task), failed.csv (a row a failed step, with its
true cause), lifelong.json and lifelong.md.

Limits, unless told otherwise: 200,000 expansions a search, 12 proposals and
120 s a task.")]
pub(super) struct LabLifelong {
    #[command(flatten)]
    experiment: ExperimentOptions,
    #[command(flatten)]
    repeated: RepeatedRoomOptions,
    /// Tasks of a life [default: 200, with --quick 12]
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_negative_numbers = true)]
    tasks: Option<u64>,
    /// Only this agent: memory, forgetful, paper or informed; may be repeated
    #[arg(long, value_name = "NAME", value_parser = parse_agent)]
    agent: Vec<Agent>,
    /// List every step that the agent with a memory failed, with its true cause and what was blamed
    #[arg(long)]
    explain: bool,
}

fn parse_agent(name: &str) -> Result<Agent, String> {
    Agent::parse(name).ok_or_else(|| format!("there are {}", Agent::ALL.map(Agent::name).join(", ")))
}

impl LabLifelong {
    pub(super) fn run(&self, clock: Clock, quiet: bool) -> Result<Exit, Failure> {
        let default = LifelongOptions::default();
        let quick = self.experiment.quick;
        let chosen = |agent: &Agent| self.agent.is_empty() || self.agent.contains(agent);
        let tasks = if quick { LifelongOptions::QUICK } else { default.tasks };
        let options = LifelongOptions {
            agents: default.agents.into_iter().filter(chosen).collect(),
            runs: self.repeated.runs(quick, default.runs),
            seed: self.repeated.rooms.seed,
            tasks: self.tasks.map_or(tasks, |tasks| usize::try_from(tasks).unwrap_or(usize::MAX)),
            states: if quick { 0 } else { default.states },
            limits: self.repeated.rooms.limits.or(default.limits),
        };
        let files = "lifelong.csv, failed.csv, lifelong.json and lifelong.md";
        let result = self
            .experiment
            .carry_out(self.repeated.rooms.jobs, clock, quiet, files, |runner| lifelong_experiment(&options, runner))?;
        self.experiment.results.print(&result.json(), |out| print(out, &result, self.explain))?;
        let tasks = || result.records.values().flat_map(|record| &record.tasks);
        let out_of_time = tasks().filter(|task| typelift_lab::is_out_of_time(&task.ending)).count();
        warn(out_of_time, tasks().any(typelift_lab::TaskRecord::solved), quiet);
        Ok(Exit::Success)
    }
}

fn print(out: &mut dyn Write, result: &LifelongResult, explain: bool) -> Result<(), Failure> {
    let LifelongOptions { runs, seed, tasks, limits, .. } = &result.options;
    let legend = format!(
        "Lives: {runs}, of {tasks} tasks, from seed {seed} on; {limits}. Tasks solved; plans a task; failed steps a task, \
         retries included, in successive parts of {}.",
        count(result.window() as u64, "task")
    );
    writeln!(out, "{}\n", wrapped(legend.split(' '), 0, 78))?;
    let summaries = result.summaries();
    let parts = summaries.iter().map(|summary| summary.failed_over_time.len()).max().unwrap_or_default();
    let mut columns = Columns::with_right(&(1..4 + parts).collect::<Vec<_>>());
    let mut head = ["agent", "solved", "#p", "failed"].map(str::to_owned).to_vec();
    head.extend((1..=parts).map(|part| format!("to {}", (part * result.window()).min(*tasks))));
    columns.styled(head.into_iter().map(|text| (text, HEAD)));
    for summary in &summaries {
        let mut row = vec![
            summary.agent.to_string(),
            format!("{}/{}", summary.solved, summary.tasks),
            format!("{:.2}", summary.proposals),
            format!("{:.2}", summary.failed),
        ];
        row.extend(summary.failed_over_time.iter().map(|failed| format!("{failed:.2}")));
        columns.row(row);
    }
    write!(out, "{}", columns.text(0))?;
    writeln!(out, "\n{HEAD}Failed steps by true cause{HEAD:#} (first part, last part, all)")?;
    let mut columns = Columns::with_right(&[2, 3, 4]);
    for summary in &summaries {
        for (kind, counts) in summary.causes_in_order() {
            let [first, last, all] = counts.map(|count| count.to_string());
            columns.row([summary.agent.to_string(), kind.to_owned(), first, last, all]);
        }
    }
    write!(out, "{}", columns.text(2))?;
    print_blame(out, result)?;
    print_truth(out, result, explain)?;
    if explain {
        explain_failures(out, result)?;
    }
    for goal in result.goals() {
        let (style, word) = if goal.met() { (GOOD, "reached") } else { (BAD, "not reached") };
        let text = format!("{}: at most {:.3}, is {:.3}", goal.what, goal.at_most, goal.reached);
        writeln!(out, "{style}{word:<12}{style:#}  {}", wrapped(text.split(' '), 14, 78))?;
    }
    Ok(())
}

/// What the agent with a memory blamed.
fn print_blame(out: &mut dyn Write, result: &LifelongResult) -> Result<(), Failure> {
    let blame = result.blame();
    if blame.first[1] == 0 {
        return Ok(());
    }
    writeln!(out, "\n{HEAD}The right kind of culprit came first{HEAD:#}")?;
    let mut columns = Columns::with_right(&[1]);
    let times = [("when a cause struck for the first time", blame.first), ("for the third time", blame.third)];
    for (when, [hit, of]) in times {
        columns.row([when.to_owned(), format!("{hit} of {of}")]);
    }
    for (cause, [hit, of]) in &blame.by_cause {
        columns.row([format!("{cause}, every time"), format!("{hit} of {of}")]);
    }
    write!(out, "{}", columns.text(2))?;
    let [believed, object, kind] = blame.brier;
    writeln!(out, "  Brier's score {believed:.3}; always the object {object:.3}, always the type {kind:.3}")?;
    Ok(())
}

/// How true it was what the agent with a memory thought to work.
fn print_truth(out: &mut dyn Write, result: &LifelongResult, explain: bool) -> Result<(), Failure> {
    let truth = result.truth();
    let Some(last) = truth.last() else { return Ok(()) };
    writeln!(out, "\n{HEAD}What is thought to work, and does{HEAD:#}")?;
    let mut columns = Columns::with_right(&[0, 1, 2]);
    columns.row(["after", "precision", "recall"]);
    for truth in &truth {
        columns.row([truth.after.to_string(), format!("{:.4}", truth.precision()), format!("{:.4}", truth.recall())]);
    }
    write!(out, "{}", columns.text(2))?;
    for (what, calls) in [("thought to work", &last.too_much), ("thought not to", &last.too_little)] {
        let mut calls: Vec<_> = calls.iter().collect();
        calls.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        for (call, count) in calls.into_iter().filter(|_| explain) {
            writeln!(out, "  {what} in the end, wrongly: {call} ({count})")?;
        }
    }
    Ok(())
}

/// Explanations of a failure that are told.
const MOST_BLAMED: usize = 3;

fn culprit(kind: Culprit) -> &'static str {
    match kind {
        Culprit::Object => "an object",
        Culprit::Type => "a type",
        Culprit::Pair => "a pair",
        Culprit::Literal => "a literal",
        Culprit::Chance => "chance",
    }
}

/// What the agent with a memory failed, and where.
fn explain_failures(out: &mut dyn Write, result: &LifelongResult) -> Result<(), Failure> {
    for (run, record) in result.records.iter().filter(|(run, _)| run.agent == Agent::Memory) {
        writeln!(out, "\n{HEAD}{run}{HEAD:#}")?;
        for (number, task) in (1..).zip(&record.tasks) {
            for (at, step) in task.failed.iter().enumerate().filter(|(_, step)| !step.retry) {
                let mut text = format!("{number} {}: {} as {}: {}", task.task, step.call, step.action, step.cause);
                if let Some(p) = step.p {
                    text += &format!("; p was {p:.2}");
                }
                if let Some(better) = step.better {
                    text += &format!(", of another plan {better:.2}");
                }
                // What counts as a failure is the last try.
                let retries = task.failed[at + 1..].iter().take_while(|step| step.retry);
                let blamed = retries.last().unwrap_or(step).explanations.iter().take(MOST_BLAMED);
                let blamed: Vec<String> =
                    blamed.map(|one| format!("{} {:.0} %", culprit(one.kind), one.share * 100.0)).collect();
                if !blamed.is_empty() {
                    text += &format!("; blamed: {}", blamed.join(", "));
                }
                writeln!(out, "  {}", wrapped(text.split(' '), 4, 78))?;
            }
            if !task.solved() {
                writeln!(out, "  {number} {}: {}", task.task, task.ending)?;
            }
        }
    }
    for summary in result.summaries().iter().filter(|summary| summary.agent == Agent::Memory) {
        for lost in &summary.lost {
            writeln!(out, "  lost: {lost}")?;
        }
    }
    Ok(())
}
