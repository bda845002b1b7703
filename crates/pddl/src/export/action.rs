//! Actions of the model as actions of PDDL.

use std::collections::BTreeSet;

use typelift_model::{ActionSchema, Cost, Effect, LiftedAtom, Literal, Parameter, PddlNames, Symbol, Term, TypeId};

use super::Writer;
use super::names::pddl;
use crate::{Action, Amount, Formula, PddlAtom, PddlEffect, PddlTerm, Typed};

/// The variables that placeholders are written as, in order: folded, and numbered where two would be the same.
pub(super) fn variables<'p>(parameters: impl IntoIterator<Item = &'p Parameter>) -> Vec<Symbol> {
    let mut used = BTreeSet::new();
    let unused = |parameter: &Parameter| {
        // One name cannot collide with itself.
        let folded = PddlNames::fold("parameter", [&parameter.name]).unwrap_or_default();
        let base = pddl(&folded, &parameter.name);
        let mut name = base.clone();
        for number in 2.. {
            if used.insert(name.clone()) {
                break;
            }
            name = Symbol::from(format!("{base}-{number}"));
        }
        name
    };
    parameters.into_iter().map(unused).collect()
}

impl Writer<'_> {
    pub(super) fn type_name(&self, ty: TypeId) -> Symbol {
        pddl(&self.names.types, self.model.hierarchy.name(ty))
    }

    pub(super) fn typed(&self, name: Symbol, ty: TypeId) -> Typed {
        Typed { name, types: vec![self.type_name(ty)] }
    }

    /// Whether actions cost something else than one each.
    pub(super) fn has_costs(&self) -> bool {
        self.model.actions.iter().any(|action| action.cost != Cost::UNIT)
    }

    pub(super) fn action(&self, action: &ActionSchema) -> Action {
        let variables = variables(&action.parameters);
        let parameters = variables.iter().zip(&action.parameters);
        let mut conditions: Vec<Formula> =
            action.preconditions.iter().map(|literal| self.literal(literal, &variables)).collect();
        for (i, j) in self.inequalities(action) {
            let [left, right] = [i, j].map(|index| PddlTerm::Variable(variables[index].clone()));
            conditions.push(Formula::Not(Box::new(Formula::Equal(left, right))));
        }
        let mut effects: Vec<PddlEffect> =
            action.effects.iter().map(|effect| self.effect(action, effect, &variables)).collect();
        if self.has_costs() {
            effects.push(self.increase(&action.cost, &variables));
        }
        Action {
            name: pddl(&self.names.actions, &action.name),
            parameters: parameters.map(|(name, p)| self.typed(name.clone(), p.ty)).collect(),
            precondition: Formula::And(conditions),
            effect: PddlEffect::And(effects),
            comment: self.action_notes(action, &variables),
        }
    }

    /// The pairs of parameters that must differ and that the types do not keep apart.
    fn inequalities<'b>(&'b self, action: &'b ActionSchema) -> impl Iterator<Item = (usize, usize)> + 'b {
        let pairs = action.distinct.iter().map(|&(i, j)| (i as usize, j as usize));
        pairs.filter(|&(i, j)| !self.model.hierarchy.disjoint(action.parameters[i].ty, action.parameters[j].ty))
    }

    fn term(&self, term: &Term, variables: &[Symbol]) -> PddlTerm {
        match term {
            Term::Param(index) => PddlTerm::Variable(variables[*index as usize].clone()),
            Term::Const(name) => PddlTerm::Object(pddl(&self.names.objects, name)),
        }
    }

    fn atom(&self, names: &PddlNames, atom: &LiftedAtom, variables: &[Symbol]) -> PddlAtom {
        let args = atom.args.iter().map(|term| self.term(term, variables)).collect();
        PddlAtom::new(pddl(names, &atom.predicate), args)
    }

    /// A literal as a condition.
    pub(super) fn literal(&self, literal: &Literal, variables: &[Symbol]) -> Formula {
        let formula = if literal.atom.is_equality() {
            let terms: Vec<PddlTerm> = literal.atom.args.iter().map(|term| self.term(term, variables)).collect();
            let mut equalities: Vec<Formula> =
                terms.windows(2).map(|pair| Formula::Equal(pair[0].clone(), pair[1].clone())).collect();
            if equalities.len() == 1 { equalities.remove(0) } else { Formula::And(equalities) }
        } else {
            Formula::Atom(self.atom(&self.names.predicates, &literal.atom, variables))
        };
        if literal.positive { formula } else { Formula::Not(Box::new(formula)) }
    }

    fn effect(&self, action: &ActionSchema, effect: &Effect, own: &[Symbol]) -> PddlEffect {
        let all = variables(action.parameters.iter().chain(&effect.parameters));
        let atom = self.atom(&self.names.predicates, &effect.literal.atom, &all);
        let mut written = if effect.literal.positive { PddlEffect::Add(atom) } else { PddlEffect::Delete(atom) };
        let mut conditions: Vec<Formula> = effect.condition.iter().map(|l| self.literal(l, &all)).collect();
        if !conditions.is_empty() {
            let condition = if conditions.len() == 1 { conditions.remove(0) } else { Formula::And(conditions) };
            written = PddlEffect::When(condition, Box::new(written));
        }
        if !effect.parameters.is_empty() {
            let choices = all.iter().skip(own.len()).zip(&effect.parameters);
            let choices = choices.map(|(name, p)| self.typed(name.clone(), p.ty)).collect();
            written = PddlEffect::Forall(choices, Box::new(written));
        }
        written
    }

    /// What an action adds to the total cost: its only function, if there is one, else a number.
    fn increase(&self, cost: &Cost, variables: &[Symbol]) -> PddlEffect {
        let function = cost.functions.first().map(|f| Amount::Function(self.atom(&self.names.functions, f, variables)));
        PddlEffect::Increase(function.unwrap_or(Amount::Number(cost.fixed)))
    }
}
