//! What changes in the demonstrations that `learn` reads, and what of it seems to change by itself.

use std::collections::{BTreeMap, BTreeSet};

use typelift::model::{
    ClusterKey, GroundAtom, LiftedAtom, ModelFileError, Observations, State, Symbol, predicate_told_apart,
};
use typelift::world::{Dataset, Transition};

use crate::failure::Failure;

/// In fewer transitions, what all of them change may still be by chance.
const TRANSITIONS: usize = 3;

/// How often the atoms of each predicate changed.
pub(crate) struct Changes {
    pub(crate) transitions: usize,
    calls: BTreeSet<Symbol>,
    predicates: BTreeMap<Symbol, Changed>,
}

/// In how many transitions something was so of a predicate.
#[derive(Default)]
struct Changed {
    /// One of its atoms changed.
    changed: usize,
    /// One of its atoms held before.
    held: usize,
    /// The calls that added an atom of which they do not speak, since it has none of their arguments; and those that
    /// deleted one.
    added_by: BTreeSet<Symbol>,
    deleted_by: BTreeSet<Symbol>,
}

impl Changes {
    /// Counts over all transitions; predicates that are told apart by their arity have the names of the model.
    pub(crate) fn of(dataset: &Dataset, by_arity: &BTreeSet<Symbol>) -> Self {
        let in_model = |atom: &GroundAtom| predicate_told_apart(by_arity, &atom.predicate, atom.arity());
        let mut changes = Self { transitions: 0, calls: BTreeSet::new(), predicates: BTreeMap::new() };
        for Transition { before, action, after, .. } in dataset.transitions() {
            changes.transitions += 1;
            let call = &action.call;
            changes.calls.insert(call.name.clone());
            let mut changed = BTreeSet::new();
            let added = before.added(after).map(|atom| (atom, true));
            for (atom, is_added) in added.chain(before.deleted(after).map(|atom| (atom, false))) {
                let predicate = in_model(atom);
                if !atom.args.iter().any(|arg| call.args.contains(arg)) {
                    let counts = changes.predicates.entry(predicate.clone()).or_default();
                    let by = if is_added { &mut counts.added_by } else { &mut counts.deleted_by };
                    by.insert(call.name.clone());
                }
                changed.insert(predicate);
            }
            for predicate in before.atoms.iter().map(in_model).collect::<BTreeSet<_>>() {
                changes.predicates.entry(predicate).or_default().held += 1;
            }
            for predicate in changed {
                changes.predicates.entry(predicate).or_default().changed += 1;
            }
        }
        changes
    }

    /// In how many transitions an atom of a predicate changed, and in how many one held before.
    pub(crate) fn changed_and_held(&self, predicate: &Symbol) -> (usize, usize) {
        self.predicates.get(predicate).map_or((0, 0), |counts| (counts.changed, counts.held))
    }

    /// The predicates that changed every time whatever was done: the same call now added an atom of which it does not
    /// speak, and now deleted one, so that it is not the call that decides.
    pub(crate) fn every_time(&self) -> Vec<&Symbol> {
        if self.transitions < TRANSITIONS || self.calls.len() < 2 {
            return Vec::new();
        }
        let is_restless =
            |counts: &Changed| counts.changed == self.transitions && !counts.added_by.is_disjoint(&counts.deleted_by);
        self.predicates.iter().filter(|(_, counts)| is_restless(counts)).map(|(predicate, _)| predicate).collect()
    }
}

