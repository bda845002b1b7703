//! Interchangeable objects: of actions that differ only in which of them they take, one is enough.
//!
//! Two objects of one type are interchangeable if the task is the same with each in the other's place: no action or axiom
//! names them, and initial state, goal and costs say the same of both. In a state, those of which everything still is as
//! it was initially are interchangeable too, so that an action need be tried only with the first of them, in the order in
//! which it mentions them. This is the part of symmetry breaking (Pochter, Zohar and Rosenschein 2011; Domshlak, Katz and
//! Shleyfman 2012) that needs no search for automorphisms; plans are plans of the task as it is, and a cheapest one is kept.
//!
//! Lazy searches use it; A* keeps every plan apart, so that several can be asked for.

use std::collections::BTreeSet;

use typelift_model::{ActionModel, HashMap, Symbol, Task};

use crate::alike::{alike, constants};
use crate::fact::FactId;
use crate::fdr::{ActionIndex, Fdr, Values};
use crate::ground::GroundTask;
use crate::op::Op;
use crate::packed_lists::PackedLists;

/// An interchangeable object: they are numbered class by class.
type Member = u32;

/// The interchangeable objects of a task.
#[derive(Debug, Default)]
pub(crate) struct Symmetry {
    /// The class of each member.
    class: Vec<u32>,
    classes: usize,
    /// The members that each fact mentions, by its dense number.
    mentioned: PackedLists<Member>,
    /// The members that each action depends on, in the order in which it mentions them.
    used: PackedLists<Member>,
    /// For actions that depend on members: the schema, and each object or, less than 0, member.
    instances: HashMap<ActionIndex, Box<[i64]>>,
    by_instance: HashMap<Box<[i64]>, ActionIndex>,
}

/// The members of which everything still is as it was initially, in one state.
#[derive(Debug, Default)]
pub(crate) struct UnchangedMembers {
    changed: Vec<bool>,
    /// The place of each unchanged member among those of its class.
    place: Vec<u32>,
    /// The unchanged members of each class.
    members: Vec<Vec<Member>>,
    /// How many of each class are used already.
    used: Vec<u32>,
}

impl Symmetry {
    pub(crate) fn of(model: &ActionModel, task: &Task, ground: &GroundTask, fdr: &Fdr) -> Self {
        let mut this = Self::default();
        let mut members: HashMap<Symbol, Member> = HashMap::default();
        for class in classes(model, task) {
            for name in class {
                members.insert(name, this.class.len() as u32);
                this.class.push(this.classes as u32);
            }
            this.classes += 1;
        }
        if members.is_empty() {
            return this;
        }
        let mentioned = |fact: FactId| {
            let args = ground.facts().args(fact).iter();
            args.filter_map(|&object| members.get(ground.facts().name(object)).copied()).collect::<Vec<_>>()
        };
        for number in 0..fdr.fact_count() as u32 {
            this.mentioned.push(mentioned(fdr.fact(number)));
        }
        for (action, &id) in fdr.actions.ids.iter().enumerate() {
            let op = ground.op(id);
            let own: Vec<Option<Member>> = op.objects.iter().map(|object| members.get(object).copied()).collect();
            if own.iter().all(Option::is_none) {
                this.used.push([]);
                continue;
            }
            let needed: BTreeSet<Member> = facts(op).flat_map(mentioned).collect();
            let mut used: Vec<Member> = Vec::new();
            for member in own.iter().flatten().filter(|member| needed.contains(member)) {
                if !used.contains(member) {
                    used.push(*member);
                }
            }
            let objects = op.objects.iter().zip(own).map(|(object, member)| {
                let object = ground.facts().object_id(object).map_or(0, |object| object.index() as i64);
                member.map_or(object, |member| -1 - i64::from(member))
            });
            let instance: Box<[i64]> = std::iter::once(op.schema as i64).chain(objects).collect();
            this.by_instance.entry(instance.clone()).or_insert(action as u32);
            this.instances.insert(action as u32, instance);
            this.used.push(used);
        }
        this
    }

    /// Whether there is nothing to be saved.
    pub(crate) fn is_trivial(&self) -> bool {
        self.classes == 0
    }

    /// Finds the unchanged members of a state.
    pub(crate) fn look_at(&self, fdr: &Fdr, values: &Values, unchanged: &mut UnchangedMembers) {
        unchanged.changed.clear();
        unchanged.changed.resize(self.class.len(), false);
        for number in fdr.differing(values, &fdr.init) {
            for &member in self.mentioned.get(number as usize) {
                unchanged.changed[member as usize] = true;
            }
        }
        unchanged.members.resize_with(self.classes, Vec::new);
        unchanged.members.iter_mut().for_each(Vec::clear);
        unchanged.place.clear();
        for (member, &class) in self.class.iter().enumerate() {
            let members = &mut unchanged.members[class as usize];
            unchanged.place.push(members.len() as u32);
            if !unchanged.changed[member] {
                members.push(member as u32);
            }
        }
        unchanged.used.clear();
        unchanged.used.resize(self.classes, 0);
    }

