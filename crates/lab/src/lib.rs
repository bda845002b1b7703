//! The laboratory: every experiment of the paper, run again, and its numbers beside the published ones.
#![deny(missing_docs)]

mod figure;
