//! What holds of every plan of the kitchen's 24 tasks: it survives the plainest replay; imagination only ever adds; the
//! same question gets the same answer, and no answer depends on what entities are called.

use std::collections::{BTreeMap, BTreeSet};

use typelift::agent::{Options, Proposal, propose};
use typelift::check::check;
use typelift::imagine::{self, imagine};
use typelift::model::{
    ActionModel, ActionSchema, Budget, Goal, GroundAtom, GroundCall, Plan, Provenance, State, Symbol, Task, strict,
};
use typelift::plan::{FactId, GroundTask, Outcome, Restrictions, TieOrder, ground};
use typelift_kitchen::{KitchenTask, tasks};
use typelift_tests::{Variant, kitchen_model, planning_task};

/// Enough for every task that is solved at all.
const EXPANSIONS: u64 = 20_000;

fn options(imagines: bool) -> Options {
    Options { imagine: imagines.then(imagine::Options::default), ..Options::default() }
}

fn proposal(model: &ActionModel, task: &Task, imagines: bool) -> Proposal {
    let budget = Budget::with_expansions(EXPANSIONS);
    propose(model, task, &Restrictions::default(), &options(imagines), &budget).expect("a plan that checks out")
}

fn kitchen_tasks(model: &ActionModel) -> Vec<(KitchenTask, Task)> {
    tasks().into_iter().map(|task| (task.clone(), planning_task(model, &task, 0))).collect()
}

#[test]
fn every_plan_of_the_kitchen_replays() {
    let models = [kitchen_model(false), kitchen_model(true)];
    let mut solved = BTreeMap::new();
    for variant in Variant::ALL {
        let model = &models[usize::from(variant.individual())];
        for (task, asked) in kitchen_tasks(model) {
            let found = proposal(model, &asked, variant.imagines());
            let Outcome::Solved(plan) = &found.outcome else { continue };
            let end = check(&found.model, &asked, plan).unwrap_or_else(|e| panic!("{variant}, {}: {e}", task.name));
            assert!(end.satisfies(&task.goal));
            // Strictness only ever forbids: the plan is one of the plain model too.
            let plain = found.imagination.added_to(model);
            check(&plain, &asked, plan).unwrap_or_else(|e| panic!("{variant}, {}, plain: {e}", task.name));
            assert!(variant.imagines() || plan.imagined_actions() == 0);
            *solved.entry(variant.name()).or_insert(0) += 1;
        }
    }
    assert_eq!(solved["generalized+imagined"], 24);
    assert_eq!(solved["generalized"], 16);
    assert!(solved["individual+imagined"] >= solved["individual"]);
}

/// What an imagined step deletes on the way to a goal that something holds, it deletes for a goal that this holds no longer.
#[test]
fn what_is_to_hold_no_longer_is_imagined_for_as_well() {
    let model = kitchen_model(false);
    let mut found_by_imagining = 0;
    for (task, asked) in kitchen_tasks(&model) {
        let found = proposal(&model, &asked, true);
        let Outcome::Solved(plan) = &found.outcome else { continue };
        let Some(first) = plan.steps.iter().position(|step| step.imagined.is_some()) else { continue };
        let part = |steps: usize| Plan { steps: plan.steps[..steps].to_vec() };
        let after = |steps: usize| {
            let anything = Task { goal: Goal::default(), ..asked.clone() };
            check(&found.model, &anything, &part(steps)).expect("the beginning of a plan is one")
        };
        let (before, after) = (after(first), after(first + 1));
        for gone in before.atoms.difference(&after.atoms).filter(|atom| asked.init.holds(atom)) {
            let goal = Goal { required: Vec::new(), forbidden: vec![gone.clone()] };
            let without_it = Task { goal, ..asked.clone() };
            if matches!(proposal(&model, &without_it, false).outcome, Outcome::Solved(_)) {
                continue;
            }
            let other = proposal(&model, &without_it, true);
            let Outcome::Solved(plan) = &other.outcome else { panic!("{}: not {gone}", task.name) };
            check(&other.model, &without_it, plan).unwrap_or_else(|e| panic!("{}, not {gone}: {e}", task.name));
            let for_it = |action: &ActionSchema| matches!(&action.provenance, Provenance::Imagined { goal, positive: false, .. } if goal == gone);
            assert!(other.imagination.actions.iter().any(for_it) && other.imagination.undeleted == [gone.clone()]);
            found_by_imagining += 1;
        }
    }
    assert!(found_by_imagining > 3, "{found_by_imagining}");
}

#[test]
fn further_plans_replay_and_none_makes_all_calls_of_another() {
    let model = kitchen_model(false);
    let mut further = 0;
    for (task, asked) in kitchen_tasks(&model) {
        let mut found = proposal(&model, &asked, true);
        let mut plans: Vec<BTreeSet<GroundCall>> = Vec::new();
        let mut outcome = found.outcome.clone();
        while let Outcome::Solved(plan) = outcome {
            check(&found.model, &asked, &plan).unwrap_or_else(|e| panic!("{}: {e}", task.name));
            let calls: BTreeSet<GroundCall> = plan.steps.into_iter().map(|step| step.call).collect();
            assert!(!plans.iter().any(|known| known.is_subset(&calls)), "{}: this is no other plan", task.name);
            plans.push(calls);
            if plans.len() == 3 {
                break;
            }
            outcome = found.next_plan(&Budget::with_expansions(EXPANSIONS)).expect("a plan that checks out");
        }
        further += plans.len() - 1;
    }
    assert!(further >= 5, "{further} further plans: where there are two of a kind, there is another way");
}

