//! Show a robot a few tasks; it plans tasks it was never shown.
#![deny(missing_docs)]
