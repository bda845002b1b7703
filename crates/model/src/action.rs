//! Lifted and ground actions.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{ClusterKey, GroundAtom, Hierarchy, Imagined, LiftedAtom, State, Step, Symbol, Term, TypeId};

/// A typed placeholder of an [`ActionSchema`].
#[derive(Debug, Clone, PartialEq, Eq)]
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
}

impl Effect {
    /// An unconditional effect.
    pub fn always(literal: Literal) -> Self {
        Self { condition: Vec::new(), literal }
    }
}

/// What the environment is told when a lifted action is executed: its name, and its arguments as terms.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct LiftedCall {
    /// The action's name in the environment.
    pub name: Symbol,
    /// The arguments in the demonstrated order.
    pub args: Vec<Term>,
}

/// An action as the environment knows it (paper: the action description a_d): `PICK(agent_1, counter_3, lettuce_1)`.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GroundCall {
    /// The action's name.
    pub name: Symbol,
    /// The entities it is applied to.
    pub args: Vec<Symbol>,
}

impl fmt::Display for GroundCall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}(", self.name)?;
        for (i, arg) in self.args.iter().enumerate() {
            write!(f, "{}{arg}", if i > 0 { ", " } else { "" })?;
        }
        f.write_str(")")
    }
}

impl fmt::Debug for GroundCall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// A cluster of observations, as seen from an action that rests on it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The cluster.
    pub cluster: ClusterKey,
    /// For each parameter of the cluster, the parameter of the action it corresponds to.
    pub map: Vec<u32>,
}

/// A parameter whose type was raised.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Replacement {
    /// The parameter's index.
    pub parameter: u32,
    /// The type it had.
    pub from: TypeId,
    /// The type it has.
    pub to: TypeId,
}

/// Where an action comes from: the answer to "why?".
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Provenance {
    /// Written by somebody, as in a PDDL domain.
    Given,
    /// Learned from one cluster of observations (an *individual* action).
    Demonstrated(Source),
    /// Generalized from several individual actions, sorted.
    Generalized(Vec<Source>),
    /// Imagined for an atom that could not be reached (Algorithm 2).
    Imagined {
        /// The learned action it raises.
        from: Symbol,
        /// The raised parameters.
        replaced: Vec<Replacement>,
        /// The unreachable atom it was imagined for.
        goal: GroundAtom,
        /// Observations behind the learned action.
        observations: u64,
    },
    /// Made to follow an imagined action, taking over its replacements.
    Substituted {
        /// The learned action it raises.
        from: Symbol,
        /// The raised parameters.
        replaced: Vec<Replacement>,
        /// The imagined action it follows.
        following: Symbol,
        /// Observations behind the learned action.
        observations: u64,
    },
}

impl Provenance {
    /// The learned action, raised parameters and observations of an imagined or substituted action.
    pub fn imagined(&self) -> Option<(&Symbol, &[Replacement], u64)> {
        match self {
            Self::Imagined { from, replaced, observations, .. }
            | Self::Substituted { from, replaced, observations, .. } => Some((from, replaced, *observations)),
            Self::Given | Self::Demonstrated(_) | Self::Generalized(_) => None,
        }
    }

    /// The clusters that a learned action rests on.
    pub fn sources(&self) -> &[Source] {
        match self {
            Self::Demonstrated(source) => std::slice::from_ref(source),
            Self::Generalized(sources) => sources,
            Self::Given | Self::Imagined { .. } | Self::Substituted { .. } => &[],
        }
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
    pub cost: u32,
    /// Where it comes from.
    pub provenance: Provenance,
}

/// Why an action schema and a list of objects do not make a ground action.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InstantiateError {
    /// The number of objects is not the number of parameters.
    #[error("{action} takes {expected} objects, not {found}")]
    Arity {
        /// The action's name.
        action: Symbol,
        /// Its number of parameters.
        expected: usize,
        /// The number of objects given.
        found: usize,
    },
    /// An object that the state does not have.
    #[error("there is no object `{object}`")]
    UnknownObject {
        /// The object's name.
        object: Symbol,
    },
    /// An object of the wrong type.
    #[error("{object} is of type {found}, where {action} takes one of type {expected}")]
    Type {
        /// The action's name.
        action: Symbol,
        /// The object's name.
        object: Symbol,
        /// The parameter's type.
        expected: Symbol,
        /// The object's type.
        found: Symbol,
    },
    /// One object for two parameters that must differ.
    #[error("{action} takes different objects where both are {object}")]
    NotDistinct {
        /// The action's name.
        action: Symbol,
        /// The object's name.
        object: Symbol,
    },
}

