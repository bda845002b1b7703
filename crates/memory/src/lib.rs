//! What an agent saw and was told, in a file that outlives it.
//!
//! A [`Memory`] is an append-only log: which demonstrations a model was learned from, what was done and observed in each
//! episode, what was taken back. The log alone decides. The evidence is a sum over its entries, and the model a function
//! of the evidence, so that neither the order of the entries nor how often the program was stopped in between matters.
//!
//! Times are kept for people; no result depends on them.
#![deny(missing_docs)]

mod checked;
mod copying;
mod episode;
mod error;
mod fold;
mod format;
mod log;
mod logged;
mod memory;
mod merge;
mod migration;
mod object;
mod recent;
mod rescue;
mod salvage;
mod scene_change;
mod version;
mod words;

pub use checked::{Checked, check};
pub use episode::EpisodeLog;
pub use error::{MemoryError, MemoryErrorKind};
pub use fold::Unread;
pub use format::{Access, looks_like_memory};
pub use log::ProposedStep;
pub use logged::{Logged, What};
pub use memory::Memory;
pub use merge::{Merged, merge};
pub use object::OfObject;
pub use recent::PastEpisode;
pub use rescue::{Rescued, rescue};
pub use version::VERSION;
