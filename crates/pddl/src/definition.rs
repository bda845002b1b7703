//! The outermost form of a PDDL file: `(define (domain NAME) …)` or `(define (problem NAME) …)`.

use typelift_model::{Symbol, did_you_mean};

use crate::names::lower;
use crate::{Document, PddlError, Sexpr};

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

impl DefinitionKind {
    /// `domain` or `problem`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Domain => "domain",
            Self::Problem => "problem",
        }
    }
}

/// Blocks of some version of PDDL that are not read.
const UNSUPPORTED: [&str; 15] = [
    ":durative-action",
    ":process",
    ":event",
    ":axiom",
    ":constraints",
    ":safety",
    ":method",
    ":task",
    ":tasks",
    ":htn",
    ":timeless",
    ":extends",
    ":situation",
    ":observe",
    ":goal-reward",
];

/// An error about a definition as a whole, at its beginning.
fn definition_error(root: Sexpr<'_>, message: impl Into<String>) -> PddlError {
    let place = root.children().nth(1).filter(|_| root.has_head("define")).unwrap_or(root);
    place.error(message)
}

/// # Errors
/// [`PddlError`] at a block that is none of these.
pub(crate) fn refuse_other_blocks(definition: &Definition<'_>, known: &[&str]) -> Result<(), PddlError> {
    for block in definition.blocks() {
        let Some(head) = block.head() else {
            return Err(block.error(format!("a block such as `({} …)` is expected here", known[0])));
        };
        let head = lower(head);
        if known.contains(&&*head) {
            continue;
        }
        let kind = definition.kind.name();
        if UNSUPPORTED.contains(&&*head) {
            return Err(block.error(format!("`{head}` is not supported")).as_unsupported());
        }
        let names: Vec<Symbol> = known.iter().map(|name| Symbol::new(name)).collect();
        let hint = did_you_mean(&head, &names).unwrap_or_else(|| format!("There are {}.", known.join(", ")));
        return Err(block.error(format!("a {kind} has no block `{head}`")).with_hint(hint));
    }
    Ok(())
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

    /// Reads a text that defines this and nothing else.
    ///
    /// # Errors
    /// [`PddlError`] if it is something else.
    pub fn only(document: &'d Document<'d>, kind: DefinitionKind) -> Result<Self, PddlError> {
        let root = document.only_root()?;
        let expected = kind.name();
        match Self::read(root)? {
            Some(definition) if definition.kind == kind => Ok(definition),
            Some(other) => {
                let error = definition_error(root, format!("this is a {}, not a {expected}", other.kind.name()));
                Err(error.with_hint(format!("A {expected} begins with `(define ({expected} NAME)`.")))
            }
            None => {
                let error = definition_error(root, format!("this is not a {expected}"));
                Err(error.with_hint(format!("A {expected} begins with `(define ({expected} NAME)`.")))
            }
        }
    }

    /// An error about it as a whole.
    pub(crate) fn error(&self, message: impl Into<String>) -> PddlError {
        definition_error(self.sexpr, message)
    }

    /// The name after `:domain`, in a problem.
    ///
    /// # Errors
    /// [`PddlError`] if there is not exactly one.
    pub fn domain_name(&self) -> Result<Sexpr<'d>, PddlError> {
        const HINT: &str = "Write `(:domain NAME)`, with the name of its domain.";
        let Some(block) = self.block(":domain")? else {
            return Err(self.error("this problem does not say to which domain it belongs").with_hint(HINT));
        };
        let mut names = block.children().skip(1);
        match (names.next().filter(|name| !name.is_list()), names.next()) {
            (Some(name), None) => Ok(name),
            _ => Err(block.error("exactly one name is expected here").with_hint(HINT)),
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
