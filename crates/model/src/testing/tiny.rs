//! Tiny random planning problems: conditional effects, constants, negations, types, costs.

use proptest::prelude::*;

use super::enumerate::{all_instances, reachable_in_order};
use crate::{
    ActionModel, ActionSchema, Atom, Effect, Goal, GroundAtom, Hierarchy, LiftedCall, Literal, Parameter, Provenance,
    State, Symbol, Task, Term,
};

/// Predicates with their numbers of arguments.
const PREDICATES: [(&str, usize); 4] = [("lit", 0), ("wet", 1), ("hot", 1), ("on", 2)];
const TYPES: [&str; 4] = ["object", "block", "cube", "table"];
const OBJECTS: [&str; 4] = ["ada", "bob", "cyd", "dan"];

/// A model and a task over it.
#[derive(Debug, Clone)]
pub struct Tiny {
    /// The actions.
    pub model: ActionModel,
    /// What is asked.
    pub task: Task,
}

/// `cube` below `block`, `table` beside it.
fn types() -> Hierarchy {
    Hierarchy::from_edges([("block", "object"), ("cube", "block"), ("table", "object")]).expect("a tree")
}

/// An atom, its arguments drawn from `0..limit`.
fn pattern(limit: usize) -> impl Strategy<Value = (usize, [usize; 2])> {
    (0..PREDICATES.len(), [0..limit, 0..limit])
}

fn atom<T>((predicate, args): (usize, [usize; 2]), term: impl Fn(usize) -> T) -> Atom<T> {
    let (name, arity) = PREDICATES[predicate];
    Atom::new(name, args[..arity].iter().map(|&i| term(i)).collect())
}

fn ground((objects, drawn): (usize, (usize, [usize; 2]))) -> GroundAtom {
    atom(drawn, |i| Symbol::new(OBJECTS[i % objects]))
}

/// A signed atom over parameters, and now and then a constant.
fn literal(parameters: usize, objects: usize) -> impl Strategy<Value = Literal> {
    let term = move |i: usize| match i {
        i if i < 6 && parameters > 0 => Term::Param((i % parameters) as u32),
        i => Term::Const(Symbol::new(OBJECTS[i % objects])),
    };
    (pattern(8), prop::bool::weighted(0.75))
        .prop_map(move |(drawn, positive)| Literal { atom: atom(drawn, term), positive })
}

fn action(number: usize, objects: usize) -> impl Strategy<Value = ActionSchema> {
    (0..=3_usize).prop_flat_map(move |n| {
        let literals = |range| prop::collection::vec(literal(n, objects), range);
        let effect = (prop_oneof![3 => literals(0..1), 1 => literals(1..3)], literal(n, objects))
            .prop_map(|(condition, literal)| Effect::when(condition, literal));
        let pairs = prop::collection::vec(any::<bool>(), 3);
        (prop::collection::vec(0..TYPES.len(), n), literals(0..3), prop::collection::vec(effect, 2..5), pairs, 1..3_u32)
            .prop_map(move |(types_drawn, mut preconditions, mut effects, pairs, cost)| {
                let hierarchy = types();
                let ty = |i: usize| hierarchy.id(TYPES[i]).expect("a type");
                preconditions.sort_unstable();
                preconditions.dedup();
                effects.sort_unstable();
                effects.dedup();
                let mut distinct = ActionSchema::all_distinct(n);
                let mut keep = pairs.into_iter();
                distinct.retain(|_| keep.next().unwrap_or(false));
                let name = Symbol::from(format!("act-{number}"));
                ActionSchema {
                    call: LiftedCall { name: name.clone(), args: (0..n as u32).map(Term::Param).collect() },
                    name,
                    parameters: types_drawn
                        .iter()
                        .enumerate()
                        .map(|(i, &t)| Parameter { name: Symbol::from(format!("x{i}")), ty: ty(t) })
                        .collect(),
                    preconditions,
                    distinct,
                    effects,
                    cost: cost.into(),
                    strict: false,
                    named_by_call: true,
                    provenance: Provenance::Given,
                }
            })
    })
}

/// Random problems of at most `most` objects.
pub fn tiny(most: usize) -> impl Strategy<Value = Tiny> {
    (1..=most).prop_flat_map(|n| {
        let actions = (2..=3_usize).prop_flat_map(move |count| (0..count).map(|i| action(i, n)).collect::<Vec<_>>());
        let init = prop::collection::vec(pattern(8), 1..6);
        let goal = prop::collection::vec((pattern(8), prop::bool::weighted(0.9), any::<prop::sample::Index>()), 1..3);
        (actions, prop::collection::vec(1..TYPES.len(), n), init, goal).prop_map(move |(actions, kinds, init, goal)| {
            let hierarchy = types();
            let ty = |i: usize| hierarchy.id(TYPES[i]).expect("a type");
            let objects = kinds.iter().enumerate().map(|(i, &t)| (Symbol::new(OBJECTS[i]), ty(t))).collect();
            let atoms = init.into_iter().map(|drawn| ground((n, drawn))).collect();
            let init = State { objects, atoms, ..State::default() };
            let predicates =
                PREDICATES.iter().map(|(name, n)| (Symbol::new(name), vec![hierarchy.root(); *n])).collect();
            let model = ActionModel { hierarchy: hierarchy.clone(), predicates, actions, ..ActionModel::default() };
            let mut task = Task::new(init, Goal::default());
            // Mostly what is reachable, and the hardest of that: anything else is unsolvable, or solved in a step.
            let reachable = reachable_in_order(&all_instances(&model, &task), &task);
            let hard = &reachable[reachable.len() * 3 / 4..];
            for (drawn, reach, index) in goal {
                let atom = if reach && !hard.is_empty() { index.get(hard).clone() } else { ground((n, drawn)) };
                if !task.goal.required.contains(&atom) {
                    task.goal.required.push(atom);
                }
            }
            Tiny { model, task }
        })
    })
}
