//! What merging drops: whoever went to a door was in a room that it joins, and whoever went to a key was in the room that it lies
//! in. To go to a thing needs neither, and that is said.

use typelift::learn::{evidence_of, learn};
use typelift::model::{GroundCall, Hierarchy, ParseConfig, Symbol};
use typelift::words::{TypeNote, dropped_by_merging};
use typelift::world::{Dataset, Parser, Trace, TraceAction};
use typelift_tests::by_hand::bench;

/// What is noted after a walk to a door and one to a key, from a room, where also this holds.
fn noted(always: &[&str]) -> Vec<TypeNote> {
    let edges = [("agent", "object"), ("room", "object"), ("thing", "object"), ("door", "thing"), ("key", "thing")];
    let hierarchy = Hierarchy::from_edges(edges).expect("a tree");
    let mut parser = Parser::new(hierarchy.clone(), ParseConfig::default());
    let mut shown = Dataset { hierarchy: hierarchy.clone(), ..Dataset::default() };
    for (thing, place) in [("door", "joins(it,hall)"), ("key", "in(it,hall)")] {
        let objects = [("robot", "agent"), ("hall", "room"), ("it", thing)];
        let mut atoms = [&[place], always].concat();
        let before = bench(&mut parser, &objects, &atoms);
        atoms.push("at(robot,it)");
        let after = bench(&mut parser, &objects, &atoms);
        let call = GroundCall { name: Symbol::new("goto"), args: ["robot", "it", "hall"].map(Symbol::new).to_vec() };
        let actions = vec![TraceAction::from(call)];
        shown.traces.push(Trace { states: vec![before, after], actions, ..Trace::default() });
    }
    let evidence = evidence_of(&shown);
    let evidence = evidence.total();
    let model = learn(&hierarchy, &evidence, &Default::default()).expect("a model").model;
    dropped_by_merging(&model, &evidence)
}

#[test]
fn what_each_of_the_merged_actions_needed_of_two_parameters_is_noted_as_dropped() {
    let notes = noted(&[]);
    let texts: Vec<&str> = notes.iter().map(|note| note.text.as_str()).collect();
    assert_eq!(
        texts,
        [
            "merging goto-agent-door-room and goto-agent-key-room dropped in(?x1,?x2) (1 of 1) and joins(?x1,?x2) (1 of 1)"
        ]
    );
    let met: Vec<&str> = notes[0].met.iter().map(Symbol::as_str).collect();
    assert_eq!(met, ["door", "key", "room"]);
}

#[test]
fn nothing_is_noted_where_something_that_all_needed_relates_the_two() {
    assert_eq!(noted(&["near(it,hall)"]), []);
}
