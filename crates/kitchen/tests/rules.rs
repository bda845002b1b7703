//! What each action needs and changes, case by case.
#![allow(clippy::unwrap_used)]

use serde_json::{Value, json};
use typelift_kitchen::{Fault, Refusal, Room, Scenario};
use typelift_model::{GroundCall, Symbol};

fn room(scenario: &Value) -> Room {
    Room::build(&Scenario::from_json(Some(scenario)).unwrap(), 4).unwrap()
}

/// A room with these items and nothing else.
fn with(items: &[&str]) -> Room {
    room(&json!({ "items": items, "filler": "none" }))
}

fn call(text: &str) -> GroundCall {
    let mut words = text.split_whitespace().map(Symbol::new);
    GroundCall { name: words.next().unwrap(), args: words.collect() }
}

/// Performs actions given as `PICK lettuce_1`, in the short form without the agent; all of them must work.
fn perform(room: &mut Room, actions: &[&str]) {
    for action in actions {
        let (name, target) = action.split_once(' ').unwrap();
        assert_eq!(room.act(&call(&format!("{name} agent_1 {target}"))), Ok(()), "{action}");
    }
}

/// Performs an action that must change nothing, and returns why it did not.
fn refused(room: &mut Room, action: &str) -> String {
    let before = room.clone();
    let (name, target) = action.split_once(' ').unwrap();
    let refusal = room.act(&call(&format!("{name} agent_1 {target}"))).expect_err(action);
    assert_eq!(*room, before, "{action} changed something");
    refusal.to_string()
}

/// The value of an attribute or relation of an entity.
fn seen(room: &Room, entity: &str, what: &str) -> Value {
    let snapshot = room.snapshot();
    let entity = snapshot.entities.into_iter().find(|e| e.id == *entity).unwrap();
    let entity = serde_json::to_value(entity).unwrap();
    let attribute = entity["attributes"].get(what).or_else(|| entity["relations"].get(what));
    attribute.unwrap_or_else(|| panic!("no {what}")).clone()
}

#[test]
fn pick_takes_a_free_item_out_of_a_station() {
    let mut room = with(&["lettuce"]);
    let counter = room.container_of("lettuce_1").unwrap().to_string();
    perform(&mut room, &["PICK lettuce_1"]);
    assert_eq!(seen(&room, "agent_1", "holding"), "lettuce_1");
    assert_eq!(seen(&room, "lettuce_1", "free"), true);
    assert_eq!(seen(&room, "lettuce_1", "location"), seen(&room, "agent_1", "location"));
    assert_eq!(seen(&room, &counter, "content"), json!([]));
    assert_eq!((seen(&room, &counter, "notFull"), seen(&room, &counter, "notEmpty")), (json!(true), json!(false)));
}

#[test]
fn pick_needs_an_empty_hand() {
    let mut room = with(&["lettuce", "carrot"]);
    perform(&mut room, &["PICK lettuce_1"]);
    assert_eq!(refused(&mut room, "PICK carrot_1"), "the hand already holds lettuce_1");
    assert_eq!(refused(&mut room, "PICK lettuce_1"), "the hand already holds lettuce_1");
}

#[test]
fn food_on_a_plate_is_never_picked_again() {
    let mut room = with(&["plate", "lettuce"]);
    let cut = ["PICK lettuce_1", "PLACE cutboard_1", "USE cutboard_1", "PICK lettuce_1", "PLACE plate_1"];
    perform(&mut room, &cut);
    let reason = "lettuce_1 lies on plate_1, and food is not taken from a plate";
    assert_eq!(refused(&mut room, "PICK lettuce_1"), reason);
    assert_eq!(refused(&mut room, "PICK plate_1 lettuce_1"), reason);
    perform(&mut room, &["PICK plate_1"]);
    assert_eq!(seen(&room, "lettuce_1", "location"), seen(&room, "agent_1", "location"));
    perform(&mut room, &["PLACE counter_2"]);
    assert_eq!(seen(&room, "lettuce_1", "location"), seen(&room, "counter_2", "location"));
    assert_eq!(refused(&mut room, "PICK lettuce_1"), reason);
}

