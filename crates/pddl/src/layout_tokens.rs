//! The words, parentheses and comments of a text, as laying it out needs them.

/// A parenthesis, a word or a comment.
#[derive(Debug)]
pub(crate) struct Token<'t> {
    pub(crate) kind: TokenKind,
    pub(crate) text: &'t str,
    /// Whether an empty line stands before it.
    pub(crate) after_empty_line: bool,
    /// Of an opening parenthesis, its list.
    pub(crate) list: Option<List>,
    /// Of a comment, the token after it and the comments that follow it.
    pub(crate) next: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TokenKind {
    Open,
    Close,
    Atom,
    /// `own_line` if nothing stands before it in its line.
    Comment {
        own_line: bool,
    },
}

/// A list between two parentheses.
#[derive(Debug, Clone, Copy)]
pub(crate) struct List {
    /// The opening parenthesis.
    pub(crate) open: usize,
    /// How many tokens it has, its parentheses included.
    pub(crate) length: usize,
    /// How many parts, without comments.
    pub(crate) parts: usize,
    /// How many characters, on one line.
    pub(crate) width: usize,
    /// Whether there are comments in it.
    pub(crate) commented: bool,
}

/// The tokens of a text whose parentheses are balanced.
pub(crate) fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let mut rest = text;
    // Line ends since the last token; before the first, as if there was one.
    let mut line_ends = 1;
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '\n' => {
                line_ends += 1;
                1
            }
            _ if first.is_ascii_whitespace() => 1,
            ';' => rest.find('\n').unwrap_or(rest.len()),
            '(' | ')' => 1,
            _ => {
                let ends = |c: char| c.is_ascii_whitespace() || matches!(c, '(' | ')' | ';' | '?');
                let begin = first.len_utf8();
                rest[begin..].find(ends).map_or(rest.len(), |end| begin + end)
            }
        };
        let (token, after) = rest.split_at(length);
        rest = after;
        if first.is_ascii_whitespace() {
            continue;
        }
        let kind = match first {
            ';' => TokenKind::Comment { own_line: line_ends > 0 },
            '(' => TokenKind::Open,
            ')' => TokenKind::Close,
            _ => TokenKind::Atom,
        };
        let after_empty_line = line_ends > 1 && !tokens.is_empty();
        // Only white space of ASCII separates words.
        let text = if kind == TokenKind::Atom { token } else { token.trim_end() };
        tokens.push(Token { kind, text, after_empty_line, list: None, next: None });
        line_ends = 0;
    }
    find_lists(&mut tokens);
    find_next(&mut tokens);
    tokens
}

fn find_lists(tokens: &mut [Token<'_>]) {
    let mut open: Vec<List> = Vec::new();
    for at in 0..tokens.len() {
        let width = tokens[at].text.chars().count();
        match tokens[at].kind {
            TokenKind::Open => open.push(List { open: at, length: 0, parts: 0, width: 2, commented: false }),
            TokenKind::Close => {
                let Some(mut list) = open.pop() else { continue };
                list.length = at + 1 - list.open;
                tokens[list.open].list = Some(list);
                if let Some(parent) = open.last_mut() {
                    parent.commented |= list.commented;
                    parent.width += list.width + usize::from(parent.parts > 0);
                    parent.parts += 1;
                }
            }
            TokenKind::Atom => {
                if let Some(parent) = open.last_mut() {
                    parent.width += width + usize::from(parent.parts > 0);
                    parent.parts += 1;
                }
            }
            TokenKind::Comment { .. } => {
                if let Some(parent) = open.last_mut() {
                    parent.commented = true;
                }
            }
        }
    }
}

fn find_next(tokens: &mut [Token<'_>]) {
    let mut next = None;
    for at in (0..tokens.len()).rev() {
        if let TokenKind::Comment { .. } = tokens[at].kind {
            tokens[at].next = next;
        } else {
            next = Some(at);
        }
    }
}
