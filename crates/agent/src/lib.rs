//! Acting with a learned model: propose a plan, execute it step by step, compare what happened with what was
//! expected, exclude what failed, imagine again, replan, remember.
//!
//! An [`Episode`] is a state machine without a thread, a clock or a world of its own: whoever drives it feeds it an
//! [`Input`] and does what the [`Command`] says. A page, a notebook or a robot's own loop can drive it; [`run`] drives
//! it over a [`World`](typelift_world::World).
#![deny(missing_docs)]

mod account;
mod episode;
mod event;
mod experience;
mod monitor;
mod options;
mod propose;
mod run;
mod turn;

pub use account::{Account, Ending, Failure};
pub use episode::Episode;
pub use event::{Event, Observer, PlanSummary, StepSummary};
pub use experience::{Experience, Remembered};
pub use monitor::{StepResult, compare};
pub use options::Options;
pub use propose::{Proposal, ProposeError, propose};
pub use run::{Confirmation, RunError, run};
pub use turn::{Command, Input};
