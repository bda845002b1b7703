//! Whether a memory is as it was written, entry by entry.

use std::path::Path;

use rusqlite::Connection;
use typelift_model::LearnedModel;

use crate::error::{MemoryError, MemoryErrorKind};
use crate::fold::{Fold, kept_fold};
use crate::format::{self, Access};
use crate::log::{self, Wanted, list};
use crate::logged::told;

/// What a look at every entry found.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Checked {
    /// Entries that can be read.
    pub entries: u64,
    /// What is wrong, each in a sentence; none if all is well.
    pub problems: Vec<String>,
}

/// Looks at every page, every entry, and whether what is learned from all of them is what the kept sum says. In time of
/// the whole file.
///
/// # Errors
/// [`MemoryError`] if it cannot be opened, so that nothing of it can be read.
pub fn check(file: &Path) -> Result<Checked, MemoryError> {
    look(file).map_err(|kind| kind.of(file))
}

fn look(file: &Path) -> Result<Checked, MemoryErrorKind> {
    let connection = format::open(file, Access::Read)?;
    let mut found = Checked::default();
    pages(&connection, &mut found.problems);
    for number in 1..=log::last(&connection)? {
        match list(&connection, Wanted::Number(number)).map(Vec::into_iter) {
            Ok(entries) => {
                for entry in entries {
                    match told(entry) {
                        Ok(_) => found.entries += 1,
                        Err(kind) => found.problems.push(kind.to_string()),
                    }
                }
            }
            Err(kind) => found.problems.push(format!("entry {number}: {kind}")),
        }
    }
    match sums(&connection) {
        Ok(problems) => found.problems.extend(problems),
        Err(kind) => found.problems.push(format!("it cannot be learned from: {kind}")),
    }
    Ok(found)
}

/// What SQLite says of the file's pages.
fn pages(connection: &Connection, problems: &mut Vec<String>) {
    let said = connection.prepare("PRAGMA integrity_check").and_then(|mut statement| {
        let lines = statement.query_map([], |row| row.get::<_, String>(0))?;
        lines.collect::<Result<Vec<_>, _>>()
    });
    match said {
        Ok(lines) => problems.extend(lines.into_iter().filter(|line| line != "ok")),
        Err(error) => problems.push(error.to_string()),
    }
}

/// What is wrong with the sum over all entries, and whether the one that is kept is another.
fn sums(connection: &Connection) -> Result<Vec<String>, MemoryErrorKind> {
    let basis = LearnedModel::from_json(&format::basis(connection)?)?;
    let anew = Fold::default().go_on(connection, &basis)?;
    let mut problems: Vec<String> = anew
        .unread
        .iter()
        .map(|unread| format!("nothing is learned from entry {}: {}", unread.entry, unread.why))
        .collect();
    if let Some((mut kept, _)) = kept_fold(connection)?
        && kept.go_on(connection, &basis)?.evidence != anew.evidence
    {
        problems.push("the sum that is kept is not that of the entries".to_owned());
    }
    Ok(problems)
}
