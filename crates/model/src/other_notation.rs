//! What a text may mean that writes a goal in another notation: `not(p(a))`, `(not (p a))`, `!p(a)`, `p(a) and q(b)`,
//! `p(a) is false`, `colour(a) = Red`.
//!
//! It is only ever a guess for a hint, so what is read here is read leniently: parentheses that are missing at the end are
//! added, and commas are white space. Nothing is guessed of a very long text.

use crate::{GroundAtom, Symbol};

/// The bytes of the longest text that is looked at: reading it takes as many calls as it has open parentheses.
const LONGEST: usize = 500;

/// What a text may mean that is not an atom, or `not` and an atom.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OtherNotation {
    /// Atoms, each with whether it must hold.
    Literals(Vec<(GroundAtom, bool)>),
    /// Something that no list of atoms says: this word of logic, or this variable, stands in it.
    BeyondLiterals(String),
}

impl OtherNotation {
    /// What `text` may mean, if that can be guessed. In time linear in its length.
    pub fn of(text: &str) -> Option<Self> {
        if text.len() > LONGEST {
            return None;
        }
        if let Some(literal) = equation(text).or_else(|| attribute_and_value(text)) {
            return Some(Self::Literals(vec![literal]));
        }
        let nodes = read(&mut words(text).into_iter().peekable());
        match formula(&nodes) {
            Ok(literals) if literals.is_empty() => None,
            Ok(literals) => Some(Self::Literals(literals)),
            Err(Unsaid::Beyond(word)) => Some(Self::BeyondLiterals(word)),
            Err(Unsaid::Unclear) => None,
        }
    }

    /// How to write it as a goal.
    pub fn hint(&self) -> String {
        match self {
            Self::Literals(literals) => {
                let written = literals.iter().map(|(atom, positive)| format!("`{}`", atom.as_goal(*positive)));
                let written: Vec<String> = written.collect();
                match written.len() {
                    1 => format!("Write {}.", written.concat()),
                    _ => format!("All that a goal lists must hold: list each on its own, {}.", written.join(", ")),
                }
            }
            Self::BeyondLiterals(word) => format!(
                "A goal is a list of atoms, all of which must hold, and of `not` with an atom; `{word}` can stand in a PDDL \
                 problem, which may be a task as well."
            ),
        }
    }
}

impl GroundAtom {
    /// How a goal writes that this must hold, or must not.
    pub fn as_goal(&self, positive: bool) -> String {
        if positive { self.to_string() } else { format!("not {self}") }
    }
}

/// `p(a) is false`, `p(a) = true`, and what an attribute is, `colour(a) = Red`, of which a snapshot makes `colour_Red(a)`.
fn equation(text: &str) -> Option<(GroundAtom, bool)> {
    let (said, value) = [" is ", "==", "!=", "="].iter().find_map(|sign| {
        let (said, value) = text.split_once(sign)?;
        Some(((said, *sign != "!="), value.trim()))
    })?;
    let (said, is_equal) = said;
    let literals = formula(&read(&mut words(said).into_iter().peekable())).ok()?;
    let [(atom, positive)] = literals.as_slice() else { return None };
    let positive = *positive == is_equal;
    match value.to_ascii_lowercase().as_str() {
        "true" => Some((atom.clone(), positive)),
        "false" => Some((atom.clone(), !positive)),
        _ if !is_plain(value) => None,
        _ => {
            let predicate = Symbol::from(format!("{}_{value}", atom.predicate));
            Some((GroundAtom { predicate, args: atom.args.clone() }, positive))
        }
    }
}

/// An attribute and its value side by side: `form Cut(a)`, of which a snapshot makes `form_Cut(a)`.
fn attribute_and_value(text: &str) -> Option<(GroundAtom, bool)> {
    let (names, arguments) = text.trim().split_once('(')?;
    let names: Vec<&str> = names.split_whitespace().collect();
    let [attribute, value] = names[..] else { return None };
    let is_logic = |name: &str| {
        let node = Node::Name(name);
        is_not(name) || is_and(&node) || beyond(&node).is_some()
    };
    if is_logic(attribute) || is_logic(value) || !is_plain(attribute) || !is_plain(value) {
        return None;
    }
    GroundAtom::parse(&format!("{attribute}_{value}({arguments}")).ok().map(|atom| (atom, true))
}

/// Whether a word is a name, or a part of one.
fn is_plain(word: &str) -> bool {
    !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "_-.".contains(c))
}

