//! Delete relaxation: a task in which no fact ever becomes false, as landmarks and heuristics see it.
//!
//! Propositions are the facts of a [`Fdr`] by their dense numbers and, if asked for, the negations of those that must not
//! hold somewhere, which what deletes the fact makes true. An effect with a condition is a relaxed action of its own, and so
//! are axioms, which cost nothing. The negation of a derived fact follows where each of its axioms is blocked by one of
//! its literals; among derived facts that depend on themselves it is taken to hold, so that no dead end is seen where
//! there is none.

use std::collections::BTreeMap;

use typelift_model::Stop;

use crate::axioms::GroundAxiom;
use crate::fdr::{ActionIndex, Assignment, Fdr, Values};
use crate::packed_lists::PackedLists;
use crate::poll::Poll;

/// A proposition of one [`Relaxation`].
pub(crate) type Prop = u32;

/// A relaxed action of one [`Relaxation`].
pub(crate) type RelaxedIndex = u32;

/// What negative literals mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Negatives {
    /// Nothing: they are taken to hold, as deletes are taken not to happen.
    Ignored,
    /// Propositions of their own.
    Propositions,
}

/// A relaxed task.
#[derive(Debug)]
pub(crate) struct Relaxation {
    facts: u32,
    /// The fact that each proposition after the facts negates; none for a proposition that only axioms make true.
    negated: Vec<Option<Assignment>>,
    /// What holds in every state.
    always: Vec<Prop>,
    pub(crate) preconditions: PackedLists<Prop>,
    pub(crate) adds: PackedLists<Prop>,
    /// The action that each relaxed action is part of; none for axioms.
    pub(crate) action: Vec<Option<ActionIndex>>,
    /// The relaxed actions that need each proposition.
    pub(crate) needed_by: PackedLists<RelaxedIndex>,
    /// The relaxed actions that add each proposition.
    pub(crate) achievers: PackedLists<RelaxedIndex>,
    pub(crate) goal: Vec<Prop>,
}

impl Relaxation {
    /// Relaxes a task.
    ///
    /// # Errors
    /// [`Stop`] if the budget ends it.
    pub(crate) fn new(task: &Fdr, negatives: Negatives, poll: &mut Poll<'_>) -> Result<Self, Stop> {
        let mut builder = Builder {
            task,
            negatives,
            props: task.fact_count() as u32,
            negations: BTreeMap::new(),
            open: Vec::new(),
            always: Vec::new(),
            relaxed: Relaxed::default(),
        };
        let mut goal = builder.all(&task.goal, &task.negative_goal);
        goal.sort_unstable();
        goal.dedup();
        builder.add_actions(poll)?;
        builder.add_axioms(poll)?;
        builder.close(poll)?;
        builder.finish(goal, poll)
    }

    /// The number of propositions.
    pub(crate) fn len(&self) -> usize {
        self.facts as usize + self.negated.len()
    }

    /// The fact that a proposition is; none if it is a negation.
    pub(crate) fn is_fact(&self, prop: Prop) -> bool {
        prop < self.facts
    }

    /// Whether a proposition is neither a fact nor the negation of one.
    pub(crate) fn is_auxiliary(&self, prop: Prop) -> bool {
        !self.is_fact(prop) && self.negated[(prop - self.facts) as usize].is_none()
    }

    /// The fact that a proposition asks for, and whether it must hold; none if it is auxiliary.
    pub(crate) fn literal(&self, task: &Fdr, prop: Prop) -> Option<(Assignment, bool)> {
        if self.is_fact(prop) {
            return Some((task.assignment_of(prop), true));
        }
        self.negated[(prop - self.facts) as usize].map(|fact| (fact, false))
    }

