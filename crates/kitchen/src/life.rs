//! A life in a kitchen: tasks one after the other, in rooms of the same tools and with other items. Tools break and are mended; some foods do not go
//! with some tools, and one rule concerns what takes no part in the call that it forbids. None of it is ever observed, and none of
//! it contradicts what the demonstrations show.

use std::collections::BTreeSet;

use serde_json::json;
use typelift_model::{SplitMix64, Symbol};
use typelift_world::{Entity, Scene};

use crate::demonstration::demonstrations;
use crate::kind::{ItemKind, Process, StationKind};
use crate::quirk::{Exception, Interlock};
use crate::tasks::{KitchenTask, tasks};

/// Exceptions of a life, from its beginning on.
const EXCEPTIONS: usize = 6;
/// In so many of a hundred tasks a tool breaks, one of those in order.
const BREAKS: usize = 5;
/// Numbers of items that each task has for itself: as many as there can be items.
const NUMBERS: usize = 14;
/// For so many tasks it stays broken, that one included.
const MENDED_AFTER: usize = 10;

/// What happens in a life, whoever lives it.
#[derive(Debug, Clone, PartialEq)]
pub struct Life {
    /// The exceptions: pairs of a food and a tool that does to others what it does not do to this one. Another tool does it.
    pub exceptions: Vec<Exception>,
    /// The hidden rule: while something lies in a toasting tool, no cutting tool does anything but those that were demonstrated to.
    pub interlock: Interlock,
    /// The tasks, in order.
    pub tasks: Vec<LifeTask>,
}

/// A task of a life.
#[derive(Debug, Clone, PartialEq)]
pub struct LifeTask {
    /// What is to be done; its scenario has what the life says.
    pub task: KitchenTask,
    /// The seed of its room.
    pub seed: u64,
    /// The tools that are broken.
    pub broken: Vec<Symbol>,
    /// The one of them that broke just before this task.
    pub newly_broken: Option<Symbol>,
}

/// The life of a seed, so many tasks long: a shorter one is the beginning of a longer one. Each task is drawn from all that
/// [`tasks`](tasks()) gives.
pub fn life(seed: u64, length: usize) -> Life {
    let mut random = SplitMix64::new(seed);
    let shown = Shown::by_demonstrations();
    let exceptions = exceptions(&mut random, &shown);
    let interlock = interlock(&mut random, &shown);
    let (all, mut broken) = (tasks(), Vec::new());
    let tasks = (0..length).map(|number| {
        let task = all[random.below(all.len())].clone();
        let seed = random.next_u64() >> 32;
        broken.retain(|(_, mended)| *mended > number);
        let newly_broken = (random.below(100) < BREAKS).then(|| in_order(&broken)).and_then(|tools| {
            let tool = tools.get(random.below(tools.len().max(1)))?.clone();
            broken.push((tool.clone(), number + MENDED_AFTER));
            Some(tool)
        });
        let broken: Vec<Symbol> = broken.iter().map(|(tool, _)| tool.clone()).collect();
        let task = of_other_items(with(task, &broken, &exceptions, &interlock), number);
        LifeTask { task, seed, broken, newly_broken }
    });
    let tasks = tasks.collect();
    Life { exceptions, interlock, tasks }
}

/// What the demonstrations show of tools in use.
struct Shown {
    /// Foods, each with a tool that does something to it.
    pairs: BTreeSet<(Symbol, Symbol)>,
    /// Tools in use, each with one in which something lay then.
    beside: BTreeSet<(Symbol, Symbol)>,
}