#[test]
fn only_the_topmost_can_be_picked() {
    let mut room = two_in_the_toaster();
    assert_eq!(refused(&mut room, "PICK bread_1"), "bread_1 is not the topmost item in toaster_1: bread_2 is");
    assert_eq!(seen(&room, "bread_1", "free"), false);
    assert_eq!(seen(&room, "toaster_1", "notFull"), false);
    perform(&mut room, &["PICK bread_2"]);
    assert_eq!(seen(&room, "bread_1", "free"), true);
    assert_eq!(seen(&room, "toaster_1", "status"), "Ready", "something is still in it");
    perform(&mut room, &["PLACE toaster_1", "PICK bread_2", "PLACE counter_2", "PICK bread_1"]);
    assert_eq!(seen(&room, "toaster_1", "status"), "NotUsable", "it is empty");
}

fn two_in_the_toaster() -> Room {
    let mut room = with(&["plate", "bread", "bread"]);
    for bread in ["bread_1", "bread_2"] {
        let pick = format!("PICK {bread}");
        perform(&mut room, &[&pick, "PLACE cutboard_1", "USE cutboard_1", &pick, "PLACE toaster_1"]);
    }
    room
}

#[test]
fn a_tool_that_is_emptied_is_not_usable() {
    let mut room = with(&["lettuce"]);
    perform(&mut room, &["PICK lettuce_1", "PLACE cutboard_1"]);
    assert_eq!(seen(&room, "cutboard_1", "status"), "Ready");
    perform(&mut room, &["PICK lettuce_1"]);
    assert_eq!(seen(&room, "cutboard_1", "status"), "NotUsable");
}

#[test]
fn place_needs_something_in_the_hand() {
    let mut room = with(&["lettuce"]);
    assert_eq!(refused(&mut room, "PLACE cutboard_1"), "the hand holds nothing");
}

#[test]
fn a_counter_takes_one_item() {
    let mut room = with(&["lettuce", "carrot"]);
    let taken = room.container_of("carrot_1").unwrap().to_string();
    perform(&mut room, &["PICK lettuce_1"]);
    assert_eq!(refused(&mut room, &format!("PLACE {taken}")), format!("{taken} is full"));
}

#[test]
fn a_plate_takes_prepared_food() {
    let mut room = with(&["plate", "plate", "carrot", "carrot"]);
    perform(&mut room, &["PICK carrot_1"]);
    assert_eq!(refused(&mut room, "PLACE plate_1"), "plate_1 does not take carrot_1: it is neither chopped nor mashed");
    perform(&mut room, &["PLACE blender_1", "USE blender_1", "PICK carrot_1", "PLACE plate_1"]);
    perform(&mut room, &["PICK carrot_2", "PLACE machete_1", "USE machete_1", "PICK carrot_2", "PLACE plate_1"]);
    assert_eq!(seen(&room, "plate_1", "content"), json!(["carrot_1", "carrot_2"]), "bottom first");
    assert_eq!((seen(&room, "carrot_1", "free"), seen(&room, "carrot_2", "free")), (json!(false), json!(true)));
    assert_eq!((seen(&room, "plate_1", "notFull"), seen(&room, "plate_1", "notEmpty")), (json!(true), json!(true)));
    perform(&mut room, &["PICK plate_2"]);
    assert_eq!(refused(&mut room, "PLACE plate_1"), "plate_1 does not take plate_2: it is not food");
    assert_eq!(refused(&mut room, "PLACE plate_2"), "plate_2 does not lie in a station");
    assert_eq!(refused(&mut room, "PLACE toaster_1"), "toaster_1 does not take plate_2: it is not food");
}

