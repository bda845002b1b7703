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
        _ => match text.rsplit_once(", expected ") {
            Some((found, expected)) => format!("{found}, expected {}", in_words(expected)),
            None => text.to_owned(),
        },
    }
}

/// What Rust calls a type, as JSON does.
fn in_words(expected: &str) -> &str {
    match expected {
        "u64" | "u32" | "usize" => "a whole number, 0 or more",
        "f64" => "a number",
        "a sequence" => "a list",
        "a map" => "an object",
        "a tuple of size 2" => "a list of 2",
        "a tuple of size 3" => "a list of 3",
        other => other,
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
