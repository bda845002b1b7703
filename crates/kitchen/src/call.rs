//! From a call to what is meant by it: each argument has to be what the action says it is.
//!
//! | call                         | short form        |
//! |------------------------------|-------------------|
//! | PICK(agent, container, item) | PICK(agent, item) |
//! | PLACE(agent, container, item)| PLACE(agent, container) |
//! | USE(agent, tool, topmost item)| USE(agent, tool) |

use typelift_model::{GroundCall, Symbol};

use crate::refusal::Refusal;
use crate::room::{Container, Room, Which};

/// An action whose arguments are what they have to be. Whether it is possible is another question.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Deed {
    /// Take an item out of the container that it lies in.
    Pick { item: usize },
    /// Put the held item into a container.
    Place { item: usize, container: Container },
    /// Use the tool.
    Use { tool: usize },
}

impl Room {
    /// What a call means.
    pub(crate) fn understand(&self, call: &GroundCall) -> Result<Deed, Refusal> {
        let form = match call.name.as_str() {
            "PICK" => "agent, container, item",
            "PLACE" => "agent, container, item",
            "USE" => "agent, tool, topmost item",
            _ => return Err(Refusal::UnknownAction { name: call.name.clone() }),
        };
        let (agent, args) = match call.args.as_slice() {
            [agent, args @ ..] if matches!(args.len(), 1 | 2) => (agent, args),
            _ => return Err(Refusal::Arguments { name: call.name.clone(), form, count: call.args.len() }),
        };
        if self.resolve(agent)? != Which::Agent {
            return Err(Refusal::NotA { name: agent.clone(), wanted: "the agent" });
        }
        match (call.name.as_str(), args) {
            ("PICK", [item]) => Ok(Deed::Pick { item: self.item(item)? }),
            ("PICK", [container, item]) => self.picking(container, item),
            ("PLACE", [container]) => Ok(Deed::Place { item: self.held()?, container: self.container(container)? }),
            ("PLACE", [container, item]) => self.placing(container, item),
            (_, [tool, item @ ..]) => self.using(tool, item.first()),
            (_, []) => Err(Refusal::Arguments { name: call.name.clone(), form, count: call.args.len() }),
        }
    }

    fn picking(&self, container: &Symbol, item: &Symbol) -> Result<Deed, Refusal> {
        let (from, taken) = (self.container(container)?, self.item(item)?);
        if self.container_holding(taken) != Some(from) {
            return Err(Refusal::NotThere { item: item.clone(), container: container.clone() });
        }
        Ok(Deed::Pick { item: taken })
    }

    fn placing(&self, container: &Symbol, item: &Symbol) -> Result<Deed, Refusal> {
        let (container, put) = (self.container(container)?, self.item(item)?);
        let held = self.held()?;
        if held != put {
            return Err(Refusal::NotHeld { item: item.clone(), held: self.items[held].name.clone() });
        }
        Ok(Deed::Place { item: put, container })
    }

    fn using(&self, name: &Symbol, item: Option<&Symbol>) -> Result<Deed, Refusal> {
        let tool = match self.resolve(name)? {
            Which::Station(station) if self.stations[station].kind.process().is_some() => station,
            _ => return Err(Refusal::NotA { name: name.clone(), wanted: "a tool" }),
        };
        let Some(item) = item else { return Ok(Deed::Use { tool }) };
        let content = &self.stations[tool].content;
        let named = self.item(item)?;
        match content.last() {
            Some(&top) if top == named => Ok(Deed::Use { tool }),
            Some(&top) if content.contains(&named) => Err(Refusal::Covered {
                item: item.clone(),
                container: name.clone(),
                above: self.items[top].name.clone(),
            }),
            _ => Err(Refusal::NotThere { item: item.clone(), container: name.clone() }),
        }
    }

    fn resolve(&self, name: &Symbol) -> Result<Which, Refusal> {
        self.find(name.as_str()).ok_or_else(|| Refusal::UnknownEntity { name: name.clone() })
    }

    fn item(&self, name: &Symbol) -> Result<usize, Refusal> {
        match self.resolve(name)? {
            Which::Item(item) => Ok(item),
            _ => Err(Refusal::NotA { name: name.clone(), wanted: "an item" }),
        }
    }

    fn container(&self, name: &Symbol) -> Result<Container, Refusal> {
        match self.resolve(name)? {
            Which::Station(station) => Ok(Container::Station(station)),
            Which::Item(item) if !self.items[item].kind.is_food() => Ok(Container::Plate(item)),
            _ => Err(Refusal::NotA { name: name.clone(), wanted: "a station or a plate" }),
        }
    }

    fn held(&self) -> Result<usize, Refusal> {
        self.agent.holding.ok_or(Refusal::HandEmpty)
    }
}
