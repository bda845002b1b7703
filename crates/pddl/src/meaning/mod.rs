//! What a domain and a problem mean, by the plainest evaluation of what they state.
//!
//! Formulas are evaluated as they are written, quantifiers by going through the objects, derived predicates by deriving
//! until nothing new follows. Nothing is normalized, grounded or cached, and no code is shared with the compiler: what is
//! judged by this is judged by the text.

mod changes;
mod formulas;
mod strata;
mod words;

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{Atom, GroundAtom, Hierarchy, Symbol, TypeId};

use self::strata::strata;
use crate::syntax::TOTAL_COST;
use crate::{Action, CompileError, CompilePart, Derived, Domain, Formula, Problem, Typed};

pub use changes::NoValue;

/// Atoms that hold.
pub type Atoms = BTreeSet<GroundAtom>;

/// What variables stand for; a later one hides an earlier one of the same name.
type Chosen = Vec<(Symbol, Symbol)>;

/// A domain with one of its problems.
#[derive(Debug)]
pub struct Meaning<'p> {
    domain: &'p Domain,
    problem: &'p Problem,
    hierarchy: Hierarchy,
    objects: BTreeMap<Symbol, TypeId>,
    /// The conditions of derived predicates, those first on whose negation others depend.
    strata: Vec<Vec<&'p Derived>>,
    /// The derived predicates.
    derived: BTreeSet<&'p Symbol>,
    values: BTreeMap<&'p Atom<Symbol>, u32>,
    /// Whether the cost of a step is what its action says; else each costs 1.
    has_costs: bool,
}

impl<'p> Meaning<'p> {
    /// The meaning of a problem of this domain, both as the readers return them.
    ///
    /// # Errors
    /// [`CompileError`] if they mean nothing: where types contradict each other, an object is of several, a derived
    /// predicate depends on its own negation, is stated or is changed by an action.
    pub fn of(domain: &'p Domain, problem: &'p Problem) -> Result<Self, CompileError> {
        let edges = domain.types.iter().map(|(child, parent)| (child.as_str(), parent.as_str()));
        let hierarchy =
            Hierarchy::from_edges(edges).map_err(|error| CompileError::new(&CompilePart::Types, error.to_string()))?;
        let mut objects = BTreeMap::new();
        for (declared, part) in [(&domain.constants, CompilePart::Constants), (&problem.objects, CompilePart::Objects)]
        {
            for object in declared {
                objects.insert(object.name.clone(), type_of(object, &hierarchy, &part)?);
            }
        }
        let derived: BTreeSet<&Symbol> = domain.derived.iter().map(|derived| &derived.head.name).collect();
        for action in &domain.actions {
            if let Some(predicate) = action.effect.changed().into_iter().find(|changed| derived.contains(changed)) {
                let message = format!("it changes `{predicate}`, which is a derived predicate");
                return Err(CompileError::new(&CompilePart::Action(action.name.clone()), message));
            }
        }
        if let Some(atom) = problem.init.iter().find(|atom| derived.contains(&atom.predicate)) {
            let message = format!("{atom} is stated, but `{}` is derived", atom.predicate);
            return Err(CompileError::new(&CompilePart::Init, message));
        }
        let says_costs = domain.actions.iter().any(|action| action.effect.increases());
        let declares_costs = domain.functions.iter().any(|function| function.name == *TOTAL_COST);
        Ok(Self {
            domain,
            problem,
            hierarchy,
            objects,
            strata: strata(domain)?,
            derived,
            values: problem.values.iter().map(|(function, value)| (function, *value)).collect(),
            has_costs: problem.minimizes_cost && (says_costs || declares_costs),
        })
    }

