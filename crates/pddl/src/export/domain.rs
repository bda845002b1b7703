//! The model as a domain.

use typelift_model::{Symbol, TypeId};

use super::Writer;
use super::names::{functions, pddl, predicates};
use crate::{Domain, Signature, Typed};

impl Writer<'_> {
    /// The domain, but for its requirements; `notes` are written at its top.
    pub(super) fn domain(&self, notes: Vec<String>) -> Domain {
        let ty = |position: usize, ty: TypeId| self.typed(Symbol::from(format!("a{position}")), ty);
        let of_predicate = |(name, arity): (&Symbol, usize)| Signature {
            name: pddl(&self.names.predicates, name),
            parameters: (0..arity).map(|i| ty(i, self.types.of_predicate(name, i))).collect(),
        };
        let of_function = |(name, arity): (&Symbol, usize)| Signature {
            name: pddl(&self.names.functions, name),
            parameters: (0..arity).map(|i| ty(i, self.types.of_function(name, i))).collect(),
        };
        let total_cost = Signature { name: Symbol::new("total-cost"), parameters: Vec::new() };
        let functions = functions(self.model).into_iter().map(of_function);
        Domain {
            name: pddl(&self.names.domain, &self.options.domain),
            requirements: Vec::new(),
            types: self.types(),
            constants: self.constants(),
            predicates: predicates(self.model, self.task).into_iter().map(of_predicate).collect(),
            functions: self.has_costs().then_some(total_cost).into_iter().chain(functions).collect(),
            derived: self.model.axioms.iter().map(|axiom| self.derived(axiom)).collect(),
            actions: self.model.actions.iter().map(|action| self.action(action)).collect(),
            comment: self.domain_notes(notes),
        }
    }

    /// Every type with its parent, those with one parent beside each other.
    fn types(&self) -> Vec<(Symbol, Symbol)> {
        let hierarchy = &self.model.hierarchy;
        let pairs = hierarchy.types().flat_map(|parent| hierarchy.children(parent).map(move |child| (child, parent)));
        pairs.map(|(child, parent)| (self.type_name(child), self.type_name(parent))).collect()
    }

    fn constants(&self) -> Vec<Typed> {
        let mut constants: Vec<(&Symbol, TypeId)> = self.types.constants.iter().map(|(c, ty)| (c, *ty)).collect();
        constants.sort_by_key(|(_, ty)| *ty);
        constants.into_iter().map(|(name, ty)| self.typed(pddl(&self.names.objects, name), ty)).collect()
    }
}
