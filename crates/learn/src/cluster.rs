//! ClusterLiftedEffects (Algorithm 1, line 1): transitions whose effects unify belong to one cluster.
//!
//! Two transitions of one action unify if a bijection of their objects that keeps every object's leaf type maps the
//! one call onto the other and adds onto adds, deletes onto deletes. The objects of a transition are the arguments
//! of its call and the entities of its effect. Instead of comparing transitions pairwise, each is brought into a
//! canonical form, so that unifying transitions have equal keys: the arguments of the call are labelled in their
//! order; the other entities of the effect in the way that makes the lifted effect smallest and, where several do
//! (automorphisms), the lifted pre-state.
//!
//! The labelling refines colour classes by type and by the effect's atoms; if the effect does not tell the entities of
//! a class apart at all, also by the pre-state's. Then it tries the orders that are left, entities that can be swapped
//! without any difference in one order only. If more than [`LEAF_BOUND`] orders are left, the transition is reported as
//! too symmetric rather than labelled by chance.
//!
//! A transition that may have changed something unseen (`open.rs`) is reported, and nothing is learned from it: to take the
//! unknown for false would drop preconditions, or weaken the effect, without a counterexample.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{
    ClusterKey, GroundAtom, Hierarchy, LiftedAtom, MOST_PARAMETERS, NegativeKey, Observations, State, Symbol, Term,
    Unexplained,
};
use typelift_world::Transition;

use crate::open::view;
use crate::outcome::{Outcome, outcome};

/// Orders of the entities of one effect that are compared at most.
const LEAF_BOUND: usize = 40_320;

/// Adds one transition to the evidence.
pub fn observe(evidence: &mut Observations, transition: &Transition<'_>, hierarchy: &Hierarchy) {
    evidence.transitions += 1;
    let (before, after, call) = (transition.before, transition.after, &transition.action.call);
    let outcome = outcome(transition.action);
    if outcome == Outcome::Undecided {
        evidence.add_unexplained(Unexplained::TimedOut, &transition.witness());
        return;
    }
    let same_objects = before.objects == after.objects;
    if !same_objects && outcome == Outcome::AsShown || call.args.iter().any(|arg| !before.objects.contains_key(arg)) {
        evidence.add_unexplained(Unexplained::ObjectsChanged, &transition.witness());
        return;
    }
    let adds: Vec<&GroundAtom> = before.added(after).collect();
    let deletes: Vec<&GroundAtom> = before.deleted(after).collect();
    let changed = !same_objects || !adds.is_empty() || !deletes.is_empty();
    let result = match outcome {
        Outcome::AsShown if changed => observe_effect(evidence, transition, adds, deletes, hierarchy),
        Outcome::AsShown => observe_failure(evidence, transition, after, hierarchy),
        Outcome::NotExecuted | Outcome::Undecided => {
            if changed {
                evidence.add_unexplained(Unexplained::NotExecuted, &transition.witness());
            }
            // Whatever is so afterwards, the action left everything as it was.
            observe_failure(evidence, transition, before, hierarchy)
        }
    };
    if let Err(reason) = result {
        evidence.add_unexplained(reason, &transition.witness());
    }
}

/// Adds what an action changed to the cluster of its lifted effect.
fn observe_effect(
    evidence: &mut Observations,
    transition: &Transition<'_>,
    adds: Vec<&GroundAtom>,
    deletes: Vec<&GroundAtom>,
    hierarchy: &Hierarchy,
) -> Result<(), Unexplained> {
    let (before, after) = (transition.before, transition.after);
    let others = adds.iter().chain(&deletes).flat_map(|atom| &atom.args);
    let entities = Entities::of(transition, others, hierarchy)?;
    let view = view([before, after], entities.index.keys().copied(), hierarchy, &mut evidence.open)?;
    let lift = |atoms: Vec<&GroundAtom>| atoms.into_iter().filter_map(|atom| entities.lift(atom)).collect();
    let effect = Effect { adds: lift(adds), deletes: lift(deletes), state: lift(before.atoms.iter().collect()) };
    let colours = entities
        .types
        .iter()
        .enumerate()
        .map(|(i, ty)| if i < entities.named { format!("{i:08}") } else { format!("~{ty}") });
    let (order, lifted) =
        canonical_form(&effect, &colours.collect::<Vec<_>>(), entities.named).ok_or(Unexplained::TooSymmetric)?;
    let key = ClusterKey {
        action: transition.action.call.name.clone(),
        types: order.iter().map(|&i| entities.types[i].clone()).collect(),
        call: entities.call.clone(),
        adds: lifted.adds,
        deletes: lifted.deletes,
    };
    let seen = evidence.seen_in(view);
    seen.clusters.entry(key).or_default().add(lifted.state.into_iter().collect(), transition.witness());
    Ok(())
}

/// Adds an action that was not executed, or changed nothing, to the negatives: over the entities of its call and, where
/// it is recorded, of the action that was expected.
fn observe_failure(
    evidence: &mut Observations,
    transition: &Transition<'_>,
    after: &State,
    hierarchy: &Hierarchy,
) -> Result<(), Unexplained> {
    let before = transition.before;
    let expected = transition.action.expected.iter().flat_map(|expected| &expected.args);
    let entities = Entities::of(transition, expected.filter(|name| before.objects.contains_key(*name)), hierarchy)?;
    let view = view([before, after], entities.index.keys().copied(), hierarchy, &mut evidence.open)?;
    let state = before.atoms.iter().filter_map(|atom| entities.lift(atom)).collect();
    let key = NegativeKey { action: transition.action.call.name.clone(), types: entities.types, call: entities.call };
    evidence.seen_in(view).negatives.entry(key).or_default().add(state, transition.witness());
    Ok(())
}

/// The entities that a transition is about, in order: those of its call first.
struct Entities<'a> {
    index: BTreeMap<&'a Symbol, u32>,
    types: Vec<Symbol>,
    /// How many the call names.
    named: usize,
    /// The call's arguments, as numbers of entities.
    call: Vec<u32>,
}

impl<'a> Entities<'a> {
    fn of(
        transition: &Transition<'a>,
        others: impl Iterator<Item = &'a Symbol>,
        hierarchy: &Hierarchy,
    ) -> Result<Self, Unexplained> {
        let args = &transition.action.call.args;
        let mut index: BTreeMap<&Symbol, u32> = BTreeMap::new();
        let mut types = Vec::new();
        let mut named = 0;
        for (i, name) in args.iter().chain(others).enumerate() {
            let next = index.len() as u32;
            index.entry(name).or_insert_with(|| {
                types.push(hierarchy.name(transition.before.objects[name]).clone());
                next
            });
            if i < args.len() {
                named = index.len();
            }
        }
        if types.len() > MOST_PARAMETERS {
            return Err(Unexplained::TooLarge);
        }
        let call = args.iter().map(|arg| index[arg]).collect();
        Ok(Self { index, types, named, call })
    }

    /// The atom over their numbers, if it is about them alone.
    fn lift(&self, atom: &GroundAtom) -> Option<LiftedAtom> {
        LiftedAtom::lift(atom, |object| self.index.get(object).copied())
    }
}

/// Lifted atoms over object indices, in some labelling. Ordered as canonical forms are compared.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Effect {
    adds: Vec<LiftedAtom>,
    deletes: Vec<LiftedAtom>,
    state: Vec<LiftedAtom>,
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
fn canonical_form(effect: &Effect, initial: &[String], named: usize) -> Option<(Vec<usize>, Effect)> {
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
