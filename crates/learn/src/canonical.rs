//! Canonical labelling: the order of the entities of an effect that does not depend on their names, so that transitions
//! that unify have equal forms.
//!
//! The labelling refines colour classes by type and by the effect's atoms; if the effect does not tell the entities of
//! a class apart at all, also by the pre-state's. Then it tries the orders that are left, entities that can be swapped
//! without any difference in one order only. If more than [`LEAF_BOUND`] orders are left, there is no form, rather than one
//! by chance.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{LiftedAtom, Term};

/// Orders of the entities of one effect that are compared at most.
const LEAF_BOUND: usize = 40_320;

/// Lifted atoms over object indices, in some labelling. Ordered as canonical forms are compared.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Effect {
    pub(crate) adds: Vec<LiftedAtom>,
    pub(crate) deletes: Vec<LiftedAtom>,
    pub(crate) state: Vec<LiftedAtom>,
}

impl Effect {
    /// The same under `label[object]`, sorted.
    fn relabelled(&self, label: &[u32]) -> Self {
        let map = |atoms: &[LiftedAtom]| {
            let mut atoms: Vec<LiftedAtom> = atoms.iter().map(|atom| atom.renamed(label)).collect();
            atoms.sort_unstable();
            atoms
        };
        Self { adds: map(&self.adds), deletes: map(&self.deletes), state: map(&self.state) }
    }
}

/// The order of objects (those named by the call first, as they are) that makes the relabelled effect smallest,
/// with that effect; `None` beyond [`LEAF_BOUND`].
pub(crate) fn canonical_form(effect: &Effect, initial: &[String], named: usize) -> Option<(Vec<usize>, Effect)> {
    let mut classes = refine(ranked(initial), &[('+', &effect.adds), ('-', &effect.deletes)]);
    let change = Effect { state: Vec::new(), ..effect.clone() };
    if swap_classes(&change, &classes) == classes {
        // Any order gives the same effect: the pre-state alone decides, and may tell apart.
        classes = refine(classes, &[('+', &effect.adds), ('-', &effect.deletes), (' ', &effect.state)]);
    }
    let swaps = swap_classes(effect, &classes);
    let mut sorted: Vec<usize> = (0..classes.len()).collect();
    sorted.sort_by_key(|&i| (classes[i], i));
    let mut search = Labelling { effect, sorted: &sorted, classes: &classes, swaps: &swaps, leaves: 0, best: None };
    let complete = search.extend(&mut sorted[..named].to_vec());
    search.best.filter(|_| complete).map(|(lifted, order)| (order, lifted))
}

/// Splits classes into those whose members can be swapped, any two of them, without any difference; numbered in the
/// order of the classes. Two transpositions that share an object make up the third, so one representative each will do.
fn swap_classes(effect: &Effect, classes: &[usize]) -> Vec<usize> {
    let identity: Vec<u32> = (0..classes.len() as u32).collect();
    let plain = effect.relabelled(&identity);
    let swappable = |a: usize, b: usize| {
        let mut swap = identity.clone();
        swap.swap(a, b);
        effect.relabelled(&swap) == plain
    };
    let mut representatives: Vec<(usize, usize)> = Vec::new();
    let mut split: Vec<(usize, usize)> = Vec::with_capacity(classes.len());
    for (object, &class) in classes.iter().enumerate() {
        let known = representatives.iter().position(|&(c, r)| c == class && swappable(r, object));
        let place = known.unwrap_or_else(|| {
            representatives.push((class, object));
            representatives.len() - 1
        });
        split.push((class, place));
    }
    ranked(&split)
}

struct Labelling<'a> {
    effect: &'a Effect,
    sorted: &'a [usize],
    classes: &'a [usize],
    swaps: &'a [usize],
    leaves: usize,
    best: Option<(Effect, Vec<usize>)>,
}

impl Labelling<'_> {
    /// Extends `order` in every way that respects the classes; `false` if there are too many.
    fn extend(&mut self, order: &mut Vec<usize>) -> bool {
        let at = order.len();
        if at == self.sorted.len() {
            self.leaves += 1;
            let mut label = vec![0; at];
            for (position, &object) in order.iter().enumerate() {
                label[object] = position as u32;
            }
            let candidate = self.effect.relabelled(&label);
            if self.best.as_ref().is_none_or(|(best, _)| candidate < *best) {
                self.best = Some((candidate, order.clone()));
            }
            return self.leaves <= LEAF_BOUND;
        }
        let class = self.classes[self.sorted[at]];
        let start = self.sorted.partition_point(|&object| self.classes[object] < class);
        let mut tried: BTreeSet<usize> = BTreeSet::new();
        for &object in self.sorted[start..].iter().take_while(|&&object| self.classes[object] == class) {
            if order[start..].contains(&object) || !tried.insert(self.swaps[object]) {
                continue;
            }
            order.push(object);
            let within_bound = self.extend(order);
            order.pop();
            if !within_bound {
                return false;
            }
        }
        true
    }
}

/// Colour refinement: the class of each object, numbered in an order that depends on structure alone. Starts from
/// the given classes and tells objects apart by the marked atoms they occur in, until nothing changes.
fn refine(mut classes: Vec<usize>, marked: &[(char, &Vec<LiftedAtom>)]) -> Vec<usize> {
    loop {
        let mut seen: Vec<Vec<String>> = vec![Vec::new(); classes.len()];
        for (mark, atoms) in marked {
            for atom in *atoms {
                for object in atom.params().map(|p| p as usize).collect::<BTreeSet<_>>() {
                    seen[object].push(occurrence(*mark, atom, object, &classes));
                }
            }
        }
        let colours: Vec<(usize, Vec<String>)> = classes
            .iter()
            .zip(seen)
            .map(|(&class, mut seen)| {
                seen.sort_unstable();
                (class, seen)
            })
            .collect();
        let refined = ranked(&colours);
        if refined == classes {
            return classes;
        }
        classes = refined;
    }
}

/// How one effect atom looks from one of its objects.
fn occurrence(sign: char, atom: &LiftedAtom, object: usize, classes: &[usize]) -> String {
    let args = atom.args.iter().map(|term| match term {
        Term::Param(p) if *p as usize == object => "self".to_owned(),
        Term::Param(p) => format!("{:08}", classes[*p as usize]),
        Term::Const(name) => format!("'{name}"),
    });
    format!("{sign}{}({})", atom.predicate, args.collect::<Vec<_>>().join(","))
}

fn ranked<T: Ord>(colours: &[T]) -> Vec<usize> {
    let distinct: BTreeSet<&T> = colours.iter().collect();
    let rank: BTreeMap<&T, usize> = distinct.into_iter().zip(0..).collect();
    colours.iter().map(|colour| rank[colour]).collect()
}
