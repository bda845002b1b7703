//! `typelift kitchen`: the built-in simulator.

use std::fs::create_dir_all;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use typelift::model::{GroundAtom, GroundCall, ParseConfig, Symbol};
use typelift::words::count;
use typelift::world::{
    FileError, Parser, Reset, Scene, TaskFile, TraceReader, World, trace_from, write_file, write_task,
};
use typelift_kitchen::{
    Difference, Kitchen as Simulator, KitchenTask, demonstrations, draw, faults, replay, serve, tasks, types_pddl,
};

use crate::exit::Exit;
use crate::failure::{Failure, or_one_of};
use crate::quantities::parse_whole;
use crate::style::{BAD, GOOD};

/// The built-in kitchen simulator
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  typelift kitchen export K\n\n`typelift kitchen COMMAND --help` tells more.")]
pub(crate) struct Kitchen {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Write types, demonstrations, tasks and scenarios with faults as files
    #[command(after_help = "Example:\n  typelift kitchen export K")]
    Export {
        /// The folder to write to; made if it is not there
        folder: PathBuf,
        /// The seed of the rooms
        #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole, allow_negative_numbers = true)]
        seed: u64,
    },
    /// Be the kitchen for another program: speak env/1 on standard input and output
    #[command(after_help = "Example:\n  typelift run model.json task.json --env 'typelift kitchen serve'")]
    Serve,
    /// Hold the simulator against recorded traces
    #[command(after_help = "Example:\n  typelift kitchen replay K/demos/*.jsonl\n\n\
        Sets the simulator to a trace's first state, performs its actions, and compares\n\
        the atoms after each. Exit codes: 0 no difference, 12 a difference,\n\
        31 bad input.")]
    Replay {
        /// Traces that begin with a snapshot of a kitchen
        #[arg(required = true, value_name = "TRACE")]
        traces: Vec<PathBuf>,
        /// Print one JSON object a trace instead
        #[arg(long)]
        json: bool,
    },
    /// Draw a room
    #[command(after_help = "Example:\n  typelift kitchen draw T5.4 --seed 3")]
    Draw {
        /// A task's or a fault's name; the default room if left out
        task: Option<String>,
        /// Print the room's state as JSON instead, as tasks and traces have it
        #[arg(long)]
        json: bool,
        /// The seed of the room
        #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole, allow_negative_numbers = true)]
        seed: u64,
    },
}

impl Kitchen {
    pub(crate) fn run(&self, quiet: bool) -> Result<Exit, Failure> {
        match &self.command {
            Command::Export { folder, seed } => export(folder, *seed, quiet),
            Command::Serve => {
                serve(std::io::stdin().lock(), std::io::stdout().lock())?;
                Ok(Exit::Success)
            }
            Command::Replay { traces, json } => replay_all(traces, *json),
            Command::Draw { task, json, seed } => draw_room(task.as_deref(), *seed, *json),
        }
    }
}

fn export(folder: &Path, seed: u64, quiet: bool) -> Result<Exit, Failure> {
    let [demos, task_folder, fault_folder] = ["demos", "tasks", "faults"].map(|name| folder.join(name));
    for path in [&demos, &task_folder, &fault_folder] {
        create_dir_all(path).map_err(|error| FileError::from_write(path, &error))?;
    }
    write_file(&folder.join("types.pddl"), types_pddl().as_bytes())?;
    let demonstrations = demonstrations(seed);
    for demonstration in &demonstrations {
        let mut bytes = Vec::new();
        demonstration.recording.write(&mut bytes)?;
        write_file(&demos.join(format!("{}.jsonl", demonstration.name)), &bytes)?;
    }
    let (tasks, faults) = (tasks(), faults());
    for (folder, list) in [(&task_folder, &tasks), (&fault_folder, &faults)] {
        for task in list {
            write_task(&folder.join(format!("{}.json", task.name)), &task_file(task, seed)?)?;
        }
    }
    if !quiet {
        anstream::eprintln!(
            "wrote types.pddl, {}, {} and {} to {}",
            count(demonstrations.len() as u64, "demonstration"),
            count(tasks.len() as u64, "task"),
            count(faults.len() as u64, "fault"),
            folder.display()
        );
    }
    Ok(Exit::Success)
}

/// The task with the state that its scenario has under this seed, so that it can be planned without the simulator.
fn task_file(task: &KitchenTask, seed: u64) -> Result<TaskFile, Failure> {
    let scenario = Some(task.scenario.clone());
    let state = Simulator::new().reset(&Reset { seed, scenario: scenario.clone() })?;
    Ok(TaskFile {
        goal: task.goal.clone().into(),
        state: Some(state),
        scenario,
        seed: Some(seed),
        ..TaskFile::default()
    })
}

