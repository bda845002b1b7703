//! JSON that people write: readable messages, and objects in which no key stands twice.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, MapAccess, Visitor};
use typelift_model::Symbol;
pub(crate) use typelift_model::json_message as message;

/// What to do about an error at the end of this text, if that is known.
pub(crate) fn hint(error: &serde_json::Error, text: &str) -> Option<String> {
    let line = text.lines().nth(error.line().max(1) - 1)?;
    // The column is that of the first letter, or the one after a sign.
    let at = |back: usize| line.get(error.column().checked_sub(back)?..);
    let starts =
        |back| at(back).is_some_and(|rest| ["NaN", "Infinity", "-Infinity"].iter().any(|n| rest.starts_with(n)));
    (starts(1) || starts(2)).then(|| "JSON has no NaN and no Infinity: leave the attribute out.".to_owned())
}

/// What a file of JSON says that it is: the `format` of its first value, other values after it or not.
pub(crate) fn format(text: &str) -> Result<Option<String>, serde_json::Error> {
    #[derive(serde::Deserialize)]
    #[serde(expecting = "an object")]
    struct FormatLine {
        format: Option<String>,
    }
    let mut values = serde_json::Deserializer::from_str(text).into_iter::<FormatLine>();
    Ok(values.next().transpose()?.and_then(|line| line.format))
}

/// The keys of an object, in order.
pub(crate) fn keys(text: &str) -> Result<Vec<Symbol>, serde_json::Error> {
    let pairs = pairs::<_, IgnoredAny>(&mut serde_json::Deserializer::from_str(text))?;
    Ok(pairs.into_iter().map(|(key, IgnoredAny)| key).collect())
}

/// Refuses a format that is not the one read: `what`, and what to do about it.
pub(crate) fn check_format(found: &str, read: &str) -> Result<(), (String, Option<String>)> {
    let kind = |format: &str| format.split('/').next().unwrap_or_default().to_owned();
    if found == read {
        Ok(())
    } else if kind(found) == kind(read) {
        let what = format!("this is a file of format `{found}`; this version of typelift reads `{read}`");
        Err((what, Some("Use the typelift that wrote it, or write it again.".to_owned())))
    } else {
        Err((format!("this is a file of format `{found}`, not a {}", kind(read)), None))
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
