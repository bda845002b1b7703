//! The values that attributes and relations have, over all scenes: what none of them shows by itself.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ParseConfig, Symbol};

use super::Problem;
use crate::left_out::KeySets;
use crate::{Entity, Relation, Snapshot, Value};

/// A number with at most so many values may stand for so many words.
const FEW: usize = 4;

/// Words with at most so many values are not called many.
const MANY: usize = 4;

/// What was seen of every attribute and relation.
#[derive(Debug, Default)]
pub(super) struct Sightings {
    attributes: BTreeMap<Symbol, Attribute>,
    relations: BTreeMap<Symbol, Related>,
    keys: KeySets,
}

/// What was seen of an attribute.
#[derive(Debug, Default)]
struct Attribute {
    entities: BTreeSet<Symbol>,
    truths: bool,
    vectors: bool,
    words: BTreeSet<Symbol>,
    /// The numbers as they are written; no more than decide whether they are few.
    numbers: BTreeSet<String>,
    all_whole: bool,
}

/// What was seen of a relation.
#[derive(Debug, Default)]
struct Related {
    /// Whether it is an id or null of some entity.
    is_one: bool,
    /// The first of which it is an empty list.
    empty: Option<Symbol>,
    longest: usize,
}

impl Sightings {
    /// Notes what a scene shows, without what is to be ignored wherever it is.
    pub(super) fn note(&mut self, snapshot: &Snapshot, parse: &ParseConfig) {
        for entity in &snapshot.entities {
            let rule_of_type = |key: &Symbol| Symbol::from(format!("{}.{key}", entity.ty));
            self.keys.note(entity, |key| parse.ignore.contains(key) || parse.ignore.contains(&rule_of_type(key)));
            for (name, value) in entity.attributes.iter().filter(|(name, _)| !parse.ignore.contains(*name)) {
                self.attributes.entry(name.clone()).or_default().note(entity, value);
            }
            for (name, relation) in entity.relations.iter().filter(|(name, _)| !parse.ignore.contains(*name)) {
                self.relations.entry(name.clone()).or_default().note(entity, relation);
            }
        }
    }

    /// What is wrong with them.
    pub(super) fn problems(&self) -> Vec<Problem> {
        let relations = self.relations.iter().filter_map(|(name, related)| related.problem(name));
        let attributes = self.attributes.iter().filter_map(|(name, attribute)| attribute.problem(name));
        let left_out = self.keys.left_out().into_iter().map(Problem::LeftOut);
        let mixed = self.keys.mixed().map(Problem::MixedRelation);
        mixed.chain(relations).chain(attributes).chain(left_out).collect()
    }
}

impl Attribute {
    fn note(&mut self, entity: &Entity, value: &Value) {
        self.entities.insert(entity.id.clone());
        match value {
            Value::Bool(_) => self.truths = true,
            Value::Vector(_) => self.vectors = true,
            Value::Text(word) => {
                self.words.insert(word.clone());
            }
            Value::Number(number) => {
                self.all_whole = number.fract() == 0.0 && (self.numbers.is_empty() || self.all_whole);
                if self.numbers.len() <= FEW {
                    self.numbers.insert(number.to_string());
                }
            }
        }
    }

    fn problem(&self, name: &Symbol) -> Option<Problem> {
        let attribute = name.clone();
        let kinds = [
            (self.truths, "true or false"),
            (!self.words.is_empty(), "a word"),
            (!self.numbers.is_empty(), "a number"),
            (self.vectors, "a list of numbers"),
        ];
        let kinds: Vec<&'static str> = kinds.into_iter().filter(|(seen, _)| *seen).map(|(_, kind)| kind).collect();
        if kinds.len() > 1 {
            return Some(Problem::MixedAttribute { attribute, kinds });
        }
        if let Some(example) = self.words.iter().find(|word| word.as_str().parse::<f64>().is_ok_and(f64::is_finite)) {
            return Some(Problem::NumberAsWord { attribute, example: example.clone() });
        }
        if self.words.len() > MANY && self.words.len() * 2 > self.entities.len() {
            let (words, entities) = (self.words.len(), self.entities.len());
            let example = self.words.first()?.clone();
            return Some(Problem::ManyWords { attribute, words, entities, example });
        }
        // A single value says nothing, unless it is one by which programs write true and false.
        let like_truths = self.numbers.iter().all(|number| number == "0" || number == "1");
        let few = (2..=FEW).contains(&self.numbers.len()) || self.numbers.len() == 1 && like_truths;
        (few && self.all_whole)
            .then(|| Problem::FewNumbers { attribute, values: self.numbers.iter().cloned().collect() })
    }
}

impl Related {
    fn note(&mut self, entity: &Entity, relation: &Relation) {
        match relation {
            Relation::One(_) => self.is_one = true,
            Relation::Many(targets) => {
                self.longest = self.longest.max(targets.len());
                if targets.is_empty() {
                    self.empty.get_or_insert_with(|| entity.id.clone());
                }
            }
        }
    }

    fn problem(&self, name: &Symbol) -> Option<Problem> {
        let relation = name.clone();
        let empty = self.empty.clone().filter(|_| self.longest == 1 && !self.is_one)?;
        Some(Problem::ListOfOne { relation, empty })
    }
}
