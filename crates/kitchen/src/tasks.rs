//! The 24 tasks of the experiments, in six sets, and the scenarios with broken tools and with food that is an
//! exception to what was learned. Where the paper only counts them, they are a reconstruction.

use serde_json::json;
use typelift_model::{GroundAtom, Symbol};

use crate::kind::ItemKind::{
    self, Apple, Bagel, Banana, Bread, Carrot, Coconut, Cucumber, Hokkaido, Lettuce, Onion, Tomato, Watermelon,
};

/// Something to be prepared.
#[derive(Debug, Clone, PartialEq)]
pub struct KitchenTask {
    /// `T1.1`, or `broken_cutboard_lettuce`.
    pub name: String,
    /// The set that it belongs to: `S1` to `S6`, or `broken` or `exception`.
    pub set: String,
    /// What is to be prepared, in words.
    pub title: String,
    /// The atoms that have to hold in the end.
    pub goal: Vec<GroundAtom>,
    /// What a reset is given; see [`Scenario`](crate::Scenario).
    pub scenario: serde_json::Value,
}

/// A food on the plate in some states.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dish {
    pub(crate) food: ItemKind,
    pub(crate) states: &'static [Prepared],
}

/// A state in which a food is wanted.
#[derive(Debug)]
pub(crate) struct Prepared {
    word: &'static str,
    predicate: &'static str,
}

pub(crate) const CHOPPED: Prepared = Prepared { word: "chopped", predicate: "chop_state_Chopped" };
pub(crate) const MASHED: Prepared = Prepared { word: "mashed", predicate: "blend_state_Mashed" };
pub(crate) const TOASTED: Prepared = Prepared { word: "toasted", predicate: "toast_state_Toasted" };

const fn chopped(food: ItemKind) -> Dish {
    Dish { food, states: &[CHOPPED] }
}

const fn mashed(food: ItemKind) -> Dish {
    Dish { food, states: &[MASHED] }
}

const fn mashed_and_chopped(food: ItemKind) -> Dish {
    Dish { food, states: &[MASHED, CHOPPED] }
}

const fn toasted(food: ItemKind) -> Dish {
    Dish { food, states: &[TOASTED] }
}

/// The tasks; the digit after the T is the set's.
const TASKS: [(&str, &[Dish]); 24] = [
    // What was demonstrated.
    ("T1.1", &[chopped(Lettuce)]),
    ("T1.2", &[mashed(Carrot)]),
    ("T1.3", &[toasted(Bread), toasted(Bread)]),
    ("T1.4", &[chopped(Tomato), chopped(Onion)]),
    // Pairs and states that were not.
    ("T2.1", &[chopped(Bread)]),
    ("T2.2", &[chopped(Lettuce), chopped(Banana)]),
    ("T2.3", &[chopped(Lettuce), toasted(Bread)]),
    ("T2.4", &[chopped(Bread), toasted(Bread)]),
    // Larger orders.
    ("T3.1", &[chopped(Lettuce), chopped(Tomato), mashed(Carrot)]),
    ("T3.2", &[chopped(Banana), chopped(Onion), toasted(Bread)]),
    ("T3.3", &[chopped(Lettuce), chopped(Tomato), chopped(Onion), chopped(Banana), mashed(Carrot)]),
    ("T3.4", &[chopped(Lettuce), chopped(Tomato), chopped(Onion), chopped(Banana), mashed(Carrot), mashed(Carrot)]),
    // Unseen food that is blended or toasted.
    ("T4.1", &[mashed(Apple)]),
    ("T4.2", &[mashed(Carrot), mashed(Apple)]),
    ("T4.3", &[chopped(Bread), toasted(Bagel)]),
    ("T4.4", &[mashed_and_chopped(Apple), toasted(Bagel)]),
    // Unseen food that is cut, among other unseen food.
    ("T5.1", &[chopped(Cucumber)]),
    ("T5.2", &[chopped(Tomato), chopped(Cucumber)]),
    ("T5.3", &[chopped(Cucumber), chopped(Watermelon)]),
    ("T5.4", &[chopped(Bagel), toasted(Bread)]),
    // Everything at once.
    ("T6.1", &[mashed(Apple), chopped(Cucumber), toasted(Bagel)]),
    ("T6.2", &[mashed(Apple), chopped(Cucumber), toasted(Bagel), chopped(Watermelon)]),
    ("T6.3", &[mashed(Apple), chopped(Cucumber), toasted(Bagel), chopped(Watermelon), mashed(Banana)]),
    (
        "T6.4",
        &[
            mashed_and_chopped(Apple),
            mashed(Banana),
            chopped(Cucumber),
            chopped(Watermelon),
            chopped(Lettuce),
            toasted(Bagel),
        ],
    ),
];

