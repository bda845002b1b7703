//! Exit codes, one for each way to end. Planning uses Fast Downward's. `docs/exit-codes.md` tells users of them.

use std::process::ExitCode;

use typelift::model::Stop;

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
    /// The external planner failed.
    Planner = 38,
    /// The external planner gave a plan that is none.
    InvalidPlan = 39,
    /// Somebody stopped it.
    Interrupted = 130,
}

impl From<Stop> for Exit {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Expansions => Self::NotAchieved,
            Stop::Memory => Self::OutOfMemory,
            Stop::Time => Self::OutOfTime,
            Stop::Cancelled => Self::Interrupted,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Exit; 13] = [
        Exit::Success,
        Exit::Unsolvable,
        Exit::NotAchieved,
        Exit::OutOfMemory,
        Exit::OutOfTime,
        Exit::BadInput,
        Exit::Internal,
        Exit::Unsupported,
        Exit::Environment,
        Exit::Usage,
        Exit::Planner,
        Exit::InvalidPlan,
        Exit::Interrupted,
    ];

    /// What the document calls it. A new way to end does not compile until it has a name here.
    fn name(exit: Exit) -> &'static str {
        match exit {
            Exit::Success => "success",
            Exit::Unsolvable => "unsolvable",
            Exit::NotAchieved => "not achieved",
            Exit::OutOfMemory => "out of memory",
            Exit::OutOfTime => "out of time",
            Exit::BadInput => "bad input",
            Exit::Internal => "internal",
            Exit::Unsupported => "unsupported",
            Exit::Environment => "environment failed",
            Exit::Usage => "wrong usage",
            Exit::Planner => "planner failed",
            Exit::InvalidPlan => "invalid plan",
            Exit::Interrupted => "interrupted",
        }
    }

    #[test]
    fn the_document_lists_every_code_and_no_other() {
        let rows = include_str!("../../../docs/exit-codes.md").lines().filter_map(|line| {
            let mut cells = line.strip_prefix('|')?.split('|').map(str::trim);
            let code = cells.next()?.parse::<u8>().ok()?;
            let (name, when) = (cells.next()?, cells.next()?);
            assert!(when.ends_with('.'), "{code}: {when}");
            Some((code, name.to_owned()))
        });
        let expected = ALL.map(|exit| (exit as u8, name(exit).to_owned()));
        assert_eq!(rows.collect::<Vec<_>>(), expected);
    }
}