#[test]
fn cutting_tools_take_what_is_not_chopped() {
    for tool in ["cutboard_1", "breadslicer_1", "machete_1"] {
        let mut room = with(&["carrot", "tomato"]);
        let (place, operate) = (format!("PLACE {tool}"), format!("USE {tool}"));
        perform(&mut room, &["PICK carrot_1", &place]);
        perform(&mut room, &["PICK tomato_1"]);
        assert_eq!(refused(&mut room, &place), format!("{tool} is full"));
        perform(&mut room, &["PLACE counter_2", &operate]);
        assert_eq!(seen(&room, "carrot_1", "chop_state"), "Chopped");
        assert_eq!(seen(&room, "carrot_1", "blend_state"), "Fresh");
        assert_eq!(seen(&room, tool, "status"), "NotUsable");
        perform(&mut room, &["PICK carrot_1"]);
        assert_eq!(refused(&mut room, &place), format!("{tool} does not take carrot_1: it is already chopped"));
    }
}

#[test]
fn hard_shells_need_a_machete() {
    for (food, name) in [("coconut", "coconut_1"), ("hokkaido", "hokkaido_1")] {
        let mut room = with(&[food]);
        perform(&mut room, &[&format!("PICK {name}")]);
        for tool in ["cutboard_1", "breadslicer_1"] {
            let reason = format!("{tool} does not take {name}: only a machete cuts it");
            assert_eq!(refused(&mut room, &format!("PLACE {tool}")), reason);
        }
        perform(&mut room, &["PLACE machete_1", "USE machete_1"]);
        assert_eq!(seen(&room, name, "chop_state"), "Chopped");
    }
}

#[test]
fn the_blender_takes_what_can_be_blended() {
    for (food, name) in [("carrot", "carrot_1"), ("banana", "banana_1"), ("apple", "apple_1")] {
        let mut room = with(&[food]);
        perform(&mut room, &[&format!("PICK {name}"), "PLACE blender_1", "USE blender_1", &format!("PICK {name}")]);
        assert_eq!(seen(&room, name, "blend_state"), "Mashed");
        let reason = format!("blender_1 does not take {name}: it is already mashed");
        assert_eq!(refused(&mut room, "PLACE blender_1"), reason);
    }
    let mut room = with(&["tomato"]);
    perform(&mut room, &["PICK tomato_1"]);
    assert_eq!(refused(&mut room, "PLACE blender_1"), "blender_1 does not take tomato_1: it cannot be blended");
}

#[test]
fn mashed_food_can_be_chopped_but_not_the_other_way_round() {
    let mut room = with(&["plate", "carrot", "apple"]);
    perform(&mut room, &["PICK carrot_1", "PLACE blender_1", "USE blender_1", "PICK carrot_1"]);
    perform(&mut room, &["PLACE cutboard_1", "USE cutboard_1", "PICK carrot_1", "PLACE plate_1"]);
    assert_eq!(seen(&room, "carrot_1", "blend_state"), "Mashed");
    assert_eq!(seen(&room, "carrot_1", "chop_state"), "Chopped");
    perform(&mut room, &["PICK apple_1", "PLACE cutboard_1", "USE cutboard_1", "PICK apple_1", "PLACE blender_1"]);
    assert_eq!(refused(&mut room, "USE blender_1"), "blender_1 was used, but nothing happened");
    assert_eq!(seen(&room, "blender_1", "status"), "Ready", "nothing has changed");
    perform(&mut room, &["PICK apple_1"]);
}

