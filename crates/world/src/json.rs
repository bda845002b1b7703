//! JSON that people write: readable messages, and objects in which no key stands twice.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, MapAccess, Visitor};
pub(crate) use typelift_model::json_message as message;
use typelift_model::{Symbol, nearest};

use crate::goal_literals;

/// What to do about an error at the end of this text, if that is known.
pub(crate) fn hint(error: &serde_json::Error, text: &str) -> Option<String> {
    let line = text.lines().nth(error.line().max(1) - 1)?;
    // The column is that of the first letter, or the one after a sign.
    let at = |back: usize| line.get(error.column().checked_sub(back)?..);
    let starts =
        |back| at(back).is_some_and(|rest| ["NaN", "Infinity", "-Infinity"].iter().any(|n| rest.starts_with(n)));
    match starts(1) || starts(2) {
        true => Some("JSON has no NaN and no Infinity: leave the attribute out.".to_owned()),
        false => missing_key(error, text).or_else(|| goal_literals::hint(error, text)),
    }
}

/// Which key of an object that lacks one is nearly that one.
fn missing_key(error: &serde_json::Error, text: &str) -> Option<String> {
    let told = error.to_string();
    let missing = told.strip_prefix("missing field `")?.split('`').next()?;
    let lines = text.split_inclusive('\n').take(error.line().checked_sub(1)?);
    let end = lines.map(str::len).sum::<usize>() + error.column();
    // The column is that of the bracket that closes the object, which must still be open to be named.
    let open = open_at(text.get(..end.checked_sub(1)?)?);
    let mut value = &serde_json::from_str::<serde_json::Value>(text).ok()?;
    for level in &open[..open.len().checked_sub(1)?] {
        value = match level {
            Open::Object(key) => value.get((*key)?)?,
            Open::List(index) => value.get(index)?,
        };
    }
    let keys: Vec<Symbol> = value.as_object()?.keys().map(|key| Symbol::new(key)).collect();
    near_key(missing, &keys)
}

/// That a key that is not read may be meant to be this one.
pub(crate) fn near_key(wanted: &str, keys: &[Symbol]) -> Option<String> {
    let near = nearest(wanted, keys)?;
    Some(format!("`{near}` is not read: is it meant to be `{wanted}`?"))
}

/// Which key of the object under a key of this one is nearly this.
pub(crate) fn near_key_of(outer: &str, text: &str, wanted: &str) -> Option<String> {
    let whole: serde_json::Value = serde_json::from_str(text).ok()?;
    let keys: Vec<Symbol> = whole.get(outer)?.as_object()?.keys().map(|key| Symbol::new(key)).collect();
    near_key(wanted, &keys)
}

/// The keys that lead to an error's place in this text, as in `state.entities[3]`; none where it is about the whole, or
/// where the text is not JSON. In time of the text before it.
pub(crate) fn place(text: &str, error: &serde_json::Error) -> Option<String> {
    if !error.is_data() {
        return None;
    }
    let lines = text.split_inclusive('\n').take(error.line().checked_sub(1)?);
    // The column is that of the byte read last: where that closes a list or an object, the error is about all of it.
    let end = lines.map(str::len).sum::<usize>() + error.column();
    let open = open_at(text.get(..end)?);
    let mut place = String::new();
    for level in open {
        match level {
            Open::Object(Some(key)) if place.is_empty() => place.push_str(key),
            Open::Object(Some(key)) => place.extend([".", key]),
            Open::Object(None) => {}
            Open::List(index) => place.push_str(&format!("[{index}]")),
        }
    }
    (!place.is_empty()).then_some(place)
}

/// What is open at a place of a JSON text.
enum Open<'t> {
    /// An object, and the key whose value stands here, if one does.
    Object(Option<&'t str>),
    /// A list, and how many of its values stand before.
    List(usize),
}

/// What is open at the end of the beginning of a JSON text, outermost first.
fn open_at(beginning: &str) -> Vec<Open<'_>> {
    let mut open = Vec::new();
    let mut word = "";
    let mut bytes = beginning.bytes().enumerate();
    while let Some((at, byte)) = bytes.next() {
        match byte {
            b'"' => {
                let mut escaped = false;
                let closes = |&(_, byte): &(usize, u8)| {
                    let is_end = byte == b'"' && !escaped;
                    escaped = byte == b'\\' && !escaped;
                    is_end
                };
                let Some((end, _)) = bytes.find(closes) else { break };
                word = beginning.get(at + 1..end).unwrap_or_default();
            }
            b'{' => open.push(Open::Object(None)),
            b'[' => open.push(Open::List(0)),
            b'}' | b']' => _ = open.pop(),
            _ => match (byte, open.last_mut()) {
                (b':', Some(Open::Object(key))) => *key = Some(word),
                (b',', Some(Open::Object(key))) => *key = None,
                (b',', Some(Open::List(index))) => *index += 1,
                _ => {}
            },
        }
    }
    open
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
        let form = match kind(read).as_str() {
            "task" => {
                Some(r#"A task is {"format":"task/1","goal":["on_holds(cup_1,tray_1)"]}, with a state to plan from."#)
            }
            "trace" => Some(r#"A trace begins with the line {"format":"trace/1"}; states and actions follow in turn."#),
            _ => None,
        };
        Err((format!("this is a file of format `{found}`, not a {}", kind(read)), form.map(str::to_owned)))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    #[allow(dead_code, reason = "they are never read")]
    struct Shelf {
        name: String,
        books: Vec<Book>,
    }

    #[derive(Debug, serde::Deserialize)]
    #[allow(dead_code, reason = "as above")]
    struct Book {
        title: String,
        pages: Option<u64>,
    }

    #[test]
    fn the_keys_to_a_place() {
        let cases = [
            (r#"{"name":1}"#, Some("name")),
            (r#"{"name":[]}"#, Some("name")),
            ("{\"name\":\"a\",\n \"books\":\"b\"}", Some("books")),
            (r#"{"name":"a \", {[","books":[{"title":"t"},{"title":"u","pages":"many"}]}"#, Some("books[1].pages")),
            ("{\"name\":\"a\",\"books\":[\n{\"title\":\"t\"},\n{\"pages\":3}]}", Some("books[1]")),
            (r#"{"books":[]}"#, None),
            ("[1", Some("[0]")),
            ("7", None),
        ];
        for (text, expected) in cases {
            let error = serde_json::from_str::<Shelf>(text).expect_err(text);
            assert_eq!(place(text, &error).as_deref(), expected, "{text}: {error}");
        }
    }
}
