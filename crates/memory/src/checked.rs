//! Whether a memory is as it was written, entry by entry.

use std::path::Path;

use rusqlite::Connection;
use typelift_model::LearnedModel;

use crate::error::{MemoryError, MemoryErrorKind};
use crate::fold::{Fold, kept_fold};
use crate::format::{self, Access};
use crate::salvage::Salvaged;

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
    let salvaged = Salvaged::read(file)?;
    let mut found = Checked {
        entries: salvaged.entries.len() as u64,
        problems: salvaged.pages.iter().cloned().chain(salvaged.said()).collect(),
    };
    let connection = match format::open(file, Access::Read) {
        Ok(connection) => connection,
        Err(kind @ MemoryErrorKind::Damaged(_)) => {
            // What is known of it already says more.
            if found.problems.is_empty() {
                found.problems.push(kind.to_string());
            }
            return Ok(found);
        }
        Err(kind) => return Err(kind),
    };
    match sums(&connection) {
        Ok(problems) => found.problems.extend(problems),
        Err(_) if !found.problems.is_empty() => {}
        Err(kind) => found.problems.push(format!("it cannot be learned from: {kind}")),
    }
    Ok(found)
}

/// What is wrong with the sum over all entries, and whether the one that is kept is another.
fn sums(connection: &Connection) -> Result<Vec<String>, MemoryErrorKind> {
    let basis = LearnedModel::from_json(&format::basis(connection)?)?;
    let anew = Fold::default().go_on(connection, &basis)?;
    let mut problems: Vec<String> = anew.unread.iter().map(ToString::to_string).collect();
    if let Some((mut kept, _)) = kept_fold(connection)?
        && kept.go_on(connection, &basis)?.evidence != anew.evidence
    {
        problems.push("the sum that is kept is not that of the entries".to_owned());
    }
    Ok(problems)
}
