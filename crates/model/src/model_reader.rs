//! Reading the model's file: everything that a later step relies on is checked here.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use serde::Deserialize;

use crate::model_1::ModelFile1;
use crate::model_error::{MODEL_FORMAT_1, at_most, inconsistent, type_id};
use crate::model_file::{ActionFile, AxiomFile, EffectFile, LiteralFile, ModelFile, ProvenanceFile, SupportFile};
use crate::{
    ActionModel, ActionSchema, ArgumentTypes, Axiom, ClusterKey, Cost, Effect, Hierarchy, LearnedModel, LiftedAtom,
    LiftedCall, Literal, MODEL_FORMAT, MOST_PARAMETERS, ModelFileError, Observations, Parameter, Provenance,
    Replacement, Support, Symbol, Term, check_name, json_message,
};

/// Preconditions that an action may have.
pub const MOST_PRECONDITIONS: usize = 40_000;

impl LearnedModel {
    /// Reads a model file of this format or the one before.
    ///
    /// # Errors
    /// [`ModelFileError`] if it is not one, or contradicts itself.
    pub fn from_json(text: &str) -> Result<Self, ModelFileError> {
        let json = |e: serde_json::Error| {
            let message = json_message(&e);
            ModelFileError::Json { line: e.line(), column: e.column(), message }
        };
        #[derive(Deserialize)]
        #[serde(expecting = "a model")]
        struct Head {
            format: Option<String>,
        }
        // Of a file of JSON Lines, the first line says what it is.
        let head = serde_json::Deserializer::from_str(text).into_iter::<Head>().next().transpose().map_err(json)?;
        let head_format = match head.and_then(|head| head.format) {
            None => return Err(ModelFileError::NoFormat),
            Some(found) if !found.starts_with("model/") => return Err(ModelFileError::NotAModel { found }),
            Some(found) if found != MODEL_FORMAT && found != MODEL_FORMAT_1 => {
                return Err(ModelFileError::Version { found });
            }
            Some(found) => found,
        };
        let format_1 = head_format == MODEL_FORMAT_1;
        let file = match format_1 {
            true => serde_json::from_str(text).map(ModelFile1::upgraded),
            false => serde_json::from_str(text).map(|file| (file, BTreeMap::new())),
        };
        let (file, arities) = file.map_err(json)?;
        let mut learned = Self::read(file)?;
        if format_1 {
            learned.upgrade(arities)?;
        }
        learned.model.check()?;
        learned.model.pddl_names()?;
        Ok(learned)
    }

    fn read(file: ModelFile) -> Result<Self, ModelFileError> {
        let hierarchy = Hierarchy::from_edges(file.types.iter().map(|(c, p)| (c.as_str(), p.as_str())))?;
        let clusters: Vec<ClusterKey> = file.evidence.clusters.iter().map(|cluster| cluster.key.clone()).collect();
        let evidence = file.evidence.read(&hierarchy)?;
        let total = evidence.total();
        let clusters: Vec<Support> = clusters.into_iter().map(|key| support(key, &total)).collect();
        let actor = file.actor.map(|name| type_id(&hierarchy, &name, || "\"actor\"".to_owned())).transpose()?;
        let mut names = BTreeSet::new();
        let mut actions = Vec::with_capacity(file.actions.len());
        for action in file.actions {
            let action = read_action(action, &hierarchy, &clusters)?;
            if !names.insert(action.name.clone()) {
                return Err(inconsistent(format!("action {}", action.name), "there is another action of this name"));
            }
            actions.push(action);
        }
        actions.sort_by(|a, b| a.name.cmp(&b.name));
        let mut constants = BTreeMap::new();
        if let Some(name) = &file.domain {
            check_name(name.as_str()).map_err(|error| inconsistent("\"domain\"".to_owned(), &error.to_string()))?;
        }
        for (name, ty) in file.constants {
            constants.insert(name, type_id(&hierarchy, &ty, || "\"constants\"".to_owned())?);
        }
        let predicates = read_predicates(file.predicates, &hierarchy)?;
        let declared_predicates = read_predicates(file.declared_predicates, &hierarchy)?;
        let axioms = file.axioms.into_iter().map(|axiom| read_axiom(axiom, &hierarchy)).collect::<Result<_, _>>()?;
        let (wordings, never_used) = (BTreeMap::new(), BTreeMap::new());
        let model = ActionModel { hierarchy, predicates, actor, constants, actions, axioms, wordings, never_used };
        drop(total);
        Ok(Self {
            model,
            domain: file.domain,
            declared_predicates,
            parse: file.parse,
            options: file.options,
            evidence,
            refused: file.refused_merges,
        })
    }
}

