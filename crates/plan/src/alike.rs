//! Classes of objects of which a task says the same.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionModel, GroundAtom, HashMap, Symbol, Term};

/// What one statement says of an object: its kind, its predicate, and what stands beside the object, which is left out.
type Statement<'a, S, O> = (S, &'a Symbol, Vec<Option<O>>);

/// The classes of objects that agree in their own key, and of which the statements, each an atom of some kind, say the
/// same. The other arguments of an atom count only as far as `beside` tells them apart. The objects of a class are in the
/// order given.
pub(crate) fn alike<'a, K: Ord, S: Ord + Copy, O: Ord>(
    objects: impl Iterator<Item = (&'a Symbol, K)>,
    statements: impl Iterator<Item = (S, &'a GroundAtom)>,
    beside: impl Fn(&'a Symbol) -> O,
) -> Vec<Vec<&'a Symbol>> {
    let mut said: HashMap<&Symbol, Vec<Statement<'a, S, O>>> = HashMap::default();
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

/// The objects that actions and axioms name.
pub(crate) fn constants(model: &ActionModel) -> BTreeSet<&Symbol> {
    let of_actions = model.actions.iter().flat_map(|action| {
        let conditions = action.effects.iter().flat_map(|effect| effect.condition.iter().chain([&effect.literal]));
        let atoms = action.preconditions.iter().chain(conditions).map(|literal| &literal.atom);
        atoms.chain(&action.cost.functions).flat_map(|atom| &atom.args).chain(&action.call.args)
    });
    let of_axioms = model.axioms.iter().flat_map(|axiom| {
        axiom.body.iter().map(|literal| &literal.atom).chain([&axiom.head]).flat_map(|atom| &atom.args)
    });
    let mut named = BTreeSet::new();
    for term in of_actions.chain(of_axioms) {
        if let Term::Const(name) = term {
            named.insert(name);
        }
    }
    named
}