    /// The unchanged members that an action uses, each with the one that is to be used in its place.
    fn exchanged<'a>(&'a self, action: ActionIndex, unchanged: &'a mut UnchangedMembers) -> Vec<(Member, Member)> {
        let used = self.used.get(action as usize);
        let mut exchanged = Vec::new();
        for &member in used.iter().filter(|&&member| !unchanged.changed[member as usize]) {
            let class = self.class[member as usize] as usize;
            exchanged.push((member, unchanged.members[class][unchanged.used[class] as usize]));
            unchanged.used[class] += 1;
        }
        for &member in used {
            unchanged.used[self.class[member as usize] as usize] = 0;
        }
        exchanged
    }

    /// Whether an action takes the first unchanged objects of each class.
    pub(crate) fn takes_first(&self, action: ActionIndex, unchanged: &mut UnchangedMembers) -> bool {
        match self.used.get(action as usize) {
            [] => true,
            [only] => unchanged.changed[*only as usize] || unchanged.place[*only as usize] == 0,
            _ => self.exchanged(action, unchanged).iter().all(|(member, first)| member == first),
        }
    }

    /// The action that is tried in the place of an action that does not take the first.
    pub(crate) fn first_like(&self, action: ActionIndex, unchanged: &mut UnchangedMembers) -> Option<ActionIndex> {
        let exchanged = self.exchanged(action, unchanged);
        let mut instance = self.instances.get(&action)?.clone();
        for object in &mut instance[1..] {
            if let Some((_, first)) = exchanged.iter().find(|(member, _)| -1 - i64::from(*member) == *object) {
                *object = -1 - i64::from(*first);
            }
        }
        self.by_instance.get(&instance).copied()
    }
}

/// What an action depends on and changes.
fn facts(op: &Op) -> impl Iterator<Item = FactId> {
    let conditional = op
        .conditional
        .iter()
        .flat_map(|effect| effect.positive.iter().chain(&effect.negative).copied().chain([effect.fact]));
    [&op.preconditions, &op.negative, &op.adds, &op.deletes].into_iter().flatten().copied().chain(conditional)
}

/// The classes of two or more interchangeable objects, in the order of names.
fn classes(model: &ActionModel, task: &Task) -> Vec<Vec<Symbol>> {
    let initial = task.init.atoms.iter().map(|atom| ((0, 0), atom));
    let goals = task.goal.required.iter().map(|atom| ((1, 0), atom));
    let negative = task.goal.forbidden.iter().map(|atom| ((2, 0), atom));
    let values = task.values.iter().map(|(atom, value)| ((3, *value), atom));
    let named = constants(model);
    let objects = task.init.objects.iter().filter(|(object, _)| !named.contains(object)).map(|(name, ty)| (name, *ty));
    let classes = alike(objects, initial.chain(goals).chain(negative).chain(values), |other| other);
    let several = classes.into_iter().filter(|class| class.len() > 1);
    let mut classes: Vec<Vec<Symbol>> = several.map(|class| class.into_iter().cloned().collect()).collect();
    classes.sort_unstable();
    classes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worked::Worked;

    /// The actions of a problem that are tried in a state, as far as symmetry goes.
    fn tried(worked: &Worked, atoms: &str) -> Vec<String> {
        let symmetry = Symmetry::of(worked.model(), worked.task(), &worked.ground, &worked.fdr);
        let mut unchanged = UnchangedMembers::default();
        symmetry.look_at(&worked.fdr, &worked.values_of(atoms), &mut unchanged);
        let all = 0..worked.fdr.action_count() as u32;
        worked.names(&all.filter(|&action| symmetry.takes_first(action, &mut unchanged)).collect::<Vec<_>>())
    }

    #[test]
    fn of_three_cups_alike_the_first_is_taken_until_it_is_touched() {
        let worked = Worked::new(
            "init: clean(a) clean(b) clean(c) clean(mug) big(mug)
             goal: tea
             fill(?0): clean(?0) -> full(?0) !clean(?0)
             drink(?0): full(?0) -> tea !full(?0)",
        );
        // The mug is like none of the others.
        assert_eq!(
            tried(&worked, "clean(a) clean(b) clean(c) clean(mug)"),
            ["drink(a)", "drink(mug)", "fill(a)", "fill(mug)"]
        );
        // Of a, which is changed, everything is tried, and of the others the first that is not.
        let after = tried(&worked, "full(a) clean(b) clean(c) clean(mug)");
        assert_eq!(after, ["drink(a)", "drink(b)", "drink(mug)", "fill(a)", "fill(b)", "fill(mug)"]);
    }
}
