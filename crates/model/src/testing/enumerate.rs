//! The plainest answers to planning problems: everything is enumerated, nothing is clever, and no code is shared with what
//! is tested.

use std::collections::{BTreeMap, BTreeSet};

use crate::{ActionModel, GroundAtom, LiftedAtom, Literal, Symbol, Task, Term, TypeId};

/// Atoms that hold or do not.
pub type Signed = BTreeSet<(bool, GroundAtom)>;

/// An action with objects in place of its parameters, conditions and all.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Instance {
    /// The schema's name.
    pub action: Symbol,
    /// The objects.
    pub objects: Vec<Symbol>,
    /// Signed preconditions.
    pub preconditions: Signed,
    /// Signed effects with their signed conditions.
    pub effects: BTreeSet<(Signed, bool, GroundAtom)>,
    /// The cost.
    pub cost: u32,
}

/// Every list of so many objects.
fn product(objects: &BTreeMap<Symbol, TypeId>, n: usize) -> Vec<Vec<Symbol>> {
    (0..n).fold(vec![Vec::new()], |lists, _| {
        lists
            .iter()
            .flat_map(|list| objects.keys().map(|o| list.iter().cloned().chain([o.clone()]).collect()))
            .collect()
    })
}

/// Every instance that types, distinctness and what nothing changes allow, reachable or not.
pub fn all_instances(model: &ActionModel, task: &Task) -> Vec<Instance> {
    let mut instances = Vec::new();
    let changed: BTreeSet<&Symbol> =
        model.actions.iter().flat_map(|action| &action.effects).map(|effect| &effect.literal.atom.predicate).collect();
    let possible = |literals: &Signed| {
        literals
            .iter()
            .all(|(positive, atom)| changed.contains(&atom.predicate) || task.init.atoms.contains(atom) == *positive)
    };
    for schema in &model.actions {
        for objects in product(&task.init.objects, schema.parameters.len()) {
            let typed = objects
                .iter()
                .zip(&schema.parameters)
                .all(|(object, parameter)| model.hierarchy.is_a(task.init.objects[object], parameter.ty));
            let distinct = schema.distinct.iter().all(|&(i, j)| objects[i as usize] != objects[j as usize]);
            if !typed || !distinct {
                continue;
            }
            let atom = |atom: &LiftedAtom| {
                atom.map(|term| match term {
                    Term::Param(i) => objects[*i as usize].clone(),
                    Term::Const(name) => name.clone(),
                })
            };
            let signed = |l: &Literal| (l.positive, atom(&l.atom));
            let preconditions: Signed = schema.preconditions.iter().map(signed).collect();
            if !possible(&preconditions) {
                continue;
            }
            let effects = schema.effects.iter().map(|e| {
                let condition: Signed = e.condition.iter().map(signed).collect();
                (condition, e.literal.positive, atom(&e.literal.atom))
            });
            instances.push(Instance {
                action: schema.name.clone(),
                preconditions,
                effects: effects.filter(|(condition, _, _)| possible(condition)).collect(),
                cost: schema.cost.fixed,
                objects,
            });
        }
    }
    instances
}

fn positive_in(literals: &Signed, atoms: &BTreeSet<GroundAtom>) -> bool {
    literals.iter().all(|(positive, atom)| !positive || atoms.contains(atom))
}

/// The atoms that can become true if nothing is ever deleted and negations always hold: applied again and again until
/// nothing is new.
pub fn reachable_atoms(instances: &[Instance], task: &Task) -> BTreeSet<GroundAtom> {
    let mut atoms: BTreeSet<GroundAtom> = reachable_in_order(instances, task).into_iter().collect();
    atoms.extend(task.init.atoms.iter().cloned());
    atoms
}

/// Those of them that do not hold at first, in layers: what takes more steps comes later.
pub(super) fn reachable_in_order(instances: &[Instance], task: &Task) -> Vec<GroundAtom> {
    let (mut atoms, mut order) = (task.init.atoms.clone(), Vec::new());
    loop {
        let mut layer = BTreeSet::new();
        for instance in instances.iter().filter(|instance| positive_in(&instance.preconditions, &atoms)) {
            let adds = instance.effects.iter().filter(|(condition, adds, _)| *adds && positive_in(condition, &atoms));
            layer.extend(adds.map(|(_, _, atom)| atom.clone()).filter(|atom| !atoms.contains(atom)));
        }
        if layer.is_empty() {
            return order;
        }
        order.extend(layer.iter().cloned());
        atoms.extend(layer);
    }
}

