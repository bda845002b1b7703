//! What was learned of a call goes before what was imagined of it.
//!
//! A call has one outcome. Where a learned action can be used that has the same call, to the last object, and predicts something
//! else, its prediction rests on what was seen, and the imagined one is contradicted before it is tried: whoever walks with a
//! bear in hand takes the bear along, and no pawn that stands by.
//!
//! That goes for what the call does not name, and so cannot ask for. Of what it names, the learned action may have been
//! generalized as far as the imagined one was raised, and neither is nearer to what was seen.
//!
//! A learned action predicts only changes here, however it may be used otherwise: where some of its effects hold already, it
//! was never seen.
//!
//! That is found out where a plan has such a step. Then the action gives way in every state: a derived predicate says of
//! which calls something was learned, and the action needs that it does not hold. So a task in which no plan has such a step is
//! planned as if nothing of this were there.

use std::collections::{BTreeMap, BTreeSet};

use typelift_model::{
    ActionModel, ActionSchema, Axiom, EQUALS, GroundAction, Hierarchy, LiftedAtom, Literal, Plan, Step, Symbol, Task,
    Term, TypeId, strict,
};
use typelift_plan::{Ban, Restrictions};

/// The imagined actions of a plan that a learned one contradicts where they are used. What may not be used contradicts nothing:
/// something spoke against it. In time of replaying the plan, and of joining the preconditions of each learned action that has
/// the call of an imagined step.
pub fn contradicted(plan: &Plan, model: &ActionModel, task: &Task, restrictions: &Restrictions) -> BTreeSet<Symbol> {
    let mut found = BTreeSet::new();
    if plan.steps.iter().all(|step| step.imagined.is_none()) {
        return found;
    }
    let strict = strict(model);
    let learned: Vec<&ActionSchema> = strict.actions.iter().filter(|schema| is_learned(schema)).collect();
    let mut state = model.with_derived(&task.init);
    for step in &plan.steps {
        let Some(schema) = model.action(step.action.as_str()) else { break };
        let Ok(action) = schema.instantiate(&step.objects, &state, &model.hierarchy) else { break };
        if has_unnamed(step, schema, task, &model.hierarchy) {
            let instances = learned.iter().flat_map(|schema| {
                let instances = schema.instances(&action.call, &state, &model.hierarchy).into_iter();
                instances.filter(|instance| may_be_used(instance, schema, restrictions, model, task))
            });
            let mut agree = instances
                .map(|instance| (instance.adds, instance.deletes) == (action.adds.clone(), action.deletes.clone()));
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

fn is_learned(schema: &ActionSchema) -> bool {
    schema.provenance.imagined().is_none()
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

/// Adds to the imagined actions of these names that nothing was learned of their call, and answers when something was.
pub(crate) fn give_way(actions: &mut [ActionSchema], model: &ActionModel, names: &BTreeSet<Symbol>) -> Vec<Axiom> {
    let giving_way = actions.iter_mut().filter(|action| names.contains(&action.name));
    let mut predicates: BTreeMap<(Symbol, usize), Symbol> = BTreeMap::new();
    for action in giving_way {
        let call = (action.call.name.clone(), action.call.args.len());
        let predicate =
            predicates.entry(call).or_insert_with_key(|(name, _)| unused(&format!("learned-{name}"), model));
        let atom = LiftedAtom { predicate: predicate.clone(), args: action.call.args.clone() };
        action.preconditions.push(Literal::negative(atom));
        action.preconditions.sort_unstable();
        action.preconditions.dedup();
    }
    let stratum = model.axioms.iter().map(|axiom| axiom.stratum + 1).max().unwrap_or(0);
    let strict = strict(model);
    let learned = strict.actions.iter().filter_map(|schema| {
        let predicate = predicates.get(&(schema.call.name.clone(), schema.call.args.len()))?;
        let differ = |&(one, other): &(u32, u32)| {
            Literal::negative(LiftedAtom::new(EQUALS, vec![Term::Param(one), Term::Param(other)]))
        };
        Some(Axiom {
            stratum,
            head: LiftedAtom { predicate: predicate.clone(), args: schema.call.args.clone() },
            parameters: schema.parameters.clone(),
            body: schema.preconditions.iter().cloned().chain(schema.distinct.iter().map(differ)).collect(),
        })
    });
    learned.collect()
}

/// A predicate that the model does not have.
fn unused(name: &str, model: &ActionModel) -> Symbol {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    let mut names = std::iter::once(name.to_owned()).chain(numbered).map(Symbol::from);
    let is_free = |name: &Symbol| !model.predicates.contains_key(name);
    names.find(is_free).unwrap_or_else(|| Symbol::new(name))
}
