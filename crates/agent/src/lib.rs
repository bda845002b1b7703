//! Acting with a learned model: propose a plan, execute it step by step, compare what happened with what was
//! expected, exclude what failed, imagine again, replan, remember.
//!
//! An [`Episode`] is a state machine without a thread, a clock or a world of its own: its driver does what the
//! [`Command`] says and reports with an [`Input`], which names the command that it answers. A page, a notebook or a
//! robot's own loop can drive it; [`run`] drives it over a [`World`](typelift_world::World).
#![deny(missing_docs)]

mod account;
mod acting;
mod actors;
mod around;
mod blame;
mod deed;
mod episode;
mod event;
mod execution;
mod experience;
mod foresight;
mod instead;
mod loosening;
mod monitor;
mod naming;
mod objection;
mod options;
mod outlook;
mod person;
mod planning;
mod propose;
mod recall;
mod resort;
mod retries;
mod risk;
mod run;
mod saved;
mod suspect;
mod turn;
mod word;

pub use account::{Account, Avoided, Ending, Failure, SeenDone, StoppedAt};
pub use around::ConditionAround;
pub use blame::BlameRule;
pub use deed::{Failed, Success};
pub use episode::{Episode, EpisodeError};
pub use event::{Event, Observer, PlanningTerms, WhyNoOther};
pub use experience::{Experience, Remembered};
pub use foresight::Explanation;
pub use loosening::{allowed, propose};
pub use monitor::{Comparison, StepResult, compare};
pub use objection::Objection;
pub use options::Options;
pub use person::{Confirmation, Person, Shown};
pub use propose::{Proposal, ProposeError, Widened, widened};
pub use recall::Recalled;
pub use resort::{CountedExclusions, LastResort, LastResorts, Resort, ResortState};
pub use run::{RunError, run};
pub use saved::{EPISODE_FORMAT, RestoreError};
pub use suspect::{Certainty, Condition, Conditions, Suspect, Suspected};
pub use turn::{Command, CommandId, Input};
pub use typelift_imagine::{GivenUp, Loosening};
pub use word::WordError;
