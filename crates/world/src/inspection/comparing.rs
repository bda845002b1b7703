//! Two states that should be the same, or differ by an action only.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{GroundAtom, GroundCall, ParseConfig, State, Symbol};

use super::Change;
use crate::{Scene, Value};

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

/// An attribute or relation of an entity; of none, where its atoms have no arguments.
pub(super) type Place = (Symbol, Option<Symbol>);

/// Where something changed, and whether the call does not speak of it: no atom that changed there is about an argument of
/// the call. What the predicates come from is in `sources`.
pub(super) fn changed_places(
    change: &Change,
    call: &GroundCall,
    sources: &BTreeMap<Symbol, Symbol>,
) -> BTreeMap<Place, bool> {
    let mut places = BTreeMap::new();
    for atom in change.added.iter().chain(&change.deleted) {
        let source = sources.get(&atom.predicate).unwrap_or(&atom.predicate);
        let is_apart = !atom.args.iter().any(|arg| call.args.contains(arg));
        *places.entry((source.clone(), atom.args.first().cloned())).or_insert(true) &= is_apart;
    }
    places
}

/// The attributes that are numbers, or lists of numbers, and differ; of entities that both scenes have.
pub(super) fn differing_numbers(first: &Scene, second: &Scene, parse: &ParseConfig) -> BTreeSet<Symbol> {
    let (first, second) = (numbers(first, parse), numbers(second, parse));
    let differs = |(place, value): &(&(&Symbol, &Symbol), &&Value)| second.get(*place).is_some_and(|now| now != *value);
    first.iter().filter(differs).map(|((_, name), _)| (*name).clone()).collect()
}

/// The numbers of a scene, by the entity and the attribute; not what is to be ignored.
fn numbers<'s>(scene: &'s Scene, parse: &ParseConfig) -> BTreeMap<(&'s Symbol, &'s Symbol), &'s Value> {
    let Scene::Snapshot(snapshot) = scene else { return BTreeMap::new() };
    let mut numbers = BTreeMap::new();
    for entity in &snapshot.entities {
        let is_ignored = |name: &Symbol| {
            parse.ignore.contains(name) || parse.ignore.contains(&Symbol::from(format!("{}.{name}", entity.ty)))
        };
        for (name, value) in entity.attributes.iter().filter(|(name, _)| !is_ignored(name)) {
            if matches!(value, Value::Number(_) | Value::Vector(_)) {
                numbers.insert((&entity.id, name), value);
            }
        }
    }
    numbers
}
