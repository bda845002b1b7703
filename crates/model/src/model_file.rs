//! The model's file: versioned, self-contained JSON, in which everything is written by name. Its reader is the next
//! file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::evidence_file::EvidenceFile;
use crate::{
    ActionSchema, Axiom, ClusterKey, Effect, GroundAtom, Hierarchy, LearnOptions, LearnedModel, LiftedAtom, Literal,
    MODEL_FORMAT, ModelFileError, Parameter, ParseConfig, Provenance, RefusedMerges, Replacement, Support, Symbol,
    TypeId,
};

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct ModelFile {
    /// The format and its version.
    #[cfg_attr(feature = "schema", schemars(extend("const" = MODEL_FORMAT)))]
    pub(crate) format: String,
    /// The name of the PDDL domain that declares the types.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) domain: Option<Symbol>,
    /// `[child, parent]` pairs, parents first.
    pub(crate) types: Vec<(Symbol, Symbol)>,
    /// The types of each predicate's arguments.
    pub(crate) predicates: BTreeMap<Symbol, Vec<Symbol>>,
    /// The types of the arguments of each predicate that the PDDL domain declares, demonstrated or not.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(crate) declared_predicates: BTreeMap<Symbol, Vec<Symbol>>,
    #[serde(default)]
    pub(crate) parse: ParseConfig,
    /// What was asked of learning.
    #[serde(default)]
    pub(crate) options: LearnOptions,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) actor: Option<Symbol>,
    /// Objects that every task has, with their types.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(crate) constants: BTreeMap<Symbol, Symbol>,
    pub(crate) actions: Vec<ActionFile>,
    /// How derived predicates follow.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) axioms: Vec<AxiomFile>,
    #[serde(default)]
    pub(crate) evidence: EvidenceFile,
    /// Pairs of actions that could be merged and are not, since failures speak against it.
    #[serde(default, skip_serializing_if = "RefusedMerges::is_none")]
    pub(crate) refused_merges: RefusedMerges,
    /// PDDL names, by the model's names; written for other tools, made anew when the model is read.
    #[serde(default)]
    pub(crate) pddl: PddlFile,
}

#[derive(Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct PddlFile {
    types: BTreeMap<Symbol, Symbol>,
    predicates: BTreeMap<Symbol, Symbol>,
    actions: BTreeMap<Symbol, Symbol>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct ActionFile {
    pub(crate) name: Symbol,
    pub(crate) call: CallFile,
    /// `[name, type]` pairs.
    pub(crate) parameters: Vec<(Symbol, Symbol)>,
    #[serde(default)]
    pub(crate) preconditions: Vec<LiteralFile>,
    #[serde(default)]
    pub(crate) distinct: Vec<(u32, u32)>,
    #[serde(default)]
    pub(crate) effects: Vec<EffectFile>,
    #[serde(default = "one")]
    pub(crate) cost: u32,
    /// Functions of the task whose values are added to the cost.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) cost_functions: Vec<LiftedAtom>,
    /// Whether every add effect was a change whenever it was observed.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) strict: bool,
    /// Whether plan files name it by its call.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) named_by_call: bool,
    pub(crate) provenance: ProvenanceFile,
}