    /// The propositions that hold in a state.
    pub(crate) fn held<'a>(&'a self, task: &'a Fdr, values: &'a Values) -> impl Iterator<Item = Prop> + 'a {
        let negated = self.negated.iter().zip(self.facts..);
        let not = negated.filter(|(fact, _)| fact.is_some_and(|fact| !fact.holds(values))).map(|(_, prop)| prop);
        task.held(values).chain(not).chain(self.always.iter().copied())
    }
}

/// Relaxed actions as they are met.
#[derive(Default)]
struct Relaxed {
    preconditions: PackedLists<Prop>,
    adds: PackedLists<Prop>,
    action: Vec<Option<ActionIndex>>,
}

impl Relaxed {
    fn push(
        &mut self,
        preconditions: impl IntoIterator<Item = Prop>,
        adds: impl IntoIterator<Item = Prop>,
        action: Option<ActionIndex>,
    ) {
        self.preconditions.push(preconditions);
        self.adds.push(adds);
        self.action.push(action);
    }
}

struct Builder<'a> {
    task: &'a Fdr,
    negatives: Negatives,
    props: u32,
    negations: BTreeMap<Assignment, Prop>,
    /// Negations for which it is not known yet what makes them true.
    open: Vec<(Assignment, Prop)>,
    always: Vec<Prop>,
    relaxed: Relaxed,
}

