//! What was learned of a call goes before what was imagined of it.
//!
//! A call has one outcome. Where the very action that another one was imagined from can be used with the same call, to the last
//! object, and predicts something else, its prediction rests on what was seen, and the imagined one is contradicted before it is
//! tried: whoever walks with a bear in hand takes the bear along, and no pawn that stands by.
//!
//! That goes for what the call does not name, and so cannot ask for. Nor does any other learned action contradict: it may have
//! been generalized further than the imagined one was raised, and then is no nearer to what was seen.
//!
//! A learned action predicts only changes here, however it may be used otherwise: where some of its effects hold already, it
//! was never seen.
//!
//! That is found out where a plan has such a step. Then the action gives way in every state: a derived predicate says with
//! which calls the learned one can be used, and the other needs that it does not hold. So a task in which no plan has such a step is
//! planned as if nothing of this were there.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{
    ActionModel, ActionSchema, Axiom, EQUALS, GroundAction, Hierarchy, LiftedAtom, Literal, Plan, Step, Symbol, Task,
    Term, TypeId, strict,
};
use typelift_plan::{Ban, Restrictions};

/// The imagined actions of a plan that the learned ones which they were imagined from contradict where they are used. What may
/// not be used contradicts nothing: something spoke against it. In time of replaying the plan, and of joining the preconditions
/// of such a learned action for each imagined step.
pub fn contradicted(plan: &Plan, model: &ActionModel, task: &Task, restrictions: &Restrictions) -> BTreeSet<Symbol> {
    let mut found = BTreeSet::new();
    if plan.steps.iter().all(|step| step.imagined.is_none()) {
        return found;
    }
    let strict = strict(model);
    let mut state = model.with_derived(&task.init);
    for step in &plan.steps {
        let Some(schema) = model.action(step.action.as_str()) else { break };
        let Ok(action) = schema.instantiate(&step.objects, &state, &model.hierarchy) else { break };
        let from = schema.provenance.imagined().and_then(|(from, ..)| strict.action(from.as_str()));
        if let Some(from) = from.filter(|_| has_unnamed(step, schema, task, &model.hierarchy)) {
            let instances = from.instances(&action.call, &state, &model.hierarchy).into_iter();
            let usable = instances.filter(|instance| may_be_used(instance, from, restrictions, model, task));
            let mut agree = usable.map(|instance| instance.adds == action.adds && instance.deletes == action.deletes);
            if agree.next().is_some_and(|first| !first && !agree.any(|other| other)) {
                found.insert(step.action.clone());
            }
        }
        for atom in &action.deletes {
            state.atoms.remove(atom);
        }
        state.atoms.extend(action.adds.iter().cloned());
        state = model.with_derived(&state);
    }
    found
}

/// Whether something takes part in an imagined step that is of no type that was seen there, and that the call does not name.
fn has_unnamed(step: &Step, schema: &ActionSchema, task: &Task, hierarchy: &Hierarchy) -> bool {
    let mut replaced = step.imagined.iter().flat_map(|imagined| &imagined.replaced);
    replaced.any(|replacement| {
        let ty = step.objects.get(replacement.parameter as usize).and_then(|object| task.init.objects.get(object));
        !schema.call.args.contains(&Term::Param(replacement.parameter))
            && ty.is_some_and(|ty| !hierarchy.is_a(*ty, replacement.from))
    })
}

fn may_be_used(
    action: &GroundAction,
    schema: &ActionSchema,
    restrictions: &Restrictions,
    model: &ActionModel,
    task: &Task,
) -> bool {
    let types: Vec<Option<TypeId>> =
        action.objects.iter().map(|object| task.init.objects.get(object).copied()).collect();
    restrictions.allows_types(schema, &types, &model.hierarchy)
        && action.objects.iter().all(|object| restrictions.allows(object, &action.call.name))
        && !restrictions.banned.contains(&Ban::of(action))
}

/// Adds to the imagined actions of these names that what they were imagined from cannot be used with their call, and answers
/// when it can.
pub(crate) fn give_way(actions: &mut [ActionSchema], model: &ActionModel, names: &BTreeSet<Symbol>) -> Vec<Axiom> {
    let giving_way = actions.iter_mut().filter(|action| names.contains(&action.name));
    let mut predicates: BTreeMap<Symbol, Symbol> = BTreeMap::new();
    for action in giving_way {
        let Some((from, ..)) = action.provenance.imagined() else { continue };
        let predicate = predicates.entry(from.clone()).or_insert_with(|| unused(&format!("usable-{from}"), model));
        let atom = LiftedAtom { predicate: predicate.clone(), args: action.call.args.clone() };
        action.preconditions.push(Literal::negative(atom));
        action.preconditions.sort_unstable();
        action.preconditions.dedup();
    }
    let stratum = model.axioms.iter().map(|axiom| axiom.stratum + 1).max().unwrap_or(0);
    let strict = strict(model);
    let usable = strict.actions.iter().filter_map(|schema| {
        let differ = |&(one, other): &(u32, u32)| {
            Literal::negative(LiftedAtom::new(EQUALS, vec![Term::Param(one), Term::Param(other)]))
        };
        Some(Axiom {
            stratum,
            head: LiftedAtom { predicate: predicates.get(&schema.name)?.clone(), args: schema.call.args.clone() },
            parameters: schema.parameters.clone(),
            body: schema.preconditions.iter().cloned().chain(schema.distinct.iter().map(differ)).collect(),
        })
    });
    usable.collect()
}

/// A predicate that the model does not have.
fn unused(name: &str, model: &ActionModel) -> Symbol {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    let mut names = std::iter::once(name.to_owned()).chain(numbered).map(Symbol::from);
    let is_free = |name: &Symbol| !model.predicates.contains_key(name);
    names.find(is_free).unwrap_or_else(|| Symbol::new(name))
}
