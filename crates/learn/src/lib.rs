//! Algorithm 1: learning individual actions from demonstrations, and generalizing them.
//!
//! Each step of the paper's pseudocode is a function of the paper's name:
//!
//! | step                    | file             |
//! |-------------------------|------------------|
//! | `ClusterLiftedEffects`  | `cluster.rs`, with the labels of its entities, `canonical.rs`, what a step is taken for, `outcome.rs`, and of which too much is hidden, `open.rs` |
//! | `ExtractPreconditions`, `CreateAction` | `draft.rs` |
//! | `CreateGenPars`, `CreateGenAction` | `generalize.rs` |
//! | `ScoreAction`           | `score.rs`       |
//!
//! Clustering is a fold: [`observe`] adds one transition to [`Observations`]; [`Evidence`] holds those of each source, and
//! their sum. Everything after it is a function of that sum: [`learn`]. Nothing looks at a transition twice, and no result
//! depends on the order of transitions, of files, or on the names of objects.
//!
//! ```
//! use typelift_learn::{evidence_of, learn, Options};
//! use typelift_world::Dataset;
//!
//! let demonstrations = Dataset::default(); // read from files, or recorded
//! let evidence = evidence_of(&demonstrations);
//! let learned = learn(&demonstrations.hierarchy, &evidence.total(), &Options::default()).unwrap();
//! assert_eq!(learned.model.actions.len(), learned.report.generalized);
//! ```
#![deny(missing_docs)]

mod actor;
mod canonical;
mod cluster;
mod draft;
mod generalize;
mod open;
mod outcome;
mod predicates;
mod score;

use std::collections::BTreeMap;

use thiserror::Error;
use typelift_model::{
    ActionModel, Evidence, Hierarchy, LearnedModel, NoActor, Observations, ParseConfig, RefusedMerges, Symbol,
};
use typelift_world::{Dataset, Trace};

pub use actor::{Part, part_of};
pub use cluster::observe;
pub use score::FailuresAgainst;
pub use typelift_model::{Actor, LearnOptions as Options};

use draft::Draft;
use generalize::Counts;

/// What learning counted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Report {
    /// Transitions in the evidence.
    pub transitions: u64,
    /// Individual actions: clusters.
    pub individual: usize,
    /// Actions after generalization; equal to `individual` if that was all that was asked for.
    pub generalized: usize,
    /// Pairs of actions whose generalization was scored.
    pub scored_pairs: usize,
    /// Pairs of actions of the model that were not merged, since failures speak against it.
    pub refused: RefusedMerges,
    /// The names of the two of each pair, sorted.
    pub not_merged: Vec<[Symbol; 2]>,
    /// Of each call of which there are such pairs, the failures that speak against it.
    pub against_merges: BTreeMap<Symbol, FailuresAgainst>,
    /// Transitions that were not executed, or changed nothing.
    pub failures: u64,
    /// Transitions of which nothing explains what changed.
    pub unexplained: u64,
    /// Actions of the model that rest on a single observation.
    pub single_support: usize,
    /// Why the model has no default actor, if none was declared and the demonstrations do not show one.
    pub no_actor: Option<NoActor>,
}

/// A model and how it came about.
#[derive(Debug, Clone)]
pub struct Learned {
    /// The model.
    pub model: ActionModel,
    /// The counts.
    pub report: Report,
}

/// Why nothing can be learned from an evidence.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum LearnError {
    /// The evidence, or the declared actor, names a type that the hierarchy does not have.
    #[error("unknown type `{0}`")]
    UnknownType(Symbol),
}

/// ClusterLiftedEffects over a whole dataset, by source; a trace that is there twice counts once.
pub fn evidence_of(dataset: &Dataset) -> Evidence {
    let of_trace = |trace: &Trace| {
        let name = trace.file.clone().unwrap_or_else(|| Symbol::new("-"));
        (trace.source_id(&dataset.hierarchy), name, observe_trace(trace, &dataset.hierarchy))
    };
    dataset.traces.iter().map(of_trace).collect()
}

