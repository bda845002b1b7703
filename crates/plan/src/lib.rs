//! Planning as heuristic search: grounding, finite-domain representation, landmarks, heuristics, searches, and why there
//! is no plan.
//!
//! The data flows through the files in this order:
//!
//! ```text
//! ActionModel, Task, Restrictions ─▶ [scope] ─▶ [reach] ─▶ [ground] GroundTask ─▶ [fdr] variables ─┬▶ [relaxation] ─▶ [landmark]
//!                                                                                       ▼        └─▶ [heuristic] ◀┘
//!                                                         Plan ◀─ [strategy] ◀─ [search] ◀───────────────┘
//! ```
//!
//! This crate has never heard of learning or imagination: it plans with whatever actions it is given.
#![deny(missing_docs)]

mod alike;
mod distinct;
mod emit;
mod explain;
mod external;
mod fact;
mod fdr;
mod ground;
mod heuristic;
mod landmark;
mod level;
mod lists;
mod outcome;
mod pattern;
mod planner;
mod poll;
mod reach;
mod relaxation;
mod restrict;
mod restricted;
mod scope;
mod search;
mod shuffle;
mod strategy;
mod symmetry;
#[cfg(test)]
mod worked;

pub use explain::{Explanation, Misfit, Nearest, UnreachableGoal};
pub use external::{ExternalFailure, ExternalPlanner, PlanDefect, StepDefect};
pub use fact::FactId;
pub use ground::{ConditionalEffect, GroundTask, Op, OpId, TieOrder, ground};
pub use landmark::{LandmarkSequence, landmark_sequences};
pub use outcome::Outcome;
pub use planner::{Options, Planner};
pub use reach::Reachable;
pub use restrict::{Ban, Exclusion, Restrictions, TypeExclusion};
pub use search::Report;
pub use strategy::{Strategy, UnknownStrategy};
