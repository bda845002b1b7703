//! Kitchens from snapshots.
#![allow(clippy::unwrap_used)]

use serde_json::{Value, json};
use typelift_kitchen::{Room, demonstrations, faults, tasks};
use typelift_model::GroundCall;
use typelift_world::{Reset, Scene, Snapshot, World};

fn restored(entities: &Value) -> Result<Room, String> {
    let snapshot: Snapshot = serde_json::from_value(json!({ "entities": entities })).unwrap();
    Room::from_snapshot(&snapshot).map_err(|error| error.to_string())
}

#[test]
fn a_snapshot_survives_the_way_through_a_room() {
    let mut seen = 0;
    for demonstration in demonstrations(8) {
        for scene in demonstration.recording.scenes() {
            let Scene::Snapshot(snapshot) = scene else { panic!("a snapshot") };
            assert_eq!(Room::from_snapshot(snapshot).unwrap().snapshot(), *snapshot);
            let text = serde_json::to_string(snapshot).unwrap();
            assert_eq!(serde_json::from_str::<Snapshot>(&text).unwrap(), *snapshot);
            seen += 1;
        }
    }
    for task in tasks().into_iter().chain(faults()) {
        let mut kitchen = typelift_kitchen::Kitchen::new();
        let scene = kitchen.reset(&Reset { seed: 3, scenario: Some(task.scenario) }).unwrap();
        let again = Reset { seed: 4, scenario: Some(json!({ "state": scene })) };
        assert_eq!(kitchen.reset(&again).unwrap(), scene);
        seen += 1;
    }
    assert_eq!(seen, 68 + 8 + 36);
}

/// As another simulator of this kitchen records it: more attributes, no corners, two plates, an odd order.
#[test]
fn a_foreign_snapshot() {
    let mut room = restored(&json!([
        {"id": "leaf", "type": "lettuce",
         "attributes": {"location": [2, 0], "walkable": false, "movable": true, "chop_state": "Fresh", "free": true}},
        {"id": "plate_7", "type": "plate", "attributes": {"location": [0, 3], "free": true, "notEmpty": false}},
        {"id": "cook", "type": "agent", "attributes": {"location": [4, 5], "orientation": 1, "movable": false},
         "relations": {"holding": null, "interacts_with": []}},
        {"id": "table", "type": "counter", "attributes": {"location": [2, 0]}, "relations": {"content": ["leaf"]}},
        {"id": "shelf", "type": "counter", "attributes": {"location": [0, 3]}, "relations": {"content": ["plate_7"]}},
        {"id": "board", "type": "cutboard", "attributes": {"location": [6, 2], "toggle": false, "status": "NotUsable"}},
    ]))
    .unwrap();
    for call in ["PICK table leaf", "PLACE board leaf", "USE board leaf", "PICK board leaf", "PLACE plate_7 leaf"] {
        let words: Vec<&str> = call.split(' ').collect();
        let args = vec!["cook".into(), words[1].into(), words[2].into()];
        assert_eq!(room.act(&GroundCall { name: words[0].into(), args }), Ok(()));
    }
    let ids: Vec<String> = room.snapshot().entities.iter().map(|e| e.id.to_string()).collect();
    assert_eq!(ids, ["leaf", "plate_7", "cook", "table", "shelf", "board"]);
}

#[test]
fn things_without_a_location_get_a_place() {
    let room = restored(&json!([
        {"id": "agent_1", "type": "agent", "relations": {"holding": "apple_1"}},
        {"id": "counter_1", "type": "counter"},
        {"id": "counter_2", "type": "counter", "attributes": {"location": [3, 3]}},
        {"id": "toaster_1", "type": "toaster", "relations": {"content": ["bread_2", "bread_1"]}},
        {"id": "apple_1", "type": "apple"},
        {"id": "bread_1", "type": "bread", "attributes": {"chop_state": "Chopped", "toast_state": "Toasted"}},
        {"id": "bread_2", "type": "bread", "attributes": {"chop_state": "Chopped", "toast_state": "Toasted"}},
        {"id": "plate_1", "type": "plate"},
        {"id": "plate_2", "type": "plate", "attributes": {"location": [3, 3]}},
    ]))
    .unwrap();
    let at = |item: &str| room.container_of(item).map(ToString::to_string);
    assert_eq!((at("plate_1").as_deref(), at("plate_2").as_deref()), (Some("counter_1"), Some("counter_2")));
    assert_eq!((at("bread_1").as_deref(), at("apple_1")), (Some("toaster_1"), None));
    let snapshot = room.snapshot();
    assert_eq!(Room::from_snapshot(&snapshot).unwrap().snapshot(), snapshot);
    assert_eq!(
        serde_json::to_value(&snapshot.entities[3].relations).unwrap(),
        json!({"content": ["bread_2", "bread_1"]})
    );
}

