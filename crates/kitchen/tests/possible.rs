//! Which calls make sense: those that are not refused, and no other.

use std::collections::BTreeSet;

use typelift_kitchen::{Kitchen, Room, demonstrations, tasks};
use typelift_model::{GroundCall, Symbol};
use typelift_world::{Reset, Scene, World};

/// Every call in its long form that a copy of the room carries out.
fn not_refused(room: &Room, names: &[Symbol]) -> BTreeSet<GroundCall> {
    let mut found = BTreeSet::new();
    for action in ["PICK", "PLACE", "USE"] {
        for (first, second) in names.iter().flat_map(|first| names.iter().map(move |second| (first, second))) {
            let args = vec![room.agent_name().clone(), first.clone(), second.clone()];
            let call = GroundCall { name: action.into(), args };
            if room.clone().act(&call).is_ok() {
                found.insert(call);
            }
        }
    }
    found
}

fn check(kitchen: &Kitchen) {
    let room = kitchen.room().expect("set up");
    let names: Vec<Symbol> = room.snapshot().entities.iter().map(|entity| entity.id.clone()).collect();
    let said = kitchen.possible_calls().expect("set up");
    assert!(said.is_sorted());
    assert_eq!(said.into_iter().collect::<BTreeSet<_>>(), not_refused(room, &names));
}

#[test]
fn before_the_first_reset_nothing_is_known() {
    assert_eq!(Kitchen::new().possible_calls(), None);
}

#[test]
fn all_that_is_not_refused_and_no_more() {
    for task in tasks().iter().step_by(5) {
        let mut kitchen = Kitchen::new();
        kitchen.reset(&Reset { seed: 1, scenario: Some(task.scenario.clone()) }).expect("a room");
        check(&kitchen);
    }
    // Along a demonstration hands fill and tools get ready.
    let recording = &demonstrations(0)[3].recording;
    let Scene::Snapshot(first) = &recording.first else { panic!("a snapshot") };
    let mut kitchen = Kitchen::from(Room::from_snapshot(first).expect("a room"));
    for call in recording.steps.iter().map(|(action, _)| &action.call) {
        check(&kitchen);
        let is_possible = kitchen
            .possible_calls()
            .expect("set up")
            .iter()
            .any(|possible| possible.name == call.name && call.args.iter().all(|arg| possible.args.contains(arg)));
        assert!(is_possible, "{call}");
        assert!(kitchen.act(call).expect("a world").executed);
    }
    check(&kitchen);
}
