//! For tests, here and in crates that import this one (feature `testing`): random problems, problems in a few lines of
//! text, and what enumeration says of them.
//!
//! What is wrong with a text is told by a panic: its reader is writing the test.

mod cases;
mod enumerate;
mod tiny;
mod written;

pub use cases::cases;
pub use enumerate::{
    Cheapest, Instance, Signed, all_instances, apply, cheapest, cheapest_without, reachable_atoms, reachable_instances,
};
pub use tiny::{Tiny, tiny};
