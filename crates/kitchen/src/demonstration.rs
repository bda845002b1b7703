//! The eight demonstrations, acted out in the simulator.

use typelift_model::{GroundCall, Symbol};
use typelift_world::{Recording, Scene, TraceHeader};

use crate::kind::ItemKind;
use crate::kind::ItemKind::{Banana, Bread, Carrot, Lettuce, Onion, Plate, Tomato};
use crate::room::Room;
use crate::tasks::{CHOPPED, Dish, MASHED, TOASTED, goal};

/// Something shown to a learner.
#[derive(Debug, Clone, PartialEq)]
pub struct Demonstration {
    /// A name that can be a file's.
    pub name: String,
    /// What is done and observed, and what holds in the end.
    pub recording: Recording,
}

/// The eight demonstrations, 5, 5, 5, 10, 8, 15, 10 and 10 steps long. Each is made in the room of this seed with the
/// food that it needs and nothing else on the counters but a plate.
pub fn demonstrations(seed: u64) -> Vec<Demonstration> {
    let chopped = |food| Dish { food, states: &[CHOPPED] };
    let mashed = |food| Dish { food, states: &[MASHED] };
    let toasted = |food| Dish { food, states: &[TOASTED] };
    vec![
        demonstrate(seed, "cut_lettuce", "cut a lettuce", &[chopped(Lettuce)], |d| {
            d.chop("lettuce_1").serve();
        }),
        demonstrate(seed, "cut_banana", "cut a banana", &[chopped(Banana)], |d| {
            d.chop("banana_1").serve();
        }),
        demonstrate(seed, "blend_carrot", "blend a carrot", &[mashed(Carrot)], |d| {
            d.blend("carrot_1").serve();
        }),
        demonstrate(seed, "blend_two_carrots", "blend two carrots", &[mashed(Carrot), mashed(Carrot)], |d| {
            d.blend("carrot_1").serve().blend("carrot_2").serve();
        }),
        demonstrate(seed, "toast_bread", "toast a bread", &[toasted(Bread)], |d| {
            d.chop("bread_1").place(TOASTER).operate(TOASTER).pick("bread_1").serve();
        }),
        demonstrate(seed, "toast_two_breads", "toast two breads", &[toasted(Bread), toasted(Bread)], |d| {
            d.chop("bread_1").place(TOASTER).chop("bread_2").place(TOASTER).operate(TOASTER);
            d.pick("bread_2").serve().pick("bread_1").serve();
        }),
        demonstrate(seed, "cut_tomato_onion", "cut a tomato and an onion", &[chopped(Tomato), chopped(Onion)], |d| {
            d.chop("tomato_1").serve().chop("onion_1").serve();
        }),
        demonstrate(
            seed,
            "cut_lettuce_blend_carrot",
            "cut a lettuce and blend a carrot",
            &[chopped(Lettuce), mashed(Carrot)],
            |d| {
                d.chop("lettuce_1").serve().blend("carrot_1").serve();
            },
        ),
    ]
}

const CUTBOARD: &str = "cutboard_1";
const BLENDER: &str = "blender_1";
const TOASTER: &str = "toaster_1";
const PLATE: &str = "plate_1";

fn demonstrate(
    seed: u64,
    name: &str,
    task: &str,
    dishes: &[Dish],
    script: impl FnOnce(&mut Demonstrator),
) -> Demonstration {
    let mut kinds = vec![Plate];
    kinds.extend(dishes.iter().map(|dish| dish.food));
    let header = TraceHeader { task: task.to_owned(), goal: goal(dishes).into() };
    let mut demonstrator = Demonstrator::new(&kinds, seed, header);
    script(&mut demonstrator);
    Demonstration { name: name.to_owned(), recording: demonstrator.recording }
}

/// Acts in a room, and records it.
struct Demonstrator {
    room: Room,
    recording: Recording,
}

impl Demonstrator {
    fn new(kinds: &[ItemKind], seed: u64, header: TraceHeader) -> Self {
        let room = Room::with_items(kinds, 1, seed).expect("a demonstration needs a handful of items");
        let first = Scene::Snapshot(room.snapshot());
        Self { room, recording: Recording { header, first, steps: Vec::new() } }
    }

    /// Takes an item from where it lies.
    fn pick(&mut self, item: &str) -> &mut Self {
        let container = self.room.container_of(item).expect("what a script picks lies somewhere").clone();
        self.act("PICK", container, Symbol::new(item))
    }

    /// Puts down what is held.
    fn place(&mut self, container: &str) -> &mut Self {
        let held = self.room.agent.holding.expect("a script places what it has picked");
        self.act("PLACE", Symbol::new(container), self.room.items[held].name.clone())
    }

    /// Uses a tool on what lies in it.
    fn operate(&mut self, tool: &str) -> &mut Self {
        let station = self.room.stations.iter().find(|s| s.name == *tool);
        let top = station.and_then(|s| s.content.last()).expect("a script uses a tool with something in it");
        self.act("USE", Symbol::new(tool), self.room.items[*top].name.clone())
    }

    fn chop(&mut self, item: &str) -> &mut Self {
        self.pick(item).place(CUTBOARD).operate(CUTBOARD).pick(item)
    }

    fn blend(&mut self, item: &str) -> &mut Self {
        self.pick(item).place(BLENDER).operate(BLENDER).pick(item)
    }

    fn serve(&mut self) -> &mut Self {
        self.place(PLATE)
    }

    fn act(&mut self, name: &str, target: Symbol, item: Symbol) -> &mut Self {
        let call = GroundCall { name: Symbol::new(name), args: vec![self.room.agent_name().clone(), target, item] };
        self.room.act(&call).expect("a script follows the rules");
        self.recording.steps.push((call.into(), Scene::Snapshot(self.room.snapshot())));
        self
    }
}