impl Builder<'_> {
    fn fresh(&mut self) -> Prop {
        self.props += 1;
        self.props - 1
    }

    fn negation(&mut self, fact: Assignment) -> Option<Prop> {
        if self.negatives == Negatives::Ignored {
            return None;
        }
        if let Some(&prop) = self.negations.get(&fact) {
            return Some(prop);
        }
        let prop = self.fresh();
        self.negations.insert(fact, prop);
        self.open.push((fact, prop));
        Some(prop)
    }

    /// The propositions of a conjunction.
    fn all(&mut self, positive: &[Assignment], negative: &[Assignment]) -> Vec<Prop> {
        let mut props: Vec<Prop> = positive.iter().map(|&fact| self.task.number(fact)).collect();
        props.extend(negative.iter().filter_map(|&fact| self.negation(fact)));
        props
    }

    fn add_actions(&mut self, poll: &mut Poll<'_>) -> Result<(), Stop> {
        let (task, actions) = (self.task, &self.task.actions);
        for index in 0..task.action_count() {
            let preconditions = self.all(actions.preconditions.get(index), actions.negative.get(index));
            poll.check((1 + preconditions.len()) * (1 + actions.conditional.get(index).len()))?;
            let action = Some(index as u32);
            for &when in actions.conditional.get(index) {
                let when = &actions.when[when as usize];
                if when.adds {
                    let mut condition = self.all(&when.positive, &when.negative);
                    condition.extend(&preconditions);
                    self.relaxed.push(condition, [task.number(when.assignment)], action);
                }
            }
            let adds = actions.adds.get(index).iter().map(|&fact| task.number(fact));
            self.relaxed.push(preconditions, adds, action);
        }
        Ok(())
    }

    fn add_axioms(&mut self, poll: &mut Poll<'_>) -> Result<(), Stop> {
        for axiom in self.task.axioms.iter() {
            poll.check(1 + axiom.negative.len())?;
            let preconditions = self.all(&axiom.conditions().collect::<Vec<_>>(), &axiom.negative);
            self.relaxed.push(preconditions, [self.task.number(axiom.head())], None);
        }
        Ok(())
    }

    /// Finds for every negation what makes it true.
    fn close(&mut self, poll: &mut Poll<'_>) -> Result<(), Stop> {
        let task = self.task;
        let depends_on_itself = task.axioms.dependent_on_themselves();
        let mut axioms: BTreeMap<u32, Vec<&GroundAxiom>> = BTreeMap::new();
        for axiom in task.axioms.iter() {
            axioms.entry(axiom.head().variable).or_default().push(axiom);
        }
        while let Some((fact, prop)) = self.open.pop() {
            poll.check(1)?;
            if depends_on_itself.contains(&fact.variable) {
                self.always.push(prop);
            } else if let Some(axioms) = axioms.get(&fact.variable) {
                let blocked: Vec<Prop> = axioms.iter().map(|axiom| self.blocked(axiom)).collect();
                self.relaxed.push(blocked, [prop], None);
            }
        }
        Ok(())
    }

    /// A proposition that one literal's negation makes true.
    fn blocked(&mut self, axiom: &GroundAxiom) -> Prop {
        let blocked = self.fresh();
        for fact in axiom.conditions() {
            if let Some(not) = self.negation(fact) {
                self.relaxed.push([not], [blocked], None);
            }
        }
        for &fact in &axiom.negative {
            self.relaxed.push([self.task.number(fact)], [blocked], None);
        }
        blocked
    }

    /// What deletes a fact under a condition makes its negation true; where the condition has negations of its own that
    /// nothing asks for, under the rest of it.
    fn add_conditional_deletes(&mut self, poll: &mut Poll<'_>) -> Result<(), Stop> {
        let actions = &self.task.actions;
        for index in 0..self.task.action_count() {
            poll.check(1 + actions.conditional.get(index).len())?;
            let mut preconditions = None;
            for &when in actions.conditional.get(index) {
                let when = &actions.when[when as usize];
                let Some(&prop) = self.negations.get(&when.assignment).filter(|_| !when.adds) else { continue };
                let preconditions = preconditions.get_or_insert_with(|| {
                    let known = |fact| self.negations.get(fact).copied();
                    let mut all: Vec<Prop> =
                        actions.preconditions.get(index).iter().map(|&fact| self.task.number(fact)).collect();
                    all.extend(actions.negative.get(index).iter().filter_map(known));
                    all
                });
                let mut condition = preconditions.clone();
                condition.extend(when.positive.iter().map(|&fact| self.task.number(fact)));
                condition.extend(when.negative.iter().filter_map(|fact| self.negations.get(fact)));
                self.relaxed.push(condition, [prop], Some(index as u32));
            }
        }
        Ok(())
    }

    fn finish(mut self, goal: Vec<Prop>, poll: &mut Poll<'_>) -> Result<Relaxation, Stop> {
        if !self.negations.is_empty() {
            self.add_conditional_deletes(poll)?;
        }
        let facts = self.task.fact_count() as u32;
        let mut negated = vec![None; (self.props - facts) as usize];
        for (&fact, &prop) in &self.negations {
            negated[(prop - facts) as usize] = Some(fact);
        }
        let (mut preconditions, mut adds, mut action) = (PackedLists::default(), PackedLists::default(), Vec::new());
        let (mut needed, mut added) = (Vec::new(), Vec::new());
        let relaxed = self.relaxed.preconditions.iter().zip(self.relaxed.adds.iter()).zip(&self.relaxed.action);
        for ((preconditions_met, adds_met), &part_of) in relaxed {
            needed.clear();
            needed.extend_from_slice(preconditions_met);
            needed.sort_unstable();
            needed.dedup();
            added.clear();
            added.extend_from_slice(adds_met);
            // What an action deletes in any case, each of its parts deletes.
            let deletes = part_of.map_or(&[][..], |action| self.task.actions.deletes.get(action as usize));
            added.extend(deletes.iter().filter_map(|fact| self.negations.get(fact)));
            added.sort_unstable();
            added.dedup();
            added.retain(|prop| needed.binary_search(prop).is_err());
            poll.check(1 + needed.len() + added.len())?;
            if !added.is_empty() {
                preconditions.push(needed.iter().copied());
                adds.push(added.iter().copied());
                action.push(part_of);
            }
        }
        let props = self.props as usize;
        Ok(Relaxation {
            facts,
            negated,
            always: self.always,
            needed_by: preconditions.inverse(props),
            achievers: adds.inverse(props),
            preconditions,
            adds,
            action,
            goal,
        })
    }
}
