//! How a text puts what a model has as a predicate of its own making.
//!
//! A model holds conjunctions only: whoever makes one from a text invents predicates for what the text quantifies or puts as
//! alternatives. No file has their names, so whatever is said of them is said with the formula that they stand for.

use std::fmt::Display;
use std::sync::Arc;

use crate::{Symbol, Term};

/// A formula of the text that a model was made from, for which, or for whose negation, a predicate was invented.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Wording {
    /// The formula as the text has it; a long one is cut off.
    pub formula: Arc<str>,
    /// Whether the predicate holds where the formula does; else it holds where the formula does not.
    pub positive: bool,
    /// What the variables stand for that are free in the formula: an argument of the predicate by its place, or an object.
    pub variables: Vec<(Symbol, Term)>,
}

impl Wording {
    /// Whether the formula, as far as it is told, has this name in it, in upper or lower case.
    pub fn mentions(&self, name: &Symbol) -> bool {
        let mut words = self.formula.split(|c: char| c.is_whitespace() || c == '(' || c == ')');
        words.any(|word| word.eq_ignore_ascii_case(name.as_str()))
    }

    /// The formula, or its negation, with what its variables stand for where the predicate has these arguments.
    pub fn say<T: Display>(&self, args: &[T], positive: bool) -> String {
        let formula = &self.formula;
        let mut text = if positive == self.positive { formula.to_string() } else { format!("(not {formula})") };
        let mut word = "where";
        for (name, term) in &self.variables {
            let object = match term {
                Term::Param(place) => args.get(*place as usize).map(ToString::to_string),
                Term::Const(object) => Some(object.to_string()),
            };
            if let Some(object) = object {
                text.push_str(&format!(" {word} ?{name} is {object}"));
                word = "and";
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::{ActionModel, GroundAtom};

    #[test]
    fn an_invented_predicate_is_said_with_its_formula() {
        let variables = vec![(Symbol::new("s"), Term::Param(0)), (Symbol::new("q"), Term::Const(Symbol::new("pier")))];
        let wording = Wording { formula: "(forall (?c) (on ?c ?s ?q))".into(), positive: false, variables };
        let wordings = BTreeMap::from([(Symbol::new("forall-go-1"), wording)]);
        let model = ActionModel { wordings, ..ActionModel::default() };
        let say = |atom: &str, positive| model.in_words(&GroundAtom::parse(atom).expect(atom), positive);
        assert_eq!(say("forall-go-1(ship)", false), "(forall (?c) (on ?c ?s ?q)) where ?s is ship and ?q is pier");
        assert_eq!(say("forall-go-1(ship)", true), "(not (forall (?c) (on ?c ?s ?q))) where ?s is ship and ?q is pier");
        let mentions = |name: &str| model.wordings.values().any(|wording| wording.mentions(&Symbol::new(name)));
        assert!(mentions("on") && mentions("ON") && !mentions("o") && !mentions("ship"));
        assert_eq!(say("on(a,b)", true), "on(a,b)");
        assert_eq!(say("on(a,b)", false), "not on(a,b)");
    }
}
