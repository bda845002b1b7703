//! ExtractPreconditions and CreateAction (Algorithm 1, lines 3 and 4): an action from a cluster, and its final, named form.

use std::collections::BTreeSet;
use std::sync::Arc;

use typelift_model::{
    ActionModel, ActionSchema, Cluster, ClusterKey, Cost, Effect, Hierarchy, LiftedAtom, LiftedCall, Literal,
    Parameter, Provenance, Support, Symbol, Term, TypeId, UniqueNames,
};

use crate::LearnError;

/// An action under construction: still without a name, its preconditions positive, its parameters distinct.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Draft {
    pub(crate) action: Symbol,
    pub(crate) types: Vec<TypeId>,
    pub(crate) call: Vec<u32>,
    pub(crate) preconditions: BTreeSet<LiftedAtom>,
    pub(crate) adds: BTreeSet<LiftedAtom>,
    pub(crate) deletes: BTreeSet<LiftedAtom>,
    /// The clusters it rests on, sorted.
    pub(crate) support: Vec<Support>,
}

/// ExtractPreconditions: the atoms that held before in every observation of a cluster. Static atoms stay in; there are no
/// negative ones.
pub(crate) fn extract_preconditions(cluster: &Cluster) -> BTreeSet<LiftedAtom> {
    cluster.states.always()
}

/// CreateAction: the individual action of a cluster.
pub(crate) fn create_action(key: &ClusterKey, cluster: &Cluster, hierarchy: &Hierarchy) -> Result<Draft, LearnError> {
    let types = key.types.iter();
    let types = types.map(|name| hierarchy.id(name.as_str()).ok_or_else(|| LearnError::UnknownType(name.clone())));
    Ok(Draft {
        action: key.action.clone(),
        types: types.collect::<Result<_, _>>()?,
        call: key.call.clone(),
        preconditions: extract_preconditions(cluster),
        adds: key.adds.iter().cloned().collect(),
        deletes: key.deletes.iter().cloned().collect(),
        support: vec![Support {
            cluster: Arc::new(key.clone()),
            map: (0..key.types.len() as u32).collect(),
            observations: cluster.count,
        }],
    })
}

impl Draft {
    /// Its effect as signed atoms.
    pub(crate) fn signed_effect(&self) -> Vec<(bool, LiftedAtom)> {
        let adds = self.adds.iter().map(|a| (true, a.clone()));
        adds.chain(self.deletes.iter().map(|a| (false, a.clone()))).collect()
    }

    /// The number of observations that it rests on.
    pub(crate) fn observations(&self) -> u64 {
        self.support.iter().map(|support| support.observations).sum()
    }

    /// The schema, named by its call alone; [`name_actions`] tells schemas apart.
    pub(crate) fn into_schema(self) -> ActionSchema {
        let literal = |(positive, atom)| Effect::always(Literal { atom, positive });
        let mut effects: Vec<Effect> = self.signed_effect().into_iter().map(literal).collect();
        effects.sort_unstable();
        let parameter = |(i, ty): (usize, &TypeId)| Parameter { name: Symbol::from(format!("x{i}")), ty: *ty };
        let provenance = match <[Support; 1]>::try_from(self.support) {
            Ok([support]) => Provenance::Demonstrated(support),
            Err(support) => Provenance::Generalized(support),
        };
        ActionSchema {
            name: self.action.clone(),
            call: LiftedCall { name: self.action, args: self.call.into_iter().map(Term::Param).collect() },
            distinct: ActionSchema::all_distinct(self.types.len()),
            parameters: self.types.iter().enumerate().map(parameter).collect(),
            preconditions: self.preconditions.into_iter().map(Literal::positive).collect(),
            effects,
            cost: Cost::UNIT,
            // A cluster's add effects are what became true in each of its transitions.
            strict: true,
            named_by_call: false,
            provenance,
        }
    }
}

/// Names the actions by call and types, numbered on ties, and sorts them by name. Gives the names in the order before.
pub(crate) fn name_actions(model: &mut ActionModel) -> Vec<Symbol> {
    let mut names = UniqueNames::default();
    let named: Vec<Symbol> = model.actions.iter().map(|action| names.of_action(action, model)).collect();
    for (action, name) in model.actions.iter_mut().zip(&named) {
        action.name = name.clone();
    }
    model.actions.sort_by(|a, b| a.name.cmp(&b.name));
    named
}
