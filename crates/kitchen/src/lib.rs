//! The kitchen simulator.
#![deny(missing_docs)]
