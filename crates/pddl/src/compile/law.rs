//! The law of the compiler: what was compiled means what the text does, by the plainest evaluation of both.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use typelift_model::testing::cases;
use typelift_model::{ActionModel, GroundCall, SplitMix64, State, Symbol, Task};

use super::limits::Limits;
use super::tests::written_and_read;
use super::{domain_within, problem_within};
use crate::generate::{Tape, domain_and_problem, ground_atoms};
use crate::{Atoms, Domain, Meaning, Problem};

/// What each call that is possible in a state leads to, without what follows from it, and what it costs.
type Successors = BTreeMap<GroundCall, BTreeSet<(Atoms, u64)>>;

/// The successors of a state, by the text.
fn stated_successors(domain: &Domain, meaning: &Meaning<'_>, state: &Atoms) -> Successors {
    let mut successors = Successors::new();
    let derived: BTreeSet<&Symbol> = domain.derived.iter().map(|derived| &derived.head.name).collect();
    for action in &domain.actions {
        for objects in meaning.choices(&action.parameters) {
            if meaning.can_be_used(action, &objects, state) {
                let (mut after, cost) = meaning.after(action, &objects, state).expect("every function has a value");
                after.retain(|atom| !derived.contains(&atom.predicate));
                let call = GroundCall { name: action.name.clone(), args: objects };
                successors.insert(call, BTreeSet::from([(after, cost)]));
            }
        }
    }
    successors
}

/// The same of a compiled model. `base` is the state without what follows from it.
fn compiled_successors(model: &ActionModel, task: &Task, base: &State) -> Successors {
    let state = model.with_derived(base);
    let mut successors = Successors::new();
    for schema in &model.actions {
        let mut open: Vec<Vec<Symbol>> = vec![Vec::new()];
        while let Some(objects) = open.pop() {
            if let Some(parameter) = schema.parameters.get(objects.len()) {
                for (object, ty) in &state.objects {
                    if model.hierarchy.is_a(*ty, parameter.ty) {
                        open.push([objects.as_slice(), std::slice::from_ref(object)].concat());
                    }
                }
                continue;
            }
            let holds = |l: &typelift_model::Literal| state.holds(&l.atom.map(|t| t.object(&objects))) == l.positive;
            if !schema.preconditions.iter().all(holds) {
                continue;
            }
            let Ok(action) = schema.instantiate(&objects, &state, &model.hierarchy) else { continue };
            assert_eq!(action.unmet(&state).count(), 0);
            let mut after = base.atoms.clone();
            after.retain(|atom| !action.deletes.contains(atom));
            after.extend(action.adds);
            let cost = schema.cost.of(&objects, &task.values).expect("every function has a value");
            successors.entry(action.call).or_default().insert((after, u64::from(cost)));
        }
    }
    successors
}

/// A state that differs from the initial one in atoms of predicates that change.
fn random_state(domain: &Domain, problem: &Problem, model: &ActionModel, task: &Task, seed: u64) -> State {
    let fluents = super::goal::fluents(model);
    let derived = model.derived_predicates();
    let objects = [domain.constants.as_slice(), &problem.objects].concat();
    let mut state = task.init.clone();
    let mut random = SplitMix64::new(seed);
    for predicate in domain.predicates.iter().filter(|p| fluents.contains(&p.name) && !derived.contains(&p.name)) {
        for atom in ground_atoms(predicate, &objects, &model.hierarchy) {
            if random.below(4) == 0 {
                state.atoms.insert(atom);
            } else {
                state.atoms.remove(&atom);
            }
        }
    }
    state
}

/// Asserts the law for one domain and problem in some states.
fn check(domain: &Domain, problem: &Problem, limits: Limits, seeds: &[u64]) {
    let model = domain_within(domain, limits).expect("it compiles");
    let read = written_and_read(&model);
    assert_eq!(read, model);
    let mut with_goal = model.clone();
    let task = problem_within(problem, &mut with_goal, limits).expect("it compiles");
    let read = written_and_read(&with_goal);
    assert_eq!(read, with_goal);

    let meaning = Meaning::of(domain, problem).expect("it means something");
    let mut states = vec![task.init.clone()];
    states.extend(seeds.iter().map(|&seed| random_state(domain, problem, &model, &task, seed)));
    for base in &states {
        let state = meaning.with_derived(base.atoms.clone());
        let expected = stated_successors(domain, &meaning, &state);
        assert_eq!(compiled_successors(&with_goal, &task, base), expected, "in {:?}", base.atoms);
        let derived = with_goal.with_derived(base);
        let reached = task.goal.holds_in(&derived);
        assert_eq!(reached, meaning.holds(&problem.goal, &state), "the goal in {:?}", base.atoms);
    }
}

fn limits() -> impl Strategy<Value = Limits> {
    let cases = prop_oneof![Just(64_usize), Just(1), Just(3)];
    let written_out = prop_oneof![Just(100_000_u64), Just(0), Just(8)];
    (cases, written_out).prop_map(|(cases, written_out)| Limits { cases, written_out, ..Limits::default() })
}

proptest! {
    #![proptest_config(cases(2_000))]

    #[test]
    fn what_is_compiled_means_the_same(
        numbers in prop::collection::vec(any::<u16>(), 0..250),
        limits in limits(),
        seeds in prop::collection::vec(any::<u64>(), 2),
    ) {
        let (domain, problem) = domain_and_problem(&mut Tape::new(numbers));
        check(&domain, &problem, limits, &seeds);
    }
}
