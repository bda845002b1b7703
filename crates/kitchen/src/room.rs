//! A room in one state: the agent, the stations and the items, and what lies in what.

use typelift_model::Symbol;

use crate::grid::{Cell, Direction};
use crate::kind::{ItemKind, StationKind};
use crate::quirk::Quirks;

/// A kitchen in one state.
///
/// Made from a [`Scenario`](crate::Scenario) by [`build`](Self::build) or from what was observed by
/// [`from_snapshot`](Self::from_snapshot); changed by [`act`](Self::act); observed by [`snapshot`](Self::snapshot).
#[derive(Debug, Clone, PartialEq)]
pub struct Room {
    pub(crate) agent: Agent,
    pub(crate) stations: Vec<Station>,
    pub(crate) items: Vec<Item>,
    /// The order in which snapshots list them.
    pub(crate) order: Vec<Which>,
    pub(crate) quirks: Quirks,
}

/// One of the things in a room.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Which {
    Agent,
    Station(usize),
    Item(usize),
}

/// What an item can lie in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Container {
    Station(usize),
    Plate(usize),
}

/// The one who acts.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Agent {
    pub(crate) name: Symbol,
    pub(crate) cell: Cell,
    /// Where it looks; nothing is known of that before it has acted.
    pub(crate) facing: Option<Direction>,
    pub(crate) holding: Option<usize>,
}

/// What stands in a cell.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Station {
    pub(crate) name: Symbol,
    pub(crate) kind: StationKind,
    pub(crate) cell: Cell,
    /// Items, bottom first.
    pub(crate) content: Vec<usize>,
    /// Whether a tool's status is Ready.
    pub(crate) ready: bool,
    /// Whether a tool does nothing when it is used. No snapshot tells.
    pub(crate) broken: bool,
}

/// What can be carried.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Item {
    pub(crate) name: Symbol,
    pub(crate) kind: ItemKind,
    pub(crate) chopped: bool,
    pub(crate) mashed: bool,
    pub(crate) toast: Toast,
    /// Items on a plate, bottom first.
    pub(crate) content: Vec<usize>,
}

/// How far the toasting of bread and bagels has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Toast {
    Fresh,
    Ready,
    Toasted,
}

impl Station {
    pub(crate) fn new(name: Symbol, kind: StationKind, cell: Cell) -> Self {
        Self { name, kind, cell, content: Vec::new(), ready: false, broken: false }
    }
}

impl Item {
    pub(crate) fn new(name: Symbol, kind: ItemKind) -> Self {
        Self { name, kind, chopped: false, mashed: false, toast: Toast::Fresh, content: Vec::new() }
    }
}

impl Room {
    /// The interlock that keeps a tool from doing anything now.
    pub(crate) fn interlock_of(&self, tool: usize) -> Option<&(Vec<usize>, usize)> {
        let mut interlocks = self.quirks.interlocks.iter();
        interlocks.find(|(tools, loaded)| tools.contains(&tool) && !self.stations[*loaded].content.is_empty())
    }

    /// Whether the item is an exception to what the tool does.
    pub(crate) fn is_exception(&self, tool: usize, item: &Item) -> bool {
        self.quirks.exceptions.contains(&(item.kind, self.stations[tool].kind))
    }

    /// The name of the one who acts: argument 0 of every call.
    pub fn agent_name(&self) -> &Symbol {
        &self.agent.name
    }

    /// The name of the station or plate that an item lies in; `None` if there is no such item or it is held.
    pub fn container_of(&self, item: &str) -> Option<&Symbol> {
        match self.find(item)? {
            Which::Item(item) => self.container_holding(item).map(|container| self.container_name(container)),
            _ => None,
        }
    }

    /// Breaks a tool: it takes and gives as before, but using it does nothing. False if there is no such tool.
    pub fn break_tool(&mut self, name: &str) -> bool {
        let tool = self.stations.iter_mut().find(|s| s.name == *name && s.kind.process().is_some());
        tool.map(|tool| tool.broken = true).is_some()
    }

    /// Mends a broken tool. False if there is no such tool.
    pub fn mend_tool(&mut self, name: &str) -> bool {
        let tool = self.stations.iter_mut().find(|s| s.name == *name && s.kind.process().is_some());
        tool.map(|tool| tool.broken = false).is_some()
    }

    pub(crate) fn find(&self, name: &str) -> Option<Which> {
        if self.agent.name == *name {
            return Some(Which::Agent);
        }
        let station = self.stations.iter().position(|s| s.name == *name).map(Which::Station);
        station.or_else(|| self.items.iter().position(|i| i.name == *name).map(Which::Item))
    }

    /// What an item lies in; `None` if it is held.
    pub(crate) fn container_holding(&self, item: usize) -> Option<Container> {
        let station = self.stations.iter().position(|s| s.content.contains(&item)).map(Container::Station);
        station.or_else(|| self.items.iter().position(|i| i.content.contains(&item)).map(Container::Plate))
    }

    pub(crate) fn container_name(&self, container: Container) -> &Symbol {
        match container {
            Container::Station(station) => &self.stations[station].name,
            Container::Plate(plate) => &self.items[plate].name,
        }
    }

    /// What lies in a container, bottom first.
    pub(crate) fn content(&self, container: Container) -> &[usize] {
        match container {
            Container::Station(station) => &self.stations[station].content,
            Container::Plate(plate) => &self.items[plate].content,
        }
    }

    pub(crate) fn content_mut(&mut self, container: Container) -> &mut Vec<usize> {
        match container {
            Container::Station(station) => &mut self.stations[station].content,
            Container::Plate(plate) => &mut self.items[plate].content,
        }
    }

    /// The number of items a container has room for.
    pub(crate) fn capacity(&self, container: Container) -> usize {
        match container {
            Container::Station(station) => self.stations[station].kind.capacity(),
            Container::Plate(plate) => self.items[plate].kind.capacity(),
        }
    }

    /// The station through which an item is reached; `None` if the agent holds it or the plate it lies on.
    pub(crate) fn station_under(&self, item: usize) -> Option<usize> {
        match self.container_holding(item)? {
            Container::Station(station) => Some(station),
            Container::Plate(plate) => self.station_under(plate),
        }
    }

    /// Whether nothing lies on an item: it is the topmost where it lies, or it is held.
    pub(crate) fn is_free(&self, item: usize) -> bool {
        self.container_holding(item).is_none_or(|container| self.content(container).last() == Some(&item))
    }

    /// Where a thing is; a held item is where the agent is.
    pub(crate) fn cell_of(&self, item: usize) -> Cell {
        self.station_under(item).map_or(self.agent.cell, |station| self.stations[station].cell)
    }

    /// Whether the agent can walk on a cell.
    pub(crate) fn is_floor(&self, cell: Cell) -> bool {
        !cell.is_border() && self.stations.iter().all(|s| s.cell != cell)
    }
}