/// What is printed of a replayed trace with `--json`.
#[derive(Serialize)]
struct Replayed {
    trace: String,
    steps: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    difference: Option<DifferenceJson>,
}

#[derive(Serialize)]
struct DifferenceJson {
    step: usize,
    call: Option<GroundCall>,
    refusal: Option<String>,
    missing: Vec<GroundAtom>,
    unexpected: Vec<GroundAtom>,
}

impl From<Difference> for DifferenceJson {
    fn from(difference: Difference) -> Self {
        let Difference { step, call, refusal, missing, unexpected } = difference;
        Self { step, call, refusal: refusal.map(|refusal| refusal.to_string()), missing, unexpected }
    }
}

fn replay_all(traces: &[PathBuf], json: bool) -> Result<Exit, Failure> {
    let mut out = anstream::stdout().lock();
    let mut exit = Exit::Success;
    for path in traces {
        let (steps, difference) = replay_one(path)?;
        if difference.is_some() {
            exit = Exit::NotAchieved;
        }
        let trace = path.display().to_string();
        if json {
            let replayed = Replayed { trace, steps, difference: difference.map(DifferenceJson::from) };
            writeln!(out, "{}", serde_json::to_string(&replayed).unwrap_or_default())?;
            continue;
        }
        match difference {
            None => writeln!(out, "{trace}: {GOOD}no difference{GOOD:#} in {}", count(steps as u64, "step"))?,
            Some(difference) => write!(out, "{trace}: {}", difference_text(&difference))?,
        }
    }
    Ok(exit)
}

fn replay_one(path: &Path) -> Result<(usize, Option<Difference>), Failure> {
    // It is read once: it may be a pipe.
    let bytes = std::fs::read(path).map_err(|error| FileError::from_io(path, &error))?;
    let reader = || TraceReader::new(path, bytes.as_slice());
    // Checks the whole trace first: types, entities, the alternation of states and actions.
    let mut parser = Parser::new(typelift_kitchen::hierarchy(), ParseConfig::default());
    trace_from(path, reader()?, &mut parser)?;
    let recording = reader()?.recording()?;
    let Scene::Snapshot(first) = recording.first else {
        return Err(Failure::bad_input(format!("{}: the first state is not a snapshot", path.display())).with_hint(
            "A kitchen cannot be built from atoms alone: they do not say in which order things are stacked.",
        ));
    };
    let steps = recording.steps.into_iter().map(|(action, after)| (action.call, after));
    let report = replay(&first, steps).map_err(|error| Failure::bad_input(error).in_file(path))?;
    Ok((report.steps, report.difference))
}

fn difference_text(difference: &Difference) -> String {
    let at = match &difference.call {
        None => "in the first state".to_owned(),
        Some(call) => format!("after step {}, {call}", difference.step),
    };
    let mut text = format!("{BAD}differs{BAD:#} {at}\n");
    for atom in &difference.missing {
        text += &format!("  recorded, but not in the simulator: {atom}\n");
    }
    for atom in &difference.unexpected {
        text += &format!("  in the simulator, but not recorded: {atom}\n");
    }
    if let Some(refusal) = &difference.refusal {
        text += &format!("  the simulator refused: {refusal}\n");
    }
    text
}

fn draw_room(name: Option<&str>, seed: u64, json: bool) -> Result<Exit, Failure> {
    let all: Vec<KitchenTask> = tasks().into_iter().chain(faults()).collect();
    let scenario = match name {
        None => None,
        Some(name) => {
            let task = all.iter().find(|task| task.name == name).ok_or_else(|| {
                let names: Vec<Symbol> = all.iter().map(|task| Symbol::from(task.name.as_str())).collect();
                Failure::bad_input(format!("there is no task `{name}`")).with_hint(or_one_of(name, &names))
            })?;
            Some(task.scenario.clone())
        }
    };
    let mut kitchen = Simulator::new();
    let scene = kitchen.reset(&Reset { seed, scenario })?;
    let mut out = anstream::stdout().lock();
    if json {
        writeln!(out, "{}", serde_json::to_string(&scene).unwrap_or_default())?;
        return Ok(Exit::Success);
    }
    write!(out, "{}", kitchen.room().map(draw).unwrap_or_default())?;
    Ok(Exit::Success)
}
