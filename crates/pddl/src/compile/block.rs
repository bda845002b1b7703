//! A block of a domain or problem that has variables: an action, a condition of a derived predicate, or the goal.
//!
//! Its variables are numbered, each quantifier's anew, so that no two are confused whatever their names are.

use typelift_model::{Atom, LiftedAtom, Literal, Parameter, Symbol, Term, TypeId};

use super::error::{CompileError, CompilePart};
use super::inventions::Inventions;
use super::names::FreshNames;
use super::normal::Normal;
use super::said::said;
use super::world::World;
use crate::{Formula, PddlAtom, PddlTerm, Typed};

/// A variable: a name that no other of its block has, and the types of which it may be, none below another.
#[derive(Debug, Clone)]
struct Variable {
    name: Symbol,
    types: Vec<TypeId>,
}

/// The variables that a name may mean, the innermost last.
pub(super) type Visible<'f> = Vec<(&'f Symbol, u32)>;

/// A block with its variables.
#[derive(Debug)]
pub(super) struct Block<'w> {
    /// Which it is.
    pub(super) part: CompilePart,
    /// What names of new predicates are made of.
    pub(super) name: Symbol,
    /// What is known outside.
    pub(super) world: World<'w>,
    /// The predicates that it needs beyond those it mentions.
    pub(super) inventions: &'w mut Inventions,
    variables: Vec<Variable>,
    names: FreshNames,
}

impl<'w> Block<'w> {
    /// A block without variables.
    pub(super) fn new(part: CompilePart, name: Symbol, world: World<'w>, inventions: &'w mut Inventions) -> Self {
        Self { part, name, world, inventions, variables: Vec::new(), names: FreshNames::default() }
    }

    /// An error about it.
    pub(super) fn error(&self, message: impl Into<String>) -> CompileError {
        CompileError::new(&self.part, message)
    }

