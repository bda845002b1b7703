//! What the drawing looks like.
#![allow(clippy::unwrap_used)]

use serde_json::json;
use typelift_kitchen::{Room, Scenario, demonstrations, draw};
use typelift_model::GroundCall;
use typelift_world::{Scene, Snapshot};

#[test]
fn before_the_first_action() {
    assert_eq!(
        draw(&Room::build(&Scenario::default(), 1).unwrap()),
        "\
┌──────────┬──────────┬──────────┬──────────┬──────────┬──────────┬──────────┐
│counter_1 │toaster_1 │breadsli~1│contactg~1│counter_2 │counter_3 │counter_4 │
│          │          │          │          │bread_1   │onion_1   │          │
├──────────┼──────────┴──────────┴──────────┴──────────┴──────────┼──────────┤
│counter_5 │                                                      │counter_6 │
│tomato_1  │                                                      │banana_1  │
├──────────┤                                                      ├──────────┤
│counter_7 │                                                      │counter_8 │
│          │                                                      │carrot_1  │
├──────────┤                                                      ├──────────┤
│cutboard_1│                                                      │blender_1 │
│          │                                                      │          │
├──────────┤                                                      ├──────────┤
│counter_9 │                                                      │counter_10│
│          │                                                      │cucumber_1│
├──────────┤                                                      ├──────────┤
│machete_1 │                      agent_1                         │counter_11│
│          │                                                      │          │
├──────────┼──────────┬──────────┬──────────┬──────────┬──────────┼──────────┤
│counter_12│counter_13│counter_14│counter_15│counter_16│counter_17│counter_18│
│          │plate_1   │          │          │lettuce_1 │          │          │
└──────────┴──────────┴──────────┴──────────┴──────────┴──────────┴──────────┘

agent_1 holds nothing
* can be used   +n more below or on the plate
"
    );
}

#[test]
fn in_the_middle_of_it() {
    let steps = &demonstrations(3)[5].recording.steps;
    let Scene::Snapshot(before) = &steps[11].1 else { panic!("a snapshot") };
    let mut room = Room::from_snapshot(before).unwrap();
    room.act(&steps[12].0.call).unwrap();
    room.act(&steps[13].0.call).unwrap();
    room.break_tool("blender_1");
    assert_eq!(
        draw(&room),
        "\
┌──────────┬──────────┬──────────┬──────────┬──────────┬──────────┬──────────┐
│counter_1 │machete_1 │counter_2 │counter_3 │counter_4 │contactg~1│counter_5 │
│          │          │          │          │          │          │          │
├──────────┼──────────┴──────────┴──────────┴──────────┴──────────┼──────────┤
│counter_6 │                                                      │counter_7 │
│          │                                                      │          │
├──────────┤                                                      ├──────────┤
│toaster_1 │agent_1 <                                             │breadsli~1│
│          │bread_1                                               │          │
├──────────┤                                                      ├──────────┤
│counter_8 │                                                      │counter_9 │
│          │                                                      │          │
├──────────┤                                                      ├──────────┤
│counter_10│                                                      │cutboard_1│
│          │                                                      │          │
├──────────┤                                                      ├──────────┤
│counter_11│                                                      │counter_12│
│          │                                                      │          │
├──────────┼──────────┬──────────┬──────────┬──────────┬──────────┼──────────┤
│counter_13│counter_14│counter_15│counter_16│blender_1 │counter_17│counter_18│
│          │          │          │          │          │plate_1 +1│          │
└──────────┴──────────┴──────────┴──────────┴──────────┴──────────┴──────────┘

agent_1 holds bread_1 (chopped, toasted), in front of toaster_1
counter_17: plate_1 with bread_2 (chopped, toasted)
blender_1 is broken, which the agent cannot see
* can be used   +n more below or on the plate
"
    );
}

#[test]
fn walls_and_tools_that_can_be_used() {
    let entities = json!([
        {"id": "agent_1", "type": "agent", "attributes": {"location": [3, 5]}},
        {"id": "counter_1", "type": "counter", "attributes": {"location": [2, 0]}, "relations": {"content": ["watermelon_1"]}},
        {"id": "counter_2", "type": "counter", "attributes": {"location": [3, 3]}},
        {"id": "cutboard_1", "type": "cutboard", "attributes": {"location": [0, 4], "status": "Ready"}, "relations": {"content": ["leek-like-lettuce"]}},
        {"id": "watermelon_1", "type": "watermelon"},
        {"id": "leek-like-lettuce", "type": "lettuce"},
    ]);
    let snapshot: Snapshot = serde_json::from_value(json!({ "entities": entities })).unwrap();
    let mut room = Room::from_snapshot(&snapshot).unwrap();
    let args = vec!["agent_1".into(), "cutboard_1".into()];
    assert!(room.act(&GroundCall { name: "PLACE".into(), args }).is_err());
    assert_eq!(
        draw(&room),
        "\
┌──────────┬──────────┬──────────┬──────────┬──────────┬──────────┬──────────┐
│##########│##########│counter_1 │##########│##########│##########│##########│
│##########│##########│watermel~1│##########│##########│##########│##########│
├──────────┼──────────┴──────────┴──────────┴──────────┴──────────┼──────────┤
│##########│                                                      │##########│
│##########│                                                      │##########│
├──────────┤                                                      ├──────────┤
│##########│                                                      │##########│
│##########│                                                      │##########│
├──────────┤                     ┌──────────┐                     ├──────────┤
│##########│                     │counter_2 │                     │##########│
│##########│                     │          │                     │##########│
├──────────┤                     └──────────┘                     ├──────────┤
│cutboar~1*│                                                      │##########│
│leek-like~│                                                      │##########│
├──────────┤                                                      ├──────────┤
│##########│                      agent_1                         │##########│
│##########│                                                      │##########│
├──────────┼──────────┬──────────┬──────────┬──────────┬──────────┼──────────┤
│##########│##########│##########│##########│##########│##########│##########│
│##########│##########│##########│##########│##########│##########│##########│
└──────────┴──────────┴──────────┴──────────┴──────────┴──────────┴──────────┘

agent_1 holds nothing
* can be used   +n more below or on the plate   ### wall
"
    );
}
