//! Where an action comes from.

use std::sync::Arc;

use crate::{ClusterKey, GroundAtom, LiftedAtom, Symbol, TypeId};

/// A cluster of observations, as seen from an action that rests on it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Support {
    /// The cluster.
    pub cluster: Arc<ClusterKey>,
    /// For each parameter of the cluster, the parameter of the action it corresponds to.
    pub map: Vec<u32>,
    /// How many observations there were in the cluster.
    pub observations: u64,
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
    Demonstrated(Support),
    /// Generalized from several individual actions, sorted.
    Generalized(Vec<Support>),
    /// Imagined for an atom that could not be reached (Algorithm 2).
    Imagined {
        /// The learned action it raises.
        from: Symbol,
        /// The raised parameters.
        replaced: Vec<Replacement>,
        /// The unreachable atom it was imagined for.
        goal: GroundAtom,
        /// Whether that was to hold; else it was to hold no longer.
        positive: bool,
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
    /// Imagined to work without preconditions that always held. It is used where they do not.
    Loosened {
        /// The learned action.
        from: Symbol,
        /// The preconditions that it does without.
        without: Vec<LiftedAtom>,
        /// Observations behind the learned action; they held in each.
        observations: u64,
    },
}

impl Provenance {
    /// The number of observations behind the action, imagined ones counting those of the action they raise; none behind
    /// a given one.
    pub fn observations(&self) -> u64 {
        match self.imagined() {
            Some((_, _, observations)) => observations,
            None => self.support().iter().map(|support| support.observations).sum(),
        }
    }

    /// The learned action, raised parameters and observations of an action that was imagined, in whatever way.
    pub fn imagined(&self) -> Option<(&Symbol, &[Replacement], u64)> {
        match self {
            Self::Imagined { from, replaced, observations, .. }
            | Self::Substituted { from, replaced, observations, .. } => Some((from, replaced, *observations)),
            Self::Loosened { from, observations, .. } => Some((from, &[], *observations)),
            Self::Given | Self::Demonstrated(_) | Self::Generalized(_) => None,
        }
    }

    /// The preconditions that the learned action has and this one does without.
    pub fn without(&self) -> &[LiftedAtom] {
        match self {
            Self::Loosened { without, .. } => without,
            _ => &[],
        }
    }

    /// The clusters that a learned action rests on.
    pub fn support(&self) -> &[Support] {
        match self {
            Self::Demonstrated(support) => std::slice::from_ref(support),
            Self::Generalized(support) => support,
            Self::Given | Self::Imagined { .. } | Self::Substituted { .. } | Self::Loosened { .. } => &[],
        }
    }
}
