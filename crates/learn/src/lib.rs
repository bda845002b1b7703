//! Algorithm 1: learning individual actions from demonstrations, and generalizing them.
//!
//! Each step of the paper's pseudocode is a file and a function of the paper's name:
//!
//! | step                    | file             |
//! |-------------------------|------------------|
//! | `ClusterLiftedEffects`  | `cluster.rs`, and what a step is taken for, `outcome.rs` |
//! | `ExtractPreconditions`  | `precondition.rs`|
//! | `CreateAction`          | `draft.rs`       |
//! | `CreateGenPars`, `CreateGenAction` | `generalize.rs` |
//! | `ScoreAction`           | `score.rs`       |
//!
//! Clustering is a fold: [`observe`] adds one transition to an [`Evidence`]. Everything after it is a function of
//! that evidence: [`learn`]. Nothing looks at a transition twice, and no result depends on the order of transitions,
//! of files, or on the names of objects.
//!
//! ```
//! use typelift_learn::{evidence_of, learn, Options};
//! use typelift_world::Dataset;
//!
//! let demonstrations = Dataset::default(); // read from files, or recorded
//! let evidence = evidence_of(&demonstrations);
//! let learned = learn(&demonstrations.hierarchy, &evidence, &Options::default()).unwrap();
//! assert_eq!(learned.model.actions.len(), learned.report.generalized);
//! ```
#![deny(missing_docs)]

mod cluster;
mod draft;
mod generalize;
mod outcome;
mod precondition;
mod score;

use std::collections::BTreeMap;

use thiserror::Error;
use typelift_model::{ActionModel, Evidence, Hierarchy, LearnedModel, Symbol};
use typelift_world::Dataset;

pub use cluster::observe;

use draft::Draft;
use generalize::Counts;

/// What is learned, and how.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Stop after the first phase: individual actions, the paper's baseline.
    pub individual: bool,
    /// The type of whoever acts. `None`: the type that fills argument 0 of every action and no other parameter.
    pub actor: Option<Actor>,
}

/// A declared actor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Actor {
    /// Objects of this type act.
    Type(Symbol),
    /// Nobody in the state acts.
    Nobody,
}

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
    pub refused_merges: usize,
    /// The failures that do.
    pub failures_against: u64,
    /// Transitions that were not executed, or changed nothing.
    pub failures: u64,
    /// Transitions of which nothing explains what changed.
    pub unexplained: u64,
    /// Actions of the model that rest on a single observation.
    pub single_support: usize,
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

/// ClusterLiftedEffects over a whole dataset.
pub fn evidence_of(dataset: &Dataset) -> Evidence {
    let mut evidence = Evidence::default();
    for transition in dataset.transitions() {
        observe(&mut evidence, &transition, &dataset.hierarchy);
    }
    evidence
}

/// Algorithm 1 from a dataset: the model with its evidence, how its snapshots were read and every predicate met.
///
/// # Errors
/// [`LearnError::UnknownType`] for a declared actor that the hierarchy does not have.
pub fn learn_dataset(dataset: &Dataset, options: &Options) -> Result<(LearnedModel, Report), LearnError> {
    let evidence = evidence_of(dataset);
    let Learned { mut model, report } = learn(&dataset.hierarchy, &evidence, options)?;
    model.predicates.extend(dataset.predicates.clone());
    Ok((LearnedModel { model, parse: dataset.parse.clone(), evidence }, report))
}

/// Algorithm 1 after clustering: a pure function of the evidence.
///
/// # Errors
/// [`LearnError::UnknownType`] if the evidence or a declared actor names a type that `hierarchy` does not have.
pub fn learn(hierarchy: &Hierarchy, evidence: &Evidence, options: &Options) -> Result<Learned, LearnError> {
    let mut actions = Vec::with_capacity(evidence.clusters.len());
    for (key, cluster) in &evidence.clusters {
        let preconditions = precondition::extract_preconditions(cluster);
        actions.push(draft::create_action(key, cluster, preconditions, hierarchy)?);
    }
    let individual = actions.len();
    let mut counts = Counts::default();
    if !options.individual {
        (actions, counts) = generalize::to_fixed_point(actions, evidence, hierarchy);
    }
    let report = Report {
        transitions: evidence.transitions,
        individual,
        generalized: actions.len(),
        scored_pairs: counts.scored,
        refused_merges: counts.refused,
        failures_against: counts.failures,
        failures: evidence.failures(),
        unexplained: evidence.unexplained.values().map(|(count, _)| count).sum(),
        single_support: actions.iter().filter(|action| action.observations() == 1).count(),
    };
    let mut model = ActionModel {
        predicates: predicates_of(&actions),
        hierarchy: hierarchy.clone(),
        actions: actions.into_iter().map(Draft::into_schema).collect(),
        ..ActionModel::default()
    };
    model.actor = match &options.actor {
        None => model.default_actor(),
        Some(Actor::Nobody) => None,
        Some(Actor::Type(name)) => {
            Some(hierarchy.id(name.as_str()).ok_or_else(|| LearnError::UnknownType(name.clone()))?)
        }
    };
    draft::name_actions(&mut model);
    Ok(Learned { model, report })
}

fn predicates_of(actions: &[Draft]) -> BTreeMap<Symbol, usize> {
    let atoms = actions.iter().flat_map(|a| a.adds.iter().chain(&a.deletes).chain(&a.preconditions));
    atoms.map(|atom| (atom.predicate.clone(), atom.arity())).collect()
}