/// What one trace shows.
pub fn observe_trace(trace: &Trace, hierarchy: &Hierarchy) -> Observations {
    let mut observations = Observations::default();
    predicates::observe_predicates(&mut observations, trace, hierarchy);
    for transition in trace.transitions() {
        observe(&mut observations, &transition, hierarchy);
    }
    observations
}

/// Algorithm 1 from a dataset: the model with its evidence, and how its snapshots were read.
///
/// # Errors
/// [`LearnError::UnknownType`] for a declared actor that the hierarchy does not have.
pub fn learn_dataset(dataset: &Dataset, options: &Options) -> Result<(LearnedModel, Report), LearnError> {
    learn_evidence(&dataset.hierarchy, &dataset.parse, evidence_of(dataset), options)
}

/// Algorithm 1 from evidence, as it was gathered or as it is after something was added or taken out: the model that
/// learning from all of its sources at once gives.
///
/// # Errors
/// [`LearnError::UnknownType`] if the evidence or a declared actor names a type that `hierarchy` does not have.
pub fn learn_evidence(
    hierarchy: &Hierarchy,
    parse: &ParseConfig,
    evidence: Evidence,
    options: &Options,
) -> Result<(LearnedModel, Report), LearnError> {
    let total = evidence.total();
    let Learned { model, report } = learn(hierarchy, &total, options)?;
    let refused = report.refused;
    let parse = ParseConfig { by_arity: total.names_of_several_arities(), ..parse.clone() };
    drop(total);
    let options = options.clone();
    Ok((LearnedModel { model, parse, options, evidence, refused, ..LearnedModel::default() }, report))
}

/// Algorithm 1 after clustering: a pure function of what was observed.
///
/// # Errors
/// [`LearnError::UnknownType`] if something observed or a declared actor names a type that `hierarchy` does not have.
pub fn learn(hierarchy: &Hierarchy, observations: &Observations, options: &Options) -> Result<Learned, LearnError> {
    let observations = &*observations.settled();
    let mut actions = Vec::with_capacity(observations.clusters.len());
    for (key, cluster) in &observations.clusters {
        actions.push(draft::create_action(key, cluster, hierarchy)?);
    }
    let individual = actions.len();
    let mut counts = Counts::default();
    if !options.individual {
        (actions, counts) = generalize::to_fixed_point(actions, observations, hierarchy);
    }
    predicates::tell_apart_by_arity(&mut actions, observations);
    let mut report = Report {
        transitions: observations.transitions,
        individual,
        generalized: actions.len(),
        scored_pairs: counts.scored,
        refused: counts.refused,
        not_merged: Vec::new(),
        against_merges: counts.against,
        failures: observations.failures(),
        unexplained: observations.unexplained.values().map(|(count, _)| count).sum(),
        single_support: actions.iter().filter(|action| action.observations() == 1).count(),
        no_actor: None,
    };
    let mut model = ActionModel {
        predicates: predicates::types_of_predicates(observations, &actions, hierarchy)?,
        hierarchy: hierarchy.clone(),
        actions: actions.into_iter().map(Draft::into_schema).collect(),
        ..ActionModel::default()
    };
    model.actor = match &options.actor {
        None => match actor::demonstrated_actor(observations, hierarchy)? {
            Ok(actor) => Some(actor),
            Err(why) => {
                report.no_actor = Some(why);
                None
            }
        },
        Some(Actor::Nobody) => None,
        Some(Actor::Type(name)) => {
            Some(hierarchy.id(name.as_str()).ok_or_else(|| LearnError::UnknownType(name.clone()))?)
        }
    };
    let names = draft::name_actions(&mut model);
    let pair = |&(one, other): &(usize, usize)| {
        let mut pair = [names[one].clone(), names[other].clone()];
        pair.sort_unstable();
        pair
    };
    report.not_merged = counts.pairs.iter().map(pair).collect();
    report.not_merged.sort_unstable();
    Ok(Learned { model, report })
}