/// A name, what is to be prepared, and the tools that are broken.
type Fault = (&'static str, &'static [Dish], &'static [&'static str]);

/// The scenarios with broken tools.
const BROKEN: [Fault; 8] = [
    ("broken_cutboard_lettuce", &[chopped(Lettuce)], &["cutboard_1"]),
    ("broken_cutboard_tomato_onion", &[chopped(Tomato), chopped(Onion)], &["cutboard_1"]),
    ("broken_cutboard_lettuce_bread", &[chopped(Lettuce), toasted(Bread)], &["cutboard_1"]),
    ("broken_cutboard_breadslicer_lettuce", &[chopped(Lettuce)], &["cutboard_1", "breadslicer_1"]),
    ("broken_toaster_bread", &[toasted(Bread)], &["toaster_1"]),
    ("broken_toaster_two_breads", &[toasted(Bread), toasted(Bread)], &["toaster_1"]),
    ("broken_cutboard_toaster_bread", &[toasted(Bread)], &["cutboard_1", "toaster_1"]),
    ("broken_blender_carrot", &[mashed(Carrot)], &["blender_1"]),
];

/// The scenarios with food that not every cutting tool cuts.
const EXCEPTIONS: [Fault; 4] = [
    ("exception_coconut", &[chopped(Coconut)], &[]),
    ("exception_hokkaido", &[chopped(Hokkaido)], &[]),
    ("exception_coconut_lettuce", &[chopped(Coconut), chopped(Lettuce)], &[]),
    ("exception_coconut_bread", &[chopped(Coconut), toasted(Bread)], &[]),
];

/// The 24 tasks, in order. Each room holds a plate, the food of the goal and fillers; in S5 these show no
/// demonstrated food beyond the goal's.
pub fn tasks() -> Vec<KitchenTask> {
    let task = |(name, dishes): &(&str, &[Dish])| {
        let set = format!("S{}", &name[1..2]);
        let filler = if set == "S5" { "novel" } else { "demonstrated" };
        kitchen_task(name, &set, dishes, filler, &[])
    };
    TASKS.iter().map(task).collect()
}

/// The scenarios with broken tools, then those with exceptional food.
pub fn faults() -> Vec<KitchenTask> {
    let sets = [("broken", &BROKEN[..]), ("exception", &EXCEPTIONS[..])];
    sets.iter()
        .flat_map(|(set, faults)| {
            faults.iter().map(|(name, dishes, broken)| kitchen_task(name, set, dishes, "demonstrated", broken))
        })
        .collect()
}

fn kitchen_task(name: &str, set: &str, dishes: &[Dish], filler: &str, broken: &[&str]) -> KitchenTask {
    let items: Vec<&str> = ["plate"].into_iter().chain(dishes.iter().map(|dish| dish.food.name())).collect();
    let mut scenario = json!({ "items": items, "filler": filler });
    if !broken.is_empty() {
        scenario["broken"] = json!(broken);
    }
    KitchenTask { name: name.to_owned(), set: set.to_owned(), title: title(dishes), goal: goal(dishes), scenario }
}

