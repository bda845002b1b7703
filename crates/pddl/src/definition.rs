//! The outermost form of a PDDL file: `(define (domain NAME) …)` or `(define (problem NAME) …)`.

use crate::{PddlError, Sexpr};

/// What a file defines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DefinitionKind {
    /// A domain.
    Domain,
    /// A problem.
    Problem,
}

/// A domain or a problem, with its blocks unread.
#[derive(Debug, Clone, Copy)]
pub struct Definition<'d> {
    /// Which of the two.
    pub kind: DefinitionKind,
    /// Its name as it is written.
    pub name: &'d str,
    sexpr: Sexpr<'d>,
}

impl<'d> Definition<'d> {
    /// Reads the outermost form; `None` if it is not a `define`.
    ///
    /// # Errors
    /// [`PddlError`] if it is one, but of neither a domain nor a problem.
    pub fn read(root: Sexpr<'d>) -> Result<Option<Self>, PddlError> {
        if !root.has_head("define") {
            return Ok(None);
        }
        let Some(header) = root.children().nth(1) else {
            return Err(root.error("there is no `(domain NAME)` or `(problem NAME)` after `define`"));
        };
        let kind = if header.has_head("domain") {
            DefinitionKind::Domain
        } else if header.has_head("problem") {
            DefinitionKind::Problem
        } else {
            return Err(header.error("`(domain NAME)` or `(problem NAME)` is expected here"));
        };
        let mut name = header.children().skip(1).map(Sexpr::atom);
        match (name.next().flatten(), name.next()) {
            (Some(name), None) => Ok(Some(Self { kind, name, sexpr: root })),
            _ => Err(header.error("exactly one name is expected here")),
        }
    }

    /// Its blocks: everything after the name.
    pub fn blocks(&self) -> impl Iterator<Item = Sexpr<'d>> {
        self.sexpr.children().skip(2)
    }

    /// The block that begins with `key`.
    ///
    /// # Errors
    /// [`PddlError`] if there are two.
    pub fn block(&self, key: &str) -> Result<Option<Sexpr<'d>>, PddlError> {
        let mut found = self.blocks().filter(|block| block.has_head(key));
        let first = found.next();
        match (first, found.next()) {
            (Some(first), Some(second)) => Err(second.error(format!("there is a second `{key}` block")).with_related(
                first.document_text(),
                first.span(),
                "the first is here",
            )),
            _ => Ok(first),
        }
    }
}
