//! Lays out the text of a domain, a problem or any s-expressions anew: indentation and line breaks change, names and
//! comments stay. The layout depends on the words and the comments alone, so that laying out twice changes nothing.
//!
//! What fits in a line stands in a line, but for the blocks and conjunctions that have a line for each part. Nothing
//! recurses, so that depth costs no stack.

use crate::layout_tokens::{List, Token, TokenKind, tokens};
use crate::{Document, PddlError};

/// How wide a line may be.
const WIDTH: usize = 100;
/// How far lines are indented at most.
const MOST_INDENTED: usize = 80;

/// Lays out a text anew. A single empty line between parts is kept; actions have one before them.
///
/// # Errors
/// [`PddlError`] at a parenthesis that has no partner.
pub fn format(text: &str) -> Result<String, PddlError> {
    Document::read(text)?;
    let tokens = tokens(text);
    let mut layout = Layout {
        tokens: &tokens,
        out: String::with_capacity(text.len()),
        column: 0,
        commented: false,
        comment_line: false,
    };
    layout.write();
    Ok(layout.out)
}

/// What a list is, as far as it matters here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// The text as a whole.
    File,
    /// `(define …)`.
    Define,
    /// A block with a line for each part.
    Lines,
    /// `(:action …)`.
    Action,
    /// `(:derived …)` or `(:goal …)`.
    Condition,
    /// `(forall …)` or `(exists …)`.
    Quantifier,
    /// Anything else.
    Other,
}

/// A list of which a part was written.
#[derive(Debug)]
struct Frame {
    kind: Kind,
    /// The token after its last part.
    end: usize,
    /// How far its parts are indented, and how far its end is.
    indent: usize,
    end_indent: usize,
    /// How many parts were written, without comments.
    parts: usize,
    /// The last part and the one before.
    last: [Option<usize>; 2],
    /// Whether it stands on one line.
    flat: bool,
}

struct Layout<'t> {
    tokens: &'t [Token<'t>],
    out: String,
    /// Characters on the line.
    column: usize,
    /// Whether the line ends with a comment.
    commented: bool,
    /// Whether the line is a comment and nothing else.
    comment_line: bool,
}