#[test]
fn toasting_tools_take_what_has_been_cut() {
    for tool in ["toaster_1", "contactgrill_1"] {
        let mut room = with(&["plate", "bread", "bagel", "bread", "tomato"]);
        let (place, operate) = (format!("PLACE {tool}"), format!("USE {tool}"));
        perform(&mut room, &["PICK tomato_1"]);
        assert_eq!(refused(&mut room, &place), format!("{tool} does not take tomato_1: it cannot be toasted"));
        perform(&mut room, &["PLACE counter_2", "PICK bread_1"]);
        assert_eq!(refused(&mut room, &place), format!("{tool} does not take bread_1: it has to be cut first"));
        perform(&mut room, &["PLACE cutboard_1", "USE cutboard_1", "PICK bread_1", &place]);
        assert_eq!(seen(&room, "bread_1", "toast_state"), "Ready");
        perform(&mut room, &["PICK bagel_1", "PLACE machete_1", "USE machete_1", "PICK bagel_1", &place]);
        perform(&mut room, &["PICK bread_2", "PLACE cutboard_1", "USE cutboard_1", "PICK bread_2"]);
        assert_eq!(refused(&mut room, &place), format!("{tool} is full"));
        perform(&mut room, &[&operate]);
        assert_eq!(seen(&room, "bread_1", "toast_state"), "Toasted");
        assert_eq!(seen(&room, "bagel_1", "toast_state"), "Toasted");
        assert_eq!(seen(&room, tool, "status"), "NotUsable");
        perform(&mut room, &["PLACE counter_3", "PICK bagel_1"]);
        assert_eq!(refused(&mut room, &place), format!("{tool} does not take bagel_1: it is already toasted"));
        perform(&mut room, &["PLACE plate_1", "PICK bread_2"]);
        let reason = format!("{tool} does not take bread_2: what is in there is already toasted");
        assert_eq!(refused(&mut room, &place), reason);
    }
}

#[test]
fn use_needs_a_tool_with_something_new_in_it() {
    let mut room = with(&["lettuce"]);
    assert_eq!(refused(&mut room, "USE cutboard_1"), "the status of cutboard_1 is not Ready");
    assert_eq!(refused(&mut room, "USE counter_1"), "`counter_1` is not a tool");
    perform(&mut room, &["PICK lettuce_1", "PLACE cutboard_1", "USE cutboard_1"]);
    assert_eq!(refused(&mut room, "USE cutboard_1"), "the status of cutboard_1 is not Ready");
    assert_eq!(refused(&mut room, "USE cutboard_1 lettuce_1"), "the status of cutboard_1 is not Ready");
}

#[test]
fn a_broken_tool_takes_and_gives_but_does_nothing() {
    let mut room = room(&json!({"items": ["lettuce"], "broken": ["cutboard_1"]}));
    perform(&mut room, &["PICK lettuce_1", "PLACE cutboard_1"]);
    assert_eq!(seen(&room, "cutboard_1", "status"), "Ready");
    assert_eq!(refused(&mut room, "USE cutboard_1"), "cutboard_1 was used, but nothing happened");
    let text = serde_json::to_string(&room.snapshot()).unwrap();
    assert!(!text.contains("broken"), "it is hidden");
    perform(&mut room, &["PICK lettuce_1", "PLACE breadslicer_1", "USE breadslicer_1"]);
    assert_eq!(seen(&room, "lettuce_1", "chop_state"), "Chopped");
}

#[test]
fn a_tool_does_nothing_to_an_exception_and_no_state_tells() {
    let exceptions = json!([{"food": "lettuce", "tool": "cutboard"}, {"food": "bread", "tool": "toaster"}]);
    let mut room = room(&json!({"items": ["lettuce", "bread", "bagel"], "exceptions": exceptions}));
    perform(&mut room, &["PICK lettuce_1", "PLACE cutboard_1"]);
    assert_eq!(seen(&room, "cutboard_1", "status"), "Ready");
    assert_eq!(refused(&mut room, "USE cutboard_1"), "cutboard_1 was used, but nothing happened");
    assert_eq!(fault(&room, "USE cutboard_1"), "exception: lettuce with cutboard");
    perform(&mut room, &["PICK lettuce_1", "PLACE breadslicer_1", "USE breadslicer_1"]);
    for item in ["bread_1", "bagel_1"] {
        let pick = format!("PICK {item}");
        perform(&mut room, &[&pick, "PLACE cutboard_1", "USE cutboard_1", &pick, "PLACE toaster_1"]);
    }
    perform(&mut room, &["USE toaster_1"]);
    let toasted = ["bread_1", "bagel_1"].map(|item| seen(&room, item, "toast_state"));
    assert_eq!(toasted, ["Ready", "Toasted"], "what is no exception is toasted beside it");
}

