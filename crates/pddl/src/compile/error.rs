//! Why a domain or a problem has no model, and where in its text that is.

use std::fmt;

use thiserror::Error;
use typelift_model::Symbol;

use crate::{Definition, Document, PddlError, Sexpr, Span};

/// The part of a domain or a problem that an error is about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CompilePart {
    /// The types of a domain.
    Types,
    /// The constants of a domain.
    Constants,
    /// The action of this name.
    Action(Symbol),
    /// The conditions of this derived predicate.
    Derived(Symbol),
    /// The objects of a problem.
    Objects,
    /// The initial state of a problem.
    Init,
    /// The goal of a problem.
    Goal,
}

impl CompilePart {
    /// Whether it stands in a problem, not in a domain.
    pub fn is_of_problem(&self) -> bool {
        matches!(self, Self::Objects | Self::Init | Self::Goal)
    }

    /// What the blocks of this part begin with.
    fn key(&self) -> &'static str {
        match self {
            Self::Types => ":types",
            Self::Constants => ":constants",
            Self::Action(_) => ":action",
            Self::Derived(_) => ":derived",
            Self::Objects => ":objects",
            Self::Init => ":init",
            Self::Goal => ":goal",
        }
    }

    /// Where this part is named, if `block` is this part.
    fn place(&self, block: Sexpr<'_>) -> Option<Span> {
        if !block.has_head(self.key()) {
            return None;
        }
        let second = block.children().nth(1);
        let named =
            |text: Option<&str>, name: &Symbol| text.is_some_and(|text| text.eq_ignore_ascii_case(name.as_str()));
        match self {
            Self::Action(name) => second.filter(|s| named(s.atom(), name)).map(Sexpr::span),
            Self::Derived(name) => {
                second.filter(|s| named(s.children().next().and_then(Sexpr::atom), name)).map(Sexpr::span)
            }
            _ => Some(block.span()),
        }
    }
}

impl fmt::Display for CompilePart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Types => f.write_str("the types"),
            Self::Constants => f.write_str("the constants"),
            Self::Action(name) => write!(f, "action `{name}`"),
            Self::Derived(name) => write!(f, "derived predicate `{name}`"),
            Self::Objects => f.write_str("the objects"),
            Self::Init => f.write_str("the initial state"),
            Self::Goal => f.write_str("the goal"),
        }
    }
}

/// Why a domain or a problem could not be compiled.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{part}: {message}")]
pub struct CompileError {
    /// What it is about.
    pub part: CompilePart,
    /// What is wrong.
    pub message: String,
    /// Whether it means something in PDDL, but something that is not supported.
    pub unsupported: bool,
}

impl CompileError {
    /// An error about this part.
    pub(crate) fn new(part: &CompilePart, message: impl Into<String>) -> Self {
        Self { part: part.clone(), message: message.into(), unsupported: false }
    }

    /// As an error about something that is not supported.
    pub(crate) fn not_supported(mut self) -> Self {
        self.unsupported = true;
        self
    }

    /// The same error at its place in `text`, the domain or the problem that was compiled. If the part is not found
    /// there, at the beginning.
    pub fn locate(&self, text: &str) -> PddlError {
        let error = match self.span(text) {
            Some(span) => PddlError::new(text, span, self.message.clone()),
            None => PddlError::new(text, Span::default(), self.to_string()),
        };
        if self.unsupported { error.as_unsupported() } else { error }
    }

    fn span(&self, text: &str) -> Option<Span> {
        let document = Document::read(text).ok()?;
        let definition = Definition::read(document.only_root().ok()?).ok()??;
        definition.blocks().find_map(|block| self.part.place(block))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn located(part: &CompilePart, text: &str) -> String {
        CompileError::new(part, "bad").locate(text).to_string()
    }

    #[test]
    fn the_part_is_found() {
        let domain = "(define (domain d)\n (:types a)\n (:action go)\n (:ACTION Stop)\n (:derived (On ?x) (and)))";
        assert_eq!(located(&CompilePart::Types, domain), "line 2, column 2: bad");
        assert_eq!(located(&CompilePart::Action(Symbol::new("stop")), domain), "line 4, column 11: bad");
        assert_eq!(located(&CompilePart::Derived(Symbol::new("on")), domain), "line 5, column 12: bad");
        let problem = "(define (problem p)\n (:goal (and)))";
        assert_eq!(located(&CompilePart::Goal, problem), "line 2, column 2: bad");
    }

    #[test]
    fn a_text_without_the_part_still_gives_an_error() {
        for text in ["", "(", "(define)", "(define (domain d))"] {
            assert_eq!(located(&CompilePart::Goal, text), "line 1, column 1: the goal: bad", "{text}");
        }
    }
}
