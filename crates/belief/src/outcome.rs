//! What was observed of an action, and what was tried in a run: where it worked, and where its call did something else, or
//! nothing.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{
    ActionSchema, Cluster, ClusterKey, Hierarchy, LiftedAtom, Observations, PreStates, Support, Symbol, Term, TypeId,
};

use crate::cause::Cause;
use crate::deed::{Deed, Tried};
use crate::object::{OutOfOrder, out_of_order};
use crate::run::Run;
use crate::surroundings::Surrounding;

/// Observations that were alike.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Outcome {
    /// The type at each of the action's parameters; none where it is not known what took part.
    pub(crate) types: Vec<Option<TypeId>>,
    /// The atoms over the action's parameters that held before.
    pub(crate) held: BTreeSet<LiftedAtom>,
    pub(crate) count: u64,
    pub(crate) worked: bool,
    /// The objects that may have been out of order; none where objects are not known.
    pub(crate) objects: BTreeMap<Cause, OutOfOrder>,
    /// What held around it, over the action's parameters; none where that is not known.
    pub(crate) around: Option<BTreeSet<Surrounding>>,
}

impl Outcome {
    /// Whether it says something of an atom: all that it is about took part.
    pub(crate) fn tells_of(&self, atom: &LiftedAtom) -> bool {
        atom.args.iter().all(|term| match term {
            Term::Param(parameter) => self.types.get(*parameter as usize).is_some_and(Option::is_some),
            Term::Const(_) => true,
        })
    }

    /// Whether all preconditions are known to have held.
    fn is_applicable(&self, schema: &ActionSchema) -> bool {
        let mut preconditions = schema.preconditions.iter();
        preconditions
            .all(|literal| self.tells_of(&literal.atom) && self.held.contains(&literal.atom) == literal.positive)
    }
}

/// All of an action: what it rests on, what else its call did, and where it did nothing. What had the same effect worked,
/// whether or not the action was generalized to cover it.
pub(crate) fn outcomes(schema: &ActionSchema, observed: &Observations, hierarchy: &Hierarchy) -> Vec<Outcome> {
    let mut outcomes = Vec::new();
    let mut of_action: BTreeSet<&ClusterKey> = BTreeSet::new();
    for support in schema.provenance.support() {
        of_action.insert(&support.cluster);
        let map: Vec<Option<u32>> = support.map.iter().copied().map(Some).collect();
        match observed.clusters.get(&*support.cluster) {
            Some(cluster) => add(&mut outcomes, schema, hierarchy, &support.cluster.types, &map, cluster, true),
            None => outcomes.push(by_provenance(schema, support, hierarchy, &map)),
        }
    }
    for (key, cluster) in observed.clusters.iter().filter(|(key, _)| !of_action.contains(key)) {
        if let Some(map) = along_call(schema, &key.action, key.types.len(), &key.call) {
            let known = outcomes.len();
            let worked = does_the_same(schema, key, &map);
            add(&mut outcomes, schema, hierarchy, &key.types, &map, cluster, worked);
            if !worked {
                // Where the action is not to be used, that something else happened is another action's affair.
                let others = outcomes.split_off(known);
                outcomes.extend(others.into_iter().filter(|outcome| outcome.is_applicable(schema)));
            }
        }
    }
    for (key, cluster) in &observed.negatives {
        if let Some(map) = along_call(schema, &key.action, key.types.len(), &key.call) {
            add(&mut outcomes, schema, hierarchy, &key.types, &map, cluster, false);
        }
    }
    outcomes
}

/// What an action alone tells of a cluster that it rests on: the types, and that its preconditions held.
fn by_provenance(schema: &ActionSchema, support: &Support, hierarchy: &Hierarchy, map: &[Option<u32>]) -> Outcome {
    let positive = schema.preconditions.iter().filter(|literal| literal.positive);
    Outcome {
        types: types_of(&support.cluster.types, map, schema, hierarchy),
        held: positive.map(|literal| literal.atom.clone()).collect(),
        count: support.observations,
        worked: true,
        objects: BTreeMap::new(),
        around: None,
    }
}

/// What was tried of an action in a run, as outcomes of it.
pub(crate) fn tried(schema: &ActionSchema, run: &Run<'_>, hierarchy: &Hierarchy) -> impl Iterator<Item = Outcome> {
    let worked = run.worked().filter_map(move |(deed, count)| of_deed(schema, deed, count, true, hierarchy));
    worked.chain(run.failed().iter().filter_map(move |failure| failed(schema, failure, hierarchy, run)))
}

/// A failure as an outcome of an action; none if it was another's, or by another call.
pub(crate) fn failed(
    schema: &ActionSchema,
    failure: &Tried<'_>,
    hierarchy: &Hierarchy,
    run: &Run<'_>,
) -> Option<Outcome> {
    let outcome = of_deed(schema, failure.deed, failure.count, false, hierarchy)?;
    let objects = failure.deed.participants.iter().map(|participant| &participant.object);
    let others = objects.filter(|object| !failure.actors.contains(*object));
    let suspected = others.map(|object| {
        let suspected = out_of_order(failure, object, run);
        let instance = failure.deed.instance.clone();
        (Cause::Object { instance, object: object.clone(), worked: suspected.worked }, suspected)
    });
    Some(Outcome { objects: suspected.collect(), around: around(schema, failure.deed, failure.around), ..outcome })
}