/// A part of the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Word<'t> {
    Name(&'t str),
    /// A name with `(` right behind it, which is passed over.
    Head(&'t str),
    Not,
    Open,
    Close,
}

/// The text cut into words.
fn words(text: &str) -> Vec<Word<'_>> {
    let mut words = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '(' | ')' | ',' | '!' | '~' | '¬' => first.len_utf8(),
            '-' if rest[1..].starts_with(|c: char| c.is_alphabetic() || c == '(') => 1,
            _ => rest.find(|c: char| c.is_whitespace() || "(),".contains(c)).unwrap_or(rest.len()),
        };
        let (word, behind) = rest.split_at(length);
        let has_arguments = behind.starts_with('(');
        words.extend(match word {
            "(" => Some(Word::Open),
            ")" => Some(Word::Close),
            "," => None,
            "!" | "~" | "¬" | "-" => Some(Word::Not),
            name if has_arguments => Some(Word::Head(name)),
            name => Some(Word::Name(name)),
        });
        let is_head = matches!(words.last(), Some(Word::Head(_))) && has_arguments;
        rest = if is_head { &behind[1..] } else { behind }.trim_start();
    }
    words
}

/// A text as a tree.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Node<'t> {
    Name(&'t str),
    /// `name(…)`
    Applied(&'t str, Vec<Node<'t>>),
    /// `(…)`
    Group(Vec<Node<'t>>),
    /// `!…`
    Not(Vec<Node<'t>>),
}

/// Reads up to a `)` or the end.
fn read<'t>(words: &mut std::iter::Peekable<impl Iterator<Item = Word<'t>>>) -> Vec<Node<'t>> {
    let mut nodes = Vec::new();
    while let Some(word) = words.next() {
        if word == Word::Close {
            break;
        }
        let mut negations = 0;
        let mut word = word;
        while word == Word::Not {
            negations += 1;
            word = match words.next_if(|next| *next != Word::Close) {
                Some(next) => next,
                None => return nodes,
            };
        }
        let mut node = match word {
            Word::Name(name) => Node::Name(name),
            Word::Head(name) => Node::Applied(name, read(words)),
            Word::Open => Node::Group(read(words)),
            Word::Not | Word::Close => return nodes,
        };
        for _ in 0..negations {
            node = Node::Not(vec![node]);
        }
        nodes.push(node);
    }
    nodes
}

/// Why a formula is no list of literals.
enum Unsaid {
    /// This stands in it.
    Beyond(String),
    /// It is not understood.
    Unclear,
}

type Literals = Vec<(GroundAtom, bool)>;

