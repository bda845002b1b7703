//! Demonstrations as somebody sees them who does not see everything.

use std::collections::{BTreeMap, BTreeSet};

use typelift::model::{AtomKind, GroundAtom, Hierarchy, State, Symbol, Unknown};
use typelift::world::{Dataset, Trace};

/// Every kind of atom that holds in some state.
pub fn kinds_of(dataset: &Dataset) -> BTreeSet<AtomKind> {
    let of_state = |state: &State| -> Vec<AtomKind> {
        state.atoms.iter().filter_map(|atom| kind_of(atom, state, &dataset.hierarchy)).collect()
    };
    dataset.traces.iter().flat_map(|trace| &trace.states).flat_map(of_state).collect()
}

fn kind_of(atom: &GroundAtom, state: &State, hierarchy: &Hierarchy) -> Option<AtomKind> {
    AtomKind::of_ground(atom, |name| state.objects.get(name).map(|ty| hierarchy.name(*ty)))
}

/// The trace with open states, which list every atom of these kinds as true or as false, but for those that are `hidden`.
pub fn opened(
    trace: &Trace,
    hierarchy: &Hierarchy,
    kinds: &BTreeSet<AtomKind>,
    mut hidden: impl FnMut(&GroundAtom) -> bool,
) -> Trace {
    let predicates: BTreeMap<Symbol, usize> =
        trace.states.iter().flat_map(|state| &state.atoms).map(|atom| (atom.predicate.clone(), atom.arity())).collect();
    let open = |state: &State| {
        let mut listed: Vec<GroundAtom> = Vec::new();
        for (predicate, arity) in &predicates {
            let mut tuples: Vec<Vec<Symbol>> = vec![Vec::new()];
            for _ in 0..*arity {
                let longer = |tuple: &Vec<Symbol>| {
                    state
                        .objects
                        .keys()
                        .map(|name| [tuple.as_slice(), std::slice::from_ref(name)].concat())
                        .collect::<Vec<_>>()
                };
                tuples = tuples.iter().flat_map(longer).collect();
            }
            listed.extend(tuples.into_iter().map(|args| GroundAtom { predicate: predicate.clone(), args }));
        }
        listed.retain(|atom| kind_of(atom, state, hierarchy).is_some_and(|kind| kinds.contains(&kind)));
        listed.retain(|atom| !hidden(atom));
        let (held, absent) = listed.into_iter().partition(|atom| state.holds(atom));
        State { objects: state.objects.clone(), atoms: held, unknown: Unknown::AllBut(absent) }
    };
    Trace { states: trace.states.iter().map(open).collect(), ..trace.clone() }
}