    /// Adds variables, visible from now on, and returns them.
    pub(super) fn declare<'f>(
        &mut self,
        declared: &'f [Typed],
        visible: &mut Visible<'f>,
    ) -> Result<Vec<u32>, CompileError> {
        let mut new = Vec::with_capacity(declared.len());
        for typed in declared {
            let types = self.types(typed)?;
            let number = self.variables.len() as u32;
            self.variables.push(Variable { name: self.names.fresh(&typed.name), types });
            visible.push((&typed.name, number));
            new.push(number);
        }
        Ok(new)
    }

    /// The types of a declaration, without those that lie below another one.
    fn types(&self, typed: &Typed) -> Result<Vec<TypeId>, CompileError> {
        let hierarchy = self.world.hierarchy;
        let id =
            |name: &Symbol| hierarchy.id(name.as_str()).ok_or_else(|| self.error(format!("there is no type `{name}`")));
        let all: Vec<TypeId> = typed.types.iter().map(id).collect::<Result<_, _>>()?;
        let mut types: Vec<TypeId> = Vec::with_capacity(all.len());
        for &ty in &all {
            let covered = all.iter().any(|&other| other != ty && hierarchy.is_a(ty, other));
            if !covered && !types.contains(&ty) {
                types.push(ty);
            }
        }
        Ok(types)
    }

    /// How many variables were declared.
    pub(super) fn number_of_variables(&self) -> usize {
        self.variables.len()
    }

    /// The types of a variable, none below another.
    pub(super) fn types_of(&self, variable: u32) -> &[TypeId] {
        &self.variables[variable as usize].types
    }

    /// Every way to give each of these variables one of its types.
    pub(super) fn typings(&self, variables: &[u32]) -> Result<Vec<Vec<Parameter>>, CompileError> {
        let mut typings: Vec<Vec<Parameter>> = vec![Vec::with_capacity(variables.len())];
        let most = self.world.limits.combinations;
        for &number in variables {
            let Variable { name, types } = &self.variables[number as usize];
            if typings.len().saturating_mul(types.len()) > most {
                let message = format!("the types of its variables can be combined in more than {most} ways");
                return Err(self.error(message).not_supported());
            }
            let with = |typing: &Vec<Parameter>, ty: TypeId| {
                let mut typing = typing.clone();
                typing.push(Parameter { name: name.clone(), ty });
                typing
            };
            typings = typings.iter().flat_map(|typing| types.iter().map(|&ty| with(typing, ty))).collect();
        }
        Ok(typings)
    }

    /// A term over the variables of the block.
    fn term(&self, term: &PddlTerm, visible: &Visible<'_>) -> Result<Term, CompileError> {
        match term {
            PddlTerm::Variable(name) => {
                let found = visible.iter().rev().find(|(other, _)| *other == name);
                let (_, number) = found.ok_or_else(|| self.error(format!("there is no variable `?{name}`")))?;
                Ok(Term::Param(*number))
            }
            PddlTerm::Object(name) if self.world.objects.contains_key(name) => Ok(Term::Const(name.clone())),
            PddlTerm::Object(name) => Err(self.error(format!("there is no object `{name}`"))),
        }
    }

    /// An atom of a function over the variables of the block.
    pub(super) fn function(&self, atom: &PddlAtom, visible: &Visible<'_>) -> Result<LiftedAtom, CompileError> {
        let args = atom.args.iter().map(|term| self.term(term, visible)).collect::<Result<_, _>>()?;
        Ok(Atom { predicate: atom.predicate.clone(), args })
    }

    /// An atom of a predicate over the variables of the block.
    pub(super) fn atom(&self, atom: &PddlAtom, visible: &Visible<'_>) -> Result<LiftedAtom, CompileError> {
        match self.world.predicates.get(&atom.predicate) {
            Some(types) if types.len() == atom.arity() => self.function(atom, visible),
            Some(types) => {
                let (has, takes) = (atom.arity(), types.len());
                Err(self.error(format!("{atom} has {has} arguments, its predicate takes {takes}")))
            }
            None => Err(self.error(format!("there is no predicate `{}`", atom.predicate))),
        }
    }

    /// The negation normal form of a formula, or (not `positive`) of its negation.
    pub(super) fn normal<'f>(
        &mut self,
        formula: &'f Formula,
        positive: bool,
        visible: &mut Visible<'f>,
    ) -> Result<Normal, CompileError> {
        let normal = match formula {
            Formula::Atom(atom) => Normal::Literal(Literal { atom: self.atom(atom, visible)?, positive }),
            Formula::Equal(a, b) => Normal::equality(self.term(a, visible)?, self.term(b, visible)?, positive),
            Formula::Not(inner) => return self.normal(inner, !positive, visible),
            Formula::And(parts) => self.junction(parts, positive, positive, visible)?,
            Formula::Or(parts) => self.junction(parts, !positive, positive, visible)?,
            Formula::Imply(premise, conclusion) => {
                let parts = [self.normal(premise, !positive, visible)?, self.normal(conclusion, positive, visible)?];
                Normal::junction(!positive, parts)
            }
            Formula::Exists(variables, body) => self.quantified(variables, body, !positive, positive, visible)?,
            Formula::Forall(variables, body) => self.quantified(variables, body, positive, positive, visible)?,
        };
        Ok(normal.said_as(|| said(formula, positive, visible)))
    }

    fn junction<'f>(
        &mut self,
        parts: &'f [Formula],
        all: bool,
        positive: bool,
        visible: &mut Visible<'f>,
    ) -> Result<Normal, CompileError> {
        let parts: Vec<Normal> =
            parts.iter().map(|part| self.normal(part, positive, visible)).collect::<Result<_, _>>()?;
        Ok(Normal::junction(all, parts))
    }

    fn quantified<'f>(
        &mut self,
        variables: &'f [Typed],
        body: &'f Formula,
        all: bool,
        positive: bool,
        visible: &mut Visible<'f>,
    ) -> Result<Normal, CompileError> {
        let outside = visible.len();
        let variables = self.declare(variables, visible)?;
        let body = self.normal(body, positive, visible)?;
        visible.truncate(outside);
        Ok(Normal::quantified(all, variables, body))
    }
}