impl Shown {
    fn by_demonstrations() -> Self {
        let mut shown = Self { pairs: BTreeSet::new(), beside: BTreeSet::new() };
        for demonstration in demonstrations(0) {
            let recording = demonstration.recording;
            for (scene, (action, _)) in recording.scenes().zip(&recording.steps) {
                let ("USE", [_, tool, food]) = (action.call.name.as_str(), &action.call.args[..]) else { continue };
                shown.pairs.insert((kind_name(food), kind_name(tool)));
                let Scene::Snapshot(snapshot) = scene else { continue };
                let content =
                    |entity: &Entity| entity.relations.get("content").is_some_and(|r| !r.targets().is_empty());
                let loaded = snapshot.entities.iter().filter(|entity| content(entity));
                shown.beside.extend(loaded.map(|entity| (tool.clone(), entity.id.clone())));
            }
        }
        shown
    }
}

/// `bread_2` is a `bread`.
fn kind_name(name: &Symbol) -> Symbol {
    Symbol::from(name.as_str().trim_end_matches(|c: char| c.is_ascii_digit() || c == '_'))
}

/// Pairs of a food and a tool that were not demonstrated, such that another tool is left for what the tool does to the food.
fn exceptions(random: &mut SplitMix64, shown: &Shown) -> Vec<Exception> {
    let foods = ItemKind::ALL.into_iter().filter(|kind| kind.is_food());
    let mut pairs: Vec<(ItemKind, StationKind)> = foods
        .flat_map(|food| StationKind::TOOLS.map(|tool| (food, tool)))
        .filter(|(food, tool)| takes(*tool, *food) && !shown.pairs.contains(&(food.name().into(), tool.name().into())))
        .collect();
    random.shuffle(&mut pairs);
    let mut chosen: Vec<(ItemKind, StationKind)> = Vec::new();
    for (food, tool) in pairs {
        let is_left = |other: &StationKind| {
            *other != tool
                && other.process() == tool.process()
                && takes(*other, food)
                && !chosen.contains(&(food, *other))
        };
        if chosen.len() < EXCEPTIONS && StationKind::TOOLS.iter().any(is_left) {
            chosen.push((food, tool));
        }
    }
    let named =
        |(food, tool): (ItemKind, StationKind)| Exception { food: food.name().into(), tool: tool.name().into() };
    chosen.into_iter().map(named).collect()
}

/// Whether a tool does something to a food that is in the state for it.
fn takes(tool: StationKind, food: ItemKind) -> bool {
    match tool.process() {
        Some(Process::Cut) => tool.cuts_hard_shells() || !food.has_hard_shell(),
        Some(Process::Blend) => food.can_be_blended(),
        Some(Process::Toast) => food.can_be_toasted(),
        None => false,
    }
}

fn interlock(random: &mut SplitMix64, shown: &Shown) -> Interlock {
    let of = |process: Process| -> Vec<Symbol> {
        StationKind::TOOLS.into_iter().filter(|tool| tool.process() == Some(process)).map(tool_name).collect()
    };
    let mut toasting = of(Process::Toast);
    let loaded = toasting.swap_remove(random.below(toasting.len()));
    let mut tools = of(Process::Cut);
    tools.retain(|tool| !shown.beside.contains(&(tool.clone(), loaded.clone())));
    Interlock { tools, loaded }
}

fn in_order(broken: &[(Symbol, usize)]) -> Vec<Symbol> {
    let is_broken = |tool: &Symbol| broken.iter().any(|(other, _)| other == tool);
    StationKind::TOOLS.into_iter().map(tool_name).filter(|tool| !is_broken(tool)).collect()
}

/// What the only tool of a kind is called in a room that a scenario without a state asks for.
fn tool_name(kind: StationKind) -> Symbol {
    Symbol::from(format!("{}_1", kind.name()))
}

fn with(mut task: KitchenTask, broken: &[Symbol], exceptions: &[Exception], interlock: &Interlock) -> KitchenTask {
    if !broken.is_empty() {
        task.scenario["broken"] = json!(broken);
    }
    task.scenario["exceptions"] = json!(exceptions);
    task.scenario["interlocks"] = json!([interlock]);
    task
}

