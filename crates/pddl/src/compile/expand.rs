//! Conditions of known objects: quantifiers are written out, and what never changes is decided.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use typelift_model::{GroundAtom, LiftedAtom, Literal, Symbol, Term, TypeId};

use super::block::Block;
use super::error::CompileError;
use super::normal::Normal;
use super::said::Said;

/// What decides.
pub(super) struct Expansion<'e, 'w> {
    block: &'e Block<'w>,
    /// The atoms that hold initially.
    init: &'e BTreeSet<GroundAtom>,
    /// The predicates that change or are derived.
    fluents: &'e BTreeSet<Symbol>,
    /// The objects that may be chosen for each variable.
    choices: Vec<Rc<[Symbol]>>,
    /// The object of each variable of a quantifier that is being written out.
    chosen: Vec<Option<Symbol>>,
    literals: u64,
    /// Whether one is inside of a quantifier that stays.
    inside: bool,
}

impl<'e, 'w> Expansion<'e, 'w> {
    /// For conditions of this block, with these atoms holding initially, of which only those of `fluents` change.
    pub(super) fn new(block: &'e Block<'w>, init: &'e BTreeSet<GroundAtom>, fluents: &'e BTreeSet<Symbol>) -> Self {
        let choices = choices(block);
        let chosen = vec![None; choices.len()];
        Self { block, init, fluents, choices, chosen, literals: 0, inside: false }
    }

    /// The condition, with quantifiers written out unless that is too long.
    pub(super) fn expand(&mut self, condition: &Normal) -> Result<Normal, CompileError> {
        match condition {
            Normal::Literal(literal) => self.literal(literal),
            Normal::And(parts) => self.junction(true, parts),
            Normal::Or(parts, said) => Ok(self.junction(false, parts)?.said_as(|| self.said(said))),
            Normal::Exists(variables, body, said) => {
                Ok(self.quantified(false, variables, body)?.said_as(|| self.said(said)))
            }
            Normal::Forall(variables, body, said) => {
                Ok(self.quantified(true, variables, body)?.said_as(|| self.said(said)))
            }
        }
    }

    /// How the text puts it, with the objects that are chosen.
    fn said(&self, said: &Said) -> Said {
        let mut said = said.as_deref()?.clone();
        for (_, term) in &mut said.variables {
            if let Term::Param(variable) = term
                && let Some(object) = &self.chosen[*variable as usize]
            {
                *term = Term::Const(object.clone());
            }
        }
        Some(Rc::new(said))
    }

    fn junction(&mut self, all: bool, parts: &[Normal]) -> Result<Normal, CompileError> {
        let mut expanded = Vec::with_capacity(parts.len());
        for part in parts {
            let part = self.expand(part)?;
            if part.decided() == Some(!all) {
                return Ok(part);
            }
            expanded.push(part);
        }
        Ok(Normal::junction(all, expanded))
    }

    fn quantified(&mut self, all: bool, variables: &[u32], body: &Normal) -> Result<Normal, CompileError> {
        let literals = self.instances(variables).saturating_mul(self.size(body));
        if self.inside || literals > self.block.world.limits.written_out {
            let outer = std::mem::replace(&mut self.inside, true);
            let body = self.expand(body)?;
            self.inside = outer;
            return Ok(Normal::quantified(all, variables.to_vec(), body));
        }
        let mut parts = Vec::new();
        self.write_out(all, variables, body, &mut parts)?;
        Ok(Normal::junction(all, parts))
    }

    /// Adds the body for every choice of objects for these variables. Stops, and returns that, once a part decides.
    fn write_out(
        &mut self,
        all: bool,
        variables: &[u32],
        body: &Normal,
        parts: &mut Vec<Normal>,
    ) -> Result<bool, CompileError> {
        let Some((first, rest)) = variables.split_first() else {
            let part = self.expand(body)?;
            let decides = part.decided() == Some(!all);
            parts.push(part);
            return Ok(decides);
        };
        for object in self.choices[*first as usize].clone().iter() {
            self.chosen[*first as usize] = Some(object.clone());
            let decided = self.write_out(all, rest, body, parts)?;
            self.chosen[*first as usize] = None;
            if decided {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn literal(&mut self, literal: &Literal) -> Result<Normal, CompileError> {
        self.literals += 1;
        let most = self.block.world.limits.goal;
        if self.literals > most {
            let message = format!("it has more than {most} literals when quantifiers are written out");
            return Err(self.block.error(message).not_supported());
        }
        let atom = literal.atom.map(|term| match term {
            Term::Param(variable) => {
                self.chosen[*variable as usize].as_ref().map_or_else(|| term.clone(), |o| Term::Const(o.clone()))
            }
            object @ Term::Const(_) => object.clone(),
        });
        if let (true, [a, b]) = (atom.is_equality(), atom.args.as_slice()) {
            return Ok(Normal::equality(a.clone(), b.clone(), literal.positive));
        }
        let is_static = !self.fluents.contains(&atom.predicate);
        Ok(match ground(&atom).filter(|_| is_static) {
            Some(atom) => Normal::constant(self.init.contains(&atom) == literal.positive),
            None => Normal::Literal(Literal { atom, positive: literal.positive }),
        })
    }

    /// The number of literals of a condition when it is written out.
    fn size(&self, condition: &Normal) -> u64 {
        match condition {
            Normal::Literal(_) => 1,
            Normal::And(parts) | Normal::Or(parts, _) => {
                parts.iter().fold(1, |sum: u64, part| sum.saturating_add(self.size(part)))
            }
            Normal::Exists(variables, body, _) | Normal::Forall(variables, body, _) => {
                self.instances(variables).saturating_mul(self.size(body)).max(1)
            }
        }
    }

    /// The number of choices of objects for these variables.
    fn instances(&self, variables: &[u32]) -> u64 {
        let objects = |variable: &u32| self.choices[*variable as usize].len() as u64;
        variables.iter().map(objects).fold(1, u64::saturating_mul)
    }
}

/// The objects that may be chosen for each variable of a block.
fn choices(block: &Block<'_>) -> Vec<Rc<[Symbol]>> {
    let hierarchy = block.world.hierarchy;
    let mut of_types: BTreeMap<&[TypeId], Rc<[Symbol]>> = BTreeMap::new();
    let of_variable = |variable: u32| {
        let types = block.types_of(variable);
        let fits = |ty: TypeId| types.iter().any(|&of| hierarchy.is_a(ty, of));
        let objects = || block.world.objects.iter().filter(|(_, ty)| fits(**ty)).map(|(name, _)| name.clone());
        of_types.entry(types).or_insert_with(|| objects().collect()).clone()
    };
    (0..block.number_of_variables() as u32).map(of_variable).collect()
}

/// The atom, if it mentions no variable.
pub(super) fn ground(atom: &LiftedAtom) -> Option<GroundAtom> {
    let object = |term: &Term| match term {
        Term::Const(name) => Some(name.clone()),
        Term::Param(_) => None,
    };
    let args = atom.args.iter().map(object).collect::<Option<_>>()?;
    Some(GroundAtom { predicate: atom.predicate.clone(), args })
}
