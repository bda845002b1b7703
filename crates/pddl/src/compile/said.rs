//! How the text puts a condition: what is said where a predicate was invented for it.

use std::collections::BTreeSet;
use std::fmt::{self, Write};
use std::rc::Rc;

use typelift_model::{Symbol, Term, Wording};

use crate::{Formula, PddlTerm, Typed};

/// The formula of a condition, over the variables of its block.
pub(super) type Said = Option<Rc<Wording>>;

/// After so many characters a formula is cut off.
const LONGEST: usize = 200;

/// How the text puts a condition that is this formula or (not `positive`) its negation.
pub(super) fn said(formula: &Formula, positive: bool, visible: &[(&Symbol, u32)]) -> Said {
    let mut free = BTreeSet::new();
    add_free(formula, &mut Vec::new(), &mut free);
    let number = |name: &Symbol| visible.iter().rev().find(|(other, _)| *other == name).map(|(_, number)| *number);
    let variables = free.into_iter().filter_map(|name| Some((name.clone(), Term::Param(number(name)?)))).collect();
    Some(Rc::new(Wording { formula: text(formula).into(), positive, variables }))
}

/// The formula as it is written in PDDL, cut off where it is long.
pub(super) fn text(formula: &Formula) -> String {
    let mut start = Start(String::new());
    if write!(start, "{formula}").is_err() {
        start.0.push('…');
    }
    start.0
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

/// The beginning of a text.
struct Start(String);

impl Write for Start {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = LONGEST.saturating_sub(self.0.len());
        if text.len() <= room {
            self.0.push_str(text);
            return Ok(());
        }
        self.0.extend(text.char_indices().take_while(|(at, c)| at + c.len_utf8() <= room).map(|(_, c)| c));
        Err(fmt::Error)
    }
}

/// Adds the variables that are free in a formula below these quantified ones.
fn add_free<'f>(formula: &'f Formula, bound: &mut Vec<&'f Symbol>, free: &mut BTreeSet<&'f Symbol>) {
    let mut add = |term: &'f PddlTerm| match term {
        PddlTerm::Variable(name) if !bound.contains(&name) => drop(free.insert(name)),
        _ => {}
    };
    match formula {
        Formula::Atom(atom) => atom.args.iter().for_each(add),
        Formula::Equal(a, b) => [a, b].into_iter().for_each(&mut add),
        Formula::Not(inner) => add_free(inner, bound, free),
        Formula::And(parts) | Formula::Or(parts) => parts.iter().for_each(|part| add_free(part, bound, free)),
        Formula::Imply(premise, conclusion) => {
            add_free(premise, bound, free);
            add_free(conclusion, bound, free);
        }
        Formula::Exists(variables, body) | Formula::Forall(variables, body) => {
            let outside = bound.len();
            bound.extend(variables.iter().map(|Typed { name, .. }| name));
            add_free(body, bound, free);
            bound.truncate(outside);
        }
    }
}
