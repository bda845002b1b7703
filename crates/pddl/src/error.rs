//! Errors that point at the text, and how they are shown.

use std::fmt::Write;

use thiserror::Error;
use typelift_model::printable;

use crate::{Position, Span};

/// Characters of a line that are shown at most.
const WIDTH: usize = 100;

/// Another place that an error is about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Related {
    /// What is there, as "first declared here".
    pub note: String,
    /// The place.
    pub position: Position,
    /// The bytes.
    pub span: Span,
}

/// What is wrong with a PDDL text, and where.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("line {}, column {}: {message}", .position.line, .position.column)]
pub struct PddlError {
    /// What is wrong.
    pub message: String,
    /// The place.
    pub position: Position,
    /// The bytes.
    pub span: Span,
    /// Another place that it is about.
    pub related: Option<Box<Related>>,
    /// What to do about it.
    pub hint: Option<String>,
    /// Whether the text is PDDL, but uses something that is not supported.
    pub unsupported: bool,
}

impl PddlError {
    /// An error about these bytes of `text`.
    pub fn new(text: &str, span: Span, message: impl Into<String>) -> Self {
        let position = Position::find(text, span.start);
        Self { message: printable(message), position, span, related: None, hint: None, unsupported: false }
    }

    /// With another place of the same text.
    #[must_use]
    pub fn with_related(mut self, text: &str, span: Span, note: impl Into<String>) -> Self {
        let position = Position::find(text, span.start);
        self.related = Some(Box::new(Related { note: printable(note), position, span }));
        self
    }

    /// With advice.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(printable(hint));
        self
    }

    /// As an error about something that is not supported.
    #[must_use]
    pub fn as_unsupported(mut self) -> Self {
        self.unsupported = true;
        self
    }

    /// The error with its lines, as several lines of text; `file` and `text` are what was read. The hint is not
    /// among them.
    pub fn render(&self, file: &str, text: &str) -> String {
        let Position { line, column } = self.position;
        format!("{file}:{line}:{column}: {}\n{}", self.message, self.excerpt(text))
    }

    /// The lines that it is about, marked, in the order of the text.
    pub fn excerpt(&self, text: &str) -> String {
        let mut marks = vec![(self.position, self.span, '^', "")];
        if let Some(related) = &self.related {
            marks.push((related.position, related.span, '-', &related.note));
        }
        marks.sort_by_key(|mark| mark.1.start);
        let gutter = marks.iter().map(|mark| mark.0.line.to_string().len()).max().unwrap_or(1);
        let mut out = format!("{:gutter$} |\n", "");
        for (position, span, mark, note) in marks {
            let (line, start, length) = shown_line(text, span);
            let underline = mark.to_string().repeat(length);
            let marked = format!("{:gutter$} | {:start$}{underline} {note}", "", "");
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{:>gutter$} | {line}\n{}", position.line, marked.trim_end());
        }
        out
    }
}

/// The line in which `span` starts, shortened around it, without tabs and control characters; then where in it the
/// span starts and how far it reaches, in characters.
fn shown_line(text: &str, span: Span) -> (String, usize, usize) {
    let at = span.start.min(text.len());
    let line_start = text[..at].rfind('\n').map_or(0, |i| i + 1);
    let line_end = text[at..].find('\n').map_or(text.len(), |i| at + i);
    let end = span.end.clamp(at, line_end);
    let expanded = |part: &str| -> Vec<char> { printable(part.replace('\t', "    ")).chars().collect() };
    let mut line = expanded(&text[line_start..at]);
    let mut start = line.len();
    line.extend(expanded(&text[at..end]));
    let mut length = (line.len() - start).max(1);
    line.extend(expanded(text[end..line_end].trim_end_matches('\r')));
    let first = if line.len() > WIDTH { start.saturating_sub(WIDTH / 3) } else { 0 };
    let last = line.len().min(first + WIDTH);
    let mut shown = String::from_iter(&line[first..last]);
    if first > 0 {
        shown.insert(0, '…');
        start = start - first + 1;
    }
    if last < line.len() {
        shown.push('…');
    }
    length = length.min((WIDTH + 1).saturating_sub(start)).max(1);
    (shown, start, length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_places_are_shown() {
        let text = "(:types a - b\r\n\ta - c)\r\n";
        let error = PddlError::new(text, Span { start: 16, end: 17 }, "type `a` has two parents, `b` and `c`")
            .with_related(text, Span { start: 8, end: 9 }, "first declared here");
        assert_eq!(
            error.render("types.pddl", text),
            "types.pddl:2:2: type `a` has two parents, `b` and `c`\n  \
             |\n\
             1 | (:types a - b\n  \
             |         - first declared here\n\
             2 |     a - c)\n  \
             |     ^\n"
        );
        assert_eq!(error.to_string(), "line 2, column 2: type `a` has two parents, `b` and `c`");
    }

    #[test]
    fn long_lines_are_shortened_around_the_place() {
        let text = format!("({} oops {})", "(p a) ".repeat(200), "(p a) ".repeat(200));
        let start = text.find("oops").expect("it is there");
        let shown = PddlError::new(&text, Span { start, end: start + 4 }, "bad").excerpt(&text);
        let lines: Vec<&str> = shown.lines().collect();
        assert!(lines.iter().all(|line| line.chars().count() < WIDTH + 10), "{shown}");
        assert_eq!(lines[1].find("oops").map(|i| lines[1][..i].chars().count()), lines[2].find("^^^^"));
        assert!(lines[1].starts_with("1 | …") && lines[1].ends_with('…'));
    }

    #[test]
    fn any_span_can_be_shown() {
        for (text, start, end) in [("", 0, 0), ("a", 1, 1), ("a", 7, 9), ("(a\nb)", 0, 5), ("a\n", 2, 2)] {
            assert!(!PddlError::new(text, Span { start, end }, "bad").excerpt(text).is_empty());
        }
    }
}
