//! The demonstrations: their lengths, their goals, and that the simulator repeats them.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;

use typelift_kitchen::{Demonstration, demonstrations, hierarchy, parse_config, replay};
use typelift_model::{GroundCall, State, Symbol};
use typelift_world::{Parser, Scene};

fn states(demonstration: &Demonstration) -> Vec<State> {
    let mut parser = Parser::new(hierarchy(), parse_config());
    demonstration.recording.scenes().map(|scene| parser.parse(scene).unwrap()).collect()
}

#[test]
fn lengths_and_goals() {
    for seed in 0..20 {
        let all = demonstrations(seed);
        let lengths: Vec<usize> = all.iter().map(|d| d.recording.steps.len()).collect();
        assert_eq!(lengths, [5, 5, 5, 10, 8, 15, 10, 10]);
        for demonstration in &all {
            let states = states(demonstration);
            let goal = &demonstration.recording.header.goal;
            assert!(goal.holds_in(states.last().unwrap()), "{}", demonstration.name);
            let goal_before_the_end = states[..states.len() - 1].iter().any(|state| goal.holds_in(state));
            assert!(!goal_before_the_end && states.windows(2).all(|pair| pair[0].atoms != pair[1].atoms));
        }
    }
}

#[test]
fn names_and_words() {
    let all = demonstrations(0);
    let names: Vec<(&str, &str)> = all.iter().map(|d| (d.name.as_str(), d.recording.header.task.as_str())).collect();
    let expected = [
        ("cut_lettuce", "cut a lettuce"),
        ("cut_banana", "cut a banana"),
        ("blend_carrot", "blend a carrot"),
        ("blend_two_carrots", "blend two carrots"),
        ("toast_bread", "toast a bread"),
        ("toast_two_breads", "toast two breads"),
        ("cut_tomato_onion", "cut a tomato and an onion"),
        ("cut_lettuce_blend_carrot", "cut a lettuce and blend a carrot"),
    ];
    assert_eq!(names, expected);
    let goal: Vec<String> = all[5].recording.header.goal.required.iter().map(ToString::to_string).collect();
    assert_eq!(goal[..2], ["toast_state_Toasted(bread_1)", "content_holds(plate_1,bread_1)"]);
}

#[test]
fn two_breads_are_toasted_at_once_and_taken_out_top_first() {
    let calls: Vec<String> =
        demonstrations(3)[5].recording.steps[9..].iter().map(|(action, _)| action.call.to_string()).collect();
    let expected = [
        "PLACE(agent_1, toaster_1, bread_2)",
        "USE(agent_1, toaster_1, bread_2)",
        "PICK(agent_1, toaster_1, bread_2)",
        "PLACE(agent_1, plate_1, bread_2)",
        "PICK(agent_1, toaster_1, bread_1)",
        "PLACE(agent_1, plate_1, bread_1)",
    ];
    assert_eq!(calls, expected);
}

/// The effect of each step over the types of what it touches: 39 different ones in 68 steps.
#[test]
fn sixty_eight_transitions_of_thirty_nine_kinds() {
    let hierarchy = hierarchy();
    let mut kinds = BTreeSet::new();
    let mut transitions = 0;
    for demonstration in demonstrations(1) {
        for (pair, (call, _)) in states(&demonstration).windows(2).zip(recorded(&demonstration)) {
            let lifted = |name: &Symbol| {
                let role = call.args.iter().position(|arg| arg == name).map_or(-1, |index| index as i64);
                format!("{role}:{}", hierarchy.name(pair[0].objects[name]))
            };
            let added: BTreeSet<_> = pair[0].added(&pair[1]).map(|atom| atom.map(lifted)).collect();
            let deleted: BTreeSet<_> = pair[0].deleted(&pair[1]).map(|atom| atom.map(lifted)).collect();
            kinds.insert((call.name.clone(), added, deleted));
            transitions += 1;
        }
    }
    assert_eq!((transitions, kinds.len()), (68, 39));
}

