//! Problems for a model that was not made from a PDDL domain: what the model declares stands in the domain's place.
//!
//! A problem spells names as the model does in PDDL. Arguments of predicates may be of any type, since the model's types
//! of them are those of what was seen.

use std::collections::BTreeMap;

use typelift_model::{ActionModel, Atom, NameCollision, PddlNames, ROOT, Symbol};

use crate::export::functions;
use crate::problem_reader::problem_within;
use crate::vocabulary::DeclaredIn;
use crate::{Domain, Formula, PddlError, PddlTerm, Problem, Signature, Span, Typed};

/// Reads a problem for a model: [`compile_problem`](crate::compile_problem) makes it a task of this model. It belongs to
/// the domain of this name, or, without one, to any.
///
/// # Errors
/// [`PddlError`] at what is wrong, at a type, a predicate or a constant that the model does not have, or if the model has
/// names that are one in PDDL.
pub fn read_model_problem(text: &str, model: &ActionModel, domain: Option<&Symbol>) -> Result<Problem, PddlError> {
    let names = Names::of(model).map_err(|error| PddlError::new(text, Span::default(), error.to_string()))?;
    let domain = names.domain(model, domain.cloned().unwrap_or_default());
    let mut problem = problem_within(text, &domain, DeclaredIn::Model)?;
    for object in &mut problem.objects {
        own_types(object, &names);
    }
    problem.init = problem.init.iter().map(|atom| names.own_atom(&names.predicates, atom)).collect();
    let value = |(function, value): &(Atom<Symbol>, u32)| (names.own_atom(&names.functions, function), *value);
    problem.values = problem.values.iter().map(value).collect();
    own_formula(&mut problem.goal, &names);
    Ok(problem)
}

/// The names of a model in PDDL.
struct Names {
    types: PddlNames,
    predicates: PddlNames,
    functions: PddlNames,
    constants: PddlNames,
}

impl Names {
    fn of(model: &ActionModel) -> Result<Self, NameCollision> {
        let own = model.pddl_names()?;
        Ok(Self {
            types: own.types,
            predicates: own.predicates,
            functions: PddlNames::fold("function", functions(model).into_keys())?,
            constants: PddlNames::fold("object", model.constants.keys())?,
        })
    }

    /// What the model declares, as a domain without actions.
    fn domain(&self, model: &ActionModel, name: Symbol) -> Domain {
        let anything = |arity: usize| {
            let typed = |i: usize| Typed { name: Symbol::from(format!("a{i}")), types: vec![Symbol::new(ROOT)] };
            (0..arity).map(typed).collect::<Vec<_>>()
        };
        let signature = |(name, arity): (&Symbol, usize)| Signature { name: name.clone(), parameters: anything(arity) };
        let arities: BTreeMap<&Symbol, usize> = model.predicates.iter().map(|(p, types)| (p, types.len())).collect();
        let in_pddl = |names: &PddlNames, arities: BTreeMap<&Symbol, usize>| {
            let known = arities.into_iter().filter_map(|(own, arity)| Some((names.pddl(own.as_str())?.clone(), arity)));
            known.map(|(name, arity)| signature((&name, arity))).collect::<Vec<_>>()
        };
        let ty = |name: &Symbol| self.types.pddl(name.as_str()).unwrap_or(name).clone();
        let constant = |(name, id): (&Symbol, &_)| Typed {
            name: self.constants.pddl(name.as_str()).unwrap_or(name).clone(),
            types: vec![ty(model.hierarchy.name(*id))],
        };
        let mut functions = in_pddl(&self.functions, functions(model));
        functions.push(signature((&Symbol::new("total-cost"), 0)));
        Domain {
            name,
            types: model.hierarchy.edges().map(|(child, parent)| (ty(child), ty(parent))).collect(),
            constants: model.constants.iter().map(constant).collect(),
            predicates: in_pddl(&self.predicates, arities),
            functions,
            ..Domain::default()
        }
    }

    fn own_atom(&self, names: &PddlNames, atom: &Atom<Symbol>) -> Atom<Symbol> {
        let args = atom.args.iter().map(|arg| own(&self.constants, arg)).collect();
        Atom { predicate: own(names, &atom.predicate), args }
    }
}

/// The model's name for a name that the problem has.
fn own(names: &PddlNames, name: &Symbol) -> Symbol {
    names.name(name.as_str()).unwrap_or(name).clone()
}

fn own_types(typed: &mut Typed, names: &Names) {
    for ty in &mut typed.types {
        *ty = own(&names.types, ty);
    }
}

fn own_term(term: &mut PddlTerm, names: &Names) {
    if let PddlTerm::Object(name) = term {
        *name = own(&names.constants, name);
    }
}

fn own_formula(formula: &mut Formula, names: &Names) {
    match formula {
        Formula::Atom(atom) => {
            atom.predicate = own(&names.predicates, &atom.predicate);
            atom.args.iter_mut().for_each(|term| own_term(term, names));
        }
        Formula::Equal(left, right) => [left, right].into_iter().for_each(|term| own_term(term, names)),
        Formula::Not(part) => own_formula(part, names),
        Formula::And(parts) | Formula::Or(parts) => parts.iter_mut().for_each(|part| own_formula(part, names)),
        Formula::Imply(left, right) => [left, right].into_iter().for_each(|part| own_formula(part, names)),
        Formula::Exists(variables, part) | Formula::Forall(variables, part) => {
            variables.iter_mut().for_each(|variable| own_types(variable, names));
            own_formula(part, names);
        }
    }
}