#[test]
fn interlocked_tools_do_nothing_while_the_other_is_loaded() {
    let interlocks = json!([{"tools": ["cutboard_1", "machete_1"], "loaded": "blender_1"}]);
    let mut room = room(&json!({"items": ["lettuce", "carrot"], "interlocks": interlocks}));
    perform(&mut room, &["PICK carrot_1", "PLACE blender_1", "PICK lettuce_1", "PLACE cutboard_1"]);
    assert_eq!(refused(&mut room, "USE cutboard_1"), "cutboard_1 was used, but nothing happened");
    assert_eq!(fault(&room, "USE cutboard_1"), "interlock: cutboard_1, machete_1 while blender_1 is loaded");
    perform(&mut room, &["USE blender_1"]);
    assert_eq!(refused(&mut room, "USE cutboard_1"), "cutboard_1 was used, but nothing happened");
    perform(&mut room, &["PICK carrot_1"]);
    assert_eq!(room.fault(&call("USE agent_1 cutboard_1")), None);
    perform(&mut room, &["USE cutboard_1"]);
}

/// Why an action would change nothing, as the room itself has it.
fn fault(room: &Room, action: &str) -> String {
    let (name, target) = action.split_once(' ').unwrap();
    room.fault(&call(&format!("{name} agent_1 {target}"))).expect(action).to_string()
}

#[test]
fn a_fault_is_what_is_refused() {
    let mut room = room(&json!({"items": ["coconut", "lettuce"], "broken": ["cutboard_1"]}));
    let of_types = |room: &Room, action: &str| match room.fault(&call(action)) {
        Some(Fault::Rule { of_types, refusal }) => (of_types, refusal),
        other => panic!("{action}: {other:?}"),
    };
    perform(&mut room, &["PICK coconut_1"]);
    let (shell, full) = ("PLACE agent_1 cutboard_1", "PICK agent_1 lettuce_1");
    assert_eq!(of_types(&room, shell), (true, "cutboard_1 does not take coconut_1: only a machete cuts it".to_owned()));
    assert_eq!(of_types(&room, full), (false, "the hand already holds coconut_1".to_owned()));
    perform(&mut room, &["PLACE machete_1"]);
    assert_eq!(room.fault(&call("USE agent_1 machete_1")), None);
    perform(&mut room, &["PICK lettuce_1", "PLACE cutboard_1"]);
    assert_eq!(fault(&room, "USE cutboard_1"), "cutboard_1 is broken");
}

#[test]
fn the_long_form_must_name_what_is_there() {
    let mut room = with(&["plate", "lettuce", "carrot"]);
    let counter = room.container_of("lettuce_1").unwrap().to_string();
    let other = room.container_of("carrot_1").unwrap().to_string();
    let reason = format!("lettuce_1 does not lie in {other}");
    assert_eq!(refused(&mut room, &format!("PICK {other} lettuce_1")), reason);
    assert_eq!(refused(&mut room, "PICK lettuce_1 carrot_1"), "`lettuce_1` is not a station or a plate");
    perform(&mut room, &[&format!("PICK {counter} lettuce_1")]);
    assert_eq!(refused(&mut room, "PLACE cutboard_1 carrot_1"), "the hand holds lettuce_1, not carrot_1");
    perform(&mut room, &["PLACE cutboard_1 lettuce_1"]);
    assert_eq!(refused(&mut room, "USE cutboard_1 carrot_1"), "carrot_1 does not lie in cutboard_1");
    assert_eq!(refused(&mut room, "USE lettuce_1 carrot_1"), "`lettuce_1` is not a tool");
    perform(&mut room, &["USE cutboard_1 lettuce_1", "PICK cutboard_1 lettuce_1", "PLACE plate_1 lettuce_1"]);

    let mut room = two_in_the_toaster();
    let reason = "bread_1 is not the topmost item in toaster_1: bread_2 is";
    assert_eq!(refused(&mut room, "USE toaster_1 bread_1"), reason);
    perform(&mut room, &["USE toaster_1 bread_2"]);
}