fn one() -> u32 {
    1
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct CallFile {
    pub(crate) name: Symbol,
    /// `?0` for a parameter, else a constant.
    pub(crate) args: Vec<String>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum LiteralFile {
    Not(LiftedAtom),
    #[serde(untagged)]
    Is(LiftedAtom),
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub(crate) enum EffectFile {
    When {
        /// `[name, type]` pairs; it happens for each choice of objects. Numbered after the action's parameters.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        forall: Vec<(Symbol, Symbol)>,
        when: Vec<LiteralFile>,
        then: LiteralFile,
    },
    Always(LiteralFile),
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct AxiomFile {
    pub(crate) stratum: u32,
    pub(crate) head: LiftedAtom,
    /// `[name, type]` pairs.
    pub(crate) parameters: Vec<(Symbol, Symbol)>,
    pub(crate) body: Vec<LiteralFile>,
}

/// What is not said to be deleted was to hold.
const fn to_hold() -> bool {
    true
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum ProvenanceFile {
    Given,
    /// The cluster's number in `evidence`, from 0, and the action's parameter for each of the cluster's.
    Demonstrated(SupportFile),
    Generalized(Vec<SupportFile>),
    Imagined {
        from: Symbol,
        replaced: Vec<(u32, Symbol, Symbol)>,
        goal: GroundAtom,
        /// Whether it is imagined for an atom that was to hold; else for one that was to hold no longer.
        #[serde(default = "to_hold", skip_serializing_if = "Clone::clone")]
        positive: bool,
        observations: u64,
    },
    Substituted {
        from: Symbol,
        replaced: Vec<(u32, Symbol, Symbol)>,
        following: Symbol,
        observations: u64,
    },
    Loosened {
        from: Symbol,
        without: Vec<LiftedAtom>,
        observations: u64,
    },
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct SupportFile {
    pub(crate) cluster: usize,
    pub(crate) map: Vec<u32>,
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for LearnedModel {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Model".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        ModelFile::json_schema(generator)
    }
}

impl LearnedModel {
    /// The model as JSON text, ending in a line feed; equal models give equal bytes.
    ///
    /// # Errors
    /// [`ModelFileError::Collision`] if its names collide in PDDL, [`ModelFileError::Inconsistent`] if an action rests on
    /// other observations than those of the evidence.
    pub fn to_json(&self) -> Result<String, ModelFileError> {
        let model = &self.model;
        let names = model.pddl_names()?;
        let total = self.evidence.total();
        for action in &model.actions {
            let known = |s: &Support| total.clusters.get(&*s.cluster).map(|cluster| cluster.count);
            if action.provenance.support().iter().any(|s| known(s) != Some(s.observations)) {
                let message = "it rests on observations that are not in the evidence".to_owned();
                return Err(ModelFileError::Inconsistent { place: format!("action {}", action.name), message });
            }
        }
        let map = |names: &crate::PddlNames| names.iter().map(|(n, p)| (n.clone(), p.clone())).collect();
        let names_of = |types: &[TypeId]| types.iter().map(|ty| model.hierarchy.name(*ty).clone()).collect();
        let named = |(name, types): (&Symbol, &Vec<TypeId>)| (name.clone(), names_of(types));
        let clusters: Vec<&ClusterKey> = total.clusters.keys().collect();
        let file = ModelFile {
            format: MODEL_FORMAT.to_owned(),
            domain: self.domain.clone(),
            types: model.hierarchy.edges().map(|(c, p)| (c.clone(), p.clone())).collect(),
            predicates: model.predicates.iter().map(named).collect(),
            declared_predicates: self.declared_predicates.iter().map(named).collect(),
            parse: self.parse.clone(),
            options: self.options.clone(),
            actor: model.actor.map(|ty| model.hierarchy.name(ty).clone()),
            constants: model.constants.iter().map(|(n, ty)| (n.clone(), model.hierarchy.name(*ty).clone())).collect(),
            axioms: model.axioms.iter().map(|a| write_axiom(a, &model.hierarchy)).collect(),
            actions: model.actions.iter().map(|a| write_action(a, &model.hierarchy, &clusters)).collect(),
            evidence: EvidenceFile::of(&self.evidence, &total),
            refused_merges: self.refused,
            pddl: PddlFile {
                types: map(&names.types),
                predicates: map(&names.predicates),
                actions: map(&names.actions),
            },
        };
        let mut text = serde_json::to_string_pretty(&file).unwrap_or_default();
        text.push('\n');
        Ok(text)
    }
}

fn write_literal(literal: &Literal) -> LiteralFile {
    if literal.positive { LiteralFile::Is(literal.atom.clone()) } else { LiteralFile::Not(literal.atom.clone()) }
}

fn write_parameters(parameters: &[Parameter], hierarchy: &Hierarchy) -> Vec<(Symbol, Symbol)> {
    parameters.iter().map(|p| (p.name.clone(), hierarchy.name(p.ty).clone())).collect()
}

fn write_axiom(axiom: &Axiom, hierarchy: &Hierarchy) -> AxiomFile {
    AxiomFile {
        stratum: axiom.stratum,
        head: axiom.head.clone(),
        parameters: write_parameters(&axiom.parameters, hierarchy),
        body: axiom.body.iter().map(write_literal).collect(),
    }
}

fn write_action(action: &ActionSchema, hierarchy: &Hierarchy, clusters: &[&ClusterKey]) -> ActionFile {
    let support = |s: &Support| SupportFile {
        cluster: clusters.binary_search(&&*s.cluster).expect("checked before writing"),
        map: s.map.clone(),
    };
    let replaced = |list: &[Replacement]| {
        list.iter().map(|r| (r.parameter, hierarchy.name(r.from).clone(), hierarchy.name(r.to).clone())).collect()
    };
    let provenance = match &action.provenance {
        Provenance::Given => ProvenanceFile::Given,
        Provenance::Demonstrated(s) => ProvenanceFile::Demonstrated(support(s)),
        Provenance::Generalized(s) => ProvenanceFile::Generalized(s.iter().map(support).collect()),
        Provenance::Imagined { from, replaced: r, goal, positive, observations } => ProvenanceFile::Imagined {
            from: from.clone(),
            replaced: replaced(r),
            goal: goal.clone(),
            positive: *positive,
            observations: *observations,
        },
        Provenance::Substituted { from, replaced: r, following, observations } => ProvenanceFile::Substituted {
            from: from.clone(),
            replaced: replaced(r),
            following: following.clone(),
            observations: *observations,
        },
        Provenance::Loosened { from, without, observations } => {
            ProvenanceFile::Loosened { from: from.clone(), without: without.clone(), observations: *observations }
        }
    };
    let effect = |e: &Effect| match e.is_unconditional() {
        true => EffectFile::Always(write_literal(&e.literal)),
        false => EffectFile::When {
            forall: write_parameters(&e.parameters, hierarchy),
            when: e.condition.iter().map(write_literal).collect(),
            then: write_literal(&e.literal),
        },
    };
    ActionFile {
        name: action.name.clone(),
        call: CallFile {
            name: action.call.name.clone(),
            args: action.call.args.iter().map(ToString::to_string).collect(),
        },
        parameters: write_parameters(&action.parameters, hierarchy),
        preconditions: action.preconditions.iter().map(write_literal).collect(),
        distinct: action.distinct.clone(),
        effects: action.effects.iter().map(effect).collect(),
        cost: action.cost.fixed,
        cost_functions: action.cost.functions.clone(),
        strict: action.strict,
        named_by_call: action.named_by_call,
        provenance,
    }
}
