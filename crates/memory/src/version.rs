//! Which version of the format is read and written.

/// The version of the format that this program reads and writes.
pub const VERSION: i64 = 1;
