//! Damaged texts: a valid one after some edits.

/// One edit: which, where, and with what.
pub type Edit = (u8, u16, u16);

/// What is put in: what separates words, ends texts early, is very large, or no longer a letter.
const PIECES: [&str; 40] = [
    "(",
    ")",
    "()",
    "{",
    "}",
    "[",
    "]",
    "\"",
    ":",
    ",",
    ";",
    "?",
    "-",
    "=",
    ".",
    "?x",
    "- -",
    "(either a)",
    "(and)",
    "(not (not",
    "and",
    "or",
    "object",
    "number",
    "total-cost",
    "99999999999999999999",
    "4294967296",
    "-1",
    "1e999",
    "0.1",
    "null",
    "true",
    "\0",
    "\r",
    "\u{FEFF}",
    "\u{A0}",
    "\u{85}",
    "é",
    "\u{1F375}",
    "\n---\n",
];

/// The text after the edits, as bytes: the last edits may break its characters.
pub fn mutated(text: &str, edits: &[Edit]) -> Vec<u8> {
    let mut words: Vec<String> = words(text);
    let mut broken: Vec<(u16, u16)> = Vec::new();
    for &(kind, at, with) in edits {
        if words.is_empty() {
            break;
        }
        let (a, b) = (usize::from(at) % words.len(), usize::from(with) % words.len());
        match kind % 14 {
            0 => drop(words.remove(a)),
            1 => words.insert(a, words[a].clone()),
            2 => words.swap(a, b),
            3 => words[a] = words[b].clone(),
            4 | 5 => words.insert(a, PIECES[usize::from(with) % PIECES.len()].to_owned()),
            6 => words[a] = PIECES[usize::from(with) % PIECES.len()].to_owned(),
            7 => words.truncate(a),
            8 => words[a] = flipped(&words[a]),
            9 => {
                let (old, new) = (words[a].clone(), words[b].clone());
                words.iter_mut().filter(|word| **word == old).for_each(|word| word.clone_from(&new));
            }
            10 => drop(words.drain(group(&words, a))),
            11 => {
                let copy = words[group(&words, a)].to_vec();
                words.splice(b..b, copy);
            }
            12 => {
                let copy = words[group(&words, b)].to_vec();
                words.splice(group(&words, a), copy);
            }
            _ => broken.push((at, with)),
        }
    }
    let mut bytes = words.concat().into_bytes();
    for (at, with) in broken {
        let end = bytes.len();
        match bytes.get_mut(usize::from(at) % end.max(1)) {
            Some(byte) if with < 256 => *byte = with as u8,
            Some(byte) => *byte ^= 1 << (with % 8),
            None => bytes.push(with as u8),
        }
    }
    bytes
}

/// Words, single signs, and the space between.
fn words(text: &str) -> Vec<String> {
    let kind = |c: char| match c {
        _ if c.is_alphanumeric() || matches!(c, '_' | '-') => 0,
        _ if c.is_whitespace() => 1,
        _ => 2,
    };
    let mut words: Vec<String> = Vec::new();
    let mut last = 2;
    for c in text.chars() {
        match words.last_mut() {
            Some(word) if kind(c) == last && last != 2 => word.push(c),
            _ => words.push(c.to_string()),
        }
        last = kind(c);
    }
    words
}

/// The word at `at`; from a parenthesis of any kind on, up to its partner.
fn group(words: &[String], at: usize) -> std::ops::Range<usize> {
    let mut depth = 0_usize;
    for (i, word) in words.iter().enumerate().skip(at) {
        match word.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return at..i + 1;
        }
    }
    at..words.len()
}

fn flipped(word: &str) -> String {
    word.chars().map(|c| if c.is_ascii_lowercase() { c.to_ascii_uppercase() } else { c.to_ascii_lowercase() }).collect()
}
