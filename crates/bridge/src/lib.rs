//! A world in a child process.
#![deny(missing_docs)]
