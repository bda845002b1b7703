//! The model's file: versioned, self-contained JSON, in which everything is written by name.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::{
    ActionModel, ActionSchema, AtomTextError, Cluster, ClusterKey, Effect, Evidence, GroundAtom, Hierarchy,
    HierarchyError, LiftedAtom, LiftedCall, Literal, NameCollision, NegativeKey, Parameter, ParseConfig, Provenance,
    Replacement, Source, Symbol, Term, TypeId, Unexplained, Witness,
};

/// The format that this version reads and writes.
pub const MODEL_FORMAT: &str = "model/1";

/// Why a text is not a model.
#[derive(Debug, Error)]
pub enum ModelFileError {
    /// It is not JSON, or not of the right shape.
    #[error("line {line}, column {column}: {message}")]
    Json {
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// It is of another version.
    #[error("this is a file of format `{found}`; this version of typelift reads `{MODEL_FORMAT}`")]
    Version {
        /// The format it names.
        found: String,
    },
    /// It does not say what it is.
    #[error("there is no \"format\":\"{MODEL_FORMAT}\": this is not a model file")]
    NoFormat,
    /// Its types are not a tree.
    #[error("\"types\": {0}")]
    Hierarchy(#[from] HierarchyError),
    /// It names a type that it does not have.
    #[error("{place}: unknown type `{name}`")]
    UnknownType {
        /// Where.
        place: String,
        /// The type's name.
        name: Symbol,
    },
    /// An action refers to a parameter, cluster or name that it does not have, or twice to one.
    #[error("{place}: {message}")]
    Inconsistent {
        /// Where.
        place: String,
        /// What is wrong.
        message: String,
    },
    /// Its names collide in PDDL.
    #[error(transparent)]
    Collision(#[from] NameCollision),
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct ModelFile {
    format: String,
    /// `[child, parent]` pairs, parents first.
    types: Vec<(Symbol, Symbol)>,
    predicates: BTreeMap<Symbol, usize>,
    #[serde(default)]
    parse: ParseConfig,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    actor: Option<Symbol>,
    actions: Vec<ActionFile>,
    #[serde(default)]
    evidence: EvidenceFile,
    /// PDDL names, by the model's names; written for other tools, made anew when the model is read.
    #[serde(default)]
    pddl: PddlFile,
}

#[derive(Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct PddlFile {
    types: BTreeMap<Symbol, Symbol>,
    predicates: BTreeMap<Symbol, Symbol>,
    actions: BTreeMap<Symbol, Symbol>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct ActionFile {
    name: Symbol,
    call: CallFile,
    /// `[name, type]` pairs.
    parameters: Vec<(Symbol, Symbol)>,
    #[serde(default)]
    preconditions: Vec<LiteralFile>,
    #[serde(default)]
    distinct: Vec<(u32, u32)>,
    #[serde(default)]
    effects: Vec<EffectFile>,
    #[serde(default = "one")]
    cost: u32,
    provenance: ProvenanceFile,
}

fn one() -> u32 {
    1
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct CallFile {
    name: Symbol,
    /// `?0` for a parameter, else a constant.
    args: Vec<String>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
enum LiteralFile {
    Not(LiftedAtom),
    #[serde(untagged)]
    Is(LiftedAtom),
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
enum EffectFile {
    When { when: Vec<LiteralFile>, then: LiteralFile },
    Always(LiteralFile),
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
enum ProvenanceFile {
    Given,
    /// The cluster's number in `evidence`, and the action's parameter for each of the cluster's.
    Demonstrated(SourceFile),
    Generalized(Vec<SourceFile>),
    Imagined {
        from: Symbol,
        replaced: Vec<(u32, Symbol, Symbol)>,
        goal: GroundAtom,
        observations: u64,
    },
    Substituted {
        from: Symbol,
        replaced: Vec<(u32, Symbol, Symbol)>,
        following: Symbol,
        observations: u64,
    },
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct SourceFile {
    cluster: usize,
    map: Vec<u32>,
}

#[derive(Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct EvidenceFile {
    #[serde(default)]
    transitions: u64,
    #[serde(default)]
    clusters: Vec<ClusterFile>,
    #[serde(default)]
    negatives: Vec<NegativeFile>,
    #[serde(default)]
    unexplained: Vec<UnexplainedFile>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct ClusterFile {
    #[serde(flatten)]
    key: ClusterKey,
    #[serde(flatten)]
    cluster: Cluster,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct NegativeFile {
    #[serde(flatten)]
    key: NegativeKey,
    #[serde(flatten)]
    cluster: Cluster,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct UnexplainedFile {
    reason: Unexplained,
    count: u64,
    witnesses: BTreeSet<Witness>,
}

impl ActionModel {
    /// The model as JSON text, ending in a line feed; equal models give equal bytes.
    ///
    /// # Errors
    /// [`ModelFileError::Collision`] if its names collide in PDDL.
    ///
    /// # Panics
    /// If an action refers to a cluster that is not in the evidence: learners never make such a model.
    pub fn to_json(&self) -> Result<String, ModelFileError> {
        let names = self.pddl_names()?;
        let map = |names: &crate::PddlNames| names.iter().map(|(n, p)| (n.clone(), p.clone())).collect();
        let clusters: Vec<&ClusterKey> = self.evidence.clusters.keys().collect();
        let file = ModelFile {
            format: MODEL_FORMAT.to_owned(),
            types: self.hierarchy.edges().map(|(c, p)| (c.clone(), p.clone())).collect(),
            predicates: self.predicates.clone(),
            parse: self.parse.clone(),
            actor: self.actor.map(|ty| self.hierarchy.name(ty).clone()),
            actions: self.actions.iter().map(|a| write_action(a, &self.hierarchy, &clusters)).collect(),
            evidence: write_evidence(&self.evidence),
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

    /// Reads a model file.
    ///
    /// # Errors
    /// [`ModelFileError`] if it is not one, or contradicts itself.
    pub fn from_json(text: &str) -> Result<Self, ModelFileError> {
        let json = |e: serde_json::Error| {
            let message = e.to_string();
            let message = message.split(" at line ").next().unwrap_or(&message).to_owned();
            ModelFileError::Json { line: e.line(), column: e.column(), message }
        };
        #[derive(Deserialize)]
        struct Head {
            format: Option<String>,
        }
        let head: Head = serde_json::from_str(text).map_err(json)?;
        match head.format {
            None => return Err(ModelFileError::NoFormat),
            Some(found) if found != MODEL_FORMAT => return Err(ModelFileError::Version { found }),
            Some(_) => {}
        }
        let file: ModelFile = serde_json::from_str(text).map_err(json)?;
        let hierarchy = Hierarchy::from_edges(file.types.iter().map(|(c, p)| (c.as_str(), p.as_str())))?;
        let keys: Vec<ClusterKey> = file.evidence.clusters.iter().map(|c| c.key.clone()).collect();
        let actor = file.actor.map(|name| type_id(&hierarchy, &name, || "\"actor\"".to_owned())).transpose()?;
        let mut names = BTreeSet::new();
        let mut actions = Vec::with_capacity(file.actions.len());
        for action in file.actions {
            let action = read_action(action, &hierarchy, &keys)?;
            if !names.insert(action.name.clone()) {
                return Err(inconsistent(format!("action {}", action.name), "there is another action of this name"));
            }
            actions.push(action);
        }
        actions.sort_by(|a, b| a.name.cmp(&b.name));
        let evidence = Evidence {
            transitions: file.evidence.transitions,
            clusters: file.evidence.clusters.into_iter().map(|c| (c.key, c.cluster)).collect(),
            negatives: file.evidence.negatives.into_iter().map(|c| (c.key, c.cluster)).collect(),
            unexplained: file.evidence.unexplained.into_iter().map(|u| (u.reason, (u.count, u.witnesses))).collect(),
        };
        let model = Self { hierarchy, predicates: file.predicates, parse: file.parse, actor, actions, evidence };
        model.check_arities()?;
        model.pddl_names()?;
        Ok(model)
    }

    fn check_arities(&self) -> Result<(), ModelFileError> {
        for action in &self.actions {
            let conditions = action.effects.iter().flat_map(|e| e.condition.iter().chain([&e.literal]));
            for literal in action.preconditions.iter().chain(conditions) {
                let expected = self.predicates.get(&literal.atom.predicate);
                if expected != Some(&literal.atom.arity()) {
                    let message = match expected {
                        Some(n) => {
                            format!("{} has {} arguments, its predicate takes {n}", literal.atom, literal.atom.arity())
                        }
                        None => format!("unknown predicate `{}`", literal.atom.predicate),
                    };
                    return Err(ModelFileError::Inconsistent { place: format!("action {}", action.name), message });
                }
            }
        }
        Ok(())
    }
}

fn inconsistent(place: String, message: &str) -> ModelFileError {
    ModelFileError::Inconsistent { place, message: message.to_owned() }
}

fn type_id(hierarchy: &Hierarchy, name: &Symbol, place: impl Fn() -> String) -> Result<TypeId, ModelFileError> {
    hierarchy.id(name.as_str()).ok_or_else(|| ModelFileError::UnknownType { place: place(), name: name.clone() })
}

fn write_literal(literal: &Literal) -> LiteralFile {
    if literal.positive { LiteralFile::Is(literal.atom.clone()) } else { LiteralFile::Not(literal.atom.clone()) }
}

fn read_literal(literal: LiteralFile) -> Literal {
    match literal {
        LiteralFile::Is(atom) => Literal::positive(atom),
        LiteralFile::Not(atom) => Literal::negative(atom),
    }
}

fn write_action(action: &ActionSchema, hierarchy: &Hierarchy, clusters: &[&ClusterKey]) -> ActionFile {
    let source = |s: &Source| SourceFile {
        cluster: clusters.binary_search(&&s.cluster).expect("an action's cluster is in the evidence"),
        map: s.map.clone(),
    };
    let replaced = |list: &[Replacement]| {
        list.iter().map(|r| (r.parameter, hierarchy.name(r.from).clone(), hierarchy.name(r.to).clone())).collect()
    };
    let provenance = match &action.provenance {
        Provenance::Given => ProvenanceFile::Given,
        Provenance::Demonstrated(s) => ProvenanceFile::Demonstrated(source(s)),
        Provenance::Generalized(sources) => ProvenanceFile::Generalized(sources.iter().map(source).collect()),
        Provenance::Imagined { from, replaced: r, goal, observations } => ProvenanceFile::Imagined {
            from: from.clone(),
            replaced: replaced(r),
            goal: goal.clone(),
            observations: *observations,
        },
        Provenance::Substituted { from, replaced: r, following, observations } => ProvenanceFile::Substituted {
            from: from.clone(),
            replaced: replaced(r),
            following: following.clone(),
            observations: *observations,
        },
    };
    let effect = |e: &Effect| match e.condition.as_slice() {
        [] => EffectFile::Always(write_literal(&e.literal)),
        when => EffectFile::When { when: when.iter().map(write_literal).collect(), then: write_literal(&e.literal) },
    };
    ActionFile {
        name: action.name.clone(),
        call: CallFile {
            name: action.call.name.clone(),
            args: action.call.args.iter().map(ToString::to_string).collect(),
        },
        parameters: action.parameters.iter().map(|p| (p.name.clone(), hierarchy.name(p.ty).clone())).collect(),
        preconditions: action.preconditions.iter().map(write_literal).collect(),
        distinct: action.distinct.clone(),
        effects: action.effects.iter().map(effect).collect(),
        cost: action.cost,
        provenance,
    }
}

fn read_action(
    file: ActionFile,
    hierarchy: &Hierarchy,
    clusters: &[ClusterKey],
) -> Result<ActionSchema, ModelFileError> {
    let place = || format!("action {}", file.name);
    let n = file.parameters.len() as u32;
    let ty = |name: &Symbol| type_id(hierarchy, name, place);
    let parameters = file
        .parameters
        .iter()
        .map(|(name, t)| Ok(Parameter { name: name.clone(), ty: ty(t)? }))
        .collect::<Result<Vec<_>, ModelFileError>>()?;
    let args = file
        .call
        .args
        .iter()
        .map(|arg| read_term(arg).map_err(|e| inconsistent(place(), &e.to_string())))
        .collect::<Result<Vec<_>, _>>()?;
    let source = |s: SourceFile| match clusters.get(s.cluster) {
        Some(key) if key.types.len() == s.map.len() && s.map.iter().all(|&p| p < n) => {
            Ok(Source { cluster: key.clone(), map: s.map })
        }
        Some(_) => {
            Err(inconsistent(place(), "a source does not map each of its cluster's parameters to one of the action's"))
        }
        None => Err(inconsistent(place(), &format!("there is no cluster {} in the evidence", s.cluster))),
    };
    let replaced = |list: Vec<(u32, Symbol, Symbol)>| {
        list.into_iter()
            .map(|(parameter, from, to)| Ok(Replacement { parameter, from: ty(&from)?, to: ty(&to)? }))
            .collect::<Result<Vec<_>, ModelFileError>>()
    };
    let provenance = match file.provenance {
        ProvenanceFile::Given => Provenance::Given,
        ProvenanceFile::Demonstrated(s) => Provenance::Demonstrated(source(s)?),
        ProvenanceFile::Generalized(s) => Provenance::Generalized(s.into_iter().map(source).collect::<Result<_, _>>()?),
        ProvenanceFile::Imagined { from, replaced: r, goal, observations } => {
            Provenance::Imagined { from, replaced: replaced(r)?, goal, observations }
        }
        ProvenanceFile::Substituted { from, replaced: r, following, observations } => {
            Provenance::Substituted { from, replaced: replaced(r)?, following, observations }
        }
    };
    let mut effects: Vec<Effect> = file
        .effects
        .into_iter()
        .map(|e| match e {
            EffectFile::Always(literal) => Effect::always(read_literal(literal)),
            EffectFile::When { when, then } => {
                Effect { condition: when.into_iter().map(read_literal).collect(), literal: read_literal(then) }
            }
        })
        .collect();
    effects.sort_unstable();
    let mut preconditions: Vec<Literal> = file.preconditions.into_iter().map(read_literal).collect();
    preconditions.sort_unstable();
    let literals = effects.iter().flat_map(|e| e.condition.iter().chain([&e.literal])).chain(&preconditions);
    let params = literals.flat_map(|l| l.atom.params());
    let called = args.iter().filter_map(|t| if let Term::Param(i) = t { Some(*i) } else { None });
    let distinct = file.distinct.iter().flat_map(|&(a, b)| [a, b]);
    if let Some(bad) = params.chain(called).chain(distinct).find(|&i| i >= n) {
        return Err(inconsistent(place(), &format!("there is no parameter ?{bad}")));
    }
    Ok(ActionSchema {
        call: LiftedCall { name: file.call.name, args },
        name: file.name,
        parameters,
        preconditions,
        distinct: file.distinct,
        effects,
        cost: file.cost,
        provenance,
    })
}

fn read_term(text: &str) -> Result<Term, AtomTextError> {
    LiftedAtom::parse(&format!("call({text})")).and_then(|mut atom| {
        atom.args.pop().filter(|_| atom.args.is_empty()).ok_or(AtomTextError::Form { text: text.to_owned() })
    })
}

fn write_evidence(evidence: &Evidence) -> EvidenceFile {
    EvidenceFile {
        transitions: evidence.transitions,
        clusters: evidence
            .clusters
            .iter()
            .map(|(key, cluster)| ClusterFile { key: key.clone(), cluster: cluster.clone() })
            .collect(),
        negatives: evidence
            .negatives
            .iter()
            .map(|(key, cluster)| NegativeFile { key: key.clone(), cluster: cluster.clone() })
            .collect(),
        unexplained: evidence
            .unexplained
            .iter()
            .map(|(reason, (count, witnesses))| UnexplainedFile {
                reason: *reason,
                count: *count,
                witnesses: witnesses.clone(),
            })
            .collect(),
    }
}
