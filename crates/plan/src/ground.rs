//! Grounding: the reachable ground actions of a task as a search wants them, in the order in which they are tried.
//!
//! The order is load-bearing (see [`TieOrder`]): of two plans that the heuristic cannot tell apart, the one whose
//! actions come first is found.

use std::collections::BTreeSet;
use std::mem::take;

use typelift_model::{ActionModel, ActionSchema, Budget, Goal, GroundAtom, Step, Stop, Symbol, Task};

use crate::Restrictions;
use crate::assignment::{Assignment, Place};
use crate::axioms::{Axioms, FOLLOWS};
use crate::distinct::Distinct;
use crate::fact::{FactId, Facts};
use crate::op::{ConditionalEffect, Op, OpId};
use crate::poll::Poll;
use crate::reach::{RawOp, Reachable};

/// In which order ground actions are tried.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum TieOrder {
    /// By the call's name, then from the most to the least specific schema (by the mean depth of its parameters'
    /// types), then by name: what was observed for a narrower type is preferred to what covers it.
    #[default]
    SpecificFirst,
    /// By the call's name, then from the least to the most specific schema.
    GeneralFirst,
    /// By the schema's and the objects' names alone.
    Name,
}

/// A grounded task.
#[derive(Debug)]
pub struct GroundTask {
    schemas: Vec<ActionSchema>,
    reachable: Reachable,
    /// The actions, then the axioms.
    ops: Vec<Op>,
    /// How many of `ops` are actions.
    actions: usize,
    /// The stratum of each axiom.
    strata: Vec<u32>,
    /// The derived facts, sorted.
    derived: Vec<FactId>,
    init: Vec<FactId>,
    goal: Vec<FactId>,
    negative_goal: Vec<FactId>,
    asked: Goal,
    ops_before_deduplication: usize,
}

/// Grounds a task: what is reachable without deletes, nothing else.
///
/// # Errors
/// [`Stop`] if the budget ends it.
pub fn ground(
    model: &ActionModel,
    task: &Task,
    restrictions: &Restrictions,
    order: TieOrder,
    budget: &Budget,
) -> Result<GroundTask, Stop> {
    GroundTask::of(Reachable::of(model, task, restrictions, budget)?, model, task, order, budget)
}

/// Facts with those that follow from them, which come last.
fn closed<'a>(
    mut init: Vec<FactId>,
    axioms: impl Iterator<Item = (&'a Op, u32)> + Clone,
    derived: &[FactId],
    facts: usize,
) -> Vec<FactId> {
    if derived.is_empty() {
        return init;
    }
    let place = |fact: FactId| Place::At(Assignment { variable: fact.index() as u32, value: FOLLOWS });
    let mut values = vec![1; facts];
    for fact in &init {
        values[fact.index()] = FOLLOWS;
    }
    Axioms::new(axioms, place).close(&mut values);
    init.extend(derived.iter().filter(|fact| values[fact.index()] == FOLLOWS));
    init
}

/// The place of each schema in the order in which successors are tried.
fn schema_ranks(model: &ActionModel, order: TieOrder) -> Vec<usize> {
    let mut sorted: Vec<usize> = (0..model.actions.len()).collect();
    sorted.sort_by(|&a, &b| {
        let (a, b) = (&model.actions[a], &model.actions[b]);
        let ((sum_a, n_a), (sum_b, n_b)) = (a.specificity(&model.hierarchy), b.specificity(&model.hierarchy));
        let specific_first = (sum_b * n_a).cmp(&(sum_a * n_b));
        let by_specificity = match order {
            TieOrder::SpecificFirst => specific_first,
            TieOrder::GeneralFirst => specific_first.reverse(),
            TieOrder::Name => std::cmp::Ordering::Equal,
        };
        a.call.name.cmp(&b.call.name).then(by_specificity).then_with(|| a.name.cmp(&b.name))
    });
    let mut rank = vec![0; sorted.len()];
    for (place, schema) in sorted.into_iter().enumerate() {
        rank[schema] = place;
    }
    rank
}

