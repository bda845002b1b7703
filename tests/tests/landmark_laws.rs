//! Landmarks are necessary, and none is missing: on the kitchen's 24 tasks, and on tiny random problems that are solved by
//! enumeration beside.

use std::collections::BTreeSet;

use proptest::prelude::*;
use typelift::imagine::{self, imagine};
use typelift::model::{ActionModel, Budget, Symbol, Task, strict};
use typelift::plan::{FactId, GroundTask, Op, Restrictions, TieOrder, ground, landmark_sequences};
use typelift_kitchen::tasks;
use typelift_model::testing::{Cheapest, Tiny, all_instances, cases, cheapest, cheapest_without, tiny};
use typelift_tests::{kitchen_model, planning_task};

fn grounded(model: &ActionModel, task: &Task) -> GroundTask {
    ground(model, task, &Restrictions::default(), TieOrder::default(), &Budget::unlimited()).expect("no limits")
}

/// What can become true without the actions that `left_out` names and without the additions that it names.
fn relaxed(task: &GroundTask, left_out: impl Fn(&Op, FactId, &[FactId]) -> bool) -> BTreeSet<FactId> {
    let mut reached: BTreeSet<FactId> = task.init().iter().copied().collect();
    loop {
        let before = reached.len();
        for (_, op) in task.ops() {
            if !op.preconditions.iter().all(|fact| reached.contains(fact)) {
                continue;
            }
            let always = op.adds.iter().map(|&fact| (fact, &[][..]));
            let adding = op.conditional.iter().filter(|e| e.adds).map(|e| (e.fact, e.positive.as_slice()));
            for (fact, condition) in always.chain(adding) {
                if condition.iter().all(|c| reached.contains(c)) && !left_out(op, fact, condition) {
                    reached.insert(fact);
                }
            }
        }
        if reached.len() == before {
            return reached;
        }
    }
}

/// Whether the goal can be reached without anything that achieves a fact, if nothing is ever deleted.
fn relaxed_without(task: &GroundTask, fact: FactId) -> bool {
    let reached = relaxed(task, |_, added, _| added == fact);
    task.goal().iter().all(|goal| reached.contains(goal))
}

/// No plan avoids a landmark.
fn assert_necessary(task: &GroundTask, context: &str, avoidable: impl Fn(FactId) -> bool) {
    let mut checked = BTreeSet::new();
    for sequence in landmark_sequences(task, &Budget::unlimited()).expect("no limits") {
        for landmark in sequence.facts {
            assert!(!task.init().contains(&landmark), "{context}: {} holds already", task.atom(landmark));
            if checked.insert(landmark) {
                assert!(!avoidable(landmark), "{context}: {} is not necessary", task.atom(landmark));
            }
        }
    }
    // What is asked is a landmark, unless it holds.
    for goal in task.goal().iter().filter(|goal| !task.init().contains(goal)) {
        assert!(checked.contains(goal), "{context}: {} is missing", task.atom(*goal));
    }
}

/// Every fact without whose use a goal atom cannot be reached, and which mentions the goal object, is a landmark of
/// its sequence.
fn assert_complete(task: &GroundTask) {
    let sequences = landmark_sequences(task, &Budget::unlimited()).expect("no limits");
    let objects: BTreeSet<Symbol> = sequences.iter().filter_map(|s| s.object.clone()).collect();
    for &goal in task.goal() {
        let atom = task.atom(goal);
        let owner = atom.args.iter().find(|&arg| objects.contains(arg));
        for fact in task.reached_facts().filter(|fact| !task.init().contains(fact)) {
            let reached =
                relaxed(task, |op, _, condition| op.preconditions.contains(&fact) || condition.contains(&fact));
            let is_used = !task.init().contains(&goal) && (fact == goal || !reached.contains(&goal));
            let mentions = match owner {
                Some(object) => task.atom(fact).args.contains(object),
                None => task.atom(fact).args.iter().any(|arg| atom.args.contains(arg)),
            };
            if is_used && (mentions || fact == goal) {
                let mut own = sequences.iter().filter(|s| s.object.as_ref() == owner);
                assert!(
                    own.any(|s| s.facts.contains(&fact)),
                    "{} is necessary for {atom} and missing",
                    task.atom(fact)
                );
            }
        }
    }
}

#[test]
fn landmarks_of_the_kitchen_are_necessary() {
    let model = kitchen_model(false);
    for task in tasks() {
        let asked = planning_task(&model, &task, 0);
        let imagined =
            imagine(&model, &asked, &Restrictions::default(), &imagine::Options::default(), &Budget::unlimited())
                .expect("no limits");
        let ground = grounded(&strict(&imagined.added_to(&model)), &asked);
        assert_necessary(&ground, &task.name, |fact| relaxed_without(&ground, fact));
        if ["T1.1", "T1.3", "T2.4", "T4.1"].contains(&task.name.as_str()) {
            assert_complete(&ground);
        }
    }
}

proptest! {
    #![proptest_config(cases(4_000))]

    #[test]
    fn landmarks_of_tiny_problems_are_necessary(Tiny { model, task } in tiny(4)) {
        let ground = grounded(&model, &task);
        let all = all_instances(&model, &task);
        if matches!(cheapest(&all, &task, 5_000), Cheapest::Cost(_)) {
            // Of actions that are never applicable landmarks know more than the delete relaxation.
            let without = |fact| cheapest_without(&all, &task, 5_000, &ground.atom(fact));
            let avoidable = |fact| matches!(without(fact), Cheapest::Cost(_));
            assert_necessary(&ground, "a tiny problem", avoidable);
            assert_complete(&ground);
        }
    }
}
