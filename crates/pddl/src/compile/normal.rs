//! Formulas in negation normal form: negation stands before atoms only.

use typelift_model::{Atom, EQUALS, Literal, Symbol, Term};

/// A formula in negation normal form. Its parameters are variables of a [`Block`](super::block::Block).
///
/// The constructors keep it simple: no truth or falsity inside of anything but a quantifier, no conjunction directly in
/// a conjunction, no disjunction directly in a disjunction, no quantifier without variables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Normal {
    /// An atom, an equality, or the negation of one.
    Literal(Literal),
    /// A conjunction; true without parts.
    And(Vec<Normal>),
    /// A disjunction; false without parts.
    Or(Vec<Normal>),
    /// For some choice of objects for these variables.
    Exists(Vec<u32>, Box<Normal>),
    /// For every choice of objects for these variables.
    Forall(Vec<u32>, Box<Normal>),
}

impl Normal {
    /// What always holds, or what never does.
    pub(super) fn constant(truth: bool) -> Self {
        if truth { Self::And(Vec::new()) } else { Self::Or(Vec::new()) }
    }

    /// Whether it is true or false by its form alone.
    pub(super) fn decided(&self) -> Option<bool> {
        match self {
            Self::And(parts) if parts.is_empty() => Some(true),
            Self::Or(parts) if parts.is_empty() => Some(false),
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
                Self::Or(inner) if !all => flat.extend(inner),
                part => flat.push(part),
            }
        }
        match flat.pop() {
            Some(only) if flat.is_empty() => only,
            last => {
                flat.extend(last);
                if all { Self::And(flat) } else { Self::Or(flat) }
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
            Self::Forall(inner, body) if all => {
                variables.extend(inner);
                Self::Forall(variables, body)
            }
            Self::Exists(inner, body) if !all => {
                variables.extend(inner);
                Self::Exists(variables, body)
            }
            body if all => Self::Forall(variables, Box::new(body)),
            body => Self::Exists(variables, Box::new(body)),
        }
    }

    /// Its negation.
    pub(super) fn negated(&self) -> Self {
        match self {
            Self::Literal(literal) => Self::Literal(negated(literal)),
            Self::And(parts) => Self::Or(parts.iter().map(Self::negated).collect()),
            Self::Or(parts) => Self::And(parts.iter().map(Self::negated).collect()),
            Self::Exists(variables, body) => Self::Forall(variables.clone(), Box::new(body.negated())),
            Self::Forall(variables, body) => Self::Exists(variables.clone(), Box::new(body.negated())),
        }
    }
}

/// The equality of two terms or its negation, written in one way only.
pub(super) fn equality(a: Term, b: Term, positive: bool) -> Literal {
    let args = if a <= b { vec![a, b] } else { vec![b, a] };
    Literal { atom: Atom { predicate: Symbol::new(EQUALS), args }, positive }
}

/// The opposite of a literal.
pub(super) fn negated(literal: &Literal) -> Literal {
    Literal { atom: literal.atom.clone(), positive: !literal.positive }
}
