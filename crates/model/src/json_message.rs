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
            let text = text.replacen("unknown variant `", "unknown word `", 1);
            match text.rsplit_once(", expected ") {
                Some((found, expected)) => format!("{found}, expected {}", in_words(expected)),
                None => text,
            }
        }
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
        assert_eq!(message_for::<Call>("1"), "invalid type: integer `1`, expected an object");
        assert_eq!(message_for::<Call>("{}"), "missing field `name`");
        assert_eq!(message_for::<Pair>("{}"), "invalid type: map, expected a list");
        assert_eq!(message_for::<Pair>("[1]"), "invalid length 1, expected a list of 2");
        assert_eq!(message_for::<Pair>("[1, true]"), "invalid type: boolean `true`, expected a whole number");
        assert_eq!(message_for::<Way>("\"down\""), "unknown word `down`, expected `up`");
        let error = serde_json::from_value::<Way>(serde_json::json!([])).expect_err("a list");
        assert_eq!(json_message(&error), "invalid type: sequence, expected a string or an object");
        assert_eq!(message_for::<Either>("3"), "this is nothing that may stand here");
        assert_eq!(message_for::<bool>("3"), "invalid type: integer `3`, expected true or false");
    }

    #[test]
    fn messages_name_no_rust_type() {
        assert_eq!(message_for::<u64>("-1"), "invalid value: integer `-1`, expected a whole number, 0 or more");
        assert_eq!(
            message_for::<f64>("\"1, expected u64\""),
            "invalid type: string \"1, expected u64\", expected a number"
        );
        assert_eq!(message_for::<f64>("1e999"), "this number is too large");
        assert_eq!(message_for::<Vec<f64>>("[NaN]"), "this is not JSON: expected value");
        assert_eq!(message_for::<Vec<f64>>("{}"), "invalid type: map, expected a list");
        assert_eq!(message_for::<Vec<(u32, u32)>>("[[1]]"), "invalid length 1, expected a list of 2");
        assert_eq!(message_for::<Vec<f64>>("[1"), "the JSON text ends too early");
        assert_eq!(message_for::<Vec<f64>>("[1] 2"), "nothing may follow after the end of the JSON text");
        assert_eq!(message_for::<serde_json::Value>(&"[".repeat(1000)), "this is nested too deeply");
    }
}