/// Drops parts that can never matter: deletes and negative conditions on facts that are never reached, effects whose
/// condition never is.
fn resolve(raw: RawOp, objects: Vec<Symbol>, cost: u32, facts: &Facts, touches_goal: bool) -> Op {
    let reached = |list: Vec<FactId>| {
        let mut list: Vec<FactId> = list.into_iter().filter(|&f| facts.is_reached(f)).collect();
        list.sort_unstable();
        list.dedup();
        list
    };
    let (mut adds, mut deletes, mut conditional) = (Vec::new(), Vec::new(), Vec::new());
    for effect in raw.effects {
        let possible = effect.condition.iter().all(|&c| facts.is_reached(c)) && facts.is_reached(effect.fact);
        if !possible {
            continue;
        }
        let negative = reached(effect.negative_condition);
        if effect.condition.is_empty() && negative.is_empty() {
            let list = if effect.adds { &mut adds } else { &mut deletes };
            list.push(effect.fact);
        } else {
            let positive = reached(effect.condition);
            conditional.push(ConditionalEffect { positive, negative, fact: effect.fact, adds: effect.adds });
        }
    }
    let adds = reached(adds);
    let mut deletes = reached(deletes);
    deletes.retain(|fact| adds.binary_search(fact).is_err());
    conditional.sort_unstable();
    Op {
        schema: raw.schema,
        objects,
        preconditions: reached(raw.preconditions),
        negative: reached(raw.negative),
        adds,
        deletes,
        conditional,
        cost,
        touches_goal,
    }
}

/// The facts that must hold in the end, and those that must not. What is never reached never holds.
fn ground_goal(goal: &Goal, facts: &mut Facts) -> (Vec<FactId>, Vec<FactId>) {
    let required: Vec<FactId> = goal.required.iter().filter_map(|atom| facts.intern_atom(atom)).collect();
    let required: BTreeSet<FactId> = required.into_iter().filter(|&fact| facts.is_reached(fact)).collect();
    let forbidden = goal.forbidden.iter().filter_map(|atom| facts.find(atom));
    (required.into_iter().collect(), forbidden.filter(|&fact| facts.is_reached(fact)).collect())
}

