//! Scenarios: what a reset is asked to set up.

use serde::{Deserialize, Serialize};
use thiserror::Error;
use typelift_model::{Symbol, json_message};
use typelift_world::Snapshot;

use crate::kind::{ItemKind, StationKind};
use crate::quirk::{Exception, Interlock};
use crate::room::{Room, Station};
use crate::snapshot_error::SnapshotError;

/// What to set up, as JSON: `{"items":["plate","bread","bread"],"filler":"novel","broken":["cutboard_1"]}`, or
/// `{"state":…}` with a snapshot. What makes tools do nothing may stand beside both. Everything may be left out; the default is a plate and demonstrated food.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object")]
pub struct Scenario {
    /// A snapshot to start from. It says where everything is, so `items`, `numbered_from` and `filler` have no place
    /// beside it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<Snapshot>,
    /// The types of the items that have to be there, numbered per type: the second `bread` is `bread_2`.
    /// Default: a plate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub items: Option<Vec<Symbol>>,
    /// The number of the first item of each type, for rooms in which no item is one that was elsewhere. Default: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub numbered_from: Option<usize>,
    /// What is added until there are 8 items. Default: [`Filler::Demonstrated`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filler: Option<Filler>,
    /// The names of tools that do nothing when they are used. No snapshot tells.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub broken: Vec<Symbol>,
    /// Foods that a tool does nothing to. No snapshot tells.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exceptions: Vec<Exception>,
    /// Tools that do nothing while something lies in another. No snapshot tells.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub interlocks: Vec<Interlock>,
}

/// What is added to the items asked for, until there are 8.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Filler {
    /// Food of the demonstrations first: lettuce, tomato, onion, carrot, bread, banana, then a cucumber.
    #[default]
    Demonstrated,
    /// Food that no demonstration shows: cucumber, apple, watermelon, bagel, again from the start.
    Novel,
    /// Nothing.
    None,
}

/// Why a scenario cannot be set up.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ScenarioError {
    /// It does not have the form of a scenario.
    #[error("the scenario is not understood: {0}")]
    Form(String),
    /// An item of a type that there is not.
    #[error("the scenario asks for the item `{name}`; there are {known}")]
    UnknownItem {
        /// The type asked for.
        name: Symbol,
        /// The types that there are.
        known: String,
    },
    /// More items than counters to start on.
    #[error("the scenario asks for {count} items, and there is room for {most}")]
    TooManyItems {
        /// How many it asks for.
        count: usize,
        /// How many there can be.
        most: usize,
    },
    /// Something is to be broken or interlocked that is no tool in this room.
    #[error("the scenario {verb} `{name}`, which is none of the room's tools ({tools})")]
    NoSuchTool {
        /// What it does to it.
        verb: &'static str,
        /// What is to be broken or interlocked.
        name: Symbol,
        /// The tools that there are.
        tools: String,
    },
    /// An exception of a type that no food or no tool has.
    #[error("the scenario has the exception `{exception}`, and `{name}` is none of {known}")]
    NoSuchException {
        /// The exception.
        exception: Exception,
        /// The type.
        name: Symbol,
        /// The types that there are.
        known: String,
    },
    /// Items or a filler beside a snapshot.
    #[error(
        "the scenario has a `state`, which says what there is: `items`, `numbered_from` and `filler` have no place beside it"
    )]
    StateAndItems,
    /// The snapshot is not one of a kitchen.
    #[error("the scenario's state is not a kitchen: {0}")]
    State(#[from] SnapshotError),
}

impl Filler {
    /// Its endless sequence.
    pub(crate) fn kinds(self) -> impl Iterator<Item = ItemKind> {
        let once: &[ItemKind] = match self {
            Self::Demonstrated => &[
                ItemKind::Lettuce,
                ItemKind::Tomato,
                ItemKind::Onion,
                ItemKind::Carrot,
                ItemKind::Bread,
                ItemKind::Banana,
                ItemKind::Cucumber,
            ],
            Self::Novel => &[ItemKind::Cucumber, ItemKind::Apple, ItemKind::Watermelon, ItemKind::Bagel],
            Self::None => &[],
        };
        once.iter().copied().cycle()
    }
}

