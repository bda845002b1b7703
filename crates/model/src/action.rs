//! Lifted and ground actions.

use std::collections::BTreeMap;
use std::fmt;

use crate::{
    GroundAtom, GroundCall, Hierarchy, Imagined, LiftedAtom, LiftedCall, Provenance, Step, Symbol, Term, TypeId,
};

/// A typed placeholder of an [`ActionSchema`].
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Parameter {
    /// Its name, without the question mark; unique within the action.
    pub name: Symbol,
    /// The type that an object put in its place must have or lie below.
    pub ty: TypeId,
}

/// A lifted atom or its negation.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Literal {
    /// The atom.
    pub atom: LiftedAtom,
    /// Whether it is the atom itself (`true`) or its negation.
    pub positive: bool,
}

impl Literal {
    /// The atom itself.
    pub fn positive(atom: LiftedAtom) -> Self {
        Self { atom, positive: true }
    }

    /// Its negation.
    pub fn negative(atom: LiftedAtom) -> Self {
        Self { atom, positive: false }
    }
}

impl fmt::Display for Literal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.positive {
            f.write_str("not ")?;
        }
        fmt::Display::fmt(&self.atom, f)
    }
}

impl fmt::Debug for Literal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// One effect: the literal that holds afterwards, if the condition held before.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Effect {
    /// Literals that must hold before; empty for an unconditional effect, as all learned ones are.
    pub condition: Vec<Literal>,
    /// An add effect if positive, else a delete effect.
    pub literal: Literal,
    /// Placeholders of its own, for each choice of which it happens; numbered after the action's parameters. Learned
    /// effects have none.
    pub parameters: Vec<Parameter>,
}

impl Effect {
    /// An unconditional effect.
    pub fn always(literal: Literal) -> Self {
        Self::when(Vec::new(), literal)
    }

    /// An effect with a condition.
    pub fn when(condition: Vec<Literal>, literal: Literal) -> Self {
        Self { condition, literal, parameters: Vec::new() }
    }

    /// Whether it depends on nothing.
    pub fn is_unconditional(&self) -> bool {
        self.condition.is_empty() && self.parameters.is_empty()
    }
}

/// What an action costs: a fixed part, and values that the task gives for objects, as the length of a road.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cost {
    /// The fixed part.
    pub fixed: u32,
    /// Functions whose values are added. Where the task gives none, the action cannot be used.
    pub functions: Vec<LiftedAtom>,
}

impl Cost {
    /// The cost of learned actions.
    pub const UNIT: Self = Self { fixed: 1, functions: Vec::new() };

    /// The cost with these objects in place of the parameters; `None` where a function has no value. Sums stop at the
    /// largest number.
    pub fn of(&self, objects: &[Symbol], values: &BTreeMap<GroundAtom, u32>) -> Option<u32> {
        self.functions.iter().try_fold(self.fixed, |sum, function| {
            let value = values.get(&function.map(|term| term.object(objects)))?;
            Some(sum.saturating_add(*value))
        })
    }
}

impl From<u32> for Cost {
    fn from(fixed: u32) -> Self {
        Self { fixed, functions: Vec::new() }
    }
}

/// A lifted action.
///
/// Parameters may stand for the same object unless `distinct` says otherwise; learned actions list every pair.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ActionSchema {
    /// A unique, readable name: the call's name and the types that tell the action apart, as `PLACE-tool-food`.
    pub name: Symbol,
    /// What the environment is told.
    pub call: LiftedCall,
    /// The typed parameters.
    pub parameters: Vec<Parameter>,
    /// Literals that must hold before, sorted.
    pub preconditions: Vec<Literal>,
    /// Pairs of parameters that must stand for different objects, each with the smaller index first, sorted.
    pub distinct: Vec<(u32, u32)>,
    /// What it changes, sorted.
    pub effects: Vec<Effect>,
    /// Its cost; 1 for learned actions.
    pub cost: Cost,
    /// Whether every add effect was a change whenever it was observed, so that [`strict`](crate::strict) may ask for its
    /// atom to be false before.
    pub strict: bool,
    /// Whether plan files name it by its call, as PDDL does, and not by its own name with all of its parameters. Only
    /// where a call has one effect is the call enough.
    pub named_by_call: bool,
    /// Where it comes from.
    pub provenance: Provenance,
}

impl ActionSchema {
    /// The lifted atoms that it adds, in order, whatever the condition.
    pub fn adds(&self) -> impl Iterator<Item = &LiftedAtom> {
        self.effects.iter().filter(|e| e.literal.positive).map(|e| &e.literal.atom)
    }

    /// The lifted atoms that it deletes, in order, whatever the condition.
    pub fn deletes(&self) -> impl Iterator<Item = &LiftedAtom> {
        self.effects.iter().filter(|e| !e.literal.positive).map(|e| &e.literal.atom)
    }

    /// Its positive preconditions.
    pub fn positive_preconditions(&self) -> impl Iterator<Item = &LiftedAtom> {
        self.preconditions.iter().filter(|l| l.positive).map(|l| &l.atom)
    }

    /// Every pair of its parameters, as [`distinct`](Self::distinct) wants them.
    pub fn all_distinct(parameters: usize) -> Vec<(u32, u32)> {
        let n = parameters as u32;
        (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect()
    }

    /// The mean depth of its parameters' types: the larger, the more specific it is.
    /// As `(sum, count)`, so that it can be compared exactly.
    pub fn specificity(&self, hierarchy: &Hierarchy) -> (u64, u64) {
        let sum = self.parameters.iter().map(|p| u64::from(hierarchy.depth(p.ty))).sum();
        (sum, self.parameters.len().max(1) as u64)
    }

    /// How a plan file names the action: by its [call](Self::named_by_call), or by its own name and all of its
    /// parameters, since one call may have several effects.
    pub fn signature(&self) -> LiftedCall {
        if self.named_by_call {
            return self.call.clone();
        }
        LiftedCall { name: self.name.clone(), args: (0..self.parameters.len() as u32).map(Term::Param).collect() }
    }

    /// The step of a plan that this action is with these objects in place of its parameters, at this cost.
    ///
    /// # Panics
    /// If there are fewer objects than parameters.
    pub fn step(&self, objects: Vec<Symbol>, cost: u32) -> Step {
        let imagined = self.provenance.imagined().map(|(from, replaced, observations)| Imagined {
            from: from.clone(),
            replaced: replaced.to_vec(),
            without: self.provenance.without().iter().map(|atom| atom.map(|term| term.object(&objects))).collect(),
            observations,
        });
        let call = GroundCall {
            name: self.call.name.clone(),
            args: self.call.args.iter().map(|term| term.object(&objects)).collect(),
        };
        Step { action: self.name.clone(), call, objects, cost, imagined }
    }
}
