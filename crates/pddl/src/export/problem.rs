//! The task as a problem.

use typelift_model::{Atom, GroundAtom, PddlNames, Symbol, Task, TypeId};

use super::Writer;
use super::names::{functions, pddl};
use crate::{Domain, Formula, PddlAtom, PddlTerm, Problem};

impl Writer<'_> {
    pub(super) fn problem(&self, task: &Task, domain: &Domain) -> Problem {
        let constants = &self.types.constants;
        let objects = task.init.objects.iter().filter(|(name, _)| !constants.contains_key(*name));
        let mut objects: Vec<(&Symbol, TypeId)> = objects.map(|(name, ty)| (name, *ty)).collect();
        objects.sort_by_key(|(_, ty)| *ty);
        let goal = task.goal.literals().map(|(atom, positive)| {
            let formula = self.goal_atom(atom);
            if positive { formula } else { Formula::Not(Box::new(formula)) }
        });
        Problem {
            name: pddl(&self.names.problem, &self.options.problem),
            domain: domain.name.clone(),
            // The domain's hold for it too, and not every planner reads them here.
            requirements: Vec::new(),
            objects: objects.into_iter().map(|(name, ty)| self.typed(self.object(name), ty)).collect(),
            init: task.init.atoms.iter().map(|atom| self.ground(&self.names.predicates, atom)).collect(),
            values: self.values(task),
            goal: Formula::And(goal.collect()),
            minimizes_cost: self.has_costs(),
            comment: self.problem_notes(),
        }
    }

    fn object(&self, name: &Symbol) -> Symbol {
        pddl(&self.names.objects, name)
    }

    fn ground(&self, names: &PddlNames, atom: &GroundAtom) -> Atom<Symbol> {
        Atom::new(pddl(names, &atom.predicate), atom.args.iter().map(|arg| self.object(arg)).collect())
    }

    fn goal_atom(&self, atom: &GroundAtom) -> Formula {
        let term = |name: &Symbol| PddlTerm::Object(self.object(name));
        if let [left, right] = &atom.args[..]
            && atom.is_equality()
        {
            return Formula::Equal(term(left), term(right));
        }
        let predicate = pddl(&self.names.predicates, &atom.predicate);
        Formula::Atom(PddlAtom::new(predicate, atom.args.iter().map(term).collect()))
    }

    /// The values of the functions that costs mention, and the total cost of doing nothing.
    fn values(&self, task: &Task) -> Vec<(Atom<Symbol>, u32)> {
        let mentioned = functions(self.model);
        let values = task.values.iter().filter(|(function, _)| mentioned.contains_key(&function.predicate));
        let values = values.map(|(function, value)| (self.ground(&self.names.functions, function), *value));
        let nothing = self.has_costs().then(|| (Atom::new("total-cost", Vec::new()), 0));
        nothing.into_iter().chain(values).collect()
    }
}