fn read_predicates(
    predicates: BTreeMap<Symbol, Vec<Symbol>>,
    hierarchy: &Hierarchy,
) -> Result<ArgumentTypes, ModelFileError> {
    let read = |(name, types): (Symbol, Vec<Symbol>)| {
        let place = || format!("predicate {name}");
        let types = types.iter().map(|ty| type_id(hierarchy, ty, place)).collect::<Result<_, _>>()?;
        Ok((name, types))
    };
    predicates.into_iter().map(read).collect()
}

/// A cluster under its own parameters.
fn support(key: ClusterKey, total: &Observations) -> Support {
    let observations = total.clusters.get(&key).map_or(0, |cluster| cluster.count);
    Support { map: (0..key.types.len() as u32).collect(), cluster: Arc::new(key), observations }
}

impl ActionModel {
    fn check(&self) -> Result<(), ModelFileError> {
        self.check_names()?;
        self.check_arities()?;
        self.check_axioms()
    }

    fn check_names(&self) -> Result<(), ModelFileError> {
        let named = |name: &Symbol, place: &str| {
            check_name(name.as_str()).map_err(|error| inconsistent(place.to_owned(), &error.to_string()))
        };
        for ty in self.hierarchy.types() {
            named(self.hierarchy.name(ty), "\"types\"")?;
        }
        for (predicate, types) in &self.predicates {
            named(predicate, "\"predicates\"")?;
            at_most(types.len(), MOST_PARAMETERS, "arguments", || format!("predicate {predicate}"))?;
        }
        for constant in self.constants.keys() {
            named(constant, "\"constants\"")?;
        }
        for action in &self.actions {
            let place = format!("action {}", action.name);
            named(&action.name, "\"actions\"")?;
            named(&action.call.name, &place)?;
            let mut names = BTreeSet::new();
            for parameter in &action.parameters {
                named(&parameter.name, &place)?;
                if !names.insert(&parameter.name) {
                    return Err(inconsistent(place, &format!("there are two parameters `{}`", parameter.name)));
                }
            }
        }
        Ok(())
    }

    fn check_arities(&self) -> Result<(), ModelFileError> {
        for action in &self.actions {
            let place = || format!("action {}", action.name);
            for literal in action.preconditions.iter().chain(action.effects.iter().flat_map(|e| &e.condition)) {
                self.check_arity(&literal.atom, true, place)?;
            }
            for effect in &action.effects {
                self.check_arity(&effect.literal.atom, false, place)?;
            }
        }
        for axiom in &self.axioms {
            let place = || format!("an axiom for {}", axiom.head.predicate);
            for literal in &axiom.body {
                self.check_arity(&literal.atom, true, place)?;
            }
            self.check_arity(&axiom.head, false, place)?;
        }
        Ok(())
    }

    fn check_arity(
        &self,
        atom: &LiftedAtom,
        in_condition: bool,
        place: impl Fn() -> String,
    ) -> Result<(), ModelFileError> {
        let equality = (in_condition && atom.is_equality()).then_some(2);
        let expected = equality.or(self.predicates.get(&atom.predicate).map(Vec::len));
        if expected == Some(atom.arity()) {
            return Ok(());
        }
        let message = match expected {
            Some(n) => format!("{atom} has {} arguments, its predicate takes {n}", atom.arity()),
            None => format!("unknown predicate `{}`", atom.predicate),
        };
        Err(ModelFileError::Inconsistent { place: place(), message })
    }