/// What held around a deed, if its participants are numbered as the action's parameters.
pub(crate) fn around(
    schema: &ActionSchema,
    deed: &Deed,
    held: &BTreeSet<Surrounding>,
) -> Option<BTreeSet<Surrounding>> {
    of_parameters(schema, deed).then(|| held.clone())
}

/// Whether it was to do what this action does, and its participants are numbered as the action's parameters.
pub(crate) fn of_parameters(schema: &ActionSchema, deed: &Deed) -> bool {
    let same = (0..).map(Some);
    deed.parameters(schema).is_some_and(|map| same.zip(&map).all(|(same, parameter)| same == *parameter))
}

/// A deed as an outcome of an action; none if it was another's, or by another call.
pub(crate) fn of_deed(
    schema: &ActionSchema,
    deed: &Deed,
    count: u64,
    worked: bool,
    hierarchy: &Hierarchy,
) -> Option<Outcome> {
    let map = deed.parameters(schema)?;
    let types: Vec<Symbol> = deed.participants.iter().map(|participant| participant.ty.clone()).collect();
    Some(Outcome {
        types: types_of(&types, &map, schema, hierarchy),
        held: deed.held.iter().filter_map(|atom| mapped(atom, &map)).collect(),
        count,
        worked,
        objects: BTreeMap::new(),
        around: None,
    })
}

fn types_of(
    names: &[Symbol],
    map: &[Option<u32>],
    schema: &ActionSchema,
    hierarchy: &Hierarchy,
) -> Vec<Option<TypeId>> {
    let mut types = vec![None; schema.parameters.len()];
    for (name, parameter) in names.iter().zip(map) {
        if let (Some(parameter), Some(ty)) = (parameter, hierarchy.id(name.as_str())) {
            types[*parameter as usize] = Some(ty);
        }
    }
    types
}

/// Whether what was observed is what the action predicts.
fn does_the_same(schema: &ActionSchema, key: &ClusterKey, map: &[Option<u32>]) -> bool {
    let all = |atoms: &[LiftedAtom]| atoms.iter().map(|atom| mapped(atom, map)).collect::<Option<BTreeSet<_>>>();
    let (adds, deletes) = (schema.adds().cloned().collect(), schema.deletes().cloned().collect());
    all(&key.adds) == Some(adds) && all(&key.deletes) == Some(deletes)
}

/// For each entity of an observation of the same call the action's parameter: those that the call names, and the others if
/// there are as many. None for another call.
fn along_call(schema: &ActionSchema, action: &Symbol, entities: usize, call: &[u32]) -> Option<Vec<Option<u32>>> {
    if *action != schema.call.name || call.len() != schema.call.args.len() {
        return None;
    }
    let mut map = vec![None; entities];
    for (&entity, term) in call.iter().zip(&schema.call.args) {
        let Term::Param(parameter) = term else { return None };
        let known = map.get_mut(entity as usize)?;
        if known.is_some_and(|known| known != *parameter) {
            return None;
        }
        *known = Some(*parameter);
    }
    let named: BTreeSet<u32> = map.iter().flatten().copied().collect();
    let distinct = map.iter().flatten().count();
    if named.len() != distinct {
        return None;
    }
    let unnamed = || (0..schema.parameters.len() as u32).filter(|parameter| !named.contains(parameter));
    if entities == schema.parameters.len() {
        map.iter_mut().filter(|known| known.is_none()).zip(unnamed()).for_each(|(known, next)| *known = Some(next));
    }
    Some(map)
}

fn add(
    outcomes: &mut Vec<Outcome>,
    schema: &ActionSchema,
    hierarchy: &Hierarchy,
    names: &[Symbol],
    map: &[Option<u32>],
    cluster: &Cluster,
    worked: bool,
) {
    let types = types_of(names, map, schema, hierarchy);
    let mut one = |state: &BTreeSet<LiftedAtom>, count: u64| {
        let held = state.iter().filter_map(|atom| mapped(atom, map)).collect();
        outcomes.push(Outcome { types: types.clone(), held, count, worked, objects: BTreeMap::new(), around: None });
    };
    match &cluster.states {
        PreStates::Exact(states) => states.iter().for_each(|(state, count)| one(state, *count)),
        // What mostly held is taken for what held.
        PreStates::Counted { total, atoms } => {
            let mostly = |(atom, count): (&LiftedAtom, &u64)| (2 * count > *total).then(|| atom.clone());
            one(&atoms.iter().filter_map(mostly).collect(), *total);
        }
    }
}

/// An atom over an observation's entities, as one over the action's parameters.
fn mapped(atom: &LiftedAtom, map: &[Option<u32>]) -> Option<LiftedAtom> {
    let args = atom.args.iter().map(|term| match term {
        Term::Param(entity) => map.get(*entity as usize).copied().flatten().map(Term::Param),
        Term::Const(name) => Some(Term::Const(name.clone())),
    });
    Some(LiftedAtom { predicate: atom.predicate.clone(), args: args.collect::<Option<_>>()? })
}

/// How often each type worked at each parameter.
pub(crate) fn worked_at(outcomes: &[Outcome], parameters: usize) -> Vec<BTreeMap<TypeId, f64>> {
    let mut worked = vec![BTreeMap::new(); parameters];
    for outcome in outcomes.iter().filter(|outcome| outcome.worked) {
        for (known, ty) in worked.iter_mut().zip(&outcome.types) {
            if let Some(ty) = ty {
                *known.entry(*ty).or_default() += outcome.count as f64;
            }
        }
    }
    worked
}
