//! What is observed of a room. That a tool is broken is not, nor where the agent looks.

use std::collections::BTreeMap;

use typelift_model::Symbol;
use typelift_world::{Entity, Relation, Snapshot, Value};

use crate::grid::Cell;
use crate::kind::AGENT;
use crate::room::{Container, Room, Toast, Which};

impl Room {
    /// What is observed: of each entity its attributes, its location (column, row) and its relations. The content
    /// of a container is listed bottom first.
    pub fn snapshot(&self) -> Snapshot {
        let entities = self.order.iter().map(|which| match *which {
            Which::Agent => self.agent_entity(),
            Which::Station(station) => self.station_entity(station),
            Which::Item(item) => self.item_entity(item),
        });
        Snapshot { entities: entities.collect() }
    }

    fn agent_entity(&self) -> Entity {
        let held = self.agent.holding.map(|item| self.items[item].name.clone());
        Entity {
            id: self.agent.name.clone(),
            ty: Symbol::new(AGENT),
            attributes: attributes([("location", location(self.agent.cell))]),
            relations: BTreeMap::from([(Symbol::new("holding"), Relation::One(held))]),
        }
    }

    fn station_entity(&self, index: usize) -> Entity {
        let station = &self.stations[index];
        let mut entity = Entity {
            id: station.name.clone(),
            ty: Symbol::new(station.kind.name()),
            attributes: attributes([("location", location(station.cell))]),
            relations: BTreeMap::new(),
        };
        if station.kind.process().is_some() {
            let status = if station.ready { "Ready" } else { "NotUsable" };
            entity.attributes.extend(attributes([("status", word(status))]));
        }
        self.add_content(&mut entity, Container::Station(index));
        entity
    }

    fn item_entity(&self, index: usize) -> Entity {
        let item = &self.items[index];
        let mut entity = Entity {
            id: item.name.clone(),
            ty: Symbol::new(item.kind.name()),
            attributes: attributes([
                ("location", location(self.cell_of(index))),
                ("movable", Value::Bool(true)),
                ("free", Value::Bool(self.is_free(index))),
            ]),
            relations: BTreeMap::new(),
        };
        if !item.kind.is_food() {
            self.add_content(&mut entity, Container::Plate(index));
            return entity;
        }
        let chopped = if item.chopped { "Chopped" } else { "Fresh" };
        entity.attributes.extend(attributes([("chop_state", word(chopped))]));
        if item.kind.can_be_blended() {
            let mashed = if item.mashed { "Mashed" } else { "Fresh" };
            entity.attributes.extend(attributes([("blend_state", word(mashed))]));
        }
        if item.kind.can_be_toasted() {
            entity.attributes.extend(attributes([("toast_state", word(item.toast.word()))]));
        }
        entity
    }

    fn add_content(&self, entity: &mut Entity, container: Container) {
        let content = self.content(container);
        entity.attributes.extend(attributes([
            ("notFull", Value::Bool(content.len() < self.capacity(container))),
            ("notEmpty", Value::Bool(!content.is_empty())),
        ]));
        let names = content.iter().map(|&item| self.items[item].name.clone()).collect();
        entity.relations.insert(Symbol::new("content"), Relation::Many(names));
    }
}

impl Toast {
    /// The word that stands for it in a snapshot.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Fresh => "Fresh",
            Self::Ready => "Ready",
            Self::Toasted => "Toasted",
        }
    }
}

fn attributes<const N: usize>(pairs: [(&str, Value); N]) -> BTreeMap<Symbol, Value> {
    pairs.into_iter().map(|(name, value)| (Symbol::new(name), value)).collect()
}

fn word(text: &str) -> Value {
    Value::Text(Symbol::new(text))
}

fn location(cell: Cell) -> Value {
    Value::Vector(vec![f64::from(cell.x), f64::from(cell.y)])
}
