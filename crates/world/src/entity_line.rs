//! Entities as files have them. A key that nothing reads may stand there, but one that is nearly the name of what is
//! read is noted: left out, relations would be taken for none.

use std::collections::BTreeSet;
use std::fmt;
use std::path::Path;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, DeserializeSeed, Deserializer, IntoDeserializer, MapAccess, Visitor};
use typelift_model::{Symbol, nearest};

use crate::{Entity, FileError};

/// The keys that an entity must have.
const REQUIRED: [&str; 2] = ["id", "type"];

/// Those that it may have.
const OPTIONAL: [&str; 2] = ["attributes", "relations"];

/// An entity, and its keys that nothing reads.
#[derive(Debug)]
pub(crate) struct EntityLine {
    pub(crate) entity: Entity,
    unread: Vec<Symbol>,
}

impl<'de> Deserialize<'de> for EntityLine {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(EntityVisitor)
    }
}

struct EntityVisitor;

impl<'de> Visitor<'de> for EntityVisitor {
    type Value = EntityLine;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an entity")
    }

    fn visit_map<A: MapAccess<'de>>(self, access: A) -> Result<EntityLine, A::Error> {
        let mut unread = Vec::new();
        let watched = Watched { access, unread: &mut unread };
        let entity = Entity::deserialize(MapAccessDeserializer::new(watched))?;
        Ok(EntityLine { entity, unread })
    }
}

/// An object whose keys are watched while it is read.
struct Watched<'u, A> {
    access: A,
    unread: &'u mut Vec<Symbol>,
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for Watched<'_, A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, A::Error> {
        match self.access.next_key::<Key>()? {
            None => Ok(None),
            Some(Key::Read(key)) => seed.deserialize(key.into_deserializer()).map(Some),
            Some(Key::Unread(key)) => {
                let ignored = seed.deserialize(key.as_str().into_deserializer())?;
                self.unread.push(key);
                Ok(Some(ignored))
            }
        }
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, A::Error> {
        self.access.next_value_seed(seed)
    }
}

/// A key of an entity.
enum Key {
    Read(&'static str),
    Unread(Symbol),
}

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(KeyVisitor)
    }
}

struct KeyVisitor;

impl Visitor<'_> for KeyVisitor {
    type Value = Key;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E>(self, key: &str) -> Result<Key, E> {
        let read = REQUIRED.into_iter().chain(OPTIONAL).find(|known| *known == key);
        Ok(read.map_or_else(|| Key::Unread(Symbol::new(key)), Key::Read))
    }
}

/// A key of an entity that nothing reads, though it is nearly one that is read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnreadKey {
    /// The entity.
    pub entity: Symbol,
    /// The key.
    pub key: Symbol,
    /// The key that may have been meant.
    pub near: Symbol,
}

/// The keys of these entities that nothing reads and that were not seen before.
pub(crate) fn unread_keys(entities: &[EntityLine], seen: &mut BTreeSet<Symbol>) -> Vec<UnreadKey> {
    let mut found = Vec::new();
    for EntityLine { entity, unread } in entities {
        for key in unread.iter().filter(|key| seen.insert((*key).clone())) {
            if let Some(near) = nearest(key.as_str(), &OPTIONAL.map(Symbol::new)) {
                found.push(UnreadKey { entity: entity.id.clone(), key: key.clone(), near: near.clone() });
            }
        }
    }
    found
}

/// What is to be said of the keys that nothing reads in a file.
#[derive(Debug, Default)]
pub(crate) struct UnreadKeys {
    seen: BTreeSet<Symbol>,
    pub(crate) warnings: Vec<FileError>,
}

impl UnreadKeys {
    /// Notes those of a line, of which these are read, each key where it is met first.
    pub(crate) fn note_keys(&mut self, file: &Path, line: usize, keys: &[Symbol], read: &[&str]) {
        for key in keys.iter().filter(|key| !read.contains(&key.as_str())) {
            let near = nearest(key.as_str(), &read.iter().copied().map(Symbol::new).collect::<Vec<_>>()).cloned();
            if let Some(near) = near.filter(|_| self.seen.insert(key.clone())) {
                let warning = FileError::at_line(file, line, format!("`{key}` is not read"));
                self.warnings.push(warning.with_hint(format!("Did you mean `{near}`?")));
            }
        }
    }

    /// Notes those of entities, each key where it is met first.
    pub(crate) fn note(&mut self, file: &Path, line: Option<usize>, entities: &[EntityLine]) {
        for UnreadKey { entity, key, near } in unread_keys(entities, &mut self.seen) {
            let what = format!("entity {entity}: `{key}` is not read");
            let warning = line.map_or_else(|| FileError::new(file, &what), |l| FileError::at_line(file, l, &what));
            self.warnings.push(warning.with_hint(format!("Did you mean `{near}`?")));
        }
    }
}