impl Layout<'_> {
    fn write(&mut self) {
        let mut stack = vec![Frame {
            kind: Kind::File,
            end: self.tokens.len(),
            indent: 0,
            end_indent: 0,
            parts: 0,
            last: [None; 2],
            flat: false,
        }];
        let mut at = 0;
        while let Some(frame) = stack.last_mut() {
            if at >= frame.end {
                if frame.kind != Kind::File {
                    let own_line = frame.kind == Kind::Define;
                    let indent = frame.end_indent;
                    if self.commented || own_line && !frame.flat {
                        self.new_line(indent, false);
                    }
                    self.put(")");
                    at += 1;
                }
                stack.pop();
                continue;
            }
            let token = &self.tokens[at];
            if let TokenKind::Comment { own_line } = token.kind {
                self.comment(token, own_line, frame);
                at += 1;
                continue;
            }
            self.space(at, frame);
            match token.list {
                Some(list) => {
                    let frame = self.open(at, list, frame);
                    stack.push(frame);
                }
                None => self.put(token.text),
            }
            at += 1;
        }
        if !self.out.is_empty() {
            self.out.push('\n');
        }
    }

    fn put(&mut self, text: &str) {
        self.out.push_str(text);
        self.column += text.chars().count();
    }

    fn new_line(&mut self, indent: usize, empty_line: bool) {
        if !self.out.is_empty() {
            self.out.push_str(if empty_line { "\n\n" } else { "\n" });
        }
        self.column = indent.min(MOST_INDENTED);
        self.out.extend(std::iter::repeat_n(' ', self.column));
        (self.commented, self.comment_line) = (false, false);
    }

    fn comment(&mut self, token: &Token<'_>, own_line: bool, frame: &Frame) {
        let begins_line = own_line || self.commented;
        if begins_line {
            let empty_line = self.may_be_empty_before(frame) && token.after_empty_line;
            let action = self.begins_action(token.next, frame) && !self.comment_line;
            self.new_line(frame.indent, empty_line || action);
        } else if !self.out.is_empty() {
            self.put(" ");
        }
        self.put(token.text);
        (self.commented, self.comment_line) = (true, begins_line);
    }

    /// Whether an empty line may stand before what comes next: not at the start of a list.
    fn may_be_empty_before(&self, frame: &Frame) -> bool {
        if frame.kind == Kind::File { !self.out.is_empty() } else { frame.parts > header(frame.kind) }
    }

    /// What separates the token from what was written.
    fn space(&mut self, at: usize, frame: &mut Frame) {
        let token = &self.tokens[at];
        if frame.parts == 0 && frame.kind != Kind::File && !self.commented {
            // It follows the parenthesis.
        } else if !self.commented && (frame.flat || self.stays_on_line(at, frame)) {
            self.put(" ");
        } else {
            let empty_line = self.may_be_empty_before(frame) && token.after_empty_line;
            let action = self.begins_action(Some(at), frame) && !self.comment_line;
            self.new_line(frame.indent, empty_line || action);
        }
        frame.parts += 1;
        frame.last = [Some(at), frame.last[0]];
    }

    /// Whether this begins an action or what is like one, in a definition.
    fn begins_action(&self, at: Option<usize>, frame: &Frame) -> bool {
        let head = at.and_then(|at| self.tokens.get(at)?.list).and_then(|list| self.head(list));
        frame.kind == Kind::Define && head.is_some_and(|head| is_one_of(head, &[":action", ":derived"]))
    }

    fn head(&self, list: List) -> Option<&str> {
        let first = self.tokens.get(list.open + 1)?;
        (first.kind == TokenKind::Atom).then_some(first.text)
    }

    /// Whether a part of a list that has several lines follows on the line of the part before.
    fn stays_on_line(&self, at: usize, frame: &Frame) -> bool {
        let [last, before] = frame.last.map(|part| part.map(|part| &self.tokens[part]));
        let token = &self.tokens[at];
        let is_dash = |part: Option<&Token<'_>>| part.is_some_and(|part| part.text == "-");
        match frame.kind {
            Kind::File => false,
            _ if frame.parts < header(frame.kind) || token.text == "-" || is_dash(last) => true,
            Kind::Action => last.is_some_and(|last| last.text.starts_with(':')) && !token.text.starts_with(':'),
            _ if frame.parts == header(frame.kind) && frame.kind == Kind::Lines => false,
            _ => {
                let both_words = token.list.is_none() && last.is_some_and(|last| last.list.is_none());
                both_words && !is_dash(before) && self.column + 1 + token.text.chars().count() <= WIDTH
            }
        }
    }

    /// Begins a list, and says how its parts are to be written.
    fn open(&mut self, at: usize, list: List, parent: &Frame) -> Frame {
        let head = self.head(list).unwrap_or_default();
        let kind = match parent.kind {
            Kind::File if is_one_of(head, &["define"]) => Kind::Define,
            Kind::Define if is_one_of(head, &[":action"]) => Kind::Action,
            Kind::Define if is_one_of(head, &[":derived", ":goal"]) => Kind::Condition,
            Kind::Define if head.starts_with(':') => Kind::Lines,
            _ if is_one_of(head, &["forall", "exists"]) => Kind::Quantifier,
            _ => Kind::Other,
        };
        let has_parts = list.parts > header(kind);
        let always_broken = match kind {
            Kind::Define | Kind::Action => true,
            Kind::Lines => has_parts && is_one_of(head, &[":types", ":predicates", ":init"]),
            Kind::Condition => has_parts && is_one_of(head, &[":derived"]),
            _ => has_parts && matches!(parent.kind, Kind::Action | Kind::Condition) && is_one_of(head, &["and"]),
        };
        let breaks_inside = kind == Kind::Condition && list.parts == 2 && self.has_conjunction(list);
        let fits = !list.commented && self.column + list.width <= WIDTH;
        let end_indent = self.indent_of_line();
        self.put("(");
        Frame {
            kind,
            end: at + list.length - 1,
            indent: end_indent + 2,
            end_indent,
            parts: 0,
            last: [None; 2],
            flat: fits && !always_broken && !breaks_inside,
        }
    }

    /// Whether the last part is a conjunction with parts of its own.
    fn has_conjunction(&self, list: List) -> bool {
        let last = self.tokens.get(list.open + 2).and_then(|token| token.list);
        last.is_some_and(|last| last.parts > 1 && self.head(last).is_some_and(|head| is_one_of(head, &["and"])))
    }

    fn indent_of_line(&self) -> usize {
        let line = &self.out[self.out.rfind('\n').map_or(0, |at| at + 1)..];
        line.len() - line.trim_start_matches(' ').len()
    }
}

/// How many parts stand on the line with which a list begins.
fn header(kind: Kind) -> usize {
    match kind {
        Kind::File => 0,
        Kind::Define | Kind::Action | Kind::Condition | Kind::Quantifier => 2,
        Kind::Lines | Kind::Other => 1,
    }
}

fn is_one_of(word: &str, words: &[&str]) -> bool {
    words.iter().any(|other| word.eq_ignore_ascii_case(other))
}
