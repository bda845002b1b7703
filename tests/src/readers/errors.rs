//! What a person sees of an error.

use typelift::pddl::{PddlError, Position, Span};
use typelift::world::FileError;

/// Characters that a line of an excerpt has at most, its number included.
const WIDEST: usize = 130;

/// An error about a text: it has its place there, and can be shown.
pub(super) fn assert_located(error: &PddlError, text: &str) {
    assert_printable(&error.message);
    assert_placed(error.position, error.span, text);
    if let Some(related) = &error.related {
        assert_printable(&related.note);
        assert_placed(related.position, related.span, text);
    }
    if let Some(hint) = &error.hint {
        assert_printable(hint);
    }
    assert_excerpt(&error.excerpt(text), error.related.is_none());
    assert!(error.render("file", text).starts_with("file:"));
}

/// An error about a file of these bytes.
pub(super) fn assert_shown(error: &FileError, bytes: &[u8]) {
    assert_printable(&error.what);
    if let Some(hint) = &error.hint {
        assert_printable(hint);
    }
    let lines = 1 + bytes.iter().filter(|&&byte| byte == b'\n').count();
    if let Some(line) = error.line {
        assert!((1..=lines).contains(&(line as usize)), "line {line} of {lines}: {error}");
    }
    if let Some(column) = error.column {
        assert!((1..=bytes.len() + 1).contains(&(column as usize)), "column {column}: {error}");
    }
    if let Some(excerpt) = &error.excerpt {
        assert_excerpt(excerpt, false);
    }
    assert!(error.render().contains(&error.what));
}

/// A message that a terminal shows as it is.
pub(super) fn assert_printable(message: &str) {
    assert!(!message.is_empty());
    assert!(!message.contains(char::is_control), "{message:?}");
}

/// The lines of a text; a note below them may be long.
fn assert_excerpt(excerpt: &str, without_note: bool) {
    assert!(!excerpt.is_empty());
    for line in excerpt.lines() {
        assert!(!line.contains(char::is_control), "{line:?}");
        assert!(!without_note || line.chars().count() <= WIDEST, "{line:?}");
    }
}

fn assert_placed(position: Position, span: Span, text: &str) {
    assert!(span.start <= span.end, "{span:?}");
    assert!(text.get(span.start..span.end).is_some(), "{span:?}");
    assert_eq!(position, Position::find(text, span.start));
}
