//! The s-expression reader, PDDL types, domains and trajectories, with errors that point at the text.
#![deny(missing_docs)]
