//! Which version of the format is read and written.

/// The version of the format that this program writes. It reads earlier ones, too.
pub const VERSION: i64 = 2;