    /// Nothing that is derived is an effect, and the strata are an order of evaluation.
    fn check_axioms(&self) -> Result<(), ModelFileError> {
        let mut strata: BTreeMap<&Symbol, u32> = BTreeMap::new();
        for axiom in &self.axioms {
            let known = *strata.entry(&axiom.head.predicate).or_insert(axiom.stratum);
            if known != axiom.stratum {
                let place = format!("an axiom for {}", axiom.head.predicate);
                return Err(inconsistent(place, "the axioms of one predicate belong to one stratum"));
            }
        }
        for axiom in &self.axioms {
            for literal in &axiom.body {
                let Some(&stratum) = strata.get(&literal.atom.predicate) else { continue };
                if stratum > axiom.stratum || stratum == axiom.stratum && !literal.positive {
                    let place = format!("an axiom for {}", axiom.head.predicate);
                    return Err(inconsistent(place, &format!("{literal} is evaluated too late")));
                }
            }
        }
        for action in &self.actions {
            if let Some(effect) = action.effects.iter().find(|e| strata.contains_key(&e.literal.atom.predicate)) {
                let place = format!("action {}", action.name);
                return Err(inconsistent(place, &format!("its effect {} is of a derived predicate", effect.literal)));
            }
        }
        Ok(())
    }
}

fn read_literal(literal: LiteralFile) -> Literal {
    match literal {
        LiteralFile::Is(atom) => Literal::positive(atom),
        LiteralFile::Not(atom) => Literal::negative(atom),
    }
}

fn read_action(file: ActionFile, hierarchy: &Hierarchy, clusters: &[Support]) -> Result<ActionSchema, ModelFileError> {
    let place = || format!("action {}", file.name);
    at_most(file.preconditions.len(), MOST_PRECONDITIONS, "preconditions", place)?;
    let n = file.parameters.len() as u32;
    let parameters = read_parameters(&file.parameters, hierarchy, place)?;
    let args = file
        .call
        .args
        .iter()
        .map(|arg| read_term(arg).map_err(|message| inconsistent(place(), &message)))
        .collect::<Result<Vec<_>, _>>()?;
    let provenance = read_provenance(file.provenance, n, hierarchy, clusters, place)?;
    let mut effects: Vec<Effect> = file
        .effects
        .into_iter()
        .map(|effect| read_effect(effect, n, hierarchy, place))
        .collect::<Result<_, ModelFileError>>()?;
    effects.sort_unstable();
    let mut preconditions: Vec<Literal> = file.preconditions.into_iter().map(read_literal).collect();
    preconditions.sort_unstable();
    preconditions.dedup();
    let params = preconditions.iter().map(|l| &l.atom).chain(&file.cost_functions).flat_map(LiftedAtom::params);
    let called = args.iter().filter_map(|t| if let Term::Param(i) = t { Some(*i) } else { None });
    let distinct = file.distinct.iter().flat_map(|&(a, b)| [a, b]);
    check_params(params.chain(called).chain(distinct), n, place)?;
    if let Some((same, _)) = file.distinct.iter().find(|(a, b)| a == b) {
        return Err(inconsistent(place(), &format!("parameter ?{same} is to differ from itself")));
    }
    Ok(ActionSchema {
        call: LiftedCall { name: file.call.name, args },
        name: file.name,
        parameters,
        preconditions,
        distinct: file.distinct,
        effects,
        cost: Cost { fixed: file.cost, functions: file.cost_functions },
        strict: file.strict,
        named_by_call: file.named_by_call,
        provenance,
    })
}

