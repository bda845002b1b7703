//! The scenarios: every tool broken in turn and every pair of them, food that is an exception to what was learned, and
//! a chopped carrot in the blender. Each comes with a later task in the same kitchen.

use serde_json::json;
use typelift::model::GroundCall;
use typelift::world::{Reset, Scene, World, WorldError};
use typelift_kitchen::{Kitchen, KitchenTask, faults, tasks};

/// A kind of work: its name, the tools that do it, a task and a later one.
const WORK: [(&str, &[&str], &str, &str); 3] = [
    ("cut", &["cutboard_1", "breadslicer_1", "machete_1"], "T1.1", "T1.4"),
    ("blend", &["blender_1"], "T1.2", "T4.2"),
    ("toast", &["toaster_1", "contactgrill_1"], "broken_toaster_bread", "T1.3"),
];

/// Food that not every cutting tool cuts: name, a task and a later one.
const EXCEPTIONS: [(&str, &str, &str); 2] = [
    ("coconut", "exception_coconut", "exception_coconut_lettuce"),
    ("hokkaido", "exception_hokkaido", "exception_hokkaido"),
];

/// A carrot that was chopped, and can no longer be blended.
const CHOPPED_CARROT: &str = "chopped carrot in the blender";

/// The scenarios of a quick run: worked around, worked around at the second attempt, not to be worked around, and an
/// exception.
pub(super) const QUICK: [&str; 4] = ["cutboard: cut", "cutboard, breadslicer: cut", "blender: blend", "coconut"];

/// Something that is not as it was shown, and no state tells.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultScenario {
    /// Its name: `cutboard, toaster: cut`.
    pub name: String,
    /// The tools that are broken.
    pub broken: Vec<&'static str>,
    /// Whether there is a way: a healthy tool of the kind is left.
    pub possible: bool,
    first: KitchenTask,
    later: KitchenTask,
}

impl FaultScenario {
    /// The task and the later one, in this room.
    ///
    /// # Errors
    /// [`WorldError`] if the simulator fails.
    pub fn tasks(&self, seed: u64) -> Result<[KitchenTask; 2], WorldError> {
        let mut tasks = [self.first.clone(), self.later.clone()];
        if self.name == CHOPPED_CARROT {
            for task in &mut tasks {
                let state = with_chopped_carrot_in_blender(task, seed)?;
                task.scenario = json!({ "state": state });
            }
        }
        Ok(tasks)
    }

    /// What is to be done, in words.
    pub fn titles(&self) -> [&str; 2] {
        [&self.first.title, &self.later.title]
    }
}

/// All scenarios.
pub fn fault_scenarios() -> Vec<FaultScenario> {
    let tools: Vec<&'static str> = WORK.iter().flat_map(|(_, tools, ..)| tools.iter().copied()).collect();
    let singles = tools.iter().map(|tool| vec![*tool]);
    let pairs = (1..tools.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
    let mut broken: Vec<Vec<&'static str>> = singles.collect();
    broken.extend(pairs.map(|(first, second)| vec![tools[first], tools[second]]));
    let mut scenarios = Vec::new();
    for broken in broken {
        // The work that the broken tools are for.
        for (work, tools, first, later) in WORK {
            if broken.iter().any(|tool| tools.contains(tool)) {
                let kinds: Vec<&str> = broken.iter().map(|tool| tool.trim_end_matches("_1")).collect();
                scenarios.push(FaultScenario {
                    name: format!("{}: {work}", kinds.join(", ")),
                    possible: tools.iter().any(|tool| !broken.contains(tool)),
                    first: with_broken(first, &broken),
                    later: with_broken(later, &broken),
                    broken: broken.clone(),
                });
            }
        }
    }
    let whole = |name: &str, first, later, possible| FaultScenario {
        name: name.to_owned(),
        broken: Vec::new(),
        possible,
        first: with_broken(first, &[]),
        later: with_broken(later, &[]),
    };
    scenarios.extend(EXCEPTIONS.map(|(name, first, later)| whole(name, first, later, true)));
    scenarios.push(whole(CHOPPED_CARROT, "T1.2", "T1.2", false));
    scenarios
}

/// A task of the kitchen in which these tools, and no others, are broken.
fn with_broken(name: &str, broken: &[&str]) -> KitchenTask {
    let known = tasks().into_iter().chain(faults()).find(|task| task.name == name);
    let mut task = known.unwrap_or_else(|| unreachable!("{name} is a task of the kitchen"));
    task.scenario["broken"] = json!(broken);
    task
}

/// The room of a task in which somebody chopped the carrot and put it into the blender.
fn with_chopped_carrot_in_blender(task: &KitchenTask, seed: u64) -> Result<serde_json::Value, WorldError> {
    let mut kitchen = Kitchen::new();
    let mut scene = kitchen.reset(&Reset { seed, scenario: Some(task.scenario.clone()) })?;
    let counter = kitchen.room().and_then(|room| room.container_of("carrot_1")).cloned().unwrap_or_default();
    let steps = [
        ("PICK", counter.as_str()),
        ("PLACE", "cutboard_1"),
        ("USE", "cutboard_1"),
        ("PICK", "cutboard_1"),
        ("PLACE", "blender_1"),
    ];
    for (name, target) in steps {
        let args = ["agent_1", target, "carrot_1"].map(Into::into).to_vec();
        let acted = kitchen.act(&GroundCall { name: name.into(), args })?;
        scene = acted.scene;
    }
    match scene {
        Scene::Snapshot(snapshot) => Ok(json!(snapshot)),
        _ => Ok(json!(null)),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_tool_and_every_pair_is_broken() {
        let scenarios = fault_scenarios();
        let names: BTreeSet<&str> = scenarios.iter().map(|scenario| scenario.name.as_str()).collect();
        assert_eq!(names.len(), scenarios.len());
        assert!(QUICK.iter().all(|name| names.contains(name)));
        let sets: BTreeSet<Vec<&str>> = scenarios.iter().map(|scenario| scenario.broken.clone()).collect();
        assert_eq!(sets.len(), 6 + 15 + 1, "and nothing broken, for the exceptions");
        let impossible: Vec<&str> =
            scenarios.iter().filter(|scenario| !scenario.possible).map(|scenario| scenario.name.as_str()).collect();
        // The blender alone and with each of the five others, both toasting tools, the carrot.
        assert_eq!(impossible.len(), 6 + 1 + 1, "{impossible:?}");
        assert_eq!(scenarios.len(), 6 + 4 + 22 + 3);
    }

    #[test]
    fn the_carrot_lies_chopped_in_the_blender() {
        let scenarios = fault_scenarios();
        let scenario = scenarios.iter().find(|scenario| scenario.name == CHOPPED_CARROT).expect("a scenario");
        for seed in 0..5 {
            for task in scenario.tasks(seed).expect("a room") {
                let mut kitchen = Kitchen::new();
                let reset = Reset { seed, scenario: Some(task.scenario) };
                let scene = serde_json::to_value(kitchen.reset(&reset).expect("a room")).expect("JSON");
                let entities = scene["entities"].as_array().expect("entities");
                let carrot = entities.iter().find(|entity| entity["id"] == "carrot_1").expect("a carrot");
                assert_eq!(carrot["attributes"]["chop_state"], "Chopped");
                let place = kitchen.room().and_then(|room| room.container_of("carrot_1")).cloned();
                assert!(place.is_some_and(|place| place == *"blender_1"));
            }
        }
    }
}
