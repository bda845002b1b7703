//! What learning makes: a model with what it was learned from.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::pddl_names::folded;
use crate::{ActionModel, ArgumentTypes, Evidence, Hierarchy, ParseConfig, Symbol};

/// A model, how the states it speaks of were read, and the evidence it rests on. Plans need the
/// [model](Self::model) alone; the rest is for reading more states and for learning more.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LearnedModel {
    /// What plans are made with.
    pub model: ActionModel,
    /// The name of the PDDL domain that declares its types, if it is known.
    pub domain: Option<Symbol>,
    /// The predicates that this domain declares. The model has those of them, too, that no demonstration showed.
    pub declared_predicates: ArgumentTypes,
    /// How snapshots are read.
    pub parse: ParseConfig,
    /// What was asked of learning.
    pub options: LearnOptions,
    /// What the actions rest on.
    pub evidence: Evidence,
    /// What was not merged.
    pub refused: RefusedMerges,
}

/// Pairs of actions that could be merged and are not. It follows from the evidence, and is kept so that it need not be
/// learned again to be told of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RefusedMerges {
    /// Pairs of actions of the model that could be merged and are not.
    pub pairs: usize,
    /// Failures that at least one of these merges would have allowed; each counts once, whichever would have.
    pub failures: u64,
}

impl RefusedMerges {
    /// Whether there are none.
    pub fn is_none(&self) -> bool {
        self.pairs == 0
    }
}

/// What is learned, and how.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LearnOptions {
    /// Stop after the first phase: individual actions, the paper's baseline.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub individual: bool,
    /// The type of the actor. `None`: the type that was seen as argument 0 of every action and in no other part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub actor: Option<Actor>,
}

/// A declared actor.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Actor {
    /// Objects of this type act.
    Type(Symbol),
    /// No object of the state acts.
    Nobody,
}

/// Where demonstrations were read otherwise than those that a model was learned from, so that they do not add up.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}", self.between("the model", "the types given"))]
pub enum Disagreement {
    /// The first type that is not in both hierarchies, or lies elsewhere.
    Type {
        /// The type.
        ty: Symbol,
        /// Its parents in the model.
        model: BTreeSet<Symbol>,
        /// Its parents in the other hierarchy.
        given: BTreeSet<Symbol>,
    },
    /// The first attribute or relation that only one of them ignores.
    Ignored {
        /// What to ignore.
        name: Symbol,
        /// Whether it is the model that ignores it.
        by_model: bool,
    },
}

impl Disagreement {
    /// The same in words, where the model and what it was compared with are called so.
    pub fn between(&self, model: &str, given: &str) -> String {
        match self {
            Self::Type { ty, model: own, given: other } => {
                format!("the type `{ty}` lies {} in {model} and {} in {given}", place(own), place(other))
            }
            Self::Ignored { name, by_model } => {
                format!("`{name}` is {} by {model}", if *by_model { "ignored" } else { "not ignored" })
            }
        }
    }
}

fn place(parents: &BTreeSet<Symbol>) -> String {
    let parents: Vec<String> = parents.iter().map(|parent| format!("`{parent}`")).collect();
    if parents.is_empty() { "nowhere".to_owned() } else { format!("below {}", parents.join(" and ")) }
}

impl LearnedModel {
    /// Adds to the model the predicates that its domain declares and no demonstration showed. Of one that was shown, the
    /// model keeps the types that were seen.
    pub fn declare(&mut self, predicates: ArgumentTypes) {
        self.declared_predicates = predicates;
        for name in self.undemonstrated() {
            let types = self.declared_predicates.get(&name).cloned().unwrap_or_default();
            self.model.predicates.insert(name, types);
        }
    }

    /// The predicates that the domain declares and no demonstration showed, in the order of their names. What is one name
    /// in PDDL is one here.
    pub fn undemonstrated(&self) -> BTreeSet<Symbol> {
        let total = self.evidence.total();
        let shown: BTreeSet<Symbol> = total.predicates.keys().map(|(name, _)| folded(name.as_str())).collect();
        self.declared_predicates.keys().filter(|name| !shown.contains(&folded(name.as_str()))).cloned().collect()
    }

    /// That states read with this hierarchy and in this way are of the kind that the model was learned from.
    ///
    /// # Errors
    /// [`Disagreement`]: the first, in alphabetical order.
    pub fn agrees(&self, hierarchy: &Hierarchy, parse: &ParseConfig) -> Result<(), Disagreement> {
        let own = &self.model.hierarchy;
        let parents = |h: &Hierarchy, name: &Symbol| {
            let names = h.id(name.as_str()).map(|ty| h.parents(ty)).unwrap_or_default().iter().map(|&ty| h.name(ty));
            names.cloned().collect::<BTreeSet<Symbol>>()
        };
        let mut names: Vec<&Symbol> = own.edges().chain(hierarchy.edges()).map(|(child, _)| child).collect();
        names.sort_unstable();
        for ty in names {
            let (model, given) = (parents(own, ty), parents(hierarchy, ty));
            if model != given {
                return Err(Disagreement::Type { ty: ty.clone(), model, given });
            }
        }
        match self.parse.ignore.symmetric_difference(&parse.ignore).next() {
            Some(name) => Err(Disagreement::Ignored { name: name.clone(), by_model: self.parse.ignore.contains(name) }),
            None => Ok(()),
        }
    }
}

impl From<ActionModel> for LearnedModel {
    /// A model that was stated, and rests on nothing.
    fn from(model: ActionModel) -> Self {
        Self { model, ..Self::default() }
    }
}