#[test]
fn a_room_may_be_all_corners_and_no_space() {
    let counters: Vec<Value> = (1..=24).map(|i| json!({"id": format!("c{i}"), "type": "counter"})).collect();
    let mut entities = vec![json!({"id": "a", "type": "agent"})];
    entities.extend(counters);
    assert!(restored(&json!(entities)).is_ok());
    entities.push(json!({"id": "late", "type": "blender"}));
    let error = restored(&json!(entities)).unwrap_err();
    assert_eq!(error, "entity late: it has no location, and there is no free place for it");
}

#[test]
fn what_is_no_kitchen_is_refused() {
    let agent = json!({"id": "a", "type": "agent", "attributes": {"location": [1, 1]}});
    let counter = json!({"id": "c", "type": "counter", "attributes": {"location": [2, 0]}});
    let with = |more: &[Value]| json!([&[agent.clone(), counter.clone()], more].concat());
    let refused = [
        (json!([counter]), "there is no agent"),
        (with(std::slice::from_ref(&counter)), "there are two entities `c`"),
        (with(&[json!({"id": "b", "type": "agent"})]), "there are two agents, a and b; a kitchen has one"),
        (with(&[json!({"id": "f", "type": "fork"})]), "entity f: nothing in a kitchen is of type `fork`"),
        (with(&[json!({"id": "f", "type": "food"})]), "entity f: nothing in a kitchen is of type `food`"),
        (
            with(&[json!({"id": "l", "type": "lettuce", "attributes": {"chop_state": "Diced"}})]),
            "entity l: `chop_state` is \"Diced\", but it can only be Fresh or Chopped",
        ),
        (
            with(&[json!({"id": "l", "type": "lettuce", "attributes": {"toast_state": "Ready"}})]),
            "entity l: `toast_state` is \"Ready\", but it can only be left out: nothing of type lettuce has it",
        ),
        (
            with(&[json!({"id": "l", "type": "lettuce", "attributes": {"free": 1}})]),
            "entity l: `free` is 1.0, but it can only be true or false",
        ),
        (
            with(&[json!({"id": "l", "type": "lettuce", "attributes": {"free": false}})]),
            "entity l: `free` is false, which contradicts what lies where",
        ),
        (
            with(&[json!({"id": "d", "type": "counter", "attributes": {"notFull": false}})]),
            "entity d: `notFull` is false, which contradicts what lies where",
        ),
        (
            with(&[json!({"id": "d", "type": "counter", "relations": {"content": ["x"]}})]),
            "entity d: `content` names `x`, which is not an item",
        ),
        (
            with(&[json!({"id": "d", "type": "counter", "relations": {"content": ["a"]}})]),
            "entity d: `content` names `a`, which is not an item",
        ),
        (
            with(&[json!({"id": "p", "type": "plate", "relations": {"content": ["p"]}})]),
            "entity p: `content` names `p`, which is not a food",
        ),
        (
            with(&[json!({"id": "l", "type": "lettuce", "relations": {"content": ["l"]}})]),
            "entity l: `content` names too many items: 1, where there is room for 0",
        ),
        (
            with(&[
                json!({"id": "d", "type": "blender", "relations": {"content": ["l"]}}),
                json!({"id": "e", "type": "counter", "relations": {"content": ["l"]}}),
                json!({"id": "l", "type": "lettuce"}),
            ]),
            "entity l: it is in d and in e",
        ),
        (
            with(&[json!({"id": "d", "type": "counter", "attributes": {"location": [2, 0]}})]),
            "entity d: the location [2.0,0.0] is taken by c",
        ),
        (
            with(&[json!({"id": "d", "type": "counter", "attributes": {"location": [7, 0]}})]),
            "entity d: the location [7.0,0.0] is not a cell [column, row], each from 0 to 6",
        ),
        (
            with(&[json!({"id": "d", "type": "counter", "attributes": {"location": [0.5, 0]}})]),
            "entity d: the location [0.5,0.0] is not a cell [column, row], each from 0 to 6",
        ),
        (
            with(&[json!({"id": "d", "type": "counter", "attributes": {"location": [1, 1]}})]),
            "entity a: the location [1.0,1.0] is not on the floor",
        ),
        (
            with(&[json!({"id": "l", "type": "lettuce", "attributes": {"location": [3, 3]}})]),
            "entity l: the location [3.0,3.0] is neither a station nor does anybody hold it",
        ),
        (
            with(&[
                json!({"id": "l", "type": "lettuce", "attributes": {"location": [2, 0]}}),
                json!({"id": "m", "type": "lettuce", "attributes": {"location": [2, 0]}}),
            ]),
            "entity m: the location [2.0,0.0] is c, which is full",
        ),
        (
            with(&[json!({"id": "l", "type": "lettuce"}), json!({"id": "m", "type": "lettuce"})]),
            "entity m: it has no location, and there is no free place for it",
        ),
    ];
    for (entities, message) in refused {
        assert_eq!(restored(&entities).expect_err(message), message);
    }
}