/// A ground action whose conditional effects were resolved in the state it was made for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GroundAction {
    /// The schema's name.
    pub schema: Symbol,
    /// The objects put in place of the parameters, in order.
    pub objects: Vec<Symbol>,
    /// What the environment is told.
    pub call: GroundCall,
    /// Preconditions: an atom, and whether it must hold.
    pub preconditions: Vec<(GroundAtom, bool)>,
    /// Atoms that it adds, sorted.
    pub adds: Vec<GroundAtom>,
    /// Atoms that it deletes and does not add, sorted.
    pub deletes: Vec<GroundAtom>,
}

impl GroundAction {
    /// The preconditions that do not hold in `state`. An unknown atom counts as not holding.
    pub fn unmet<'a>(&'a self, state: &'a State) -> impl Iterator<Item = &'a (GroundAtom, bool)> {
        self.preconditions.iter().filter(|(atom, positive)| state.holds(atom) != *positive)
    }
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

    /// The step of a plan that this action is with these objects in place of its parameters.
    ///
    /// # Panics
    /// If there are fewer objects than parameters.
    pub fn step(&self, objects: Vec<Symbol>) -> Step {
        let imagined = self.provenance.imagined().map(|(from, replaced, observations)| Imagined {
            from: from.clone(),
            replaced: replaced.to_vec(),
            observations,
        });
        let call = GroundCall {
            name: self.call.name.clone(),
            args: self.call.args.iter().map(|term| term.object(&objects)).collect(),
        };
        Step { action: self.name.clone(), call, objects, cost: self.cost, imagined }
    }

    /// Puts objects in place of the parameters. Conditional effects are resolved in `state`; preconditions are not
    /// checked.
    ///
    /// # Errors
    /// [`InstantiateError`] if number, type or distinctness of the objects does not fit.
    pub fn instantiate(
        &self,
        objects: &[Symbol],
        state: &State,
        hierarchy: &Hierarchy,
    ) -> Result<GroundAction, InstantiateError> {
        if objects.len() != self.parameters.len() {
            return Err(InstantiateError::Arity {
                action: self.name.clone(),
                expected: self.parameters.len(),
                found: objects.len(),
            });
        }
        for (object, parameter) in objects.iter().zip(&self.parameters) {
            let ty =
                *state.objects.get(object).ok_or_else(|| InstantiateError::UnknownObject { object: object.clone() })?;
            if !hierarchy.is_a(ty, parameter.ty) {
                return Err(InstantiateError::Type {
                    action: self.name.clone(),
                    object: object.clone(),
                    expected: hierarchy.name(parameter.ty).clone(),
                    found: hierarchy.name(ty).clone(),
                });
            }
        }
        for &(i, j) in &self.distinct {
            if objects[i as usize] == objects[j as usize] {
                return Err(InstantiateError::NotDistinct {
                    action: self.name.clone(),
                    object: objects[i as usize].clone(),
                });
            }
        }
        let term = |term: &Term| term.object(objects);
        let mut changes: BTreeMap<GroundAtom, bool> = BTreeMap::new();
        for effect in &self.effects {
            if effect.condition.iter().all(|l| state.holds(&l.atom.map(term)) == l.positive) {
                let added = changes.entry(effect.literal.atom.map(term)).or_default();
                *added |= effect.literal.positive;
            }
        }
        let select = |added: bool| changes.iter().filter(|(_, a)| **a == added).map(|(atom, _)| atom.clone()).collect();
        Ok(GroundAction {
            schema: self.name.clone(),
            objects: objects.to_vec(),
            call: GroundCall { name: self.call.name.clone(), args: self.call.args.iter().map(term).collect() },
            preconditions: self.preconditions.iter().map(|l| (l.atom.map(term), l.positive)).collect(),
            adds: select(true),
            deletes: select(false),
        })
    }
}
