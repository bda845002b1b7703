//! What is observed: the snapshots that an environment gives, how they become symbolic states, the transitions of
//! demonstrations, and the files and messages in which people and programs exchange them.
#![deny(missing_docs)]

mod dataset;
mod environment;
mod parse;
mod protocol;
mod snapshot;

pub use dataset::{Dataset, Trace, TraceAction, Transition};
pub use environment::{Acted, Reset, World, WorldError};
pub use parse::{ParseError, ParseErrorKind, Parser};
pub use protocol::{Answer, PROTOCOL, Request, RequestBody};
pub use snapshot::{Entity, Relation, Scene, Snapshot, Value};
