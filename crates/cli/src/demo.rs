//! `typelift demo`: the whole loop in two seconds.

use std::io::Write;
use std::sync::Arc;
use std::time::Instant;

use typelift::agent::{Account, Confirmation, Episode, Event, Experience, Observer, Options, run};
use typelift::imagine;
use typelift::learn::{self, Report, learn_dataset};
use typelift::model::{ActionModel, Budget, LearnedModel, ParseConfig, Plan};
use typelift::words::{count, describe_action, imagined_note, individual_name, line, plan_size};
use typelift::world::{Dataset, Parser, Reset, World};
use typelift_kitchen::{Demonstration, Kitchen, KitchenTask, demonstrations, draw, faults, hierarchy, tasks};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::limits::Clock;
use crate::quantities::parse_whole;
use crate::style::{DIM, GOOD, HEAD, IMAGINED, described, painted, wrapped};

/// The task shown of each set, and what is new about it.
const SHOWN: [(&str, &str); 6] = [
    ("T1.4", "shown, in another room"),
    ("T2.3", "shown foods, never together"),
    ("T3.4", "more of them than ever shown"),
    ("T4.3", "a bagel was never seen; nothing like it was ever toasted"),
    ("T5.3", "neither was ever seen; both are food"),
    ("T6.4", "all of it at once"),
];

/// Watch a kitchen agent learn from 8 demonstrations and solve what it was never shown
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  typelift demo --seed 3")]
pub(crate) struct Demo {
    /// The seed of the rooms
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole, allow_negative_numbers = true)]
    seed: u64,
}

impl Demo {
    pub(crate) fn run(&self, clock: Clock) -> Result<Exit, Failure> {
        let mut out = anstream::stdout().lock();
        let demonstrations = demonstrations(self.seed);
        let titles = demonstrations.iter().map(|d| d.recording.header.task.as_str()).collect::<Vec<_>>().join(", ");
        writeln!(out, "{HEAD}Shown{HEAD:#}: 8 tasks in a kitchen")?;
        writeln!(out, "  {}.", wrapped(titles.split(' '), 2, 78))?;

        let started = Instant::now();
        let (learned, report) = learn_all(&demonstrations)?;
        let took = started.elapsed().as_millis();
        print_learned(&mut out, &learned, &report, took)?;

        let model = Arc::new(learned.model);
        writeln!(out, "\n{HEAD}Asked{HEAD:#}: one task of each of the six sets, in rooms with 32 objects")?;
        let all = tasks();
        let mut solved = true;
        for (name, novelty) in SHOWN {
            if let Some(task) = all.iter().find(|task| task.name == name) {
                solved &= self.solve(&mut out, &model, task, novelty)?;
            }
        }
        if let Some(fault) = faults().iter().find(|fault| fault.name == "broken_cutboard_lettuce") {
            solved &= self.repair(&mut out, &model, fault)?;
        }
        writeln!(
            out,
            "\n{DIM}{:.1} s. Next: typelift kitchen export K, and the README's tour.{DIM:#}",
            clock.elapsed().as_secs_f64()
        )?;
        Ok(if solved { Exit::Success } else { Exit::NotAchieved })
    }

    fn solve(
        &self,
        out: &mut impl Write,
        model: &Arc<ActionModel>,
        task: &KitchenTask,
        novelty: &str,
    ) -> Result<bool, Failure> {
        let started = Instant::now();
        let (account, _) = self.act(model, task, &mut ())?;
        let took = started.elapsed().as_secs_f64() * 1e3;
        let plan = account.plan.clone().unwrap_or_default();
        let verdict = if account.solved() { format!("{GOOD}solved{GOOD:#}") } else { "not solved".to_owned() };
        writeln!(out, "  {HEAD}{}{HEAD:#} {}", task.name, wrapped(task.title.split(' '), 7, 78))?;
        writeln!(out, "       {DIM}{novelty}{DIM:#}")?;
        writeln!(
            out,
            "       {verdict}: {}, {}, {took:.0} ms",
            plan_size(&plan),
            count(account.proposals, "proposal")
        )?;
        for note in imagined_notes(&plan, model) {
            writeln!(out, "       {IMAGINED}{}{IMAGINED:#}", wrapped(note.split(' '), 9, 78))?;
        }
        Ok(account.solved())
    }

