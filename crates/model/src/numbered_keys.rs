//! JSON objects whose keys are numbers.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, de};

/// Reads a map from numbers, for `#[serde(deserialize_with = …)]`. Keys of JSON are strings. serde_json turns them into
/// numbers itself, but not inside an enum whose tag stands among its fields.
///
/// # Errors
/// If a key is no number, or a value is not of its type.
pub fn numbered_keys<'de, V: Deserialize<'de>, D: Deserializer<'de>>(input: D) -> Result<BTreeMap<usize, V>, D::Error> {
    let entries = BTreeMap::<String, V>::deserialize(input)?;
    entries.into_iter().map(|(key, value)| Ok((key.parse().map_err(de::Error::custom)?, value))).collect()
}
