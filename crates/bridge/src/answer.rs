//! Reads an answer, and says where one is malformed.

use serde_json::{Map, Value as Json};
use typelift_model::json_message as message;
use typelift_world::{Answer, Entity, Relation, Scene, Value};

/// Why a line is not an answer, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Unreadable {
    /// It is not JSON.
    NotJson(String),
    /// It would be JSON, were it not for what stands for a number that is none.
    NoNumber(String),
    /// It is JSON, and perhaps says which request it answers.
    Malformed { id: Option<u64>, what: String },
}

/// The answer on a line.
pub(crate) fn read_answer(line: &[u8]) -> Result<Answer, Unreadable> {
    let text = std::str::from_utf8(line)
        .map_err(|e| Unreadable::NotJson(format!("not UTF-8 text from byte {} on", e.valid_up_to() + 1)))?;
    let error = match serde_json::from_str::<Answer>(text) {
        Ok(answer) => return Ok(answer),
        Err(error) => error,
    };
    let json: Json = serde_json::from_str(text).map_err(|e| match not_a_number(text, e.column()) {
        Some(written) => Unreadable::NoNumber(format!("{written} at column {}", e.column())),
        None => Unreadable::NotJson(format!("{} at column {}", syntax_message(&e), e.column())),
    })?;
    let Json::Object(fields) = json else {
        return Err(Unreadable::Malformed { id: None, what: "it is not an object".to_owned() });
    };
    let what = malformed(&fields).unwrap_or_else(|| message(&error));
    Err(Unreadable::Malformed { id: fields.get("id").and_then(Json::as_u64), what })
}

/// What many programs write for numbers that JSON does not have, if that stands at this column, from 1.
fn not_a_number(text: &str, column: usize) -> Option<&'static str> {
    let before = column.saturating_sub(1);
    // An error is told where the first letter stands, or after what could still have begun a number.
    let places = (before.saturating_sub(1)..=before).filter_map(|at| text.get(at..));
    let written = |rest: &str| ["NaN", "Infinity", "-Infinity"].into_iter().find(|name| rest.starts_with(name));
    places.filter_map(written).next()
}

/// What is wrong with a text where it is said already that it is not JSON.
fn syntax_message(error: &serde_json::Error) -> String {
    let message = message(error);
    message.strip_prefix("this is not JSON: ").map_or(message.clone(), str::to_owned)
}

/// What is wrong with an answer's fields.
fn malformed(fields: &Map<String, Json>) -> Option<String> {
    let required = |name: &str, what: &str, fits: fn(&Json) -> bool| match fields.get(name) {
        None => Some(format!("it has no `{name}`")),
        Some(value) if !fits(value) => Some(format!("`{name}` is not {what}")),
        Some(_) => None,
    };
    let optional = |name: &str, what: &str, fits: fn(&Json) -> bool| {
        fields.get(name).filter(|value| !value.is_null() && !fits(value)).map(|_| format!("`{name}` is not {what}"))
    };
    required("id", "a whole number", Json::is_u64)
        .or_else(|| required("ok", "true or false", Json::is_boolean))
        .or_else(|| optional("error", "text", Json::is_string))
        .or_else(|| optional("name", "text", Json::is_string))
        .or_else(|| optional("reset", "true or false", Json::is_boolean))
        .or_else(|| optional("executed", "true or false", Json::is_boolean))
        .or_else(|| optional("reason", "text", Json::is_string))
        .or_else(|| optional("state", "an object", Json::is_object))
        .or_else(|| fields.get("state").and_then(Json::as_object).and_then(malformed_state))
}

fn malformed_state(fields: &Map<String, Json>) -> Option<String> {
    let what = match (fields.get("entities"), fields.get("objects")) {
        (Some(_), Some(_)) => Some("there are both `entities` and `objects`".to_owned()),
        (None, None) => Some("there are neither `entities` nor `objects`".to_owned()),
        (Some(Json::Array(entities)), None) => entities.iter().enumerate().find_map(malformed_entity),
        (Some(_), None) => Some("`entities` is not a list".to_owned()),
        (None, Some(_)) => malformed_symbolic(fields),
    };
    what.map(|what| format!("in the state, {what}"))
}

fn malformed_entity((index, entity): (usize, &Json)) -> Option<String> {
    let error = serde_json::from_value::<Entity>(entity.clone()).err()?;
    let name = match entity.get("id").and_then(Json::as_str) {
        Some(id) => format!("entity {id}"),
        None => format!("entity number {}", index + 1),
    };
    let attribute = |(attribute, value): (&String, &Json)| {
        let wrong = serde_json::from_value::<Value>(value.clone()).is_err();
        wrong.then(|| match value {
            Json::Null => {
                format!("{name}: attribute `{attribute}` is null: leave out what is not known, or give it a word")
            }
            _ => format!(
                "{name}: attribute `{attribute}` is neither true, false, a word, a number nor a list of numbers"
            ),
        })
    };
    let relation = |(relation, value): (&String, &Json)| {
        let wrong = serde_json::from_value::<Relation>(value.clone()).is_err();
        wrong.then(|| format!("{name}: relation `{relation}` is neither an entity's id, null nor a list of ids"))
    };
    let object = |field: &str| entity.get(field).and_then(Json::as_object).into_iter().flatten();
    let found = object("attributes").find_map(attribute).or_else(|| object("relations").find_map(relation));
    Some(found.unwrap_or_else(|| format!("{name}: {}", message(&error))))
}

