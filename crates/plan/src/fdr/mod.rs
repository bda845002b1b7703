//! Finite-domain representation: the task as a search works on it (Helmert, *Concise finite-domain representations for
//! PDDL planning tasks*, Artificial Intelligence 173, 2009).
//!
//! Facts of which at most one can hold are the values of one variable, whose last value says that none of them does.
//! What can never change is left out, and so are ground actions that need two values of one variable at once. Derived
//! facts are variables of their own, which [`Axioms`] decides from the others.

mod mutex;
mod state;
mod successor;

use typelift_model::{Budget, Stop};

pub(crate) use mutex::MutexGroups;
pub(crate) use state::{Registry, StateId};
pub(crate) use successor::SuccessorGenerator;

pub(crate) use crate::assignment::{Assignment, Place, Values};
use crate::axioms::Axioms;
use crate::fact::FactId;
use crate::ground::GroundTask;
use crate::op::{ConditionalEffect, Op, OpId};
use crate::packed_lists::PackedLists;
use crate::poll::Poll;

/// An effect with a condition.
#[derive(Debug, Clone)]
pub(crate) struct When {
    pub(crate) positive: Vec<Assignment>,
    pub(crate) negative: Vec<Assignment>,
    pub(crate) assignment: Assignment,
    pub(crate) adds: bool,
}

/// An action of one [`Fdr`], by its place in the order in which actions are tried.
pub(crate) type ActionIndex = u32;

/// Actions as columns.
#[derive(Debug, Default)]
pub(crate) struct Actions {
    pub(crate) ids: Vec<OpId>,
    pub(crate) costs: Vec<u32>,
    /// Whether each touches an object of the goal that is no actor.
    pub(crate) touches_goal: Vec<bool>,
    pub(crate) preconditions: PackedLists<Assignment>,
    pub(crate) negative: PackedLists<Assignment>,
    pub(crate) deletes: PackedLists<Assignment>,
    pub(crate) adds: PackedLists<Assignment>,
    /// Which of `when` belong to each.
    pub(crate) conditional: PackedLists<u32>,
    pub(crate) when: Vec<When>,
}

/// A task in finite-domain representation.
#[derive(Debug)]
pub(crate) struct Fdr {
    /// How many values each variable has, the one for "none of these" included.
    pub(crate) domains: Vec<u32>,
    /// The fact of each value but the last of each variable, by [`first`](Self::first).
    facts: Vec<FactId>,
    first: Vec<u32>,
    places: Vec<Place>,
    pub(crate) mutexes: MutexGroups,
    pub(crate) actions: Actions,
    pub(crate) axioms: Axioms,
    pub(crate) init: Vec<u32>,
    pub(crate) goal: Vec<Assignment>,
    pub(crate) negative_goal: Vec<Assignment>,
}

