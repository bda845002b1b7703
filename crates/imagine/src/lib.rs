//! Algorithm 2.
#![deny(missing_docs)]
