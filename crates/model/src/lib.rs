//! The vocabulary of typelift, shared by every other crate and depending on none of them.
//!
//! What is *observed* is a [`State`] (objects with types, and the ground atoms that hold) and, between two
//! states, a [`GroundCall`]. What is *learned* is an [`ActionModel`]: a [`Hierarchy`] of types and a list of
//! lifted [`ActionSchema`]s; a [`LearnedModel`] keeps the [`Evidence`] they rest on beside it. What is *asked* is a
//! [`Task`], what is *answered* a [`Plan`].
//!
//! Ground and lifted things are different types: [`GroundAtom`] is an [`Atom`] over [`Symbol`]s,
//! [`LiftedAtom`] one over [`Term`]s. Everything symbolic is ordered by its name, never by an interning
//! order, so that no result depends on the order in which names were met.
#![deny(missing_docs)]

mod action;
mod action_model;
mod argument_types;
mod atom;
mod axiom;
mod budget;
mod call;
mod choices;
mod derivation;
mod evidence;
mod evidence_file;
mod familiar;
mod goal;
mod goal_error;
mod goal_types;
mod hierarchy;
mod instances;
mod instantiate;
mod json_message;
mod learned_model;
mod matching;
mod model_1;
mod model_error;
mod model_file;
mod model_reader;
mod no_actor;
mod numbered_keys;
mod observations;
mod open_file;
mod other_notation;
mod parse_config;
mod pddl_names;
mod plan;
mod pre_states;
mod predicate_name;
mod printable;
mod provenance;
mod renaming;
mod settled;
mod similar;
mod source;
mod split_mix;
mod state;
mod strict;
mod symbol;
mod task;
#[cfg(feature = "testing")]
pub mod testing;
mod unify;
mod unknown;
mod view;
mod wording;

pub use action::{ActionSchema, Cost, Effect, Literal, Parameter};
pub use action_model::{ActionModel, ModelPddlNames, UniqueNames, describe_replacements, schema_name};
pub use argument_types::{ArgumentTypes, cover};
pub use atom::{Atom, AtomTextError, EQUALS, GroundAtom, LiftedAtom, Term, check_name};
pub use axiom::Axiom;
pub use budget::{Budget, MemoryLimit, MemoryProbe, Stop};
pub use call::{GroundCall, LiftedCall};
pub use evidence::{CompactError, Evidence, MergeError};
pub use familiar::{Familiar, Unfamiliar};
pub use goal::Goal;
pub use goal_error::{GoalError, GoalErrorKind};
pub use goal_types::GoalTypeMismatch;
pub use hierarchy::{Hierarchy, HierarchyError, ROOT, TypeId};
pub use instantiate::{GroundAction, InstantiateError};
pub use json_message::json_message;
pub use learned_model::{Actor, Disagreement, LearnOptions, LearnedModel, RefusedMerges};
pub use matching::{Place, bind_places};
pub use model_error::{MODEL_FORMAT, ModelFileError};
pub use model_reader::MOST_PRECONDITIONS;
pub use no_actor::{ActedOn, NoActor};
pub use numbered_keys::numbered_keys;
pub use observations::{
    Cluster, ClusterKey, MOST_PARAMETERS, NegativeKey, Observations, OpenObservations, Unexplained, WITNESS_BOUND,
    Witness,
};
pub use other_notation::OtherNotation;
pub use parse_config::ParseConfig;
pub use pddl_names::{NameCollision, PddlNames};
pub use plan::{Imagined, Plan, Step};
pub use pre_states::{PRE_STATE_BOUND, PreStates};
pub use predicate_name::{name_with_arity, predicate_told_apart};
pub use printable::printable;
pub use provenance::{Provenance, Replacement, Support};
pub use similar::{did_you_mean, nearest};
pub use source::{Source, SourceId, SourceIdError};
pub use split_mix::{SplitMix64, spread};
pub use state::State;
pub use strict::strict;
pub use symbol::{Symbol, SymbolPool};
pub use task::Task;
pub use unify::{effect_bijections, is_bijection};
pub use unknown::{Pattern, Slot, Unknown};
pub use view::{AtomKind, View};
pub use wording::Wording;

/// The hash map of all crates: fast, and never iterated into a result.
pub type HashMap<K, V> = rustc_hash::FxHashMap<K, V>;
/// The hash set of all crates: fast, and never iterated into a result.
pub type HashSet<K> = rustc_hash::FxHashSet<K>;
