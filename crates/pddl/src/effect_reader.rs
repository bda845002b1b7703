//! Reads the effects of actions.

use crate::formula_reader::{check_depth, first_word, is_empty, parts};
use crate::names::lower;
use crate::scope::Scope;
use crate::{Amount, PddlAtom, PddlEffect, PddlError, Sexpr, Span};

/// Words of PDDL that begin an effect of a kind that is not read.
const UNSUPPORTED: [(&str, &str); 7] = [
    ("decrease", "changes of numbers other than `(increase (total-cost) …)`"),
    ("assign", "changes of numbers other than `(increase (total-cost) …)`"),
    ("scale-up", "changes of numbers other than `(increase (total-cost) …)`"),
    ("scale-down", "changes of numbers other than `(increase (total-cost) …)`"),
    ("probabilistic", "effects that happen with some probability"),
    ("oneof", "effects of which one happens"),
    ("at", "effects at a time"),
];

/// Reads one effect.
#[derive(Debug)]
pub(crate) struct EffectReader<'s, 'v> {
    scope: &'s mut Scope<'v>,
    /// Where the cost is increased.
    increase: Option<Span>,
}

impl<'s, 'v> EffectReader<'s, 'v> {
    pub(crate) fn new(scope: &'s mut Scope<'v>) -> Self {
        Self { scope, increase: None }
    }

    /// The effect of an action; `()` if there is none.
    pub(crate) fn read(mut self, item: Sexpr<'_>) -> Result<PddlEffect, PddlError> {
        if is_empty(item) { Ok(PddlEffect::And(Vec::new())) } else { self.effect(item, 0, false) }
    }

    /// An effect that stands inside `depth` others; `conditional` if a `forall` or a `when` is among them.
    fn effect(&mut self, item: Sexpr<'_>, depth: usize, conditional: bool) -> Result<PddlEffect, PddlError> {
        check_depth(item, depth)?;
        let word = first_word(item, "effect")?;
        match &*lower(word.text()) {
            "and" => {
                let effects = item.children().skip(1).map(|part| self.effect(part, depth + 1, conditional));
                Ok(PddlEffect::And(effects.collect::<Result<_, _>>()?))
            }
            "not" => {
                let [atom] = parts(item, "one atom")?;
                Ok(PddlEffect::Delete(self.changed_atom(atom)?))
            }
            "forall" => {
                let [variables, effect] = parts(item, "a list of variables and one effect")?;
                let variables = self.scope.enter(variables)?;
                let effect = Box::new(self.effect(effect, depth + 1, true)?);
                self.scope.leave(variables.len());
                Ok(PddlEffect::Forall(variables, effect))
            }
            "when" => {
                let [condition, effect] = parts(item, "a condition and one effect")?;
                let condition = self.scope.condition(condition, depth + 1)?;
                Ok(PddlEffect::When(condition, Box::new(self.effect(effect, depth + 1, true)?)))
            }
            "increase" => self.increase(item, conditional),
            _ => Ok(PddlEffect::Add(self.changed_atom(item)?)),
        }
    }

    fn changed_atom(&self, item: Sexpr<'_>) -> Result<PddlAtom, PddlError> {
        let word = first_word(item, "effect")?;
        let name = lower(word.text());
        let vocabulary = self.scope.vocabulary;
        if vocabulary.predicates.get(&name).is_none() {
            if let Some((_, what)) = UNSUPPORTED.iter().find(|(word, _)| *word == name) {
                return Err(item.error(format!("{what} are not supported")).as_unsupported());
            }
            if matches!(&*name, "or" | "exists" | "imply" | "=" | "and" | "not" | "when" | "forall") {
                return Err(item.error(format!("`{name}` cannot be an effect here")));
            }
        }
        if vocabulary.derived.contains(&*name) {
            let error = word.error(format!("`{name}` is a derived predicate, no action changes it"));
            return Err(error.with_hint("Change what it is derived from."));
        }
        self.scope.atom(item)
    }

    fn increase(&mut self, item: Sexpr<'_>, conditional: bool) -> Result<PddlEffect, PddlError> {
        let [cost, amount] = parts(item, "`(total-cost)` and an amount")?;
        let text = item.document_text();
        if !is_total_cost(cost) {
            let error = item.error("changes of numbers other than `(increase (total-cost) …)` are not supported");
            return Err(error.as_unsupported());
        }
        if conditional {
            let error = item.error("costs that depend on a condition are not supported").as_unsupported();
            return Err(error.with_hint("Move it out of the `when` or the `forall`."));
        }
        if let Some(first) = self.increase.replace(item.span()) {
            let error = item.error("a second increase of the total cost is not supported").as_unsupported();
            return Err(error.with_related(text, first, "the first is here"));
        }
        if !amount.is_list() {
            let is_function = self.scope.vocabulary.functions.get(amount.text()).is_some();
            return Ok(PddlEffect::Increase(if is_function {
                Amount::Function(self.cost_function(amount)?)
            } else {
                Amount::Number(read_number(amount)?)
            }));
        }
        Ok(PddlEffect::Increase(Amount::Function(self.cost_function(amount)?)))
    }

    fn cost_function(&self, item: Sexpr<'_>) -> Result<PddlAtom, PddlError> {
        if let Some(word @ ("+" | "-" | "*" | "/")) = item.head() {
            return Err(item.error(format!("arithmetic with `{word}` is not supported")).as_unsupported());
        }
        let function = self.scope.function(item)?;
        if function.predicate == "total-cost" {
            return Err(item.error("the total cost cannot increase by itself").as_unsupported());
        }
        Ok(function)
    }
}

fn is_total_cost(item: Sexpr<'_>) -> bool {
    item.has_head("total-cost") && item.children().count() == 1
}

/// A whole number that is not negative.
///
/// # Errors
/// [`PddlError`] if it is another number, or none.
pub(crate) fn read_number(item: Sexpr<'_>) -> Result<u32, PddlError> {
    let Some(digits) = item.atom() else {
        return Err(item.error("a number is expected here, not a list"));
    };
    // `10.0` is a whole number too.
    let is_zero = |fraction: &str| !fraction.is_empty() && fraction.bytes().all(|byte| byte == b'0');
    let whole = digits.split_once('.').filter(|(_, fraction)| is_zero(fraction)).map_or(digits, |(whole, _)| whole);
    if !whole.is_empty() && whole.bytes().all(|byte| byte.is_ascii_digit()) {
        return whole
            .parse()
            .map_err(|_| item.error(format!("numbers above {} are not supported", u32::MAX)).as_unsupported());
    }
    Err(match digits.parse::<f64>() {
        Ok(number) if number < 0.0 => item.error("negative numbers are not supported").as_unsupported(),
        Ok(_) => item.error("numbers that are not whole are not supported").as_unsupported(),
        Err(_) => item.error(format!("a number is expected here, not `{digits}`")),
    })
}
