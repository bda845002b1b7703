//! How the text puts a condition: what is said where a predicate was invented for it.

use std::rc::Rc;

use typelift_model::{Symbol, Term, Wording};

use crate::Formula;
use crate::formula_text::{free_variables, shortened};

/// The formula of a condition, over the variables of its block.
pub(super) type Said = Option<Rc<Wording>>;

/// How the text puts a condition that is this formula or (not `positive`) its negation.
pub(super) fn said(formula: &Formula, positive: bool, visible: &[(&Symbol, u32)]) -> Said {
    let number = |name: &Symbol| visible.iter().rev().find(|(other, _)| *other == name).map(|(_, number)| *number);
    let variables = free_variables(formula)
        .into_iter()
        .filter_map(|name| Some((name.clone(), Term::Param(number(name)?))))
        .collect();
    Some(Rc::new(Wording { formula: shortened(formula).into(), positive, variables }))
}

/// What is said of a condition, as a predicate with these arguments that holds where the condition does.
pub(super) fn of_predicate(said: &Wording, args: &[u32]) -> Wording {
    let place = |term: &Term| match term {
        Term::Param(variable) => args.iter().position(|arg| arg == variable).map(|place| Term::Param(place as u32)),
        object @ Term::Const(_) => Some(object.clone()),
    };
    let variables = said.variables.iter().filter_map(|(name, term)| Some((name.clone(), place(term)?)));
    Wording { formula: said.formula.clone(), positive: said.positive, variables: variables.collect() }
}
