//! How a file of an earlier version becomes one of this.

use rusqlite::{Connection, TransactionBehavior};

use crate::error::MemoryErrorKind;
use crate::version::VERSION;

/// What makes a file of each version, from 1, one of the next.
const MIGRATIONS: [fn(&Connection) -> rusqlite::Result<()>; (VERSION - 1) as usize] = [from_1];

/// Plans and words may be entries, and words be taken back, which version 1 does not know; what it knows stays as it is.
fn from_1(_: &Connection) -> rusqlite::Result<()> {
    Ok(())
}

/// Whether a file of this version can be read as it is.
pub(crate) fn is_readable(version: i64) -> bool {
    (1..=VERSION).contains(&version)
}

/// Makes a file of an earlier version one of this, all at once. One of this version stays as it is.
pub(crate) fn migrate(connection: &mut Connection) -> Result<(), MemoryErrorKind> {
    let version =
        |connection: &Connection| connection.pragma_query_value(None, "user_version", |row| row.get::<_, i64>(0));
    if version(connection)? == VERSION {
        return Ok(());
    }
    let transaction = connection.transaction_with_behavior(TransactionBehavior::Immediate)?;
    // Another program may have done it by now.
    let found = version(&transaction)?;
    for migration in MIGRATIONS.iter().skip(usize::try_from(found - 1).unwrap_or_default()) {
        migration(&transaction)?;
    }
    transaction.pragma_update(None, "user_version", VERSION)?;
    Ok(transaction.commit()?)
}
