//! Grounding, reachability, landmarks and heuristic search.
#![deny(missing_docs)]
