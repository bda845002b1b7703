//! What was learned of a call goes before what was imagined of it. A robot goes to a place, with what it holds; that something
//! else that stands there goes along can be imagined, since the call does not name it.

use typelift::agent::{Options, Proposal, propose};
use typelift::imagine;
use typelift::learn::{evidence_of, learn};
use typelift::model::{ActionModel, Budget, GroundAtom, GroundCall, Hierarchy, ParseConfig, Step, Symbol, Task};
use typelift::plan::{Outcome, Restrictions};
use typelift::world::{Dataset, Parser, Trace, TraceAction};
use typelift_tests::by_hand::bench;

const OBJECTS: [(&str, &str); 6] = [
    ("robot_1", "robot"),
    ("bear_1", "bear"),
    ("pawn_1", "pawn"),
    ("hall", "place"),
    ("yard", "place"),
    ("shed", "place"),
];

/// A model learned from two walks, one with a bear in hand and one without, and what reads its scenes.
fn walks() -> (ActionModel, Parser) {
    let edges = [
        ("place", "object"),
        ("moveable", "object"),
        ("robot", "moveable"),
        ("toy", "moveable"),
        ("bear", "toy"),
        ("pawn", "toy"),
    ];
    let hierarchy = Hierarchy::from_edges(edges).expect("a tree");
    let mut parser = Parser::new(hierarchy.clone(), ParseConfig::default());
    let mut shown = Dataset { hierarchy: hierarchy.clone(), ..Dataset::default() };
    let walk = |robot: &str, bear: &str, hand: &str| {
        vec![format!("at(robot_1,{robot})"), format!("at(bear_1,{bear})"), hand.to_owned()]
    };
    for hand in ["held(bear_1)", "free(robot_1)"] {
        let places = ["hall", "yard", "shed"];
        let states = places.map(|place| {
            let bear = if hand.starts_with("held") { place } else { "hall" };
            let atoms = walk(place, bear, hand);
            bench(&mut parser, &OBJECTS, &atoms.iter().map(String::as_str).collect::<Vec<_>>())
        });
        let go = |place: &str| GroundCall { name: Symbol::new("go"), args: vec![Symbol::new(place)] };
        let actions = places[1..].iter().map(|place| TraceAction::from(go(place))).collect();
        shown.traces.push(Trace { states: states.to_vec(), actions, ..Trace::default() });
    }
    (learn(&hierarchy, &evidence_of(&shown).total(), &Default::default()).expect("a model").model, parser)
}

/// What is proposed to have the pawn in the yard, from where these atoms hold.
fn proposed(atoms: &[&str]) -> Proposal {
    let (model, mut parser) = walks();
    let goal = GroundAtom::parse("at(pawn_1,yard)").expect("an atom");
    let task = Task::new(bench(&mut parser, &OBJECTS, atoms), vec![goal]);
    let options = Options { imagine: Some(imagine::Options::default()), ..Options::default() };
    propose(&model, &task, &Restrictions::default(), &options, &Budget::with_expansions(2_000)).expect("an answer")
}

#[test]
fn where_what_was_learned_can_be_used_nothing_else_is_imagined_of_the_call() {
    let beside = proposed(&["at(robot_1,hall)", "at(bear_1,hall)", "at(pawn_1,hall)", "held(bear_1)"]);
    assert_eq!(beside.outcome, Outcome::Unsolvable, "who goes is the robot");
    assert!(!beside.imagination.actions.is_empty());
    assert_eq!(beside.imagination.usable.len(), 1, "for what it was imagined from, and not for what else has the call");
}

#[test]
fn where_it_cannot_be_used_imagination_stands() {
    let elsewhere = proposed(&["at(robot_1,shed)", "at(bear_1,hall)", "at(pawn_1,hall)", "held(bear_1)"]);
    let Outcome::Solved(plan) = &elsewhere.outcome else { panic!("there is a plan: {:?}", elsewhere.outcome) };
    let steps: Vec<(String, bool)> =
        plan.steps.iter().map(|Step { call, imagined, .. }| (call.to_string(), imagined.is_some())).collect();
    assert_eq!(steps, [("go(yard)".to_owned(), true)]);
    assert!(elsewhere.imagination.usable.is_empty(), "nothing had to give way");
}
