//! Planning as heuristic search: grounding, finite-domain representation, landmarks, heuristics, searches, and why there
//! is no plan.
//!
//! The data flows through the files in this order:
//!
//! ```text
//! ActionModel, Task, Restrictions ─▶ [scope] ─▶ [reach] ─▶ [ground] GroundTask ─▶ [fdr] variables ─┬▶ [relaxation] ─▶ [landmark]
//!                                                                                       ▼        └─▶ [heuristic] ◀┘
//! Plan ◀─ [planner] ◀─ [widening] ◀─ [level] ◀─ [stages] ◀─ [lama], [search] ◀─────────────────────────────┘
//! ```
//!
//! The last row's modules but the planner are searches around searches, each of which can be asked for one plan after
//! another. The planner alone tells plans apart.
//!
//! This crate has never heard of learning or imagination: it plans with whatever actions it is given.
#![deny(missing_docs)]

mod alike;
mod alternatives;
mod assignment;
mod axioms;
mod conflict;
mod distinct;
mod explain;
mod explanation;
mod external;
mod fact;
mod fdr;
mod ground;
mod heuristic;
mod instantiate;
mod lama;
mod landmark;
mod level;
mod obstacle;
mod op;
mod options;
mod ordered_first;
mod outcome;
mod packed_lists;
mod pattern;
mod planner;
mod poll;
mod reach;
mod relaxation;
mod report;
mod restriction_literals;
mod restrictions;
mod scope;
mod search;
mod shuffle;
mod stages;
mod strategy;
mod symmetry;
mod widening;
#[cfg(test)]
mod worked;

pub use conflict::{Conflict, Need};
pub use explanation::{Explanation, UndeletedGoal, UnreachableGoal, Unreached};
pub use external::{ExternalFailure, ExternalPlanner, PlanDefect, StepDefect};
pub use fact::FactId;
pub use ground::{GroundTask, TieOrder, ground};
pub use landmark::{LandmarkSequence, landmark_sequences};
pub use obstacle::{Nearest, Obstacle, Root};
pub use op::{ConditionalEffect, Op, OpId};
pub use options::Options;
pub use outcome::Outcome;
pub use planner::Planner;
pub use reach::Reachable;
pub use report::Report;
pub use restrictions::{Ban, Exclusion, Restrictions, TypeExclusion};
pub use strategy::{Strategy, UnknownStrategy};
