//! Replays a plan by the plainest semantics.
#![deny(missing_docs)]
