//! The format before, `model/1`, which is still read. It had numbers of arguments where there are types now, and evidence
//! as a single sum whose sources are unknown; whether an action is strict and how plan files name it followed from its
//! provenance.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;

use crate::evidence_file::{ClusterFile, EvidenceFile, NegativeFile, UnexplainedFile};
use crate::model_error::at_most;
use crate::model_file::{ActionFile, AxiomFile, ModelFile, PddlFile, ProvenanceFile};
use crate::{
    Cluster, ClusterKey, Evidence, LearnOptions, LearnedModel, MODEL_FORMAT, MOST_PARAMETERS, ModelFileError,
    NegativeKey, ParseConfig, RefusedMerges, Symbol, Unexplained, Witness,
};

#[derive(Deserialize)]
pub(crate) struct ModelFile1 {
    types: Vec<(Symbol, Symbol)>,
    predicates: BTreeMap<Symbol, usize>,
    #[serde(default)]
    parse: ParseConfig,
    #[serde(default)]
    actor: Option<Symbol>,
    #[serde(default)]
    constants: BTreeMap<Symbol, Symbol>,
    actions: Vec<ActionFile>,
    #[serde(default)]
    axioms: Vec<AxiomFile>,
    #[serde(default)]
    evidence: EvidenceFile1,
}

#[derive(Default, Deserialize)]
struct EvidenceFile1 {
    #[serde(default)]
    transitions: u64,
    #[serde(default)]
    clusters: Vec<KeyedFile1<ClusterKey>>,
    #[serde(default)]
    negatives: Vec<KeyedFile1<NegativeKey>>,
    #[serde(default)]
    unexplained: Vec<UnexplainedFile1>,
}

#[derive(Deserialize)]
struct KeyedFile1<K> {
    #[serde(flatten)]
    key: K,
    #[serde(flatten)]
    cluster: Cluster,
}

#[derive(Deserialize)]
struct UnexplainedFile1 {
    reason: Unexplained,
    count: u64,
    witnesses: BTreeSet<Witness>,
}

impl ModelFile1 {
    /// The file as this version has it, but for the predicates, and these with their numbers of arguments.
    pub(crate) fn upgraded(mut self) -> (ModelFile, BTreeMap<Symbol, usize>) {
        for action in &mut self.actions {
            let given = matches!(action.provenance, ProvenanceFile::Given);
            (action.strict, action.named_by_call) = (!given, given);
        }
        let EvidenceFile1 { transitions, clusters, negatives, unexplained } = self.evidence;
        let evidence = EvidenceFile {
            compact: true,
            transitions,
            clusters: clusters.into_iter().map(|c| ClusterFile::of_total(c.key, c.cluster)).collect(),
            negatives: negatives.into_iter().map(|n| NegativeFile::of_total(n.key, n.cluster)).collect(),
            unexplained: unexplained
                .into_iter()
                .map(|u| UnexplainedFile::of_total(u.reason, u.count, u.witnesses))
                .collect(),
            ..EvidenceFile::default()
        };
        let file = ModelFile {
            domain: None,
            format: MODEL_FORMAT.to_owned(),
            types: self.types,
            predicates: BTreeMap::new(),
            declared_predicates: BTreeMap::new(),
            parse: self.parse,
            options: LearnOptions::default(),
            actor: self.actor,
            constants: self.constants,
            actions: self.actions,
            axioms: self.axioms,
            evidence,
            refused_merges: RefusedMerges::default(),
            pddl: PddlFile::default(),
        };
        (file, self.predicates)
    }
}

impl LearnedModel {
    /// Gives the predicates the lowest types that cover their uses; what nothing uses is of anything.
    pub(crate) fn upgrade(&mut self, arities: BTreeMap<Symbol, usize>) -> Result<(), ModelFileError> {
        let model = &mut self.model;
        let root = model.hierarchy.root();
        let mut uses = model.argument_uses();
        let mut total = self.evidence.total().into_owned();
        for (name, arity) in arities {
            at_most(arity, MOST_PARAMETERS, "arguments", || format!("predicate {name}"))?;
            let types = uses.remove(&name).filter(|types| types.len() == arity).unwrap_or_else(|| vec![root; arity]);
            total.add_predicate(&name, types.iter().map(|ty| Some(model.hierarchy.name(*ty))));
            model.predicates.insert(name, types);
        }
        self.evidence = Evidence::of_total(BTreeMap::new(), total);
        Ok(())
    }
}