/// Per food the atoms of its states, then that it is on the plate. Equal foods are numbered.
pub(crate) fn goal(dishes: &[Dish]) -> Vec<GroundAtom> {
    let mut goal = Vec::new();
    for (index, dish) in dishes.iter().enumerate() {
        let number = dishes[..=index].iter().filter(|d| d.food == dish.food).count();
        let food = Symbol::from(format!("{}_{number}", dish.food.name()));
        goal.extend(dish.states.iter().map(|state| GroundAtom::new(state.predicate, vec![food.clone()])));
        goal.push(GroundAtom::new("content_holds", vec![Symbol::new("plate_1"), food]));
    }
    goal
}

/// `chopped lettuce, toasted bread and toasted bread`.
fn title(dishes: &[Dish]) -> String {
    let words = |dish: &Dish| {
        let states: Vec<&str> = dish.states.iter().map(|state| state.word).collect();
        format!("{} {}", states.join(" and "), dish.food.name())
    };
    let words: Vec<String> = dishes.iter().map(words).collect();
    match words.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => words.concat(),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::room::Room;
    use crate::scenario::Scenario;

    #[test]
    fn every_room_holds_32_objects_and_the_goals() {
        let all: Vec<KitchenTask> = tasks().into_iter().chain(faults()).collect();
        assert_eq!(all.len(), 24 + 12);
        let names: BTreeSet<&str> = all.iter().map(|task| task.name.as_str()).collect();
        assert_eq!(names.len(), all.len());
        for task in &all {
            let scenario = Scenario::from_json(Some(&task.scenario)).expect("a scenario");
            for seed in 0..5 {
                let room = Room::build(&scenario, seed).expect("a room");
                assert_eq!(room.stations.len() + room.items.len(), 32, "{}", task.name);
                let known = |name: &Symbol| room.find(name.as_str()).is_some();
                assert!(task.goal.iter().all(|atom| atom.args.iter().all(known)), "{}", task.name);
            }
        }
    }

    fn shown(name: &str) -> (String, Vec<String>, Vec<String>) {
        let task = tasks().into_iter().chain(faults()).find(|t| t.name == name).expect(name);
        let scenario = Scenario::from_json(Some(&task.scenario)).expect("a scenario");
        let room = Room::build(&scenario, 0).expect("a room");
        let items = room.items.iter().map(|i| i.name.to_string()).collect();
        (task.title, task.goal.iter().map(ToString::to_string).collect(), items)
    }

    #[test]
    fn titles_goals_and_items() {
        let (title, goal, items) = shown("T1.3");
        assert_eq!(title, "toasted bread and toasted bread");
        let expected = [
            "toast_state_Toasted(bread_1)",
            "content_holds(plate_1,bread_1)",
            "toast_state_Toasted(bread_2)",
            "content_holds(plate_1,bread_2)",
        ];
        assert_eq!(goal, expected);
        let expected = ["plate_1", "bread_1", "bread_2", "lettuce_1", "tomato_1", "onion_1", "carrot_1", "bread_3"];
        assert_eq!(items, expected);

        let (title, goal, _) = shown("T4.4");
        assert_eq!(title, "mashed and chopped apple and toasted bagel");
        assert_eq!(goal[..2], ["blend_state_Mashed(apple_1)", "chop_state_Chopped(apple_1)"]);

        let (_, _, items) = shown("T5.2");
        let expected =
            ["plate_1", "tomato_1", "cucumber_1", "cucumber_2", "apple_1", "watermelon_1", "bagel_1", "cucumber_3"];
        assert_eq!(items, expected);

        let (title, _, items) = shown("exception_hokkaido");
        assert_eq!((title.as_str(), items[1].as_str()), ("chopped hokkaido", "hokkaido_1"));
    }

    #[test]
    fn the_named_tools_are_broken() {
        let names = faults().into_iter().map(|task| (task.name, task.scenario["broken"].clone()));
        let broken: Vec<_> = names.filter(|(_, broken)| !broken.is_null()).collect();
        assert_eq!(broken.len(), 8);
        assert_eq!(broken[3].1, json!(["cutboard_1", "breadslicer_1"]));
    }
}
