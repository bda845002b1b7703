//! An episode as a state machine.
#![deny(missing_docs)]
