//! A model and a goal with other names for some objects.

use std::collections::BTreeMap;

use crate::{ActionModel, Atom, Goal, GroundAtom, LiftedAtom, Literal, Symbol, Term};

/// The new name of an object, or that which it has.
fn renamed(name: &Symbol, names: &BTreeMap<Symbol, Symbol>) -> Symbol {
    names.get(name).unwrap_or(name).clone()
}

fn rename_term(term: &mut Term, names: &BTreeMap<Symbol, Symbol>) {
    if let Term::Const(name) = term {
        *name = renamed(name, names);
    }
}

impl GroundAtom {
    /// The atom with the objects of these names under the new ones.
    #[must_use]
    pub fn with_objects_renamed(&self, names: &BTreeMap<Symbol, Symbol>) -> Self {
        Atom { predicate: self.predicate.clone(), args: self.args.iter().map(|arg| renamed(arg, names)).collect() }
    }
}

impl Goal {
    /// The goal with the objects of these names under the new ones.
    #[must_use]
    pub fn with_objects_renamed(&self, names: &BTreeMap<Symbol, Symbol>) -> Self {
        let renamed = |atoms: &[GroundAtom]| atoms.iter().map(|atom| atom.with_objects_renamed(names)).collect();
        Self { required: renamed(&self.required), forbidden: renamed(&self.forbidden) }
    }

    /// Every object that the goal mentions.
    pub fn objects(&self) -> impl Iterator<Item = &Symbol> {
        self.literals().flat_map(|(atom, _)| &atom.args)
    }
}

impl ActionModel {
    /// The model with the objects of these names under the new ones, wherever it mentions one.
    #[must_use]
    pub fn with_objects_renamed(mut self, names: &BTreeMap<Symbol, Symbol>) -> Self {
        self.constants = self.constants.iter().map(|(name, ty)| (renamed(name, names), *ty)).collect();
        self.terms_mut(&mut |term| rename_term(term, names));
        // These lists are sorted, also by what was renamed.
        for action in &mut self.actions {
            action.preconditions.sort_unstable();
            action.effects.iter_mut().for_each(|effect| effect.condition.sort_unstable());
            action.effects.sort_unstable();
        }
        self
    }

    /// Every object that the model mentions by its name.
    pub fn objects(&self) -> Vec<Symbol> {
        let mut objects: Vec<Symbol> = self.constants.keys().cloned().collect();
        let mut add = |terms: &[Term]| {
            objects.extend(terms.iter().filter_map(|term| match term {
                Term::Const(name) => Some(name.clone()),
                Term::Param(_) => None,
            }));
        };
        self.for_each_atom(&mut |atom, _, _| add(&atom.args));
        self.actions.iter().for_each(|action| add(&action.call.args));
        objects.sort_unstable();
        objects.dedup();
        objects
    }

    fn terms_mut(&mut self, visit: &mut dyn FnMut(&mut Term)) {
        for action in &mut self.actions {
            action.call.args.iter_mut().for_each(&mut *visit);
            action.preconditions.iter_mut().for_each(|literal| in_literal(literal, visit));
            for effect in &mut action.effects {
                effect.condition.iter_mut().for_each(|literal| in_literal(literal, visit));
                in_literal(&mut effect.literal, visit);
            }
            action.cost.functions.iter_mut().for_each(|function| in_atom(function, visit));
        }
        for axiom in &mut self.axioms {
            in_atom(&mut axiom.head, visit);
            axiom.body.iter_mut().for_each(|literal| in_literal(literal, visit));
        }
        for wording in self.wordings.values_mut() {
            wording.variables.iter_mut().for_each(|(_, term)| visit(term));
        }
    }
}

fn in_literal(literal: &mut Literal, visit: &mut dyn FnMut(&mut Term)) {
    in_atom(&mut literal.atom, visit);
}

fn in_atom(atom: &mut LiftedAtom, visit: &mut dyn FnMut(&mut Term)) {
    atom.args.iter_mut().for_each(visit);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axiom, Hierarchy, Parameter};

    #[test]
    fn an_object_is_renamed_wherever_it_is_mentioned() {
        let hierarchy = Hierarchy::default();
        let root = hierarchy.root();
        let atom = |text: &str| LiftedAtom::parse(text).expect(text);
        let axiom = Axiom {
            stratum: 0,
            head: atom("done(?0)"),
            parameters: vec![Parameter { name: "x".into(), ty: root }],
            body: vec![Literal::positive(atom("on(?0,cup_1)")), Literal::negative(atom("on(cup_2,?0)"))],
        };
        let constants = [("depot".into(), root)].into();
        let model = ActionModel { hierarchy, constants, axioms: vec![axiom], ..ActionModel::default() };
        let names = [("cup_1".into(), "Cup_1".into()), ("depot".into(), "Depot".into())].into();
        let renamed = model.with_objects_renamed(&names);
        let objects: Vec<String> = renamed.objects().iter().map(ToString::to_string).collect();
        assert_eq!(objects, ["Cup_1", "Depot", "cup_2"]);
        assert_eq!(renamed.axioms[0].body[0].atom, atom("on(?0,Cup_1)"));
    }
}