/// A symbolic state's fields are tried one after the other.
fn malformed_symbolic(fields: &Map<String, Json>) -> Option<String> {
    let with = |name: &str, value: Json| {
        let mut alone = Map::from_iter([("objects".to_owned(), Json::Object(Map::new()))]);
        alone.insert(name.to_owned(), value);
        serde_json::from_value::<Scene>(Json::Object(alone))
    };
    if fields.get("objects").is_some_and(|objects| with("objects", objects.clone()).is_err()) {
        return Some("`objects` is not an object that gives each name its type's name".to_owned());
    }
    ["atoms", "unknown"].into_iter().find_map(|name| match fields.get(name)? {
        Json::Array(atoms) => {
            let wrong = atoms.iter().find(|atom| with(name, Json::Array(vec![(*atom).clone()])).is_err())?;
            Some(format!("in `{name}`, {wrong} is not an atom"))
        }
        _ => Some(format!("`{name}` is not a list of atoms")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrong(line: &[u8]) -> Unreadable {
        read_answer(line).expect_err("not an answer")
    }

    #[test]
    fn both_kinds_of_state_are_read() {
        let snapshot = br#"{"id":1,"ok":true,"state":{"entities":[{"id":"a","type":"saw"}]},"more":1}"#;
        assert!(matches!(read_answer(snapshot).expect("an answer").state, Some(Scene::Snapshot(_))));
        let symbolic = br#"{"id":1,"ok":true,"state":{"objects":{"a":"saw"},"atoms":["free(a)"]}}"#;
        assert!(matches!(read_answer(symbolic).expect("an answer").state, Some(Scene::Symbolic { .. })));
    }

    #[test]
    fn what_is_no_answer() {
        assert_eq!(wrong(b"hello"), Unreadable::NotJson("expected value at column 1".to_owned()));
        assert_eq!(wrong(b"{\"\xff\"}"), Unreadable::NotJson("not UTF-8 text from byte 3 on".to_owned()));
        let no_number = |what: &str| Unreadable::NoNumber(what.to_owned());
        assert_eq!(wrong(br#"{"id":1,"v":NaN}"#), no_number("NaN at column 13"));
        assert_eq!(wrong(br#"{"id":1,"v":[0,Infinity]}"#), no_number("Infinity at column 16"));
        assert_eq!(wrong(br#"{"id":1,"v":-Infinity}"#), no_number("-Infinity at column 14"));
        assert_eq!(wrong(b"[1]"), Unreadable::Malformed { id: None, what: "it is not an object".to_owned() });
    }

    #[test]
    fn malformed_answers() {
        let cases = [
            (r#"{"ok":true}"#, "it has no `id`"),
            (r#"{"id":"1","ok":true}"#, "`id` is not a whole number"),
            (r#"{"id":1}"#, "it has no `ok`"),
            (r#"{"id":1,"ok":"yes"}"#, "`ok` is not true or false"),
            (r#"{"id":1,"ok":true,"executed":1}"#, "`executed` is not true or false"),
            (r#"{"id":1,"id":1,"ok":true}"#, "`id` stands here twice"),
            (r#"{"id":1,"ok":true,"state":[]}"#, "`state` is not an object"),
            (r#"{"id":1,"ok":true,"state":{}}"#, "in the state, there are neither `entities` nor `objects`"),
            (r#"{"id":1,"ok":true,"state":{"entities":{}}}"#, "in the state, `entities` is not a list"),
            (
                r#"{"id":1,"ok":true,"state":{"entities":[{"id":"a","type":"saw"},{"id":"b"}]}}"#,
                "in the state, entity b: `type` is missing",
            ),
            (
                r#"{"id":1,"ok":true,"state":{"entities":[{"type":"saw"}]}}"#,
                "in the state, entity number 1: `id` is missing",
            ),
            (
                r#"{"id":1,"ok":true,"state":{"entities":[{"id":"a","type":"saw","attributes":{"speed":{}}}]}}"#,
                "in the state, entity a: attribute `speed` is neither true, false, a word, a number nor a list of numbers",
            ),
            (
                r#"{"id":1,"ok":true,"state":{"entities":[{"id":"a","type":"saw","relations":{"load":3}}]}}"#,
                "in the state, entity a: relation `load` is neither an entity's id, null nor a list of ids",
            ),
            (
                r#"{"id":1,"ok":true,"state":{"objects":{"a":1}}}"#,
                "in the state, `objects` is not an object that gives each name its type's name",
            ),
            (
                r#"{"id":1,"ok":true,"state":{"objects":{"a":"saw"},"atoms":["free(a)","free a"]}}"#,
                "in the state, in `atoms`, \"free a\" is not an atom",
            ),
        ];
        for (line, what) in cases {
            let Unreadable::Malformed { what: found, .. } = wrong(line.as_bytes()) else { panic!("{line} is JSON") };
            assert_eq!(found, what, "{line}");
        }
    }

    #[test]
    fn a_malformed_answer_still_says_what_it_answers() {
        let what = "in the state, there are neither `entities` nor `objects`".to_owned();
        assert_eq!(wrong(br#"{"id":7,"ok":true,"state":{}}"#), Unreadable::Malformed { id: Some(7), what });
    }
}