/// Where an action with `n` parameters comes from.
fn read_provenance(
    file: ProvenanceFile,
    n: u32,
    hierarchy: &Hierarchy,
    clusters: &[Support],
    place: impl Fn() -> String + Copy,
) -> Result<Provenance, ModelFileError> {
    let ty = |name: &Symbol| type_id(hierarchy, name, place);
    let support = |s: SupportFile| match clusters.get(s.cluster) {
        Some(known) if known.map.len() == s.map.len() && s.map.iter().all(|&p| p < n) => {
            Ok(Support { map: s.map, ..known.clone() })
        }
        Some(_) => {
            let message = "what supports it does not map each of its cluster's parameters to one of the action's";
            Err(inconsistent(place(), message))
        }
        None => Err(inconsistent(place(), &format!("there is no cluster {} in the evidence", s.cluster))),
    };
    let replaced = |list: Vec<(u32, Symbol, Symbol)>| {
        list.into_iter()
            .map(|(parameter, from, to)| Ok(Replacement { parameter, from: ty(&from)?, to: ty(&to)? }))
            .collect::<Result<Vec<_>, ModelFileError>>()
    };
    Ok(match file {
        ProvenanceFile::Given => Provenance::Given,
        ProvenanceFile::Demonstrated(s) => Provenance::Demonstrated(support(s)?),
        ProvenanceFile::Generalized(s) => {
            Provenance::Generalized(s.into_iter().map(support).collect::<Result<_, _>>()?)
        }
        ProvenanceFile::Imagined { from, replaced: r, goal, positive, observations } => {
            Provenance::Imagined { from, replaced: replaced(r)?, goal, positive, observations }
        }
        ProvenanceFile::Substituted { from, replaced: r, following, observations } => {
            Provenance::Substituted { from, replaced: replaced(r)?, following, observations }
        }
        ProvenanceFile::Loosened { from, without, observations } => {
            if without.iter().flat_map(LiftedAtom::params).any(|p| p >= n) {
                return Err(inconsistent(place(), "it does without an atom of a parameter that it does not have"));
            }
            Provenance::Loosened { from, without, observations }
        }
    })
}

fn read_parameters(
    pairs: &[(Symbol, Symbol)],
    hierarchy: &Hierarchy,
    place: impl Fn() -> String,
) -> Result<Vec<Parameter>, ModelFileError> {
    at_most(pairs.len(), MOST_PARAMETERS, "parameters", &place)?;
    let read =
        |(name, ty): &(Symbol, Symbol)| Ok(Parameter { name: name.clone(), ty: type_id(hierarchy, ty, &place)? });
    pairs.iter().map(read).collect()
}

/// Reads an effect of an action with `n` parameters.
fn read_effect(
    file: EffectFile,
    n: u32,
    hierarchy: &Hierarchy,
    place: impl Fn() -> String,
) -> Result<Effect, ModelFileError> {
    let effect = match file {
        EffectFile::Always(literal) => Effect::always(read_literal(literal)),
        EffectFile::When { forall, when, then } => Effect {
            parameters: read_parameters(&forall, hierarchy, &place)?,
            ..Effect::when(when.into_iter().map(read_literal).collect(), read_literal(then))
        },
    };
    let n = n + effect.parameters.len() as u32;
    let params = effect.condition.iter().chain([&effect.literal]).flat_map(|literal| literal.atom.params());
    check_params(params, n, place)?;
    Ok(effect)
}

fn read_axiom(file: AxiomFile, hierarchy: &Hierarchy) -> Result<Axiom, ModelFileError> {
    let place = || format!("an axiom for {}", file.head.predicate);
    let parameters = read_parameters(&file.parameters, hierarchy, place)?;
    let body: Vec<Literal> = file.body.into_iter().map(read_literal).collect();
    let params = body.iter().map(|l| &l.atom).chain([&file.head]).flat_map(LiftedAtom::params);
    check_params(params, parameters.len() as u32, place)?;
    Ok(Axiom { stratum: file.stratum, head: file.head, parameters, body })
}

/// Every parameter that is mentioned exists.
fn check_params(
    mut params: impl Iterator<Item = u32>,
    n: u32,
    place: impl Fn() -> String,
) -> Result<(), ModelFileError> {
    params.find(|&i| i >= n).map_or(Ok(()), |bad| Err(inconsistent(place(), &format!("there is no parameter ?{bad}"))))
}

fn read_term(text: &str) -> Result<Term, String> {
    match LiftedAtom::parse(&format!("call({text})")).map(|atom| atom.args) {
        Ok(args) if args.len() == 1 => Ok(args[0].clone()),
        _ => Err(format!("`{text}` is neither a parameter nor a name")),
    }
}
