//! A formula in a message.

use std::collections::BTreeSet;
use std::fmt::{self, Write};

use typelift_model::Symbol;

use crate::{Formula, PddlTerm, Typed};

/// After so many characters a formula is cut off.
const LONGEST: usize = 200;

/// The formula as it is written in PDDL, cut off where it is long.
pub(crate) fn shortened(formula: &Formula) -> String {
    let mut start = Start(String::new());
    if write!(start, "{formula}").is_err() {
        start.0.push('…');
    }
    start.0
}

/// The variables that a formula has from outside.
pub(crate) fn free_variables(formula: &Formula) -> BTreeSet<&Symbol> {
    let mut free = BTreeSet::new();
    add_free(formula, &mut Vec::new(), &mut free);
    free
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