impl Scenario {
    /// Reads one; `None` is the default.
    ///
    /// # Errors
    /// [`ScenarioError::Form`] if it is something else, with the field that is not known.
    pub fn from_json(value: Option<&serde_json::Value>) -> Result<Self, ScenarioError> {
        match value {
            None => Ok(Self::default()),
            Some(value) => Self::deserialize(value).map_err(|error| ScenarioError::Form(json_message(&error))),
        }
    }
}

impl Room {
    /// The room that a scenario asks for. The seed decides which station stands where, which counter each item
    /// starts on, and where the agent starts; a scenario with a state leaves nothing to it.
    ///
    /// # Errors
    /// [`ScenarioError`] if there is no such room.
    pub fn build(scenario: &Scenario, seed: u64) -> Result<Self, ScenarioError> {
        let mut room = match &scenario.state {
            Some(_) if scenario.items.is_some() || scenario.filler.is_some() || scenario.numbered_from.is_some() => {
                return Err(ScenarioError::StateAndItems);
            }
            Some(state) => Self::from_snapshot(state)?,
            None => Self::with_items(&kinds(scenario)?, scenario.numbered_from.unwrap_or(1), seed)?,
        };
        for name in &scenario.broken {
            let tool = room.tool(name, "breaks")?;
            room.stations[tool].broken = true;
        }
        for exception in &scenario.exceptions {
            room.quirks.exceptions.push(kinds_of(exception)?);
        }
        for Interlock { tools, loaded } in &scenario.interlocks {
            let tools = tools.iter().map(|tool| room.tool(tool, "interlocks")).collect::<Result<_, _>>()?;
            let loaded = room.tool(loaded, "interlocks")?;
            room.quirks.interlocks.push((tools, loaded));
        }
        Ok(room)
    }

    /// The tool of this name, to which something is done.
    fn tool(&self, name: &Symbol, verb: &'static str) -> Result<usize, ScenarioError> {
        let is_tool = |station: &&Station| station.kind.process().is_some();
        let found = self.stations.iter().position(|station| is_tool(&station) && station.name == *name);
        found.ok_or_else(|| {
            let tools: Vec<&str> = self.stations.iter().filter(is_tool).map(|s| s.name.as_str()).collect();
            ScenarioError::NoSuchTool { verb, name: name.clone(), tools: tools.join(", ") }
        })
    }
}

/// The food and the tool of an exception.
fn kinds_of(exception: &Exception) -> Result<(ItemKind, StationKind), ScenarioError> {
    let unknown = |name: &Symbol, known: Vec<&str>| ScenarioError::NoSuchException {
        exception: exception.clone(),
        name: name.clone(),
        known: known.join(", "),
    };
    let Exception { food, tool } = exception;
    let foods = || ItemKind::ALL.into_iter().filter(|kind| kind.is_food());
    let food = foods()
        .find(|kind| *food == *kind.name())
        .ok_or_else(|| unknown(food, foods().map(ItemKind::name).collect()))?;
    let tools = || StationKind::TOOLS.into_iter();
    let tool = tools()
        .find(|kind| *tool == *kind.name())
        .ok_or_else(|| unknown(tool, tools().map(StationKind::name).collect()))?;
    Ok((food, tool))
}

/// The number of items that fillers fill up to.
const ITEMS: usize = 8;

