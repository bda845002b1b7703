//! Results as JSON files.

use serde::Serialize;

/// A result as text, a field a line.
///
/// # Panics
/// If it has a map whose keys are no strings, or a number that is none: results have neither.
pub(crate) fn pretty(result: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(result).expect("a result is JSON");
    text.push('\n');
    text
}