#[test]
fn a_better_plan_is_cheaper() {
    // Two identical breads, one at a time: wasteful plans exist, and the first plan is not always the cheapest.
    let model = kitchen_model(true);
    let mut improved = 0;
    for (task, asked) in kitchen_tasks(&model) {
        let mut found = proposal(&model, &asked, true);
        let Outcome::Solved(first) = found.outcome.clone() else { continue };
        // Asked for a dearer bound, anything cheaper than it will do.
        for bound in [first.cost() + 3, first.cost(), first.cost() - 1] {
            let better = found.better_plan(bound, &Budget::with_expansions(2_000)).expect("a plan that checks out");
            if let Outcome::Solved(plan) = better {
                assert!(plan.cost() < bound, "{}: {} where less than {bound} was asked", task.name, plan.cost());
                check(&found.model, &asked, &plan).unwrap_or_else(|e| panic!("{}: {e}", task.name));
                improved += 1;
            }
        }
    }
    assert!(improved > 0, "nothing was tested");
}

#[test]
fn the_same_question_gets_the_same_answer() {
    let model = kitchen_model(false);
    for (task, asked) in kitchen_tasks(&model) {
        let [a, b] = [(); 2].map(|()| proposal(&model, &asked, true));
        assert_eq!(a.outcome, b.outcome, "{}", task.name);
        assert_eq!(a.report(), b.report(), "{}", task.name);
        assert_eq!(a.imagination, b.imagination, "{}", task.name);
        assert_eq!(a.model, b.model, "{}", task.name);
    }
}

/// The task with other names, in another order, for its entities.
fn renamed(task: &Task, multiplier: usize) -> Task {
    let number = |i: usize| (i * multiplier + 11) % 97;
    let names: BTreeMap<&Symbol, Symbol> = task
        .init
        .objects
        .keys()
        .enumerate()
        .map(|(i, name)| (name, Symbol::from(format!("n{:02}", number(i)))))
        .collect();
    let atom = |atom: &GroundAtom| atom.map(|arg| names[arg].clone());
    let init = State {
        objects: task.init.objects.iter().map(|(name, ty)| (names[name].clone(), *ty)).collect(),
        atoms: task.init.atoms.iter().map(atom).collect(),
        ..State::default()
    };
    Task::new(init, task.goal.required.iter().map(atom).collect::<Vec<_>>())
}

#[test]
fn names_of_entities_do_not_change_the_length_of_plans() {
    let model = kitchen_model(false);
    for (task, asked) in kitchen_tasks(&model) {
        let length = |asked: &Task| match proposal(&model, asked, true).outcome {
            Outcome::Solved(plan) => plan.len(),
            other => panic!("{}: {other:?}", task.name),
        };
        let expected = length(&asked);
        for multiplier in [96, 41, 5] {
            assert_eq!(length(&renamed(&asked, multiplier)), expected, "{}, names × {multiplier}", task.name);
        }
    }
}

// Grounding.

fn grounded(model: &ActionModel, task: &Task) -> GroundTask {
    ground(model, task, &Restrictions::default(), TieOrder::default(), &Budget::unlimited()).expect("no limits")
}

/// What a ground action is, by its atoms.
type Described = (GroundCall, BTreeSet<GroundAtom>, BTreeSet<GroundAtom>, BTreeSet<GroundAtom>, BTreeSet<GroundAtom>);

fn atoms(task: &GroundTask, facts: &[FactId]) -> BTreeSet<GroundAtom> {
    facts.iter().map(|&fact| task.atom(fact)).collect()
}

/// Call, preconditions, adds, then negative preconditions and deletes as far as they are among `of`.
fn described(task: &GroundTask, of: &BTreeSet<GroundAtom>) -> BTreeSet<Described> {
    let among = |facts: &[FactId]| atoms(task, facts).intersection(of).cloned().collect();
    task.ops()
        .map(|(id, op)| {
            let (preconditions, adds) = (atoms(task, &op.preconditions), atoms(task, &op.adds));
            (task.step(id).call, preconditions, adds, among(&op.negative), among(&op.deletes))
        })
        .collect()
}

#[test]
fn imagination_only_adds() {
    let models = [kitchen_model(false), kitchen_model(true)];
    let mut added = 0;
    for model in &models {
        for (task, asked) in kitchen_tasks(model) {
            let imagined =
                imagine(model, &asked, &Restrictions::default(), &imagine::Options::default(), &Budget::unlimited())
                    .expect("no limits");
            for rewrite in [Clone::clone, strict] {
                let (base, widened) = (rewrite(model), rewrite(&imagined.added_to(model)));
                let (base, widened) = (grounded(&base, &asked), grounded(&widened, &asked));
                // What cannot be reached without imagination is no part of the actions there.
                let of: BTreeSet<GroundAtom> = base.reached_facts().map(|fact| base.atom(fact)).collect();
                let (without, with) = (described(&base, &of), described(&widened, &of));
                let lost: Vec<_> = without.difference(&with).collect();
                assert!(lost.is_empty(), "{}: {lost:?}", task.name);
                assert!(of.iter().all(|atom| widened.reaches(atom)), "{}", task.name);
                if imagined.actions.is_empty() {
                    assert_eq!(without, with, "{}", task.name);
                } else {
                    added += with.len() - without.len();
                }
            }
            for action in &imagined.actions {
                if let Provenance::Imagined { goal, positive, .. } = &action.provenance {
                    assert!(
                        *positive && imagined.unreachable.contains(goal),
                        "{}: {} for {goal}",
                        task.name,
                        action.name
                    );
                }
            }
        }
    }
    assert!(added > 0);
}
