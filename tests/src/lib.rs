//! What the tests that cross rooms share; the tests themselves are in `tests/tests`.

pub mod readers;
pub mod seen;
pub mod strips;
mod worlds;

use std::collections::BTreeSet;
use std::sync::Arc;

use typelift::agent::{Account, Confirmation, Episode, Experience, Observer, Options, run};
use typelift::imagine;
use typelift::learn::{self, learn_dataset};
use typelift::model::{ActionModel, ActionSchema, Budget, ParseConfig, Symbol, Task};
use typelift::world::{Dataset, Parser, Reset, Trace, TraceAction, World};
use typelift_kitchen::{Demonstration, Kitchen, KitchenTask, demonstrations, hierarchy};

pub use worlds::{Meddle, Ran, Watched, approve, run_in};

/// Demonstrations of the kitchen as a dataset.
///
/// # Panics
/// If the simulator's scenes are not states.
pub fn dataset_of(demonstrations: &[Demonstration]) -> Dataset {
    let mut parser = Parser::new(hierarchy(), ParseConfig::default());
    let trace = |d: &Demonstration| Trace {
        file: Some(Symbol::from(format!("{}.jsonl", d.name))),
        task: d.task.clone(),
        goal: d.goal.clone(),
        states: d.scenes.iter().map(|scene| parser.parse(scene).expect("a state")).collect(),
        actions: d
            .calls
            .iter()
            .map(|call| TraceAction { call: call.clone(), executed: None, reason: None, time: None })
            .collect(),
    };
    let traces: Vec<Trace> = demonstrations.iter().map(trace).collect();
    Dataset::new(&parser, traces)
}

/// The model of the kitchen's eight demonstrations: generalized, or individual actions only.
///
/// # Panics
/// If learning fails.
pub fn kitchen_model(individual: bool) -> ActionModel {
    let options = learn::Options { individual, ..learn::Options::default() };
    learn_dataset(&dataset_of(&demonstrations(0)), &options).expect("a model").model
}

/// The four variants of the paper's evaluation: name, individual actions only, with imagination.
pub const VARIANTS: [(&str, bool, bool); 4] = [
    ("generalized+imagined", false, true),
    ("generalized", false, false),
    ("individual+imagined", true, true),
    ("individual", true, false),
];

/// How the paper's experiments are run.
pub fn paper_options(imagine: bool) -> Options {
    Options { imagine: imagine.then(imagine::Options::default), restart: true, ..Options::default() }
}

/// One task in the simulator, without experience from others.
///
/// # Panics
/// If the simulator fails.
pub fn solve(model: &ActionModel, task: &KitchenTask, seed: u64, options: &Options, budget: &Budget) -> Account {
    solve_watched(model, task, seed, options, budget, &mut ())
}

/// The same, watched.
///
/// # Panics
/// If the simulator fails.
pub fn solve_watched(
    model: &ActionModel,
    task: &KitchenTask,
    seed: u64,
    options: &Options,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> Account {
    let model = Arc::new(model.clone());
    let mut parser = Parser::new(model.hierarchy.clone(), model.parse.clone());
    let mut episode = Episode::new(model, task.goal.clone(), options.clone(), Experience::new(), budget.clone());
    let reset = Reset { seed, scenario: Some(task.scenario.clone()) };
    let mut approve = |_: &_| Confirmation::Approve;
    run(&mut episode, &mut Kitchen::new(), &reset, &mut parser, &mut approve, observer).expect("the simulator works")
}

/// A task of the kitchen as a planner gets it.
///
/// # Panics
/// If the simulator fails.
pub fn planning_task(model: &ActionModel, task: &KitchenTask, seed: u64) -> Task {
    let reset = Reset { seed, scenario: Some(task.scenario.clone()) };
    let scene = Kitchen::new().reset(&reset).expect("the simulator works");
    let mut parser = Parser::new(model.hierarchy.clone(), model.parse.clone());
    Task::new(parser.parse(&scene).expect("a state"), task.goal.clone())
}

/// What an action is, whatever its parameters are called or numbered beyond the call's arguments: its text under every
/// numbering.
///
/// # Panics
/// If it has more than two parameters that its call does not name.
pub fn shape(action: &ActionSchema) -> BTreeSet<String> {
    // Every numbering of the parameters that keeps the call's, which come first.
    let (fixed, n) = (action.call.args.len(), action.parameters.len());
    let free: Vec<u32> = (fixed as u32..n as u32).collect();
    let orders = match free.as_slice() {
        [] => vec![vec![]],
        [a] => vec![vec![*a]],
        [a, b] => vec![vec![*a, *b], vec![*b, *a]],
        _ => panic!("{} has many parameters beyond its call", action.name),
    };
    orders
        .into_iter()
        .map(|order| {
            let map: Vec<u32> = (0..fixed as u32).chain(order).collect();
            let mut types = vec![None; n];
            for (i, parameter) in action.parameters.iter().enumerate() {
                types[map[i] as usize] = Some(parameter.ty);
            }
            let preconditions: BTreeSet<_> = action.preconditions.iter().map(|l| l.atom.renamed(&map)).collect();
            let effects: BTreeSet<_> =
                action.effects.iter().map(|e| (e.literal.positive, e.literal.atom.renamed(&map))).collect();
            format!("{:?} {types:?} {preconditions:?} {effects:?}", action.call.name)
        })
        .collect()
}
