//! Names as PDDL compares them: in lower case.

use std::borrow::Cow;

use typelift_model::{Symbol, check_name};

use crate::{PddlError, Sexpr, Span};

/// The text in lower case; nothing is copied if it already is.
pub(crate) fn lower(text: &str) -> Cow<'_, str> {
    if text.bytes().any(|byte| byte.is_ascii_uppercase()) {
        Cow::Owned(text.to_ascii_lowercase())
    } else {
        Cow::Borrowed(text)
    }
}

/// # Errors
/// [`PddlError`] at a name that holds what separates names.
pub(crate) fn check_new_name(text: &str, name: &str, span: Span) -> Result<(), PddlError> {
    let refused = |why: String| Err(PddlError::new(text, span, why));
    match check_name(name) {
        Err(error) => refused(error.to_string()),
        Ok(()) if name == "-" => refused("`-` cannot be a name: it stands before a type".to_owned()),
        Ok(()) if name.starts_with(':') => refused(format!("`{name}` cannot be a name: it starts with `:`")),
        Ok(()) => Ok(()),
    }
}

/// A name that is declared at `span`, in lower case.
///
/// # Errors
/// [`PddlError`] if it holds what separates names.
pub(crate) fn new_name(text: &str, name: &str, span: Span) -> Result<Symbol, PddlError> {
    check_new_name(text, name, span)?;
    Ok(Symbol::new(&lower(name)))
}

/// The name that is declared by this atom, in lower case.
///
/// # Errors
/// [`PddlError`] if it is a list, or holds what separates names.
pub(crate) fn declared_name(item: Sexpr<'_>) -> Result<Symbol, PddlError> {
    match item.atom() {
        Some(name) => new_name(item.document_text(), name, item.span()),
        None => Err(item.error("a name is expected here, not a list")),
    }
}

/// The variable that is written like this, in lower case and without its question mark.
///
/// # Errors
/// [`PddlError`] if it has no question mark, or nothing behind it.
pub(crate) fn new_variable(text: &str, name: &str, span: Span) -> Result<Symbol, PddlError> {
    match name.strip_prefix('?') {
        Some("") => Err(PddlError::new(text, span, "there is no name after this `?`")),
        Some(name) => new_name(text, name, span),
        None => {
            let error = PddlError::new(text, span, format!("a variable is expected here, not `{name}`"));
            Err(error.with_hint(match name.strip_prefix('-') {
                Some(ty) => format!("Write a space after `-`: `- {ty}`."),
                None => format!("Write `?{name}`."),
            }))
        }
    }
}