#[test]
fn calls_that_mean_nothing() {
    let room = with(&["lettuce"]);
    let calls = [
        ("THROW agent_1 lettuce_1", "there is no action `THROW`; there are PICK, PLACE and USE"),
        ("pick agent_1 lettuce_1", "there is no action `pick`; there are PICK, PLACE and USE"),
        ("PICK", "PICK takes (agent, container, item), but the number of its arguments is 0"),
        ("USE agent_1", "USE takes (agent, tool, topmost item), but the number of its arguments is 1"),
        (
            "PICK agent_1 counter_1 lettuce_1 plate_1",
            "PICK takes (agent, container, item), but the number of its arguments is 4",
        ),
        ("PICK agent_2 lettuce_1", "there is no `agent_2` here"),
        ("PICK cutboard_1 lettuce_1", "`cutboard_1` is not the agent"),
        ("PICK agent_1 lettuce_2", "there is no `lettuce_2` here"),
        ("PICK agent_1 cutboard_1", "`cutboard_1` is not an item"),
        ("PICK agent_1 agent_1", "`agent_1` is not an item"),
        ("USE agent_1 agent_1", "`agent_1` is not a tool"),
    ];
    for (text, reason) in calls {
        let mut after = room.clone();
        assert_eq!(after.act(&call(text)).expect_err(text).to_string(), reason);
        assert_eq!(after, room);
    }
}

#[test]
fn what_cannot_be_reached_stays_as_it_is() {
    let entities = json!([
        {"id": "agent_1", "type": "agent", "attributes": {"location": [1, 1]}},
        {"id": "counter_1", "type": "counter", "attributes": {"location": [0, 0]}, "relations": {"content": ["apple_1"]}},
        {"id": "counter_2", "type": "counter", "attributes": {"location": [1, 2]}},
        {"id": "counter_3", "type": "counter", "attributes": {"location": [2, 1]}},
        {"id": "counter_4", "type": "counter", "attributes": {"location": [3, 3]}, "relations": {"content": ["apple_2"]}},
        {"id": "apple_1", "type": "apple"},
        {"id": "apple_2", "type": "apple"},
    ]);
    let mut room = room(&json!({ "state": { "entities": entities } }));
    assert_eq!(refused(&mut room, "PICK apple_1"), "there is no way to counter_1");
    assert_eq!(refused(&mut room, "PICK counter_4 apple_2"), "there is no way to counter_4");
    let refusal = room.act(&call("PICK agent_1 apple_2")).expect_err("shut in");
    assert_eq!(refusal, Refusal::Unreachable { target: "counter_4".into() });
}

#[test]
fn the_agent_walks_to_the_target() {
    let mut room = with(&["lettuce"]);
    for station in ["cutboard_1", "counter_2", "machete_1", "breadslicer_1", "counter_10"] {
        perform(&mut room, &["PICK lettuce_1", &format!("PLACE {station}")]);
        let at = |name: &str| seen(&room, name, "location").as_array().unwrap().clone();
        let (agent, target) = (at("agent_1"), at(station));
        let distance = |i: usize| (agent[i].as_f64().unwrap() - target[i].as_f64().unwrap()).abs();
        assert_eq!(distance(0) + distance(1), 1.0, "{station}");
    }
}