/// The kinds of the items that a scenario without a state asks for, fillers last.
fn kinds(scenario: &Scenario) -> Result<Vec<ItemKind>, ScenarioError> {
    let known = || ItemKind::ALL.map(ItemKind::name).join(", ");
    let mut kinds = match &scenario.items {
        None => vec![ItemKind::Plate],
        Some(names) => names
            .iter()
            .map(|name| {
                ItemKind::from_name(name.as_str())
                    .ok_or_else(|| ScenarioError::UnknownItem { name: name.clone(), known: known() })
            })
            .collect::<Result<_, _>>()?,
    };
    let missing = ITEMS.saturating_sub(kinds.len());
    kinds.extend(scenario.filler.unwrap_or_default().kinds().take(missing));
    Ok(kinds)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn build(value: &Value) -> Result<Room, ScenarioError> {
        Room::build(&Scenario::from_json(Some(value))?, 1)
    }

    fn items(value: &Value) -> Vec<String> {
        build(value).expect("a room").items.iter().map(|i| i.name.to_string()).collect()
    }

    #[test]
    fn items_and_fillers() {
        assert_eq!(
            items(&json!({})),
            ["plate_1", "lettuce_1", "tomato_1", "onion_1", "carrot_1", "bread_1", "banana_1", "cucumber_1"]
        );
        assert_eq!(
            items(&json!({"items": ["plate", "bread", "bread"], "filler": "novel"})),
            ["plate_1", "bread_1", "bread_2", "cucumber_1", "apple_1", "watermelon_1", "bagel_1", "cucumber_2"]
        );
        assert_eq!(items(&json!({"items": ["plate", "onion"], "filler": "none"})), ["plate_1", "onion_1"]);
        let later = json!({"items": ["plate", "onion", "onion"], "filler": "none", "numbered_from": 31});
        assert_eq!(items(&later), ["plate_31", "onion_31", "onion_32"]);
        assert_eq!(items(&json!({"items": vec!["apple"; 14]})).len(), 14);
        assert!(items(&json!({"items": [], "filler": "none"})).is_empty());
    }

    #[test]
    fn what_cannot_be_set_up_is_refused() {
        let state = serde_json::to_value(build(&json!({})).expect("a room").snapshot()).expect("JSON");
        let refused = [
            (
                json!({"itmes": []}),
                "expected one of `state`, `items`, `numbered_from`, `filler`, `broken`, `exceptions`, `interlocks`, found the unknown field `itmes`",
            ),
            (
                json!({"filler": "some"}),
                "expected one of `demonstrated`, `novel`, `none`, found the unknown word `some`",
            ),
            (json!("burger"), "the scenario is not understood: expected an object, found the string \"burger\""),
            (json!({"items": ["leek"]}), "the scenario asks for the item `leek`; there are plate, lettuce, tomato"),
            (json!({"items": ["lettuce_1"]}), "the scenario asks for the item `lettuce_1`"),
            (json!({"items": vec!["apple"; 15]}), "the scenario asks for 15 items, and there is room for 14"),
            (json!({"broken": ["cutboard_2"]}), "breaks `cutboard_2`, which is none of the room's tools (cutboard_1, "),
            (json!({"broken": ["counter_1"]}), "breaks `counter_1`, which is none of the room's tools"),
            (
                json!({"exceptions": [{"food": "plate", "tool": "cutboard"}]}),
                "the exception `plate with cutboard`, and `plate` is none of lettuce, tomato, ",
            ),
            (
                json!({"exceptions": [{"food": "onion", "tool": "counter"}]}),
                "`counter` is none of cutboard, breadslicer, ",
            ),
            (json!({"exceptions": ["onion"]}), "expected an object with `food` and `tool`"),
            (
                json!({"interlocks": [{"tools": ["cutboard_1"], "loaded": "counter_1"}]}),
                "interlocks `counter_1`, which is none of the room's tools",
            ),
            (
                json!({"state": state, "items": ["plate"]}),
                "`items`, `numbered_from` and `filler` have no place beside it",
            ),
            (json!({"state": {"entities": []}}), "the scenario's state is not a kitchen: there is no agent"),
            (json!({"state": {"objects": {}}}), "`entities` is missing"),
        ];
        for (scenario, message) in refused {
            let error = build(&scenario).expect_err(message).to_string();
            assert!(error.contains(message), "{error}");
        }
    }

    #[test]
    fn tools_of_a_given_state_can_be_broken() {
        let state = serde_json::to_value(build(&json!({})).expect("a room").snapshot()).expect("JSON");
        let room = build(&json!({"state": state, "broken": ["blender_1", "toaster_1"]})).expect("a room");
        let broken: Vec<_> = room.stations.iter().filter(|s| s.broken).map(|s| s.name.as_str()).collect();
        assert_eq!(broken, ["blender_1", "toaster_1"]);
    }
}
