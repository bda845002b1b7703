//! Reads conditions.

use crate::names::lower;
use crate::scope::Scope;
use crate::{Formula, MOST_NESTED, PddlError, Sexpr};

/// Words of PDDL that no predicate may be named.
pub(crate) const RESERVED: [&str; 12] =
    ["and", "or", "not", "imply", "exists", "forall", "when", "=", "<", ">", "<=", ">="];

/// Words of PDDL that begin a condition of a kind that is not read.
const UNSUPPORTED: [(&str, &str); 16] = [
    ("<", "comparisons of numbers"),
    (">", "comparisons of numbers"),
    ("<=", "comparisons of numbers"),
    (">=", "comparisons of numbers"),
    ("preference", "preferences"),
    ("at", "conditions at a time"),
    ("over", "conditions over a time"),
    ("always", "constraints on the course of a plan"),
    ("sometime", "constraints on the course of a plan"),
    ("within", "constraints on the course of a plan"),
    ("at-most-once", "constraints on the course of a plan"),
    ("sometime-after", "constraints on the course of a plan"),
    ("sometime-before", "constraints on the course of a plan"),
    ("always-within", "constraints on the course of a plan"),
    ("hold-during", "constraints on the course of a plan"),
    ("hold-after", "constraints on the course of a plan"),
];

impl Scope<'_> {
    /// A condition as a whole: as [`formula`](Self::formula), or `()` for what always holds.
    pub(crate) fn condition(&mut self, item: Sexpr<'_>, depth: usize) -> Result<Formula, PddlError> {
        if is_empty(item) { Ok(Formula::truth()) } else { self.formula(item, depth) }
    }

    /// A condition that stands inside `depth` others.
    pub(crate) fn formula(&mut self, item: Sexpr<'_>, depth: usize) -> Result<Formula, PddlError> {
        check_depth(item, depth)?;
        let word = first_word(item, "condition")?;
        match &*lower(word.text()) {
            "and" => Ok(Formula::And(self.formulas(item, depth)?)),
            "or" => Ok(Formula::Or(self.formulas(item, depth)?)),
            "not" => {
                let [negated] = parts(item, "one condition")?;
                Ok(Formula::Not(Box::new(self.formula(negated, depth + 1)?)))
            }
            "imply" => {
                let [premise, conclusion] = parts(item, "two conditions")?;
                let premise = self.formula(premise, depth + 1)?;
                Ok(Formula::Imply(Box::new(premise), Box::new(self.formula(conclusion, depth + 1)?)))
            }
            quantifier @ ("exists" | "forall") => {
                let [variables, body] = parts(item, "a list of variables and one condition")?;
                let variables = self.enter(variables)?;
                let body = Box::new(self.formula(body, depth + 1)?);
                self.leave(variables.len());
                let quantified = if quantifier == "exists" { Formula::Exists } else { Formula::Forall };
                Ok(quantified(variables, body))
            }
            "=" => {
                let [left, right] = parts(item, "two objects")?;
                if left.is_list() || right.is_list() {
                    return Err(item.error("comparisons of numbers are not supported").as_unsupported());
                }
                Ok(Formula::Equal(self.any_term(left)?, self.any_term(right)?))
            }
            other => {
                let unsupported = UNSUPPORTED.iter().find(|(word, _)| *word == other);
                match unsupported.filter(|_| self.vocabulary.predicates.get(other).is_none()) {
                    Some((_, what)) => Err(item.error(format!("{what} are not supported")).as_unsupported()),
                    None => self.atom(item).map(Formula::Atom),
                }
            }
        }
    }

    fn formulas(&mut self, item: Sexpr<'_>, depth: usize) -> Result<Vec<Formula>, PddlError> {
        item.children().skip(1).map(|part| self.formula(part, depth + 1)).collect()
    }
}

/// Whether it is `()`.
pub(crate) fn is_empty(item: Sexpr<'_>) -> bool {
    item.is_list() && item.children().next().is_none()
}

/// # Errors
/// [`PddlError`] if it stands inside too many others.
pub(crate) fn check_depth(item: Sexpr<'_>, depth: usize) -> Result<(), PddlError> {
    if depth < MOST_NESTED {
        return Ok(());
    }
    Err(item.error(format!("nesting deeper than {MOST_NESTED} is not supported")).as_unsupported())
}

/// The word with which a condition or an effect begins.
pub(crate) fn first_word<'d>(item: Sexpr<'d>, kind: &str) -> Result<Sexpr<'d>, PddlError> {
    match item.children().next() {
        Some(word) if !word.is_list() => Ok(word),
        Some(list) => {
            let error = list.error(format!("a {kind} begins with a word, not with a list"));
            Err(error.with_hint("Join several with `(and …)`."))
        }
        None if item.is_list() => {
            Err(item.error(format!("a {kind} is expected in here")).with_hint("Write `(and)` for an empty one."))
        }
        None => {
            let error = item.error(format!("a {kind} is expected here, not `{}`", item.text()));
            Err(error.with_hint("A condition or an effect stands in parentheses."))
        }
    }
}

/// What follows the first word, if it is that many.
pub(crate) fn parts<'d, const N: usize>(item: Sexpr<'d>, what: &str) -> Result<[Sexpr<'d>; N], PddlError> {
    let parts: Vec<Sexpr<'d>> = item.children().skip(1).take(N + 1).collect();
    <[Sexpr<'d>; N]>::try_from(parts)
        .map_err(|_| item.error(format!("`{}` takes {what}", item.head().map(lower).unwrap_or_default())))
}
