//! The order in which derived predicates are evaluated.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{Axiom, Symbol};

/// That the first derived predicate depends on the second, and whether on its truth (else on its falsity).
pub(super) type Dependency<'a> = (&'a Symbol, &'a Symbol, bool);

/// What axioms make their predicates depend on.
pub(super) fn dependencies(axioms: &[Axiom]) -> BTreeSet<Dependency<'_>> {
    let derived: BTreeSet<&Symbol> = axioms.iter().map(|axiom| &axiom.head.predicate).collect();
    let mut dependencies = BTreeSet::new();
    for axiom in axioms {
        for literal in axiom.body.iter().filter(|literal| derived.contains(&literal.atom.predicate)) {
            dependencies.insert((&axiom.head.predicate, &literal.atom.predicate, literal.positive));
        }
    }
    dependencies
}

/// The least stratum of each predicate that depends on another: none below that of what it depends on, and above that
/// of what must be false. Predicates that are not among them have stratum 0.
///
/// # Errors
/// The predicates on a cycle in which one must be false.
pub(super) fn strata<'a>(
    dependencies: &BTreeSet<Dependency<'a>>,
) -> Result<BTreeMap<&'a Symbol, u32>, BTreeSet<&'a Symbol>> {
    let mut dependents: BTreeMap<&Symbol, Vec<(&'a Symbol, u32)>> = BTreeMap::new();
    for (head, body, positive) in dependencies {
        dependents.entry(body).or_default().push((head, u32::from(!positive)));
    }
    let most = dependents.len() as u32;
    let mut strata: BTreeMap<&'a Symbol, u32> = BTreeMap::new();
    let mut open: Vec<&'a Symbol> = dependencies.iter().map(|(_, body, _)| *body).collect();
    open.dedup();
    while let Some(body) = open.pop() {
        let stratum = strata.get(body).copied().unwrap_or(0);
        for &(head, step) in dependents.get(body).into_iter().flatten() {
            let known = strata.entry(head).or_insert(0);
            if *known < stratum + step {
                *known = stratum + step;
                open.push(head);
            }
            // Without a cycle, each predicate is passed once at most.
            if *known > most {
                return Err(negative_cycle(dependencies));
            }
        }
    }
    Ok(strata)
}

/// The predicates on the first cycle in which one must be false.
fn negative_cycle<'a>(dependencies: &BTreeSet<Dependency<'a>>) -> BTreeSet<&'a Symbol> {
    let forward = edges(dependencies.iter().map(|(head, body, _)| (*head, *body)));
    let backward = edges(dependencies.iter().map(|(head, body, _)| (*body, *head)));
    for (head, body, positive) in dependencies {
        if !positive {
            let needed = reached(&forward, body);
            if needed.contains(head) {
                return needed.intersection(&reached(&backward, head)).copied().collect();
            }
        }
    }
    BTreeSet::new()
}

type Edges<'a> = BTreeMap<&'a Symbol, Vec<&'a Symbol>>;

fn edges<'a>(pairs: impl Iterator<Item = (&'a Symbol, &'a Symbol)>) -> Edges<'a> {
    let mut edges = Edges::new();
    for (from, to) in pairs {
        edges.entry(from).or_default().push(to);
    }
    edges
}

/// What can be reached from `start`, itself included.
fn reached<'a>(edges: &Edges<'a>, start: &'a Symbol) -> BTreeSet<&'a Symbol> {
    let mut seen = BTreeSet::from([start]);
    let mut open = vec![start];
    while let Some(from) = open.pop() {
        for &to in edges.get(from).into_iter().flatten() {
            if seen.insert(to) {
                open.push(to);
            }
        }
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solved(text: &str) -> String {
        let pairs: Vec<(Symbol, Symbol, bool)> = text
            .split_whitespace()
            .map(|word| {
                let (head, body) = word.split_once('<').expect("a dependency");
                (Symbol::new(head), Symbol::new(body.trim_start_matches('!')), !body.starts_with('!'))
            })
            .collect();
        match strata(&pairs.iter().map(|(head, body, positive)| (head, body, *positive)).collect()) {
            Ok(strata) => strata.iter().map(|(name, stratum)| format!("{name}{stratum}")).collect(),
            Err(cycle) => format!("cycle {}", cycle.iter().map(|name| name.as_str()).collect::<String>()),
        }
    }

    #[test]
    fn negation_raises_the_stratum() {
        assert_eq!(solved("b<a b<b c<!b d<c d<!a e<!d f<!e f<a"), "b0c1d1e2f3");
        assert_eq!(solved("a<b b<a c<!a"), "a0b0c1");
        assert_eq!(solved(""), "");
    }

    #[test]
    fn cycles_are_refused_only_with_a_negation() {
        assert_eq!(solved("a<b b<c c<a d<!a"), "a0b0c0d1");
        assert_eq!(solved("z<a a<b b<!c c<a c<x x<!y"), "cycle abc");
        assert_eq!(solved("a<!a"), "cycle a");
    }
}
