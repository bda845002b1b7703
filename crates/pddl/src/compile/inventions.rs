//! The derived predicates that stand for parts of conditions, of all blocks together.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{ActionModel, Axiom, Literal, Symbol, Term, TypeId, Wording};

use super::names::FreshNames;

/// An axiom but for its predicate and stratum: the types of its parameters, the head's arguments, the body.
pub(super) type Rule = (Vec<TypeId>, Vec<Term>, Vec<Literal>);

/// The derived predicates that were made, and all axioms.
#[derive(Debug)]
pub(super) struct Inventions {
    names: FreshNames,
    /// What was invented.
    predicates: BTreeSet<Symbol>,
    /// How the text puts what they stand for.
    wordings: BTreeMap<Symbol, Wording>,
    /// The axioms, of stated and of invented predicates; the strata are still to be found.
    pub(super) axioms: Vec<Axiom>,
    /// Those that stand for the same rules.
    pub(super) known: BTreeMap<Vec<Rule>, Symbol>,
    /// The literals that were gone through.
    pub(super) literals: usize,
}

impl Inventions {
    /// None yet, for a model that uses these names for predicates and functions.
    pub(super) fn new(used: impl IntoIterator<Item = Symbol>) -> Self {
        let names = FreshNames::with(used);
        let (predicates, wordings) = (BTreeSet::new(), BTreeMap::new());
        Self { names, predicates, wordings, axioms: Vec::new(), known: BTreeMap::new(), literals: 0 }
    }

    /// A new predicate without axioms, which the text puts like this.
    pub(super) fn predicate(&mut self, base: &str, wording: Option<Wording>) -> Symbol {
        let name = self.names.numbered(base, 1);
        self.wordings.extend(wording.map(|wording| (name.clone(), wording)));
        self.predicates.insert(name.clone());
        name
    }

    /// Writes what was invented into the model.
    pub(super) fn finish(self, model: &mut ActionModel) {
        model.axioms.extend(self.axioms);
        model.wordings.extend(self.wordings);
        let mut uses = model.argument_uses();
        for name in self.predicates {
            // One that nothing uses is of a goal that can never hold, and has no arguments.
            let types = uses.remove(&name).unwrap_or_default();
            model.predicates.insert(name, types);
        }
    }
}

/// What an axiom says, whatever its predicate.
pub(super) fn rule(axiom: &Axiom) -> Rule {
    (axiom.parameters.iter().map(|p| p.ty).collect(), axiom.head.args.clone(), axiom.body.clone())
}
