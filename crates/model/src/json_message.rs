//! What is wrong with a JSON text, for people who do not read Rust.

use crate::printable;

/// The message of an error of the reader of JSON, without its place.
pub fn json_message(error: &serde_json::Error) -> String {
    printable(message(error))
}

fn message(error: &serde_json::Error) -> String {
    if error.is_eof() {
        return "the JSON text ends too early".to_owned();
    }
    let full = error.to_string();
    let text = full.rsplit_once(" at line ").map_or(full.as_str(), |(text, _)| text);
    match text {
        "trailing characters" => "nothing may follow after the end of the JSON text".to_owned(),
        "recursion limit exceeded" => "this is nested too deeply".to_owned(),
        "number out of range" => "this number is too large".to_owned(),
        _ if error.is_syntax() => format!("this is not JSON: {text}"),
        _ if text.starts_with("data did not match any variant") => "this is nothing that may stand here".to_owned(),
        _ => {
            let text = text.replacen("unknown variant `", "the unknown word `", 1);
            let text = text.replacen("unknown field `", "the unknown field `", 1);
            match text.rsplit_once(", expected ") {
                Some((found, expected)) => format!("expected {}, found {}", in_words(expected), found_in_words(found)),
                None => of_a_field(&text),
            }
        }
    }
}

/// What is said of a field that is not there, or there twice.
fn of_a_field(text: &str) -> String {
    if let Some(field) = text.strip_prefix("missing field ") {
        return format!("{field} is missing");
    }
    text.strip_prefix("duplicate field ").map_or(text.to_owned(), |field| format!("{field} stands here twice"))
}

/// What was found instead of what was expected, as JSON calls it.
fn found_in_words(found: &str) -> String {
    if let Some(length) = found.strip_prefix("invalid length ") {
        return format!("a list of {length}");
    }
    let kinds = ["invalid type: ", "invalid value: "];
    let Some(found) = kinds.iter().find_map(|kind| found.strip_prefix(kind)) else { return found.to_owned() };
    let quoted = |kind: &str| Some(found.strip_prefix(kind)?.trim_matches('`'));
    match found {
        "sequence" => "a list".to_owned(),
        "map" => "an object".to_owned(),
        "unit value" => "null".to_owned(),
        _ if found.starts_with("string ") => format!("the {found}"),
        _ => match quoted("integer ").or_else(|| quoted("floating point ")) {
            Some(number) => format!("the number {number}"),
            None => quoted("boolean ").unwrap_or(found).to_owned(),
        },
    }
}

/// What Rust calls a type, as JSON does. Names of structs and enums mean nothing to whoever wrote the text.
fn in_words(expected: &str) -> String {
    let length = || Some(expected.rsplit_once(" with ")?.1.split_once(" element")?.0);
    let is = |kinds: &[&str]| kinds.iter().any(|kind| expected.starts_with(kind));
    match expected {
        "u64" | "u32" | "u16" | "u8" | "usize" => "a whole number, 0 or more".to_owned(),
        "i64" | "i32" | "i16" | "i8" | "isize" => "a whole number".to_owned(),
        "f64" | "f32" => "a number".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a map" => "an object".to_owned(),
        "unit" => "null".to_owned(),
        "string or map" => "a string or an object".to_owned(),
        _ if is(&["a tuple of size "]) => format!("a list of {}", &expected["a tuple of size ".len()..]),
        _ if is(&["struct ", "tuple struct ", "struct variant ", "tuple variant "]) => match length() {
            Some(length) => format!("a list of {length}"),
            None if expected.starts_with("tuple") => "a list".to_owned(),
            None => "an object".to_owned(),
        },
        _ if is(&["unit struct ", "unit variant "]) => "null".to_owned(),
        _ if is(&["enum "]) => "a word, or an object with one key".to_owned(),
        _ if is(&["newtype struct ", "newtype variant "]) => "another value".to_owned(),
        other => other.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message_for<T: serde::de::DeserializeOwned>(text: &str) -> String {
        match serde_json::from_str::<T>(text) {
            Ok(_) => panic!("{text} is read"),
            Err(error) => json_message(&error),
        }
    }

    #[derive(serde::Deserialize, Debug)]
    struct Call {
        #[serde(rename = "name")]
        _name: String,
    }

    #[derive(serde::Deserialize, Debug)]
    struct Pair(#[allow(dead_code, reason = "it is never read")] i64, #[allow(dead_code, reason = "as above")] i64);

    #[derive(serde::Deserialize, Debug)]
    #[serde(rename_all = "lowercase")]
    enum Way {
        Up,
    }

    #[derive(serde::Deserialize, Debug)]
    #[serde(untagged)]
    enum Either {
        Flag(#[allow(dead_code, reason = "it is never read")] bool),
    }

    #[test]
    fn no_name_of_a_struct_or_enum_is_told() {
        assert_eq!(message_for::<Call>("1"), "expected an object, found the number 1");
        assert_eq!(message_for::<Call>("{}"), "`name` is missing");
        assert_eq!(message_for::<Pair>("{}"), "expected a list, found an object");
        assert_eq!(message_for::<Pair>("[1]"), "expected a list of 2, found a list of 1");
        assert_eq!(message_for::<Pair>("[1, true]"), "expected a whole number, found true");
        assert_eq!(message_for::<Way>("\"down\""), "expected `up`, found the unknown word `down`");
        let error = serde_json::from_value::<Way>(serde_json::json!([])).expect_err("a list");
        assert_eq!(json_message(&error), "expected a string or an object, found a list");
        assert_eq!(message_for::<Either>("3"), "this is nothing that may stand here");
        assert_eq!(message_for::<bool>("3"), "expected true or false, found the number 3");
    }

    #[test]
    fn messages_name_no_rust_type() {
        assert_eq!(message_for::<u64>("-1"), "expected a whole number, 0 or more, found the number -1");
        assert_eq!(
            message_for::<f64>("\"1, expected u64\""),
            "expected a number, found the string \"1, expected u64\""
        );
        assert_eq!(message_for::<f64>("1e999"), "this number is too large");
        assert_eq!(message_for::<Vec<f64>>("[NaN]"), "this is not JSON: expected value");
        assert_eq!(message_for::<Vec<f64>>("{}"), "expected a list, found an object");
        assert_eq!(message_for::<Vec<(u32, u32)>>("[[1]]"), "expected a list of 2, found a list of 1");
        assert_eq!(message_for::<Vec<f64>>("[1"), "the JSON text ends too early");
        assert_eq!(message_for::<Vec<f64>>("[1] 2"), "nothing may follow after the end of the JSON text");
        assert_eq!(message_for::<serde_json::Value>(&"[".repeat(1000)), "this is nested too deeply");
    }
}