/// What words say that stand beside each other.
fn formula(nodes: &[Node<'_>]) -> Result<Literals, Unsaid> {
    if let Some(word) = nodes.iter().find_map(beyond) {
        return Err(Unsaid::Beyond(word.to_owned()));
    }
    let parts: Vec<&[Node<'_>]> = nodes.split(is_and).filter(|part| !part.is_empty()).collect();
    match parts[..] {
        [] => Err(Unsaid::Unclear),
        [part] if part.len() == nodes.len() => without_and(part),
        // With `and` in front, each part is a formula of its own.
        [part] if is_and(&nodes[0]) => joined(items(part)),
        ref parts => joined(parts.iter().copied()),
    }
}

fn joined<'n, 't: 'n>(parts: impl IntoIterator<Item = &'n [Node<'t>]>) -> Result<Literals, Unsaid> {
    let literals: Result<Vec<Literals>, Unsaid> = parts.into_iter().map(formula).collect();
    Ok(literals?.concat())
}

/// Whether these are what one `not` is about: one thing, or names alone.
fn is_one(nodes: &[Node<'_>]) -> bool {
    items(nodes).len() == 1 || nodes.iter().all(|node| matches!(node, Node::Name(_)))
}

/// What stands in a list, each with the `not` before it.
fn items<'n, 't>(nodes: &'n [Node<'t>]) -> Vec<&'n [Node<'t>]> {
    nodes.split_inclusive(|node| !matches!(node, Node::Name(name) if is_not(name))).collect()
}

fn without_and(nodes: &[Node<'_>]) -> Result<Literals, Unsaid> {
    match nodes {
        [Node::Group(inner)] => formula(inner),
        [Node::Not(inner)] => negated(inner),
        [Node::Applied(name, inner)] => {
            let mut words = vec![Node::Name(name)];
            words.extend(inner.iter().cloned());
            match is_not(name) || is_and(&words[0]) {
                true => formula(&words),
                false => atom(name, inner),
            }
        }
        [Node::Name(name), rest @ ..] if is_not(name) && !rest.is_empty() && is_one(rest) => negated(rest),
        [Node::Name(name), Node::Group(arguments)] => atom(name, arguments),
        [Node::Name(name), arguments @ ..] if arguments.iter().all(|node| matches!(node, Node::Name(_))) => {
            atom(name, arguments)
        }
        _ if items(nodes).len() > 1 => joined(items(nodes)),
        _ => Err(Unsaid::Unclear),
    }
}

/// That what words say does not hold: of one literal only, since of several not all need be false.
fn negated(nodes: &[Node<'_>]) -> Result<Literals, Unsaid> {
    match formula(nodes)?.as_slice() {
        [(atom, positive)] => Ok(vec![(atom.clone(), !positive)]),
        _ => Err(Unsaid::Unclear),
    }
}

fn atom(predicate: &str, arguments: &[Node<'_>]) -> Result<Literals, Unsaid> {
    let arguments: Vec<&str> = arguments.iter().map(name).collect::<Result<_, _>>()?;
    let atom = GroundAtom::parse(&format!("{predicate}({})", arguments.join(",")));
    atom.map(|atom| vec![(atom, true)]).map_err(|_| Unsaid::Unclear)
}

/// The name of an argument.
fn name<'t>(node: &Node<'t>) -> Result<&'t str, Unsaid> {
    match node {
        Node::Name(name) if name.starts_with('?') => Err(Unsaid::Beyond((*name).to_owned())),
        Node::Name(name) => Ok(name),
        _ => Err(Unsaid::Unclear),
    }
}

fn is_not(name: &str) -> bool {
    name.eq_ignore_ascii_case("not")
}

fn is_and(node: &Node<'_>) -> bool {
    matches!(node, Node::Name(name) if name.eq_ignore_ascii_case("and") || ["&", "&&", "∧"].contains(name))
}

/// The word of logic that a node is, or is applied, and that no list of literals knows.
fn beyond<'t>(node: &Node<'t>) -> Option<&'t str> {
    let (Node::Name(name) | Node::Applied(name, _)) = node else { return None };
    let known = ["or", "|", "||", "∨", "imply", "implies", "->", "=>", "forall", "exists", "when"];
    known.iter().any(|word| name.eq_ignore_ascii_case(word)).then_some(*name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn how_others_write_it() {
        let meant = |text: &str| match OtherNotation::of(text) {
            Some(OtherNotation::Literals(literals)) => {
                literals.iter().map(|(atom, positive)| atom.as_goal(*positive)).collect::<Vec<_>>().join("; ")
            }
            Some(OtherNotation::BeyondLiterals(word)) => format!("beyond: {word}"),
            None => "unclear".to_owned(),
        };
        for (text, expected) in [
            ("not(on(a,b))", "not on(a,b)"),
            ("not (on(a,b))", "not on(a,b)"),
            ("Not on(a,b)", "not on(a,b)"),
            ("(not (on a b))", "not on(a,b)"),
            ("not (on a b)", "not on(a,b)"),
            ("!on(a,b)", "not on(a,b)"),
            ("~ on(a, b)", "not on(a,b)"),
            ("not !on(a)", "on(a)"),
            ("-on(a,b)", "not on(a,b)"),
            ("on(a,b) is false", "not on(a,b)"),
            ("on(a,b)=False", "not on(a,b)"),
            ("not on(a,b) == false", "on(a,b)"),
            ("(on a b) = true", "on(a,b)"),
            ("colour(a)=Red", "colour_Red(a)"),
            ("colour(a) != Red", "not colour_Red(a)"),
            ("not colour(a) is Red", "not colour_Red(a)"),
            ("colour Red(a)", "colour_Red(a)"),
            ("on(a) -> on(b)", "beyond: ->"),
            ("on(a) => on(b)", "beyond: =>"),
            ("!(on a b)", "not on(a,b)"),
            ("(on a b)", "on(a,b)"),
            ("on a b", "on(a,b)"),
            ("on(a, b", "on(a,b)"),
            ("on(a b)", "on(a,b)"),
            ("not on(a,b", "not on(a,b)"),
            ("on(a,b))", "on(a,b)"),
            ("and(on(a,b), dark)", "on(a,b); dark()"),
            ("(and (on a b) (not (lit c)))", "on(a,b); not lit(c)"),
            ("on(a,b) and not lit(c)", "on(a,b); not lit(c)"),
            ("and(on(a,b), not lit(c), dark)", "on(a,b); not lit(c); dark()"),
            ("not lit(c), on(a,b)", "not lit(c); on(a,b)"),
            ("not on a b", "not on(a,b)"),
            ("on(a,b) & lit(c) & lit(d)", "on(a,b); lit(c); lit(d)"),
            ("on(a,b), lit(c)", "on(a,b); lit(c)"),
            ("or(on(a,b), on(a,c))", "beyond: or"),
            ("(or (on a b) (on a c))", "beyond: or"),
            ("on(a,b) OR on(a,c)", "beyond: OR"),
            ("(exists (?x) (on a ?x))", "beyond: exists"),
            ("lit(?x)", "beyond: ?x"),
            ("not (and (on a b) (lit c))", "unclear"),
            ("(((", "unclear"),
            ("!", "unclear"),
            ("not", "not()"),
            ("", "unclear"),
            (&"(".repeat(1_000_000), "unclear"),
        ] {
            assert_eq!(meant(text), expected, "{text:.80}");
        }
    }
}
