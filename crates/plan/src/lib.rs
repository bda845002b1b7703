//! Planning as heuristic search: grounding, relaxed reachability, landmarks, A*, and why there is no plan.
//!
//! The data flows through the files in this order:
//!
//! ```text
//! ActionModel, Task, Restrictions ─▶ [reach] ─▶ [ground] GroundTask ─▶ [landmark] sequences ─▶ [heuristic]
//!                                                        └──────────▶ [successor] ─▶ [search] ─▶ Plan
//! ```
//!
//! This crate has never heard of learning or imagination: it plans with whatever actions it is given.
#![deny(missing_docs)]

mod axiom;
mod distinct;
mod emit;
mod explain;
mod external;
mod fact;
mod ground;
pub mod heuristic;
mod landmark;
mod memory;
mod pattern;
mod planner;
mod poll;
mod reach;
mod restrict;
mod restricted;
mod search;
mod successor;

pub use explain::{Explanation, Misfit, Nearest, UnreachableGoal};
pub use external::{ExternalFailure, ExternalPlanner};
pub use fact::FactId;
pub use ground::{ConditionalEffect, GroundTask, Op, OpId, TieOrder, ground};
pub use landmark::{LandmarkSequence, landmark_sequences};
pub use planner::{Options, Planner};
pub use reach::Cut;
pub use restrict::{Ban, Exclusion, Restrictions};
pub use search::{Outcome, Report};
