//! Algorithm 1.
#![deny(missing_docs)]
