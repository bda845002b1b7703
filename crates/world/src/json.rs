//! JSON that people write: readable messages, and objects in which no key stands twice.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use typelift_model::Symbol;

/// The message of an error without its place.
pub(crate) fn message(error: &serde_json::Error) -> String {
    let full = error.to_string();
    let text = full.rsplit_once(" at line ").map_or(full.as_str(), |(text, _)| text);
    if error.is_eof() {
        return "the JSON text ends too early".to_owned();
    }
    match text {
        "data did not match any variant of untagged enum Value" => {
            "an attribute is true, false, a word, a number or a list of numbers".to_owned()
        }
        "data did not match any variant of untagged enum Relation" => {
            "a relation is to an entity's name, null or a list of names".to_owned()
        }
        "trailing characters" => "nothing may follow after the end of the JSON text".to_owned(),
        _ => text.to_owned(),
    }
}

/// Reads every pair of an object, in order, equal keys included.
pub(crate) fn pairs<'de, D, V>(deserializer: D) -> Result<Vec<(Symbol, V)>, D::Error>
where
    D: Deserializer<'de>,
    V: Deserialize<'de>,
{
    deserializer.deserialize_map(Pairs { distinct: false, value: PhantomData })
}

/// Reads an object; a key that stands there twice is an error, at its second place.
pub(crate) fn distinct_map<'de, D, V>(deserializer: D) -> Result<BTreeMap<Symbol, V>, D::Error>
where
    D: Deserializer<'de>,
    V: Deserialize<'de>,
{
    let pairs = deserializer.deserialize_map(Pairs { distinct: true, value: PhantomData })?;
    Ok(pairs.into_iter().collect())
}

struct Pairs<V> {
    distinct: bool,
    value: PhantomData<V>,
}

impl<'de, V: Deserialize<'de>> Visitor<'de> for Pairs<V> {
    type Value = Vec<(Symbol, V)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of names")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Self::Value, A::Error> {
        let mut seen = BTreeSet::new();
        let mut pairs = Vec::new();
        while let Some(key) = access.next_key::<Symbol>()? {
            if self.distinct && !seen.insert(key.clone()) {
                return Err(A::Error::custom(format!("`{key}` stands here twice")));
            }
            pairs.push((key, access.next_value()?));
        }
        Ok(pairs)
    }
}
