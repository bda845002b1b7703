//! The types of predicates' arguments: the lowest that cover what may stand there.

use std::collections::BTreeMap;

use crate::{Hierarchy, Symbol, TypeId};

/// Predicates (or functions) with the type of each argument.
pub type ArgumentTypes = BTreeMap<Symbol, Vec<TypeId>>;

/// Raises the types of a predicate's arguments until they cover these as well.
pub fn cover(
    types: &mut ArgumentTypes,
    hierarchy: &Hierarchy,
    predicate: &Symbol,
    args: impl IntoIterator<Item = TypeId>,
) {
    let args = args.into_iter();
    match types.get_mut(predicate) {
        Some(known) => known.iter_mut().zip(args).for_each(|(known, ty)| *known = hierarchy.lca(*known, ty)),
        None => {
            types.insert(predicate.clone(), args.collect());
        }
    }
}
