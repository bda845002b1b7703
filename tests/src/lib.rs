//! What the tests that cross rooms share; the tests themselves are in `tests/tests`.

pub mod adl_tasks;
pub mod by_hand;
pub mod open;
pub mod readers;
pub mod schema;
pub mod seen;
pub mod source;
mod worlds;

use std::collections::BTreeSet;
use std::sync::Arc;

use typelift::agent::{Account, Options};
use typelift::model::{ActionModel, ActionSchema, Budget, ParseConfig, Task};
use typelift::world::{Parser, Reset, World};
use typelift_kitchen::{Kitchen, KitchenTask};
use typelift_lab::{Setting, attempt};

pub use typelift_lab::{Variant, dataset_of, kitchen_model, paper_options};
pub use worlds::{Meddle, Ran, Watched, approve, run_in};

/// One task in the simulator, without experience from others.
///
/// # Panics
/// If the simulator fails.
pub fn solve(model: &ActionModel, task: &KitchenTask, seed: u64, options: &Options, budget: &Budget) -> Account {
    let done = attempt(&Arc::new(model.clone()), Setting::new(task, seed), options, budget.clone());
    done.expect("the simulator works").account
}

/// A task of the kitchen as a planner gets it.
///
/// # Panics
/// If the simulator fails.
pub fn planning_task(model: &ActionModel, task: &KitchenTask, seed: u64) -> Task {
    let reset = Reset { seed, scenario: Some(task.scenario.clone()) };
    let scene = Kitchen::new().reset(&reset).expect("the simulator works");
    let mut parser = Parser::new(model.hierarchy.clone(), ParseConfig::default());
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