    /// A broken cutboard, without setting the kitchen back.
    fn repair(&self, out: &mut impl Write, model: &Arc<ActionModel>, fault: &KitchenTask) -> Result<bool, Failure> {
        writeln!(out, "\n{HEAD}Broken{HEAD:#}: the cutboard no longer cuts, and no state tells")?;
        let mut lines = Lines(Vec::new());
        let (account, kitchen) = self.act(model, fault, &mut lines)?;
        for line in lines.0 {
            writeln!(out, "{line}")?;
        }
        for note in imagined_notes(account.plan.as_ref().unwrap_or(&Plan::default()), model) {
            writeln!(out, "  {IMAGINED}{}{IMAGINED:#}", wrapped(note.split(' '), 4, 78))?;
        }
        if account.solved() {
            writeln!(out, "  {GOOD}solved{GOOD:#} from where it stood, without starting over:\n")?;
        }
        write!(out, "{}", kitchen.room().map(draw).unwrap_or_default())?;
        Ok(account.solved())
    }

    fn act(
        &self,
        model: &Arc<ActionModel>,
        task: &KitchenTask,
        observer: &mut dyn Observer,
    ) -> Result<(Account, Kitchen), Failure> {
        let options = Options { imagine: Some(imagine::Options::default()), ..Options::default() };
        let budget = Budget::with_expansions(200_000);
        let mut episode = Episode::new(Arc::clone(model), task.goal.clone(), options, Experience::new(), budget);
        let mut kitchen = Kitchen::new();
        let mut parser = Parser::new(model.hierarchy.clone(), ParseConfig::default());
        let reset = Reset { seed: self.seed, scenario: Some(task.scenario.clone()) };
        let mut approve = |_: &Plan| Confirmation::Approve;
        let world: &mut dyn World = &mut kitchen;
        let account = run(&mut episode, world, &reset, &mut parser, &mut approve, observer, &mut [])?;
        Ok((account, kitchen))
    }
}

/// Collects what happens as lines.
struct Lines(Vec<String>);

impl Observer for Lines {
    fn event(&mut self, event: &Event) {
        // A reason gets a line of its own: with it, a line would be longer than 80 columns.
        let mut event = event.clone();
        let reason = if let Event::Stepped { reason, .. } = &mut event { reason.take() } else { None };
        self.0.extend(line(&event).as_ref().map(painted));
        self.0.extend(reason.map(|reason| format!("       {DIM}{reason}{DIM:#}")));
    }
}

/// What the imagined steps of a plan rest on, each once.
fn imagined_notes(plan: &Plan, model: &ActionModel) -> Vec<String> {
    let mut notes: Vec<String> = Vec::new();
    for step in &plan.steps {
        if let Some(note) = imagined_note(step, &model.hierarchy)
            && !notes.contains(&note)
        {
            notes.push(note);
        }
    }
    notes
}

fn learn_all(demonstrations: &[Demonstration]) -> Result<(LearnedModel, Report), Failure> {
    let mut parser = Parser::new(hierarchy(), ParseConfig::default());
    let traces = demonstrations.iter().map(|d| d.recording.trace(format!("{}.jsonl", d.name), &mut parser));
    let traces = traces.collect::<Result<_, _>>().map_err(Failure::bad_input)?;
    let dataset = Dataset::new(&parser, traces);
    learn_dataset(&dataset, &learn::Options::default()).map_err(Failure::bad_input)
}

fn print_learned(out: &mut impl Write, learned: &LearnedModel, report: &Report, took: u128) -> Result<(), Failure> {
    let model = &learned.model;
    writeln!(
        out,
        "\n{HEAD}Learned{HEAD:#} in {took} ms: {}, {}, {}",
        count(report.transitions, "transition"),
        count(report.individual as u64, "individual action"),
        count(report.generalized as u64, "generalized action"),
    )?;
    for action in &model.actions {
        let name = format!("{:<25}", action.name);
        let observations = count(action.provenance.observations(), "observation");
        let support = action.provenance.support();
        if support.len() < 2 {
            writeln!(out, "  {name} {DIM}as shown, {observations}{DIM:#}")?;
            continue;
        }
        let prefix = format!("{}-", action.call.name);
        let from = support.iter().map(|support| individual_name(support, model));
        let from: Vec<String> = from.map(|name| name.strip_prefix(&prefix).unwrap_or(&name).to_owned()).collect();
        let words = from.iter().map(String::as_str);
        writeln!(out, "  {name} {DIM}{}{DIM:#}", wrapped(words, 28, 78))?;
    }
    if let Some(action) = model.action("USE-cutboard-food") {
        writeln!(out, "\n{HEAD}One of them{HEAD:#}, in full:")?;
        write!(out, "{}", described(&describe_action(action, model, None)))?;
    }
    Ok(())
}
