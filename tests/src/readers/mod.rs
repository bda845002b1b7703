//! What must hold of every reader, whatever it is given: a function for each, which takes any bytes and panics where a
//! law is broken. The tests in `tests/readers.rs` call them with valid texts and with damaged ones, the targets in
//! `fuzz` with what a fuzzer makes up.
//!
//! Some take several texts, the parts of the input between lines that are [`BETWEEN_PARTS`]; where one is left out, a
//! sample stands for it.

mod domain;
mod errors;
mod format;
mod learning;
mod model;
mod mutation;
mod plan;
mod planning;
mod problem;
mod sample;
mod scratch;
mod task;
mod trace;
mod trajectory;
mod types;

pub use domain::domain;
pub use format::format;
pub use model::model;
pub use mutation::{Edit, mutated};
pub use plan::plan;
pub use problem::problem;
pub use task::task;
pub use trace::trace;
pub use trajectory::trajectory;
pub use types::types;

/// A reader's laws.
pub type Laws = fn(&[u8]);

/// Every reader, by the name of its folder of seeds and of its fuzz target.
pub const READERS: [(&str, Laws); 9] = [
    ("domain", domain),
    ("problem", problem),
    ("plan", plan),
    ("format", format),
    ("types", types),
    ("trajectory", trajectory),
    ("trace", trace),
    ("task", task),
    ("model", model),
];

/// The line between two texts of one input.
pub const BETWEEN_PARTS: &str = "\n---\n";

/// The input as the text of a file, without a byte order mark. What is not UTF-8 never gets further than to
/// [`read_text`](typelift::world::read_text), so that it is replaced here.
fn text_of(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    text.strip_prefix('\u{FEFF}').unwrap_or(&text).to_owned()
}

/// The last part of an input, and the parts before it if they are as many.
fn last_part<const N: usize>(text: &str) -> (Option<[&str; N]>, &str) {
    let mut parts: Vec<&str> = text.splitn(N + 1, BETWEEN_PARTS).collect();
    let last = parts.pop().unwrap_or_default();
    match <[&str; N]>::try_from(parts) {
        Ok(first) => (Some(first), last),
        Err(_) => (None, text),
    }
}
