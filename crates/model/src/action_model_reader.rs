//! Reading the model's file: everything that a later step relies on is checked here.

use std::collections::BTreeSet;

use serde::Deserialize;

use crate::action_model_file::{ActionFile, EffectFile, LiteralFile, ModelFile, ProvenanceFile, SourceFile};
use crate::{
    ActionModel, ActionSchema, ClusterKey, Effect, Evidence, Hierarchy, LiftedAtom, LiftedCall, Literal, MODEL_FORMAT,
    MOST_PARAMETERS, ModelFileError, Parameter, PreStates, Provenance, Replacement, Source, Symbol, Term, TypeId,
    check_name, json_message,
};

/// Preconditions that an action may have.
const MOST_PRECONDITIONS: usize = 40_000;

impl ActionModel {
    /// Reads a model file.
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
        match head.and_then(|head| head.format) {
            None => return Err(ModelFileError::NoFormat),
            Some(found) if !found.starts_with("model/") => return Err(ModelFileError::NotAModel { found }),
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
        model.check_names()?;
        model.check_arities()?;
        model.evidence.check(&model.hierarchy)?;
        model.pddl_names()?;
        Ok(model)
    }

    fn check_names(&self) -> Result<(), ModelFileError> {
        let named = |name: &Symbol, place: &str| {
            check_name(name.as_str()).map_err(|error| inconsistent(place.to_owned(), &error.to_string()))
        };
        for ty in self.hierarchy.types() {
            named(self.hierarchy.name(ty), "\"types\"")?;
        }
        for (predicate, arity) in &self.predicates {
            named(predicate, "\"predicates\"")?;
            at_most(*arity, MOST_PARAMETERS, "arguments", || format!("predicate {predicate}"))?;
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

impl Evidence {
    fn check(&self, hierarchy: &Hierarchy) -> Result<(), ModelFileError> {
        let mut total = 0_u64;
        let clusters = self.clusters.iter().map(|(key, cluster)| {
            let atoms = key.adds.iter().chain(&key.deletes);
            (&key.action, &key.types, &key.call, atoms.collect::<Vec<_>>(), cluster)
        });
        let negatives =
            self.negatives.iter().map(|(key, cluster)| (&key.action, &key.types, &key.call, Vec::new(), cluster));
        for (action, types, call, mut atoms, cluster) in clusters.chain(negatives) {
            let place = || format!("\"evidence\" of {action}");
            for ty in types {
                type_id(hierarchy, ty, place)?;
            }
            let mut counts = vec![cluster.count];
            match &cluster.states {
                PreStates::Exact(states) => {
                    atoms.extend(states.keys().flatten());
                    counts.extend(states.values());
                }
                PreStates::Counted { total, atoms: counted } => {
                    atoms.extend(counted.keys());
                    counts.push(*total);
                    counts.extend(counted.values());
                }
            }
            let mut params = atoms.iter().flat_map(|atom| atom.params()).chain(call.iter().copied());
            if let Some(bad) = params.find(|&i| i as usize >= types.len()) {
                return Err(inconsistent(place(), &format!("there is no parameter ?{bad}")));
            }
            let sum = counts.into_iter().try_fold(total, u64::checked_add);
            total = sum.ok_or_else(|| inconsistent(place(), "its counts are too large"))?;
        }
        Ok(())
    }
}

fn at_most(n: usize, most: usize, what: &str, place: impl Fn() -> String) -> Result<(), ModelFileError> {
    if n <= most { Ok(()) } else { Err(inconsistent(place(), &format!("{n} {what} are more than {most}"))) }
}

fn inconsistent(place: String, message: &str) -> ModelFileError {
    ModelFileError::Inconsistent { place, message: message.to_owned() }
}

fn type_id(hierarchy: &Hierarchy, name: &Symbol, place: impl Fn() -> String) -> Result<TypeId, ModelFileError> {
    hierarchy.id(name.as_str()).ok_or_else(|| ModelFileError::UnknownType { place: place(), name: name.clone() })
}

fn read_literal(literal: LiteralFile) -> Literal {
    match literal {
        LiteralFile::Is(atom) => Literal::positive(atom),
        LiteralFile::Not(atom) => Literal::negative(atom),
    }
}

fn read_action(
    file: ActionFile,
    hierarchy: &Hierarchy,
    clusters: &[ClusterKey],
) -> Result<ActionSchema, ModelFileError> {
    let place = || format!("action {}", file.name);
    at_most(file.parameters.len(), MOST_PARAMETERS, "parameters", place)?;
    at_most(file.preconditions.len(), MOST_PRECONDITIONS, "preconditions", place)?;
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
        .map(|arg| read_term(arg).map_err(|message| inconsistent(place(), &message)))
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
    preconditions.dedup();
    let literals = effects.iter().flat_map(|e| e.condition.iter().chain([&e.literal])).chain(&preconditions);
    let params = literals.flat_map(|l| l.atom.params());
    let called = args.iter().filter_map(|t| if let Term::Param(i) = t { Some(*i) } else { None });
    let distinct = file.distinct.iter().flat_map(|&(a, b)| [a, b]);
    if let Some(bad) = params.chain(called).chain(distinct).find(|&i| i >= n) {
        return Err(inconsistent(place(), &format!("there is no parameter ?{bad}")));
    }
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
        cost: file.cost,
        provenance,
    })
}

fn read_term(text: &str) -> Result<Term, String> {
    match LiftedAtom::parse(&format!("call({text})")).map(|atom| atom.args) {
        Ok(args) if args.len() == 1 => Ok(args[0].clone()),
        _ => Err(format!("`{text}` is neither a parameter nor a name")),
    }
}
