//! ClusterLiftedEffects (Algorithm 1, line 1): transitions whose effects unify belong to one cluster.
//!
//! Two transitions of one action unify if a bijection of their objects that keeps every object's leaf type maps the
//! one call onto the other and adds onto adds, deletes onto deletes. The objects of a transition are the arguments
//! of its call and the entities of its effect. Instead of comparing transitions pairwise, each is brought into a
//! canonical form, so that unifying transitions have equal keys: the arguments of the call are labelled in their
//! order; the other entities of the effect in the way that makes the lifted effect smallest and, where several do
//! (automorphisms), the lifted pre-state (`canonical.rs`).
//!
//! A transition that may have changed something unseen (`open.rs`) is reported, and nothing is learned from it: to take the
//! unknown for false would drop preconditions, or weaken the effect, without a counterexample.

use std::collections::BTreeMap;

use typelift_model::{
    ClusterKey, GroundAtom, Hierarchy, LiftedAtom, MOST_PARAMETERS, NegativeKey, Observations, State, Symbol,
    Unexplained,
};
use typelift_world::Transition;

use crate::canonical::{Effect, canonical_form};
use crate::open::view;
use crate::outcome::{Outcome, outcome};

/// Adds one transition to the evidence. One in which an entity takes part that its first state does not have is
/// [not explained](Unexplained::ObjectsChanged).
pub fn observe(evidence: &mut Observations, transition: &Transition<'_>, hierarchy: &Hierarchy) {
    evidence.transitions += 1;
    let (before, after, call) = (transition.before, transition.after, &transition.action.call);
    let outcome = outcome(transition.action);
    if outcome == Outcome::Undecided {
        evidence.add_unexplained(Unexplained::TimedOut, &transition.witness());
        return;
    }
    let same_objects = before.objects == after.objects;
    if !same_objects && outcome == Outcome::AsShown || call.args.iter().any(|arg| !before.objects.contains_key(arg)) {
        evidence.add_unexplained(Unexplained::ObjectsChanged, &transition.witness());
        return;
    }
    let adds: Vec<&GroundAtom> = before.added(after).collect();
    let deletes: Vec<&GroundAtom> = before.deleted(after).collect();
    let changed = !same_objects || !adds.is_empty() || !deletes.is_empty();
    let result = match outcome {
        Outcome::AsShown if changed => observe_effect(evidence, transition, adds, deletes, hierarchy),
        Outcome::AsShown => observe_failure(evidence, transition, after, hierarchy),
        Outcome::NotExecuted | Outcome::Undecided => {
            if changed {
                evidence.add_unexplained(Unexplained::NotExecuted, &transition.witness());
            }
            // What is different afterwards is not the action's doing: it counts as having left everything as it was.
            observe_failure(evidence, transition, before, hierarchy)
        }
    };
    if let Err(reason) = result {
        evidence.add_unexplained(reason, &transition.witness());
    }
}

/// Adds what an action changed to the cluster of its lifted effect.
fn observe_effect(
    evidence: &mut Observations,
    transition: &Transition<'_>,
    adds: Vec<&GroundAtom>,
    deletes: Vec<&GroundAtom>,
    hierarchy: &Hierarchy,
) -> Result<(), Unexplained> {
    let (before, after) = (transition.before, transition.after);
    let others = adds.iter().chain(&deletes).flat_map(|atom| &atom.args);
    let entities = Entities::of(transition, others, hierarchy)?;
    let view = view([before, after], entities.index.keys().copied(), hierarchy, &mut evidence.open)?;
    let lift = |atoms: Vec<&GroundAtom>| atoms.into_iter().filter_map(|atom| entities.lift(atom)).collect();
    let effect = Effect { adds: lift(adds), deletes: lift(deletes), state: lift(before.atoms.iter().collect()) };
    let colours = entities
        .types
        .iter()
        .enumerate()
        .map(|(i, ty)| if i < entities.named { format!("{i:08}") } else { format!("~{ty}") });
    let (order, lifted) =
        canonical_form(&effect, &colours.collect::<Vec<_>>(), entities.named).ok_or(Unexplained::TooSymmetric)?;
    let key = ClusterKey {
        action: transition.action.call.name.clone(),
        types: order.iter().map(|&i| entities.types[i].clone()).collect(),
        call: entities.call.clone(),
        adds: lifted.adds,
        deletes: lifted.deletes,
    };
    let seen = evidence.seen_in(view);
    seen.clusters.entry(key).or_default().add(lifted.state.into_iter().collect(), transition.witness());
    Ok(())
}

/// Adds an action that was not executed, or changed nothing, to the negatives: over the entities of its call and, where
/// it is recorded, of the action that was expected.
fn observe_failure(
    evidence: &mut Observations,
    transition: &Transition<'_>,
    after: &State,
    hierarchy: &Hierarchy,
) -> Result<(), Unexplained> {
    let before = transition.before;
    let expected = transition.action.expected.iter().flat_map(|expected| &expected.args);
    let entities = Entities::of(transition, expected.filter(|name| before.objects.contains_key(*name)), hierarchy)?;
    let view = view([before, after], entities.index.keys().copied(), hierarchy, &mut evidence.open)?;
    let state = before.atoms.iter().filter_map(|atom| entities.lift(atom)).collect();
    let key = NegativeKey { action: transition.action.call.name.clone(), types: entities.types, call: entities.call };
    evidence.seen_in(view).negatives.entry(key).or_default().add(state, transition.witness());
    Ok(())
}

/// The entities that a transition is about, in order: those of its call first.
struct Entities<'a> {
    index: BTreeMap<&'a Symbol, u32>,
    types: Vec<Symbol>,
    /// How many the call names.
    named: usize,
    /// The call's arguments, as numbers of entities.
    call: Vec<u32>,
}

impl<'a> Entities<'a> {
    fn of(
        transition: &Transition<'a>,
        others: impl Iterator<Item = &'a Symbol>,
        hierarchy: &Hierarchy,
    ) -> Result<Self, Unexplained> {
        let args = &transition.action.call.args;
        let mut index: BTreeMap<&Symbol, u32> = BTreeMap::new();
        let mut types = Vec::new();
        let mut named = 0;
        for (i, name) in args.iter().chain(others).enumerate() {
            if !index.contains_key(name) {
                let ty = transition.before.objects.get(name).ok_or(Unexplained::ObjectsChanged)?;
                index.insert(name, index.len() as u32);
                types.push(hierarchy.name(*ty).clone());
            }
            if i < args.len() {
                named = index.len();
            }
        }
        if types.len() > MOST_PARAMETERS {
            return Err(Unexplained::TooLarge);
        }
        let call = args.iter().map(|arg| index[arg]).collect();
        Ok(Self { index, types, named, call })
    }

    /// The atom over their numbers, if it is about them alone.
    fn lift(&self, atom: &GroundAtom) -> Option<LiftedAtom> {
        LiftedAtom::lift(&atom.without_arity(), |object| self.index.get(object).copied())
    }
}
