//! The s-expression reader.
//!
//! A text becomes a flat list of nodes in the order in which they open, each knowing its span and where the node
//! after it starts. Nothing recurses, neither reading nor walking nor dropping, so that depth costs no stack. Linear in
//! the text.
//!
//! Comments run from `;` to the end of the line. A `?` begins a new atom, since it only ever begins a variable.

use crate::{PddlError, Span};

#[derive(Debug, Clone, Copy)]
struct Node {
    span: Span,
    /// The index of the first node that is not inside this one.
    next: usize,
    is_list: bool,
}

/// A text with its s-expressions.
#[derive(Debug, Clone)]
pub struct Document<'t> {
    text: &'t str,
    nodes: Vec<Node>,
}

/// One s-expression of a [`Document`]: an atom or a list.
#[derive(Debug, Clone, Copy)]
pub struct Sexpr<'d> {
    document: &'d Document<'d>,
    index: usize,
}

/// The parts of a list, in order.
#[derive(Debug, Clone)]
pub struct Children<'d> {
    document: &'d Document<'d>,
    next: usize,
    end: usize,
}

fn ends_atom(byte: u8) -> bool {
    byte.is_ascii_whitespace() || matches!(byte, b'(' | b')' | b';' | b'?')
}

impl<'t> Document<'t> {
    /// Reads all s-expressions of a text.
    ///
    /// # Errors
    /// [`PddlError`] at a parenthesis that has no partner.
    pub fn read(text: &'t str) -> Result<Self, PddlError> {
        let bytes = text.as_bytes();
        let length_of = |from: usize, ends: fn(u8) -> bool| {
            bytes[from..].iter().position(|&b| ends(b)).unwrap_or(bytes.len() - from)
        };
        let mut nodes: Vec<Node> = Vec::new();
        let mut open: Vec<usize> = Vec::new();
        // A block, as `(:action …)`, stands in no other: the first that seems to follows one that is not closed.
        let mut unclosed_block: Option<usize> = None;
        let mut at = 0;
        while at < bytes.len() {
            let start = at;
            match bytes[at] {
                b';' => at += length_of(at, |b| b == b'\n'),
                b'(' => {
                    at += 1;
                    if open.len() > 1 && bytes.get(at) == Some(&b':') {
                        unclosed_block = unclosed_block.or(Some(open[1]));
                    }
                    open.push(nodes.len());
                    nodes.push(Node { span: Span { start, end: at }, next: 0, is_list: true });
                }
                b')' => {
                    at += 1;
                    let Some(list) = open.pop() else {
                        return Err(PddlError::new(text, Span { start, end: at }, "this `)` closes nothing"));
                    };
                    nodes[list].span.end = at;
                    nodes[list].next = nodes.len();
                }
                byte if byte.is_ascii_whitespace() => at += 1,
                _ => {
                    at += 1 + length_of(at + 1, ends_atom);
                    nodes.push(Node { span: Span { start, end: at }, next: nodes.len() + 1, is_list: false });
                }
            }
        }
        match open.pop() {
            Some(list) => {
                let span = nodes[unclosed_block.unwrap_or(list)].span;
                let start = Span { start: span.start, end: span.start + 1 };
                Err(PddlError::new(text, start, "this `(` is never closed"))
            }
            None => Ok(Self { text, nodes }),
        }
    }

    /// The text that was read.
    pub fn text(&self) -> &'t str {
        self.text
    }

    /// The outermost s-expressions, in order.
    pub fn roots(&self) -> Children<'_> {
        Children { document: self, next: 0, end: self.nodes.len() }
    }

    /// The only s-expression.
    ///
    /// # Errors
    /// [`PddlError`] if there is none, or more than one.
    pub fn only_root(&self) -> Result<Sexpr<'_>, PddlError> {
        let mut roots = self.roots();
        let Some(first) = roots.next() else {
            return Err(PddlError::new(self.text, Span::default(), "there is nothing in this text"));
        };
        match roots.next() {
            None => Ok(first),
            Some(extra) => {
                let Span { start, end } = first.span();
                let last = Span { start: if first.is_list() { end - 1 } else { start }, end };
                let error = extra.error("nothing may follow after the end of the expression");
                Err(error.with_related(self.text, last, "which ends here"))
            }
        }
    }
}

impl<'d> Sexpr<'d> {
    fn node(self) -> Node {
        self.document.nodes[self.index]
    }

    /// Where it stands.
    pub fn span(self) -> Span {
        self.node().span
    }

