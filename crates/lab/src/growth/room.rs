//! Kitchens larger than the simulator's room, as snapshots without geometry: planning sees none.
//!
//! Everything in them looks exactly as the simulator shows it in a room of the paper's size; there is only more of it,
//! in the paper's proportions: of 32 objects 6 are tools, 8 are items, and the rest are counters. Each item lies alone
//! on a counter.

use std::collections::BTreeMap;

use typelift::model::{GroundAtom, ParseConfig, State, Symbol, Task};
use typelift::world::{Entity, Parser, Relation, Scene, Snapshot};
use typelift_kitchen::{Room, Scenario, hierarchy};

/// The tools of a kitchen.
const TOOLS: [&str; 6] = ["cutboard", "breadslicer", "machete", "blender", "toaster", "contactgrill"];

/// Food in the order in which it fills a kitchen, with the state in which a goal wants it.
const FOOD: [(&str, &str); 7] = [
    ("lettuce", "chop_state_Chopped"),
    ("tomato", "chop_state_Chopped"),
    ("carrot", "blend_state_Mashed"),
    ("onion", "chop_state_Chopped"),
    ("bread", "toast_state_Toasted"),
    ("banana", "chop_state_Chopped"),
    ("cucumber", "chop_state_Chopped"),
];

/// How many of everything there are; the agent is not counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Stock {
    /// Of each of the six tools.
    pub(crate) tools: usize,
    pub(crate) plates: usize,
    pub(crate) food: usize,
    pub(crate) counters: usize,
}

impl Stock {
    /// One kitchen with a larger storeroom: a plate and one of each tool, however many objects there are.
    pub(crate) fn storeroom(objects: usize) -> Self {
        let food = objects / 4 - 1;
        Self { tools: 1, plates: 1, food, counters: objects - TOOLS.len() - 1 - food }
    }

    /// As many kitchens as there are 32 objects: tools and plates grow too.
    pub(crate) fn kitchens(objects: usize) -> Self {
        let kitchens = (objects / 32).max(1);
        let food = objects / 4 - kitchens;
        Self { tools: kitchens, plates: kitchens, food, counters: objects - (TOOLS.len() + 1) * kitchens - food }
    }

    /// The number of objects.
    #[cfg(test)]
    pub(crate) fn objects(self) -> usize {
        TOOLS.len() * self.tools + self.plates + self.food + self.counters
    }
}

/// What each type looks like in the simulator, nothing in or on it.
fn looks() -> BTreeMap<String, Entity> {
    let mut items: Vec<Symbol> = FOOD.iter().map(|(name, _)| Symbol::new(name)).collect();
    items.push("plate".into());
    let room =
        Room::build(&Scenario { items: Some(items), ..Scenario::default() }, 0).expect("a room of the paper's size");
    let mut looks = BTreeMap::new();
    for mut entity in room.snapshot().entities {
        entity.attributes.remove("location");
        // A counter on which something lies looks otherwise.
        let empty = entity.relations.get("content").is_none_or(|content| content.targets().is_empty());
        if empty {
            looks.entry(entity.ty.to_string()).or_insert(entity);
        } else {
            looks.insert(format!("full {}", entity.ty), entity);
        }
    }
    looks
}

/// A kitchen with this stock, as its snapshot.
pub(crate) fn snapshot(stock: Stock) -> Snapshot {
    let looks = looks();
    let named = |look: &str, ty: &str, number: usize| {
        let mut entity = looks[look].clone();
        entity.id = Symbol::from(format!("{ty}_{number}"));
        entity
    };
    let mut entities = vec![named("agent", "agent", 1)];
    let mut items: Vec<Entity> = (1..=stock.plates).map(|number| named("plate", "plate", number)).collect();
    items.extend((0..stock.food).map(|i| named(FOOD[i % FOOD.len()].0, FOOD[i % FOOD.len()].0, i / FOOD.len() + 1)));
    for number in 1..=stock.counters {
        let item = items.get(number - 1).map(|item| item.id.clone());
        let mut counter = named(if item.is_some() { "full counter" } else { "counter" }, "counter", number);
        counter.relations.insert("content".into(), Relation::Many(item.into_iter().collect()));
        entities.push(counter);
    }
    let tools = TOOLS.iter().flat_map(|tool| (1..=stock.tools).map(move |number| (*tool, number)));
    entities.extend(tools.map(|(tool, number)| named(tool, tool, number)));
    entities.extend(items);
    Snapshot { entities }
}

/// The task of preparing the first `dishes` foods of this kitchen and serving them on the first plate.
pub(crate) fn task(stock: Stock, dishes: usize) -> Task {
    let mut goal = Vec::new();
    for index in 0..dishes {
        let (food, state) = FOOD[index % FOOD.len()];
        let food = Symbol::from(format!("{food}_{}", index / FOOD.len() + 1));
        goal.push(GroundAtom::new(state, vec![food.clone()]));
        goal.push(GroundAtom::new("content_holds", vec!["plate_1".into(), food]));
    }
    Task::new(state(stock), goal)
}

fn state(stock: Stock) -> State {
    let mut parser = Parser::new(hierarchy(), ParseConfig::default());
    parser.parse(&Scene::Snapshot(snapshot(stock))).expect("a snapshot of the kitchen's own types")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn proportions() {
        for objects in [32, 100, 320, 1000, 3200, 10_000] {
            for stock in [Stock::storeroom(objects), Stock::kitchens(objects)] {
                assert_eq!(stock.objects(), objects);
                assert!(stock.counters >= stock.food + stock.plates, "each item has a counter");
                assert_eq!(state(stock).objects.len(), objects + 1);
            }
        }
        assert_eq!(Stock::storeroom(32), Stock { tools: 1, plates: 1, food: 7, counters: 18 });
        assert_eq!(Stock::kitchens(32), Stock::storeroom(32));
    }

    #[test]
    fn the_smallest_is_a_room_of_the_simulator() {
        let snapshot = snapshot(Stock::storeroom(32));
        let room = Room::from_snapshot(&snapshot).expect("a legal kitchen");
        let atoms = |snapshot: Snapshot| {
            let mut parser = Parser::new(hierarchy(), ParseConfig::default());
            parser.parse(&Scene::Snapshot(snapshot)).expect("a state").atoms
        };
        assert_eq!(atoms(room.snapshot()), atoms(snapshot));
        let own = Room::build(&Scenario::default(), 3).expect("a room").snapshot();
        assert_eq!(own.entities.len(), 33);
        assert_eq!(atoms(own).len(), state(Stock::storeroom(32)).atoms.len());
    }
}
