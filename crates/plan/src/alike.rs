//! Objects of which a task says the same.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{GroundAtom, HashMap, Symbol};

/// What one statement says of an object: its kind, its predicate, and what stands beside the object, which is left out.
type Said<'a, S, O> = (S, &'a Symbol, Vec<Option<O>>);

/// The classes of objects that agree in their own key, and of which the statements, each an atom of some kind, say the
/// same. What stands beside an object is known by `beside` alone. The objects of a class are in the order given.
pub(crate) fn alike<'a, K: Ord, S: Ord + Copy, O: Ord>(
    objects: impl Iterator<Item = (&'a Symbol, K)>,
    statements: impl Iterator<Item = (S, &'a GroundAtom)>,
    beside: impl Fn(&'a Symbol) -> O,
) -> Vec<Vec<&'a Symbol>> {
    let mut said: HashMap<&Symbol, Vec<Said<'a, S, O>>> = HashMap::default();
    for (kind, atom) in statements {
        for object in atom.args.iter().collect::<BTreeSet<_>>() {
            let others = atom.args.iter().map(|arg| (arg != object).then(|| beside(arg))).collect();
            said.entry(object).or_default().push((kind, &atom.predicate, others));
        }
    }
    let mut classes: BTreeMap<_, Vec<&Symbol>> = BTreeMap::new();
    for (object, key) in objects {
        let mut said = said.remove(object).unwrap_or_default();
        said.sort_unstable();
        classes.entry((key, said)).or_default().push(object);
    }
    classes.into_values().collect()
}