/// Why a model cannot be written; where two predicates are one name in PDDL, with where each of them was seen first.
pub(crate) fn colliding(error: ModelFileError, dataset: &Dataset) -> Failure {
    let ModelFileError::Collision(collision) = &error else { return error.into() };
    let first_seen = |predicate: &Symbol| {
        dataset.traces.iter().find_map(|trace| {
            let holds = |state: &State| state.atoms.iter().any(|atom| atom.predicate == *predicate);
            let file = trace.file.as_ref()?;
            Some(match trace.states.iter().position(holds)? {
                0 => format!("`{predicate}` is in {file} before step 1"),
                step => format!("`{predicate}` is in {file} after step {step}"),
            })
        })
    };
    let places: Vec<String> = [&collision.first, &collision.second].into_iter().filter_map(first_seen).collect();
    let failure = Failure::from(error);
    match failure.hint().filter(|_| !places.is_empty()) {
        Some(hint) => {
            let hint = format!("{}. {hint}", places.join(", and "));
            failure.with_hint(hint)
        }
        None => failure,
    }
}

/// What keeps actions apart that are alike otherwise.
pub(crate) struct Flickering {
    /// The attribute or relation.
    pub(crate) name: Symbol,
    /// How many kinds of effect there would be without it.
    pub(crate) fewer: usize,
    /// How many there are.
    pub(crate) all: usize,
    /// Whether it is all that some call changes.
    pub(crate) is_needed: bool,
}

/// The attribute or relation, as `source` has them of predicates, without which there would be the fewest kinds of effect;
/// none if there would not be fewer. A kind is what could be generalized into one action, whatever the types.
pub(crate) fn flickering<'a>(
    observations: &'a Observations,
    source: impl Fn(&'a Symbol) -> &'a Symbol,
) -> Option<Flickering> {
    let clusters: Vec<&'a ClusterKey> = observations.clusters.keys().collect();
    let kinds = |left_out: Option<&Symbol>| {
        let kind = |key: &&'a ClusterKey| {
            let names = |atoms: &'a [LiftedAtom]| {
                let names = atoms.iter().map(|atom| &atom.predicate).filter(|name| Some(source(name)) != left_out);
                names.cloned().collect::<Vec<_>>()
            };
            (key.action.clone(), names(&key.adds), names(&key.deletes))
        };
        clusters.iter().map(kind).collect::<BTreeSet<_>>().len()
    };
    let atoms = clusters.iter().flat_map(|key| key.adds.iter().chain(&key.deletes));
    let sources: BTreeSet<&Symbol> = atoms.map(|atom| source(&atom.predicate)).collect();
    let (fewest, left_out) = sources.into_iter().map(|source| (kinds(Some(source)), source)).min()?;
    let all = kinds(None);
    (fewest < all).then(|| Flickering {
        name: left_out.clone(),
        fewer: fewest,
        all,
        is_needed: is_all_of_a_call(observations, |predicate| source(predicate) == left_out),
    })
}

/// Whether some call changed nothing else, and that of its own arguments and in the same way more than once: then this is what
/// the call does.
fn is_all_of_a_call<'a>(observations: &'a Observations, is_of: impl Fn(&'a Symbol) -> bool) -> bool {
    // Of each call whether it changed anything else, and whether it was seen twice to change its arguments so.
    let mut seen: BTreeMap<&Symbol, (bool, bool)> = BTreeMap::new();
    for (key, cluster) in &observations.clusters {
        let (changes_more, is_repeated) = seen.entry(&key.action).or_default();
        let speaks_of_it = |atom: &LiftedAtom| atom.params().any(|parameter| key.call.contains(&parameter));
        let mut atoms = key.adds.iter().chain(&key.deletes);
        *changes_more |= atoms.clone().any(|atom| !is_of(&atom.predicate));
        *is_repeated |= cluster.count > 1 && atoms.all(speaks_of_it);
    }
    seen.into_values().any(|(changes_more, is_repeated)| is_repeated && !changes_more)
}

/// The calls of which transitions were seen, and none that changed anything.
pub(crate) fn without_effect(observations: &Observations) -> BTreeSet<&Symbol> {
    let changing: BTreeSet<&Symbol> = observations.clusters.keys().map(|key| &key.action).collect();
    let failing = observations.negatives.keys().map(|key| &key.action);
    failing.filter(|call| !changing.contains(call)).collect()
}
