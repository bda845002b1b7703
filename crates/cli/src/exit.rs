//! Exit codes, one for each way to end. Planning uses Fast Downward's.

use std::process::ExitCode;

/// How the program ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Done; a plan was found; the goal was seen to hold; the replay agrees.
    Success = 0,
    /// There is no plan in this model, and nothing was cut off.
    Unsolvable = 11,
    /// The search gave up at a limit; the goal was not achieved; the replay differs.
    NotAchieved = 12,
    /// The memory allowed is used up.
    OutOfMemory = 22,
    /// The time allowed is used up.
    OutOfTime = 23,
    /// Something read is wrong.
    BadInput = 31,
    /// A defect of typelift itself.
    Internal = 32,
    /// Something read is right, but not supported.
    Unsupported = 34,
    /// The environment failed.
    Environment = 35,
    /// The command line is wrong.
    Usage = 36,
    /// Somebody stopped it.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
