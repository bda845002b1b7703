//! The law of the compiler: what was compiled means what the text does, by the plainest evaluation of both.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use typelift_model::testing::cases;
use typelift_model::{ActionModel, Atom, GroundAtom, GroundCall, SplitMix64, State, Symbol, Task, TypeId};

use super::limits::Limits;
use super::tests::written_and_read;
use super::{domain_within, problem_within};
use crate::generate::{Tape, domain_and_problem, ground_atoms};
use crate::{Action, Amount, Domain, Formula, PddlAtom, PddlEffect, PddlTerm, Problem, Typed};

/// What a domain means over these objects.
struct Meaning<'d> {
    domain: &'d Domain,
    problem: &'d Problem,
    model: &'d ActionModel,
    objects: BTreeMap<Symbol, TypeId>,
}

type Atoms = BTreeSet<GroundAtom>;
type Choice = Vec<(Symbol, Symbol)>;

impl Meaning<'_> {
    /// Every choice of objects for these variables, after what was chosen before.
    fn choices(&self, variables: &[Typed], chosen: &Choice) -> Vec<Choice> {
        let hierarchy = &self.model.hierarchy;
        let mut choices = vec![chosen.clone()];
        for Typed { name, types } in variables {
            let fits = |ty: &TypeId| {
                types.iter().any(|of| hierarchy.id(of.as_str()).is_some_and(|of| hierarchy.is_a(*ty, of)))
            };
            let fitting: Vec<&Symbol> = self.objects.iter().filter(|(_, ty)| fits(ty)).map(|(name, _)| name).collect();
            let mut longer = Vec::new();
            for choice in &choices {
                for object in &fitting {
                    let mut choice = choice.clone();
                    choice.push((name.clone(), (*object).clone()));
                    longer.push(choice);
                }
            }
            choices = longer;
        }
        choices
    }

    fn object(&self, term: &PddlTerm, chosen: &Choice) -> Symbol {
        match term {
            PddlTerm::Object(name) => name.clone(),
            PddlTerm::Variable(name) => {
                chosen.iter().rev().find(|(variable, _)| variable == name).expect("it is in scope").1.clone()
            }
        }
    }

    fn ground(&self, atom: &PddlAtom, chosen: &Choice) -> GroundAtom {
        atom.map(|term| self.object(term, chosen))
    }

    fn holds(&self, formula: &Formula, state: &Atoms, chosen: &Choice) -> bool {
        let holds = |formula: &Formula| self.holds(formula, state, chosen);
        match formula {
            Formula::Atom(atom) => state.contains(&self.ground(atom, chosen)),
            Formula::Equal(a, b) => self.object(a, chosen) == self.object(b, chosen),
            Formula::Not(inner) => !holds(inner),
            Formula::And(parts) => parts.iter().all(holds),
            Formula::Or(parts) => parts.iter().any(holds),
            Formula::Imply(premise, conclusion) => !holds(premise) || holds(conclusion),
            Formula::Exists(variables, body) => {
                self.choices(variables, chosen).iter().any(|chosen| self.holds(body, state, chosen))
            }
            Formula::Forall(variables, body) => {
                self.choices(variables, chosen).iter().all(|chosen| self.holds(body, state, chosen))
            }
        }
    }

    /// The state with what follows, one derived predicate after the other.
    fn with_derived(&self, state: &Atoms) -> Atoms {
        let mut state = state.clone();
        for derived in &self.domain.derived {
            loop {
                let before = state.len();
                for chosen in self.choices(&derived.head.parameters, &Choice::new()) {
                    if self.holds(&derived.condition, &state, &chosen) {
                        let args = chosen.iter().map(|(_, object)| object.clone()).collect();
                        state.insert(Atom { predicate: derived.head.name.clone(), args });
                    }
                }
                if state.len() == before {
                    break;
                }
            }
        }
        state
    }

    fn changes(&self, effect: &PddlEffect, state: &Atoms, chosen: &Choice, changes: &mut (Atoms, Atoms, u32)) {
        match effect {
            PddlEffect::And(parts) => parts.iter().for_each(|part| self.changes(part, state, chosen, changes)),
            PddlEffect::Add(atom) => drop(changes.0.insert(self.ground(atom, chosen))),
            PddlEffect::Delete(atom) => drop(changes.1.insert(self.ground(atom, chosen))),
            PddlEffect::Forall(variables, body) => {
                for chosen in self.choices(variables, chosen) {
                    self.changes(body, state, &chosen, changes);
                }
            }
            PddlEffect::When(condition, body) if self.holds(condition, state, chosen) => {
                self.changes(body, state, chosen, changes);
            }
            PddlEffect::When(..) => {}
            PddlEffect::Increase(Amount::Number(number)) => changes.2 += number,
            PddlEffect::Increase(Amount::Function(function)) => {
                let function = self.ground(function, chosen);
                changes.2 += self.problem.values.iter().find(|(f, _)| *f == function).expect("it has a value").1;
            }
        }
    }

    /// What each call that is possible in a state leads to, and what it costs.
    fn successors(&self, action: &Action, base: &Atoms, state: &Atoms, has_costs: bool) -> Successors {
        let mut successors = Successors::new();
        for chosen in self.choices(&action.parameters, &Choice::new()) {
            if self.holds(&action.precondition, state, &chosen) {
                let mut changes = Default::default();
                self.changes(&action.effect, state, &chosen, &mut changes);
                let (adds, deletes, cost) = changes;
                let args = chosen.iter().map(|(_, object)| object.clone()).collect();
                let after = base.difference(&deletes).chain(&adds).cloned().collect();
                let cost = if has_costs { cost } else { 1 };
                successors.insert(GroundCall { name: action.name.clone(), args }, BTreeSet::from([(after, cost)]));
            }
        }
        successors
    }
}

type Successors = BTreeMap<GroundCall, BTreeSet<(Atoms, u32)>>;

/// The same of a compiled model, all actions together. `base` is the state without what follows from it.
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
            successors.entry(action.call).or_default().insert((after, cost));
        }
    }
    successors
}

/// A state that differs from the initial one in atoms of predicates that change.
fn random_state(meaning: &Meaning<'_>, task: &Task, seed: u64) -> State {
    let fluents = super::goal::fluents(meaning.model);
    let derived = meaning.model.derived_predicates();
    let objects = [meaning.domain.constants.as_slice(), &meaning.problem.objects].concat();
    let mut state = task.init.clone();
    let mut random = SplitMix64::new(seed);
    for predicate in
        meaning.domain.predicates.iter().filter(|p| fluents.contains(&p.name) && !derived.contains(&p.name))
    {
        for atom in ground_atoms(predicate, &objects, &meaning.model.hierarchy) {
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

    let has_costs = problem.minimizes_cost;
    let meaning = Meaning { domain, problem, model: &model, objects: task.init.objects.clone() };
    let mut states = vec![task.init.clone()];
    states.extend(seeds.iter().map(|&seed| random_state(&meaning, &task, seed)));
    for base in &states {
        let state = meaning.with_derived(&base.atoms);
        let actions = domain.actions.iter();
        let expected: Successors =
            actions.flat_map(|action| meaning.successors(action, &base.atoms, &state, has_costs)).collect();
        assert_eq!(compiled_successors(&with_goal, &task, base), expected, "in {:?}", base.atoms);
        let derived = with_goal.with_derived(base);
        let reached = task.goal.holds_in(&derived);
        assert_eq!(reached, meaning.holds(&problem.goal, &state, &Choice::new()), "the goal in {:?}", base.atoms);
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
