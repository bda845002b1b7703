//! Plan files: one `(name object …)` after the other, as the planning competitions have them. With times in front,
//! `0.000: (name object …) [1.000]`, the times give the order; actions of one time are in that of the text, and one without
//! a time follows the one before it. Durations are passed over.

use typelift_model::{Symbol, SymbolPool};

use crate::trajectory::read_atom;
use crate::{Document, PddlError, Sexpr, Span};

/// One action of a plan file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanLine {
    /// The action's name, in lower case.
    pub name: Symbol,
    /// Its objects, in lower case.
    pub args: Vec<Symbol>,
    /// Where it stands.
    pub span: Span,
}

/// Reads a plan file; one without actions is the empty plan.
///
/// # Errors
/// [`PddlError`] at what is no action.
pub fn read_plan(text: &str) -> Result<Vec<PlanLine>, PddlError> {
    let document = Document::read(text)?;
    let mut names = SymbolPool::new();
    let mut lines: Vec<(f64, PlanLine)> = Vec::new();
    // What was read last: a time, or an action.
    let (mut time, mut action): (Option<Sexpr<'_>>, bool) = (None, false);
    for item in document.roots() {
        if item.is_list() {
            let atom = read_atom(item, &mut names)?;
            let stated = time.and_then(|time| read_time(time.text()));
            let at = stated.or(lines.last().map(|(before, _)| *before)).unwrap_or(f64::NEG_INFINITY);
            lines.push((at, PlanLine { name: atom.predicate, args: atom.args, span: item.span() }));
            (time, action) = (None, true);
        } else if time.is_none() && read_time(item.text()).is_some() {
            (time, action) = (Some(item), false);
        } else if action && is_duration(item.text()) {
            action = false;
        } else {
            let error = item.error(format!("an action `(name object …)` is expected here, not `{}`", item.text()));
            return Err(error.with_hint("Each action stands in parentheses."));
        }
    }
    if let Some(time) = time {
        return Err(time.error("there is no action after this time"));
    }
    lines.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    Ok(lines.into_iter().map(|(_, line)| line).collect())
}

/// `3:` or `0.000:`.
fn read_time(text: &str) -> Option<f64> {
    text.strip_suffix(':')?.parse().ok().filter(|time: &f64| time.is_finite())
}

/// `[1]` or `[1.000]`.
fn is_duration(text: &str) -> bool {
    let number = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    number.is_some_and(|number| number.parse::<f64>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<String, String> {
        let show = |line: PlanLine| {
            let words: Vec<&str> = [&line.name].into_iter().chain(&line.args).map(Symbol::as_str).collect();
            format!("{}@{}", words.join(" "), line.span.start)
        };
        let lines = read_plan(text).map_err(|error| error.to_string())?;
        Ok(lines.into_iter().map(show).collect::<Vec<_>>().join(", "))
    }

    #[test]
    fn the_dialects() {
        assert_eq!(read("(PICK a)\n(stack a B) ; why\r\n; cost = 2\n"), Ok("pick a@0, stack a b@9".to_owned()));
        assert_eq!(read("0: (pick a) [1]\n1.5: (noop)[2.0]\n"), Ok("pick a@3, noop@21".to_owned()));
        assert_eq!(read("; nothing to do\n"), Ok(String::new()));
    }

    #[test]
    fn times_give_the_order() {
        assert_eq!(read("2: (c)\n1.0: (b)\n10: (d)\n.5: (a)\n1: (b2)"), Ok("a@28, b@12, b2@35, c@3, d@20".to_owned()));
        assert_eq!(read("(a) 5: (c) (d) 1: (b)"), Ok("a@0, b@18, c@7, d@11".to_owned()));
    }

    #[test]
    fn what_is_no_plan() {
        for (text, message) in [
            ("pick a", "line 1, column 1: an action `(name object …)` is expected here, not `pick`"),
            ("(a)\n0:", "line 2, column 1: there is no action after this time"),
            ("0: 1: (a)", "line 1, column 4: an action `(name object …)` is expected here, not `1:`"),
            ("[1] (a)", "line 1, column 1: an action `(name object …)` is expected here, not `[1]`"),
            ("(a) [1] [2]", "line 1, column 9: an action `(name object …)` is expected here, not `[2]`"),
            ("()", "line 1, column 1: an atom `(name object …)` is expected here"),
            ("(a (b))", "line 1, column 4: a name is expected here, not a list"),
            ("(a ?x)", "line 1, column 4: `?x` cannot be a name: it starts with `?`, which marks a parameter"),
            ("(a", "line 1, column 1: this `(` is never closed"),
        ] {
            assert_eq!(read(text), Err(message.to_owned()), "{text}");
        }
    }
}