    /// The action of this name.
    pub fn action(&self, name: &str) -> Option<&'p Action> {
        self.domain.actions.iter().find(|action| action.name == *name)
    }

    /// What holds at the beginning, derived or not.
    pub fn initial(&self) -> Atoms {
        self.with_derived(self.problem.init.iter().cloned().collect())
    }

    /// The total cost at the beginning, which is 0 in most problems.
    pub fn initial_cost(&self) -> u64 {
        let stated = self.values.iter().find(|(function, _)| function.predicate == *TOTAL_COST);
        stated.filter(|_| self.has_costs).map_or(0, |(_, value)| u64::from(*value))
    }

    /// The problem's goal.
    pub fn goal(&self) -> &'p Formula {
        &self.problem.goal
    }

    /// The objects and constants.
    pub fn objects(&self) -> impl Iterator<Item = &Symbol> {
        self.objects.keys()
    }

    /// The type of an object or a constant.
    pub fn type_of(&self, object: &Symbol) -> Option<&Symbol> {
        self.objects.get(object).map(|ty| self.hierarchy.name(*ty))
    }

    /// Whether a declared variable may stand for an object.
    pub fn fits(&self, object: &Symbol, variable: &Typed) -> bool {
        let of = |declared: &Symbol| self.hierarchy.id(declared.as_str());
        let is_a =
            |ty: TypeId, declared: &Symbol| of(declared).is_some_and(|declared| self.hierarchy.is_a(ty, declared));
        self.objects.get(object).is_some_and(|ty| variable.types.iter().any(|declared| is_a(*ty, declared)))
    }

    /// Every choice of objects for these variables, in the order of their names. As many as the product of the numbers of
    /// fitting objects.
    pub fn choices(&self, variables: &[Typed]) -> Vec<Vec<Symbol>> {
        let mut choices = Vec::new();
        self.any(variables, &mut Chosen::new(), &mut |chosen| {
            choices.push(chosen.iter().map(|(_, object)| object.clone()).collect());
            false
        });
        choices
    }

    /// Whether a test is passed for some choice of objects for these variables.
    fn any(&self, variables: &[Typed], chosen: &mut Chosen, test: &mut dyn FnMut(&mut Chosen) -> bool) -> bool {
        let Some((variable, others)) = variables.split_first() else { return test(chosen) };
        self.objects.keys().filter(|object| self.fits(object, variable)).any(|object| {
            chosen.push((variable.name.clone(), object.clone()));
            let found = self.any(others, chosen, test);
            chosen.pop();
            found
        })
    }

    /// What holds where these atoms do that are not derived. In time of the choices of objects for the variables of all
    /// conditions, once more for each time that something new follows.
    pub fn with_derived(&self, mut atoms: Atoms) -> Atoms {
        for stratum in &self.strata {
            loop {
                let before = atoms.len();
                for derived in stratum {
                    self.derive(derived, &mut atoms);
                }
                if atoms.len() == before {
                    break;
                }
            }
        }
        atoms
    }

    /// Adds what follows by one condition.
    fn derive(&self, derived: &Derived, atoms: &mut Atoms) {
        self.any(&derived.head.parameters, &mut Chosen::new(), &mut |chosen| {
            let args = chosen.iter().map(|(_, object)| object.clone()).collect();
            let atom = Atom { predicate: derived.head.name.clone(), args };
            if !atoms.contains(&atom) && self.is_true(&derived.condition, atoms, chosen) {
                atoms.insert(atom);
            }
            false
        });
    }
}

/// The one type of a declared object.
fn type_of(object: &Typed, hierarchy: &Hierarchy, part: &CompilePart) -> Result<TypeId, CompileError> {
    match object.types.as_slice() {
        [] => Ok(hierarchy.root()),
        [ty] => hierarchy.id(ty.as_str()).ok_or_else(|| CompileError::new(part, format!("there is no type `{ty}`"))),
        _ => {
            let message = format!("`{}` is `either` of several types", object.name);
            Err(CompileError::new(part, message).not_supported())
        }
    }
}

/// What an action's variables stand for.
fn chosen(action: &Action, objects: &[Symbol]) -> Chosen {
    action.parameters.iter().map(|parameter| parameter.name.clone()).zip(objects.iter().cloned()).collect()
}