/// The instances that are applicable if nothing is ever deleted, without what can never matter there: negations of
/// unreachable atoms, effects with unreachable conditions, deletes of unreachable or added atoms.
pub fn reachable_instances(instances: &[Instance], reachable: &BTreeSet<GroundAtom>) -> Vec<Instance> {
    let known = |literals: &Signed| -> Signed {
        literals.iter().filter(|(_, atom)| reachable.contains(atom)).cloned().collect()
    };
    let simplified = |instance: &Instance| {
        let possible =
            instance.effects.iter().filter(|(c, _, atom)| positive_in(c, reachable) && reachable.contains(atom));
        let mut effects: BTreeSet<_> =
            possible.map(|(condition, positive, atom)| (known(condition), *positive, atom.clone())).collect();
        let always: BTreeSet<GroundAtom> =
            effects.iter().filter(|(c, positive, _)| *positive && c.is_empty()).map(|e| e.2.clone()).collect();
        effects.retain(|(condition, positive, atom)| *positive || !condition.is_empty() || !always.contains(atom));
        Instance { preconditions: known(&instance.preconditions), effects, ..instance.clone() }
    };
    instances.iter().filter(|instance| positive_in(&instance.preconditions, reachable)).map(simplified).collect()
}

fn holds(literals: &Signed, atoms: &BTreeSet<GroundAtom>) -> bool {
    literals.iter().all(|(positive, atom)| atoms.contains(atom) == *positive)
}

/// The atoms after an instance, conditions being looked at before; adding wins over deleting. `None` where it is not
/// applicable.
pub fn apply(instance: &Instance, atoms: &BTreeSet<GroundAtom>) -> Option<BTreeSet<GroundAtom>> {
    if !holds(&instance.preconditions, atoms) {
        return None;
    }
    let mut after = atoms.clone();
    for adds in [false, true] {
        for (condition, positive, atom) in &instance.effects {
            if *positive == adds && holds(condition, atoms) {
                if adds {
                    after.insert(atom.clone());
                } else {
                    after.remove(atom);
                }
            }
        }
    }
    Some(after)
}

/// What a search over all states, cheapest first, finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cheapest {
    /// A plan of this cost, and none cheaper.
    Cost(u64),
    /// No plan.
    None,
    /// Too many states to tell.
    TooMany,
}

/// The cost of the cheapest plan, by visiting states in the order of their cost, at most so many.
pub fn cheapest(instances: &[Instance], task: &Task, most: usize) -> Cheapest {
    cheapest_through(instances, task, most, |_| true)
}

/// The same, through states in which an atom never holds.
pub fn cheapest_without(instances: &[Instance], task: &Task, most: usize, avoided: &GroundAtom) -> Cheapest {
    cheapest_through(instances, task, most, |atoms| !atoms.contains(avoided))
}

fn cheapest_through(
    instances: &[Instance],
    task: &Task,
    most: usize,
    may_pass: impl Fn(&BTreeSet<GroundAtom>) -> bool,
) -> Cheapest {
    let mut best = BTreeMap::from([(task.init.atoms.clone(), 0)]);
    let mut queue = BTreeSet::from([(0, task.init.atoms.clone())]);
    while let Some((cost, atoms)) = queue.pop_first() {
        if task.goal.required.iter().all(|goal| atoms.contains(goal)) {
            return Cheapest::Cost(cost);
        }
        for instance in instances {
            let Some(after) = apply(instance, &atoms).filter(&may_pass) else { continue };
            let cost = cost + u64::from(instance.cost);
            if best.get(&after).is_none_or(|&known| cost < known) {
                best.insert(after.clone(), cost);
                queue.insert((cost, after));
            }
        }
        if best.len() > most {
            return Cheapest::TooMany;
        }
    }
    Cheapest::None
}
