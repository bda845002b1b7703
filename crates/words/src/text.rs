//! Text of which each part has a role: a terminal paints it, a page gives it a class, and without either it reads the
//! same, since a role never carries meaning alone.

use std::fmt;

use serde::Serialize;
use typelift_model::Witness;

/// What a part of a text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Plain text.
    Plain,
    /// A heading, or the name of what a line is about.
    Heading,
    /// Of less weight than the rest.
    Aside,
    /// Something went well.
    Good,
    /// Something went wrong.
    Bad,
    /// Something rests on imagination.
    Imagined,
    /// Something to be aware of.
    Warning,
}

/// A part of a text.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Span {
    /// What it is.
    pub role: Role,
    /// What it says.
    pub text: String,
}

/// Text in parts; displayed, the parts follow each other without anything in between.
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Text(pub Vec<Span>);

impl Text {
    /// No text.
    pub fn new() -> Self {
        Self::default()
    }

    /// The same with a part after it; nothing is added for an empty one.
    #[must_use]
    pub fn with(mut self, role: Role, text: impl Into<String>) -> Self {
        let text = text.into();
        if !text.is_empty() {
            self.0.push(Span { role, text });
        }
        self
    }

    /// The same with plain text after it.
    #[must_use]
    pub fn plain(self, text: impl Into<String>) -> Self {
        self.with(Role::Plain, text)
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|span| f.write_str(&span.text))
    }
}

/// The places where something was observed; of `times` observations perhaps not all are known: `a.jsonl step 3 and 7 more`.
pub fn places<'a>(witnesses: impl IntoIterator<Item = &'a Witness>, times: u64) -> String {
    let places: Vec<String> = witnesses.into_iter().map(|w| format!("{} step {}", w.file, w.step)).collect();
    match times.saturating_sub(places.len() as u64) {
        0 => places.join(", "),
        more => format!("{} and {more} more", places.join(", ")),
    }
}

/// `1 step`, `2 steps`.
///
/// ```
/// assert_eq!(typelift_words::count(2, "step"), "2 steps");
/// ```
pub fn count(n: u64, singular: &str) -> String {
    format!("{n} {singular}{}", if n == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_its_roles_a_text_reads_the_same() {
        let text = Text::new().with(Role::Heading, "T1").plain("  ").with(Role::Good, "solved").with(Role::Bad, "");
        assert_eq!(text.to_string(), "T1  solved");
        assert_eq!(text.0.len(), 3, "an empty part is none");
    }
}
