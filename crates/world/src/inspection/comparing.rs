//! Two states that should be the same.

use std::collections::BTreeSet;

use typelift_model::{GroundAtom, State, Symbol};

use super::Change;

/// How the second state differs from the first, leaving out some predicates; nothing if it does not.
pub(super) fn compare(first: &State, second: &State, without: &BTreeSet<Symbol>) -> Option<Change> {
    let counts = |atom: &&GroundAtom| !without.contains(&atom.predicate);
    let objects = first.objects.keys().filter(|name| !second.objects.contains_key(*name));
    let objects = objects.chain(second.objects.keys().filter(|name| !first.objects.contains_key(*name)));
    let change = Change {
        objects: objects.cloned().collect(),
        added: first.added(second).filter(counts).cloned().collect(),
        deleted: first.deleted(second).filter(counts).cloned().collect(),
    };
    (!change.is_empty()).then_some(change)
}