#[test]
fn a_seed_means_the_same_demonstrations() {
    assert_eq!(demonstrations(9), demonstrations(9));
    assert_ne!(demonstrations(9), demonstrations(10));
}

fn recorded(demonstration: &Demonstration) -> Vec<(GroundCall, Scene)> {
    demonstration.recording.steps.iter().map(|(action, after)| (action.call.clone(), after.clone())).collect()
}

#[test]
fn a_recording_is_repeated() {
    for demonstration in demonstrations(2) {
        let Scene::Snapshot(first) = &demonstration.recording.first else { panic!("a snapshot") };
        let report = replay(first, recorded(&demonstration)).unwrap();
        assert_eq!((report.steps, report.difference), (demonstration.recording.steps.len(), None));
    }
}

#[test]
fn the_first_difference_is_found() {
    let demonstration = &demonstrations(2)[0];
    let Scene::Snapshot(first) = &demonstration.recording.first else { panic!("a snapshot") };
    let mut steps = recorded(demonstration);
    for (_, scene) in &mut steps[2..] {
        let Scene::Snapshot(snapshot) = scene else { panic!("a snapshot") };
        let lettuce = snapshot.entities.iter_mut().find(|e| e.id == "lettuce_1").unwrap();
        lettuce.attributes.insert("chop_state".into(), serde_json::from_str("\"Sliced\"").unwrap());
    }
    let report = replay(first, steps).unwrap();
    let difference = report.difference.unwrap();
    assert_eq!((report.steps, difference.step, difference.refusal), (3, 3, None));
    assert_eq!(difference.call.unwrap().to_string(), "USE(agent_1, cutboard_1, lettuce_1)");
    assert_eq!(difference.missing[0].to_string(), "chop_state_Sliced(lettuce_1)");
    assert_eq!(difference.unexpected[0].to_string(), "chop_state_Chopped(lettuce_1)");
    assert_eq!((difference.missing.len(), difference.unexpected.len()), (1, 1));
}

#[test]
fn an_action_that_is_refused_here_is_a_difference() {
    let demonstration = &demonstrations(2)[0];
    let Scene::Snapshot(first) = &demonstration.recording.first else { panic!("a snapshot") };
    let mut steps = recorded(demonstration);
    steps.remove(1);
    let difference = replay(first, steps).unwrap().difference.unwrap();
    assert_eq!(difference.step, 2);
    assert_eq!(difference.refusal.unwrap().to_string(), "lettuce_1 does not lie in cutboard_1");
}

#[test]
fn unknown_atoms_are_not_compared() {
    let demonstration = &demonstrations(2)[0];
    let Scene::Snapshot(first) = &demonstration.recording.first else { panic!("a snapshot") };
    let after = &states(demonstration)[1];
    let hierarchy = hierarchy();
    let hidden: BTreeSet<_> = after.atoms.iter().filter(|atom| atom.predicate == "free").cloned().collect();
    let objects = after.objects.iter().map(|(name, ty)| (name.clone(), hierarchy.name(*ty).clone())).collect();
    let mut atoms = after.atoms.difference(&hidden).cloned().collect::<BTreeSet<_>>();
    let call = demonstration.recording.steps[0].0.call.clone();
    let symbolic = |atoms: &BTreeSet<_>| Scene::Symbolic {
        objects: std::collections::BTreeMap::clone(&objects),
        atoms: atoms.clone(),
        unknown: hidden.iter().cloned().map(Into::into).collect(),
    };
    assert_eq!(replay(first, [(call.clone(), symbolic(&atoms))]).unwrap().difference, None);
    let gone = atoms.pop_first().unwrap();
    let difference = replay(first, [(call, symbolic(&atoms))]).unwrap().difference.unwrap();
    assert_eq!((difference.missing, difference.unexpected), (vec![], vec![gone]));
}
