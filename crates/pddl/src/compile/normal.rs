//! Formulas in negation normal form: negation stands before atoms only.

use std::rc::Rc;

use typelift_model::{Atom, EQUALS, Literal, Symbol, Term, Wording};

use super::said::Said;

/// A formula in negation normal form. Its parameters are variables of a [`Block`](super::block::Block).
///
/// The constructors keep it simple: no truth or falsity inside of anything but a quantifier, no conjunction directly in
/// a conjunction, no disjunction directly in a disjunction, no quantifier without variables. What predicates may be
/// invented for knows how the text puts it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Normal {
    /// An atom, an equality, or the negation of one.
    Literal(Literal),
    /// A conjunction; true without parts.
    And(Vec<Normal>),
    /// A disjunction; false without parts.
    Or(Vec<Normal>, Said),
    /// For some choice of objects for these variables.
    Exists(Vec<u32>, Box<Normal>, Said),
    /// For every choice of objects for these variables.
    Forall(Vec<u32>, Box<Normal>, Said),
}

impl Normal {
    /// What always holds, or what never does.
    pub(super) fn constant(truth: bool) -> Self {
        if truth { Self::And(Vec::new()) } else { Self::Or(Vec::new(), None) }
    }

    /// Whether it is true or false by its form alone.
    pub(super) fn decided(&self) -> Option<bool> {
        match self {
            Self::And(parts) if parts.is_empty() => Some(true),
            Self::Or(parts, _) if parts.is_empty() => Some(false),
            _ => None,
        }
    }

    /// That two terms stand for the same object, or do not.
    pub(super) fn equality(a: Term, b: Term, positive: bool) -> Self {
        match (&a, &b) {
            _ if a == b => Self::constant(positive),
            (Term::Const(_), Term::Const(_)) => Self::constant(!positive),
            _ => Self::Literal(equality(a, b, positive)),
        }
    }

    /// The conjunction (`all`) or the disjunction of these.
    pub(super) fn junction(all: bool, parts: impl IntoIterator<Item = Self>) -> Self {
        let mut flat = Vec::new();
        for part in parts {
            match part {
                part if part.decided() == Some(all) => {}
                part if part.decided() == Some(!all) => return Self::constant(!all),
                Self::And(inner) if all => flat.extend(inner),
                Self::Or(inner, _) if !all => flat.extend(inner),
                part => flat.push(part),
            }
        }
        match flat.pop() {
            Some(only) if flat.is_empty() => only,
            last => {
                flat.extend(last);
                if all { Self::And(flat) } else { Self::Or(flat, None) }
            }
        }
    }

    /// The universal (`all`) or existential quantification over these variables. Over no object at all, what is false
    /// holds for every one: so only one of truth and falsity passes through.
    pub(super) fn quantified(all: bool, mut variables: Vec<u32>, body: Self) -> Self {
        if variables.is_empty() || body.decided() == Some(all) {
            return body;
        }
        match body {
            Self::Forall(inner, body, _) if all => {
                variables.extend(inner);
                Self::Forall(variables, body, None)
            }
            Self::Exists(inner, body, _) if !all => {
                variables.extend(inner);
                Self::Exists(variables, body, None)
            }
            body if all => Self::Forall(variables, Box::new(body), None),
            body => Self::Exists(variables, Box::new(body), None),
        }
    }

    /// Its negation.
    pub(super) fn negated(&self) -> Self {
        match self {
            Self::Literal(literal) => Self::Literal(negated(literal)),
            Self::And(parts) => Self::Or(parts.iter().map(Self::negated).collect(), None),
            Self::Or(parts, _) => Self::And(parts.iter().map(Self::negated).collect()),
            Self::Exists(variables, body, said) => {
                Self::Forall(variables.clone(), Box::new(body.negated()), opposite(said))
            }
            Self::Forall(variables, body, said) => {
                Self::Exists(variables.clone(), Box::new(body.negated()), opposite(said))
            }
        }
    }

    /// The same, which the text puts like this.
    pub(super) fn said_as(mut self, new: impl FnOnce() -> Said) -> Self {
        if let Self::Or(_, said) | Self::Exists(_, _, said) | Self::Forall(_, _, said) = &mut self {
            *said = new();
        }
        self
    }

    /// How the text puts it; literals and conjunctions of them need no other words.
    pub(super) fn said(&self) -> Option<&Wording> {
        match self {
            Self::Or(_, said) | Self::Exists(_, _, said) | Self::Forall(_, _, said) => said.as_deref(),
            Self::Literal(_) | Self::And(_) => None,
        }
    }
}

/// The equality of two terms or its negation, written in one way only.
pub(super) fn equality(a: Term, b: Term, positive: bool) -> Literal {
    let args = if a <= b { vec![a, b] } else { vec![b, a] };
    Literal { atom: Atom { predicate: Symbol::new(EQUALS), args }, positive }
}

/// How the text puts the opposite.
fn opposite(said: &Said) -> Said {
    let said = said.as_deref()?;
    Some(Rc::new(Wording { positive: !said.positive, ..said.clone() }))
}

/// The opposite of a literal.
pub(super) fn negated(literal: &Literal) -> Literal {
    Literal { atom: literal.atom.clone(), positive: !literal.positive }
}