impl GroundTask {
    /// Grounds a task from what can be reached of it.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub(crate) fn of(
        mut reachable: Reachable,
        model: &ActionModel,
        task: &Task,
        order: TieOrder,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        let (mut raw, raw_axioms) = (take(&mut reachable.ops), take(&mut reachable.axioms));
        let derived = model.derived_predicates();
        let basic = task.init.atoms.iter().filter(|atom| !derived.contains(&atom.predicate));
        let init: Vec<FactId> = basic.filter_map(|atom| reachable.facts.find(atom)).collect();
        let (goal, negative_goal) = ground_goal(&task.goal, &mut reachable.facts);
        let facts = &reachable.facts;
        let rank = schema_ranks(model, order);
        raw.sort_by(|a, b| (rank[a.schema], &a.objects).cmp(&(rank[b.schema], &b.objects)));
        let mentioned: BTreeSet<&Symbol> = task.goal.literals().flat_map(|(atom, _)| &atom.args).collect();
        let touches_goal = |op: &RawOp| {
            op.objects.iter().any(|&object| {
                let ty = task.init.objects[facts.name(object)];
                !model.is_actor(ty) && mentioned.contains(facts.name(object))
            })
        };
        let ops_before_deduplication = raw.len();
        let mut ops = Distinct::new(&model.actions);
        let mut poll = Poll::new(budget);
        for op in raw {
            poll.check(1 + op.effects.len())?;
            let schema = &model.actions[op.schema];
            let touches_goal = touches_goal(&op);
            let objects: Vec<Symbol> = op.objects.iter().map(|&o| facts.name(o).clone()).collect();
            // Where what it costs is not stated, an action cannot be used.
            let Some(cost) = schema.cost.of(&objects, &task.values) else { continue };
            ops.insert(resolve(op, objects, cost, facts, touches_goal));
        }
        let mut ops = ops.into_ops();
        let actions = ops.len();
        let mut strata = Vec::with_capacity(raw_axioms.len());
        for axiom in raw_axioms {
            poll.check(1)?;
            strata.push(model.axioms[axiom.schema].stratum);
            ops.push(resolve(axiom, Vec::new(), 0, facts, false));
        }
        let mut derived: Vec<FactId> = ops[actions..].iter().flat_map(|axiom| &axiom.adds).copied().collect();
        derived.sort_unstable();
        derived.dedup();
        let init = closed(init, ops[actions..].iter().zip(strata.iter().copied()), &derived, facts.len());
        let schemas = model.actions.clone();
        Ok(Self {
            schemas,
            reachable,
            ops,
            actions,
            strata,
            derived,
            init,
            goal,
            negative_goal,
            asked: task.goal.clone(),
            ops_before_deduplication,
        })
    }

    /// The ground actions, in the order in which they are tried.
    pub fn ops(&self) -> impl Iterator<Item = (OpId, &Op)> {
        self.ops_and_axioms().take(self.actions)
    }

    /// The ground actions, then the ground axioms as actions without cost: all that makes facts true.
    pub(crate) fn ops_and_axioms(&self) -> impl Iterator<Item = (OpId, &Op)> {
        self.ops.iter().enumerate().map(|(i, op)| (OpId::new(i), op))
    }

    /// The ground axioms, as actions that add their heads, each with its stratum.
    pub(crate) fn axioms(&self) -> impl Iterator<Item = (&Op, u32)> + Clone {
        self.ops[self.actions..].iter().zip(self.strata.iter().copied())
    }

    /// Whether a fact follows from others.
    pub(crate) fn derives(&self, fact: FactId) -> bool {
        self.derived.binary_search(&fact).is_ok()
    }

    /// The tables of objects, predicates and facts.
    pub(crate) fn facts(&self) -> &Facts {
        &self.reachable.facts
    }

    /// One ground action, or axiom.
    pub fn op(&self, id: OpId) -> &Op {
        &self.ops[id.index()]
    }

    /// The number of ground actions.
    pub fn op_count(&self) -> usize {
        self.actions
    }

    /// The number of ground actions with those that only repeat another's call, preconditions and effect.
    pub fn op_count_with_duplicates(&self) -> usize {
        self.ops_before_deduplication
    }

    /// The ground action as a step of a plan.
    pub fn step(&self, id: OpId) -> Step {
        let op = self.op(id);
        self.schemas[op.schema].step(op.objects.clone(), op.cost)
    }

    /// What plans call an action.
    pub(crate) fn name_in_plans(&self, op: &Op) -> Symbol {
        self.schemas[op.schema].signature().name
    }

    /// The number of facts, reached or not.
    pub fn fact_count(&self) -> usize {
        self.reachable.facts.len()
    }

    /// The atom of a fact.
    pub fn atom(&self, id: FactId) -> GroundAtom {
        self.reachable.facts.atom(id)
    }

    /// The facts of the initial state, those that follow from the others last.
    pub fn init(&self) -> &[FactId] {
        &self.init
    }

    /// The reachable goal facts, sorted.
    pub fn goal(&self) -> &[FactId] {
        &self.goal
    }

    /// The reachable facts that must not hold in the end.
    pub fn negative_goal(&self) -> &[FactId] {
        &self.negative_goal
    }

    /// The goal as it was asked, with what cannot be reached.
    pub fn asked(&self) -> &Goal {
        &self.asked
    }

    /// GetUnreachableGoals: goal atoms that cannot be reached even if nothing is ever deleted, in the goal's order.
    pub fn unreachable_goals(&self) -> &[GroundAtom] {
        self.reachable.unreached_goals()
    }

    /// Whether the atom is reachable if nothing is ever deleted.
    pub fn reaches(&self, atom: &GroundAtom) -> bool {
        self.reachable.facts.find(atom).is_some_and(|fact| self.reachable.facts.is_reached(fact))
    }

    /// What can be reached of it.
    pub fn reachable(&self) -> &Reachable {
        &self.reachable
    }

    /// Every reachable fact, in the order in which it was numbered.
    pub fn reached_facts(&self) -> impl Iterator<Item = FactId> + '_ {
        self.reachable.facts.ids().filter(|&fact| self.reachable.facts.is_reached(fact))
    }
}