/// The task with items that were in none before: what is called `bread_1` is another bread in each task.
fn of_other_items(mut task: KitchenTask, number: usize) -> KitchenTask {
    let earlier = number * NUMBERS;
    task.scenario["numbered_from"] = json!(earlier + 1);
    let renumbered = |name: &Symbol| {
        let parts =
            name.as_str().rsplit_once('_').and_then(|(kind, number)| Some((kind, number.parse::<usize>().ok()?)));
        parts.map_or_else(|| name.clone(), |(kind, number)| Symbol::from(format!("{kind}_{}", number + earlier)))
    };
    task.goal = task.goal.iter().map(|atom| atom.map(renumbered)).collect();
    task
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::room::Room;
    use crate::scenario::Scenario;

    #[test]
    fn a_shorter_life_is_the_beginning_of_a_longer_one() {
        for seed in 0..20 {
            let (short, long) = (life(seed, 20), life(seed, 200));
            assert_eq!((&short.exceptions, &short.interlock), (&long.exceptions, &long.interlock));
            assert_eq!(short.tasks[..], long.tasks[..20]);
            assert_ne!(life(seed + 1, 20), short);
        }
    }

    #[test]
    fn every_room_can_be_set_up_and_every_food_processed() {
        for seed in 0..50 {
            let life = life(seed, 50);
            let different: BTreeSet<&Exception> = life.exceptions.iter().collect();
            assert_eq!(different.len(), EXCEPTIONS);
            for LifeTask { task, seed, .. } in &life.tasks {
                let scenario = Scenario::from_json(Some(&task.scenario)).expect("a scenario");
                let room = Room::build(&scenario, *seed).expect("a room");
                let known = |name: &Symbol| room.find(name.as_str()).is_some();
                assert!(task.goal.iter().all(|atom| atom.args.iter().all(known)), "{:?}", task.goal);
                for food in ItemKind::ALL.into_iter().filter(|kind| kind.is_food()) {
                    let does = |process: Process, exceptions: &[(ItemKind, StationKind)]| {
                        StationKind::TOOLS.into_iter().any(|tool| {
                            tool.process() == Some(process) && takes(tool, food) && !exceptions.contains(&(food, tool))
                        })
                    };
                    for process in [Process::Cut, Process::Blend, Process::Toast] {
                        assert_eq!(does(process, &room.quirks.exceptions), does(process, &[]), "{}", food.name());
                    }
                }
            }
        }
    }

    #[test]
    fn what_was_demonstrated_works() {
        for seed in 0..10 {
            let life = life(seed, 1);
            assert!(!life.interlock.tools.is_empty());
            for demonstration in demonstrations(0) {
                let Scene::Snapshot(first) = demonstration.recording.first else { panic!("a snapshot") };
                let scenario = Scenario {
                    state: Some(first),
                    exceptions: life.exceptions.clone(),
                    interlocks: vec![life.interlock.clone()],
                    ..Scenario::default()
                };
                let mut room = Room::build(&scenario, 0).expect("a room");
                for (action, _) in demonstration.recording.steps {
                    assert_eq!(room.act(&action.call), Ok(()), "life {seed}, {}: {}", demonstration.name, action.call);
                }
            }
        }
    }

    #[test]
    fn tools_break_and_are_mended() {
        let (mut breaks, length) = (0, 200);
        for seed in 0..10 {
            let life = life(seed, length);
            for (number, task) in life.tasks.iter().enumerate() {
                let Some(tool) = &task.newly_broken else { continue };
                breaks += 1;
                let is_broken = |at: usize| life.tasks.get(at).is_some_and(|task| task.broken.contains(tool));
                assert!(number == 0 || !is_broken(number - 1));
                let last = (number + MENDED_AFTER - 1).min(length - 1);
                assert!((number..=last).all(is_broken));
                let again = life.tasks.get(last + 1).is_some_and(|task| task.newly_broken.as_ref() == Some(tool));
                assert!(again || !is_broken(last + 1), "{seed} {number}");
            }
        }
        assert!((60..=140).contains(&breaks), "{breaks} of 2000 tasks, and 5 % are expected");
    }
}