impl Fdr {
    /// Represents a ground task.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub(crate) fn new(task: &GroundTask, budget: &Budget) -> Result<Self, Stop> {
        let mut poll = Poll::new(budget);
        let changing = changing_facts(task, &mut poll)?;
        let mutexes = MutexGroups::of(task, &changing, &mut poll)?;
        let mut initially = vec![false; task.fact_count()];
        for &fact in task.init() {
            initially[fact.index()] = true;
        }
        let mut places: Vec<Place> =
            initially.iter().map(|&holds| if holds { Place::Always } else { Place::Never }).collect();
        let groups = mutexes.partition(&changing);
        let (mut domains, mut facts, mut first) = (Vec::new(), Vec::new(), Vec::new());
        for (variable, group) in groups.iter().enumerate() {
            for (value, &fact) in group.iter().enumerate() {
                let (variable, value) = (variable as u32, value as u32);
                places[fact.index()] = Place::At(Assignment { variable, value });
            }
            first.push(facts.len() as u32);
            facts.extend_from_slice(group);
            domains.push(group.len() as u32 + 1);
        }
        let mut this = Self {
            init: domains.iter().map(|size| size - 1).collect(),
            domains,
            facts,
            first,
            places,
            mutexes,
            actions: Actions::default(),
            axioms: Axioms::default(),
            goal: Vec::new(),
            negative_goal: Vec::new(),
        };
        for &fact in task.init() {
            if let Place::At(Assignment { variable, value }) = this.place(fact) {
                this.init[variable as usize] = value;
            }
        }
        for (id, op) in task.ops() {
            poll.check(1 + op.preconditions.len() + op.adds.len() + op.conditional.len())?;
            this.add(id, op);
        }
        this.axioms = Axioms::new(task.axioms(), |fact| this.place(fact));
        let goal = this.all(task.goal());
        let negative_goal = this.none(task.negative_goal());
        (this.goal, this.negative_goal) = (goal.unwrap_or_default(), negative_goal.unwrap_or_default());
        Ok(this)
    }

    fn place(&self, fact: FactId) -> Place {
        self.places[fact.index()]
    }

    /// Where a fact stands among the variables' values; `None` if it never changes.
    pub(crate) fn assignment(&self, fact: FactId) -> Option<Assignment> {
        match self.place(fact) {
            Place::At(assignment) => Some(assignment),
            Place::Always | Place::Never => None,
        }
    }

    /// Whether a fact holds in a state.
    pub(crate) fn holds(&self, values: &Values, fact: FactId) -> bool {
        match self.place(fact) {
            Place::Always => true,
            Place::Never => false,
            Place::At(assignment) => assignment.holds(values),
        }
    }

    /// The number of facts that are values of variables.
    pub(crate) fn fact_count(&self) -> usize {
        self.facts.len()
    }

    /// The dense number of a value: the values of a variable follow each other, and those of the next follow. The last
    /// value of a variable, which stands for no fact, has none.
    pub(crate) fn number(&self, assignment: Assignment) -> u32 {
        self.first[assignment.variable as usize] + assignment.value
    }

    /// The variable and value of a dense number. Logarithmic in the variables.
    pub(crate) fn assignment_of(&self, number: u32) -> Assignment {
        let variable = self.first.partition_point(|&first| first <= number) as u32 - 1;
        Assignment { variable, value: number - self.first[variable as usize] }
    }

    /// The fact of a dense number.
    pub(crate) fn fact(&self, number: u32) -> FactId {
        self.facts[number as usize]
    }

    /// The dense numbers of the facts that hold in a state, in order.
    pub(crate) fn held<'a>(&'a self, values: &'a Values) -> impl Iterator<Item = u32> + 'a {
        let columns = values.iter().zip(&self.first).zip(&self.domains);
        columns.filter(|((value, _), size)| **value + 1 < **size).map(|((value, first), _)| first + value)
    }

    /// The dense numbers of the facts that hold in one of two states and not in the other.
    pub(crate) fn differing<'a>(&'a self, a: &'a Values, b: &'a Values) -> impl Iterator<Item = u32> + 'a {
        let columns = a.iter().zip(b).zip(self.first.iter().zip(&self.domains)).filter(|((a, b), _)| a != b);
        columns.flat_map(|((&a, &b), (&first, &size))| {
            [a, b].into_iter().filter(move |value| value + 1 < size).map(move |value| first + value)
        })
    }

    /// The dense numbers of the facts that hold in the second of two states and not in the first, in order.
    pub(crate) fn gained<'a>(&'a self, before: &'a Values, after: &'a Values) -> impl Iterator<Item = u32> + 'a {
        let columns = before.iter().zip(after).zip(self.first.iter().zip(&self.domains));
        let changed = columns.filter(|((before, after), (_, size))| before != after && **after + 1 < **size);
        changed.map(|((_, after), (first, _))| first + after)
    }

    /// Whether the goal holds.
    pub(crate) fn is_goal(&self, values: &Values) -> bool {
        self.goal.iter().all(|goal| goal.holds(values)) && !self.negative_goal.iter().any(|goal| goal.holds(values))
    }

    pub(crate) fn action_count(&self) -> usize {
        self.actions.ids.len()
    }

    /// What of a conjunction can change; `None` if it never holds.
    fn all(&self, facts: &[FactId]) -> Option<Vec<Assignment>> {
        let mut list = Vec::with_capacity(facts.len());
        for &fact in facts {
            match self.place(fact) {
                Place::At(assignment) => list.push(assignment),
                Place::Always => {}
                Place::Never => return None,
            }
        }
        list.sort_unstable();
        Some(list)
    }

    /// What of facts that must not hold can change; `None` if one always does.
    fn none(&self, facts: &[FactId]) -> Option<Vec<Assignment>> {
        let mut list = Vec::with_capacity(facts.len());
        for &fact in facts {
            match self.place(fact) {
                Place::At(assignment) => list.push(assignment),
                Place::Always => return None,
                Place::Never => {}
            }
        }
        list.sort_unstable();
        Some(list)
    }

    fn add(&mut self, id: OpId, op: &Op) {
        let open = self.mutexes.compatible(&op.negative, &op.preconditions);
        let (Some(preconditions), Some(negative)) = (self.all(&op.preconditions), self.none(&open)) else {
            return;
        };
        if self.mutexes.excluded_pair(&op.preconditions).is_some() {
            return;
        }
        let changes = |facts: &[FactId]| {
            let mut changes: Vec<Assignment> = facts.iter().filter_map(|&fact| self.assignment(fact)).collect();
            changes.sort_unstable();
            changes
        };
        let (deletes, adds) = (changes(&op.deletes), changes(&op.adds));
        let when: Vec<When> = op.conditional.iter().filter_map(|effect| self.when(effect)).collect();
        let actions = &mut self.actions;
        actions.ids.push(id);
        actions.costs.push(op.cost);
        actions.touches_goal.push(op.touches_goal);
        actions.preconditions.push(preconditions);
        actions.negative.push(negative);
        actions.deletes.push(deletes);
        actions.adds.push(adds);
        let start = actions.when.len() as u32;
        actions.conditional.push(start..start + when.len() as u32);
        actions.when.extend(when);
    }

    fn when(&self, effect: &ConditionalEffect) -> Option<When> {
        let assignment = self.assignment(effect.fact)?;
        let (positive, negative) = (self.all(&effect.positive)?, self.none(&effect.negative)?);
        Some(When { positive, negative, assignment, adds: effect.adds })
    }

    /// Whether an action can be done.
    pub(crate) fn is_applicable(&self, action: ActionIndex, values: &Values) -> bool {
        let (actions, action) = (&self.actions, action as usize);
        actions.preconditions.get(action).iter().all(|assignment| assignment.holds(values))
            && !actions.negative.get(action).iter().any(|assignment| assignment.holds(values))
    }

    /// Applies an action; `after` starts as a copy of `before`.
    pub(crate) fn apply(&self, action: ActionIndex, before: &Values, after: &mut Values) {
        let actions = &self.actions;
        let action = action as usize;
        let clear = |assignment: Assignment, after: &mut Values| {
            let variable = assignment.variable as usize;
            if after[variable] == assignment.value {
                after[variable] = self.domains[variable] - 1;
            }
        };
        for &delete in actions.deletes.get(action) {
            clear(delete, after);
        }
        let conditional = actions.conditional.get(action);
        if !conditional.is_empty() {
            let fires = |when: &&When| {
                when.positive.iter().all(|a| a.holds(before)) && !when.negative.iter().any(|a| a.holds(before))
            };
            let firing = || conditional.iter().map(|&index| &actions.when[index as usize]).filter(fires);
            for when in firing().filter(|when| !when.adds) {
                clear(when.assignment, after);
            }
            for when in firing().filter(|when| when.adds) {
                after[when.assignment.variable as usize] = when.assignment.value;
            }
        }
        for &add in actions.adds.get(action) {
            after[add.variable as usize] = add.value;
        }
        self.axioms.close(after);
    }
}

/// The facts that can change: reached, and not true from the beginning for ever.
fn changing_facts(task: &GroundTask, poll: &mut Poll<'_>) -> Result<Vec<bool>, Stop> {
    let mut changing = vec![false; task.fact_count()];
    for fact in task.reached_facts() {
        changing[fact.index()] = true;
    }
    for &fact in task.init() {
        changing[fact.index()] = task.derives(fact);
    }
    for (_, op) in task.ops() {
        poll.check(1 + op.deletes.len() + op.conditional.len())?;
        for &fact in &op.deletes {
            changing[fact.index()] = true;
        }
        for effect in op.conditional.iter().filter(|effect| !effect.adds) {
            changing[effect.fact.index()] = true;
        }
    }
    Ok(changing)
}