    /// Its text, parentheses included.
    pub fn text(self) -> &'d str {
        let Span { start, end } = self.span();
        &self.document.text[start..end]
    }

    /// The whole text that it is part of.
    pub fn document_text(self) -> &'d str {
        self.document.text
    }

    /// Its text if it is an atom, in the case in which it is written.
    pub fn atom(self) -> Option<&'d str> {
        (!self.node().is_list).then(|| self.text())
    }

    /// Whether it is a list.
    pub fn is_list(self) -> bool {
        self.node().is_list
    }

    /// Whether it is the atom `word`, in whatever case.
    pub fn is(self, word: &str) -> bool {
        self.atom().is_some_and(|atom| atom.eq_ignore_ascii_case(word))
    }

    /// Its parts; none if it is an atom.
    pub fn children(self) -> Children<'d> {
        Children { document: self.document, next: self.index + 1, end: self.node().next }
    }

    /// The first part of a list, if that is an atom.
    pub fn head(self) -> Option<&'d str> {
        self.children().next()?.atom()
    }

    /// Whether it is a list that begins with the atom `word`, in whatever case.
    pub fn has_head(self, word: &str) -> bool {
        self.head().is_some_and(|head| head.eq_ignore_ascii_case(word))
    }

    /// An error about it.
    pub fn error(self, message: impl Into<String>) -> PddlError {
        PddlError::new(self.document.text, self.span(), message)
    }
}

impl<'d> Iterator for Children<'d> {
    type Item = Sexpr<'d>;

    fn next(&mut self) -> Option<Sexpr<'d>> {
        (self.next < self.end).then(|| {
            let child = Sexpr { document: self.document, index: self.next };
            self.next = child.node().next;
            child
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn message(text: &str) -> String {
        match Document::read(text) {
            Ok(document) => document.only_root().err().map(|e| e.to_string()).unwrap_or_default(),
            Err(error) => error.to_string(),
        }
    }

    /// The text with single spaces, from a walk without recursion.
    fn normal(document: &Document<'_>) -> String {
        let mut out = String::new();
        let mut work = vec![document.roots()];
        while let Some(children) = work.last_mut() {
            match children.next() {
                Some(child) if child.is_list() => {
                    out.push('(');
                    work.push(child.children());
                }
                Some(child) => out.extend([child.text(), " "]),
                None => {
                    work.pop();
                    out.push(')');
                }
            }
        }
        out
    }

    #[test]
    fn tabs_comments_line_ends_and_case() {
        let text = "; first (\r\n(define\t(Domain d) ; more )\r\n (:types aircraft?a))";
        let document = Document::read(text).expect("balanced");
        let root = document.only_root().expect("one");
        let parts: Vec<&str> = root.children().map(Sexpr::text).collect();
        assert_eq!(parts, ["define", "(Domain d)", "(:types aircraft?a)"]);
        assert!(root.has_head("DEFINE"));
        let block = root.children().nth(2).expect("the third");
        assert_eq!(block.children().filter_map(Sexpr::atom).collect::<Vec<_>>(), [":types", "aircraft", "?a"]);
    }

    #[test]
    fn unbalanced_and_trailing_text_is_refused_with_its_place() {
        assert_eq!(message("(a (b)\n  (c"), "line 2, column 3: this `(` is never closed");
        let blocks = "(define (domain d)\n (:predicates (p))\n (:action a :effect (and (p))\n (:action b))";
        assert_eq!(message(blocks), "line 3, column 2: this `(` is never closed");
        assert_eq!(message("(a)\n )"), "line 2, column 2: this `)` closes nothing");
        assert_eq!(message("(a)\n(b)"), "line 2, column 1: nothing may follow after the end of the expression");
        assert_eq!(message(" ; only a comment"), "line 1, column 1: there is nothing in this text");
    }

    #[test]
    fn depth_costs_no_stack() {
        let depth = 100_000;
        let text = format!("{}{}", "(".repeat(depth), ")".repeat(depth));
        let document = Document::read(&text).expect("balanced");
        assert_eq!(normal(&document), format!("{text})"));
        assert_eq!(message(&"(".repeat(depth)), format!("line 1, column {depth}: this `(` is never closed"));
    }

    #[test]
    fn a_large_text_is_read_in_linear_time() {
        let text = format!("({})", "(on b1 b2) ".repeat(500_000));
        assert_eq!(Document::read(&text).expect("balanced").only_root().expect("one").children().count(), 500_000);
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused(text in "\\PC{0,60}|[();? a\\-\n\té]{0,60}") {
            match Document::read(&text) {
                Ok(document) => {
                    let _ = document.only_root();
                    prop_assert_eq!(normal(&document).matches('(').count(), document.nodes.iter().filter(|n| n.is_list).count());
                }
                Err(error) => prop_assert!(!error.render("x", &text).is_empty()),
            }
        }

        #[test]
        fn reading_the_normal_form_again_changes_nothing(text in "(\\([a-c?; \n]{0,5}\\)|[ab]| ){0,12}") {
            if let Ok(document) = Document::read(&text) {
                let once = normal(&document);
                let once = once.strip_suffix(')').expect("the end of the walk").to_owned();
                let again = normal(&Document::read(&once).expect("balanced"));
                prop_assert_eq!(again, format!("{once})"));
            }
        }
    }
}
