//! Models learned from the kitchen's demonstrations, and from some of them.

use typelift::learn::{self, Report, learn_dataset};
use typelift::model::{ActionModel, LearnedModel, ParseConfig};
use typelift::world::{Dataset, Parser, Trace};
use typelift_kitchen::{Demonstration, demonstrations, hierarchy};

/// Demonstrations of the kitchen as a dataset.
///
/// # Panics
/// If the simulator's scenes are not states of its own hierarchy.
pub fn dataset_of(demonstrations: &[Demonstration]) -> Dataset {
    let mut parser = Parser::new(hierarchy(), ParseConfig::default());
    let trace = |d: &Demonstration| d.recording.trace(format!("{}.jsonl", d.name), &mut parser).expect("states");
    let traces: Vec<Trace> = demonstrations.iter().map(trace).collect();
    Dataset::new(&parser, traces)
}

/// What is learned from demonstrations of the kitchen: generalized, or individual actions only.
///
/// # Panics
/// If a demonstration speaks of a type that its hierarchy does not have.
pub fn learned_from(demonstrations: &[Demonstration], individual: bool) -> (LearnedModel, Report) {
    let options = learn::Options { individual, ..learn::Options::default() };
    learn_dataset(&dataset_of(demonstrations), &options).expect("the kitchen's own types")
}

/// The model of all eight demonstrations.
pub fn kitchen_model(individual: bool) -> ActionModel {
    learned_from(&demonstrations(0), individual).0.model
}
