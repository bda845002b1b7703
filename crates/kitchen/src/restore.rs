//! From a snapshot to the room that it shows: who is there, what lies in what, in which state, and where.
//!
//! Attributes and relations that a kitchen does not have are left aside. What follows from the rest (`free`,
//! `notFull`, `notEmpty`, `movable`) may be left out, but must not contradict it. Locations are
//! [given](crate::settle) last.

use std::collections::BTreeSet;

use typelift_model::Symbol;
use typelift_world::{Entity, Snapshot, Value};

use crate::grid::Cell;
use crate::kind::{AGENT, ItemKind, StationKind};
use crate::quirk::Quirks;
use crate::room::{Agent, Container, Item, Room, Station, Toast, Which};
use crate::snapshot_error::SnapshotError;

/// Where a thing is until its location is settled.
const NOWHERE: Cell = Cell { x: 0, y: 0 };

impl Room {
    /// The room that a snapshot shows, all tools healthy.
    ///
    /// Things without a location get a free place. A border cell without a station is wall.
    ///
    /// # Errors
    /// [`SnapshotError`] with the entity concerned, if it does not show a kitchen.
    pub fn from_snapshot(snapshot: &Snapshot) -> Result<Self, SnapshotError> {
        let mut room = Self::with_things_of(snapshot)?;
        let order = room.order.clone();
        for (entity, &which) in snapshot.entities.iter().zip(&order) {
            room.restore_relations(entity, which)?;
        }
        for (entity, &which) in snapshot.entities.iter().zip(&order) {
            room.restore_states(entity, which)?;
        }
        room.settle(snapshot)?;
        room.check_derived(snapshot)?;
        Ok(room)
    }

    /// The agent, stations and items of a snapshot, in their initial states and nowhere yet.
    fn with_things_of(snapshot: &Snapshot) -> Result<Self, SnapshotError> {
        let (mut agent, mut stations, mut items, mut order) = (None::<Agent>, Vec::new(), Vec::new(), Vec::new());
        let mut names = BTreeSet::new();
        for Entity { id, ty, .. } in &snapshot.entities {
            if !names.insert(id) {
                return Err(SnapshotError::Duplicate { entity: id.clone() });
            }
            if *ty == AGENT {
                if let Some(first) = &agent {
                    return Err(SnapshotError::TwoAgents { first: first.name.clone(), second: id.clone() });
                }
                agent = Some(Agent { name: id.clone(), cell: NOWHERE, facing: None, holding: None });
                order.push(Which::Agent);
            } else if let Some(kind) = StationKind::from_name(ty.as_str()) {
                order.push(Which::Station(stations.len()));
                stations.push(Station::new(id.clone(), kind, NOWHERE));
            } else if let Some(kind) = ItemKind::from_name(ty.as_str()) {
                order.push(Which::Item(items.len()));
                items.push(Item::new(id.clone(), kind));
            } else {
                return Err(SnapshotError::Type { entity: id.clone(), ty: ty.clone() });
            }
        }
        let agent = agent.ok_or(SnapshotError::NoAgent)?;
        Ok(Self { agent, stations, items, order, quirks: Quirks::default() })
    }

    /// What the entity holds or contains.
    fn restore_relations(&mut self, entity: &Entity, which: Which) -> Result<(), SnapshotError> {
        let container = match which {
            Which::Agent => None,
            Which::Station(station) => Some(Container::Station(station)),
            Which::Item(item) => Some(Container::Plate(item)),
        };
        let (relation, most) = match container {
            None => ("holding", 1),
            Some(container) => ("content", self.capacity(container)),
        };
        let targets = entity.relations.get(relation).map_or(&[][..], |r| r.targets());
        if targets.len() > most {
            let (entity, count) = (entity.id.clone(), targets.len());
            return Err(SnapshotError::TooMany { entity, relation, count, most });
        }
        for target in targets {
            let on_plate = matches!(which, Which::Item(_));
            let item = match self.find(target.as_str()) {
                Some(Which::Item(item)) if !on_plate || self.items[item].kind.is_food() => item,
                _ => {
                    let expected = if on_plate { "a food" } else { "an item" };
                    let (entity, target) = (entity.id.clone(), target.clone());
                    return Err(SnapshotError::Target { entity, relation, target, expected });
                }
            };
            if let Some(first) = self.place_of(item) {
                return Err(SnapshotError::TwoPlaces {
                    entity: target.clone(),
                    first: first.clone(),
                    second: entity.id.clone(),
                });
            }
            match container {
                None => self.agent.holding = Some(item),
                Some(container) => self.content_mut(container).push(item),
            }
        }
        Ok(())
    }

    /// The name of the entity that holds an item, if one does yet.
    pub(crate) fn place_of(&self, item: usize) -> Option<&Symbol> {
        let held = self.agent.holding == Some(item);
        held.then_some(&self.agent.name).or_else(|| self.container_holding(item).map(|c| self.container_name(c)))
    }

    /// The status of a tool, the states of a food.
    fn restore_states(&mut self, entity: &Entity, which: Which) -> Result<(), SnapshotError> {
        let (tool, food, blend, toast) = match which {
            Which::Agent => (false, false, false, false),
            Which::Station(station) => (self.stations[station].kind.process().is_some(), false, false, false),
            Which::Item(item) => {
                let kind = self.items[item].kind;
                (false, kind.is_food(), kind.can_be_blended(), kind.can_be_toasted())
            }
        };
        let status = choice(entity, "status", &["NotUsable", "Ready"], tool)?;
        let chopped = choice(entity, "chop_state", &["Fresh", "Chopped"], food)?;
        let mashed = choice(entity, "blend_state", &["Fresh", "Mashed"], blend)?;
        let toasts = [Toast::Fresh, Toast::Ready, Toast::Toasted];
        let toasted = choice(entity, "toast_state", &toasts.map(Toast::word), toast)?;
        match which {
            Which::Agent => {}
            Which::Station(station) => self.stations[station].ready = status == 1,
            Which::Item(item) => {
                let item = &mut self.items[item];
                (item.chopped, item.mashed, item.toast) = (chopped == 1, mashed == 1, toasts[toasted]);
            }
        }
        Ok(())
    }

    /// Compares the attributes that follow from the rest with the rest.
    fn check_derived(&self, snapshot: &Snapshot) -> Result<(), SnapshotError> {
        for (entity, derived) in snapshot.entities.iter().zip(self.snapshot().entities) {
            for attribute in ["movable", "free", "notFull", "notEmpty"] {
                let found = match entity.attributes.get(attribute) {
                    None => continue,
                    Some(Value::Bool(found)) => *found,
                    Some(value) => return Err(wrong_value(entity, attribute, value, "true or false")),
                };
                if found != (derived.attributes.get(attribute) == Some(&Value::Bool(true))) {
                    return Err(SnapshotError::Contradiction { entity: entity.id.clone(), attribute, found });
                }
            }
        }
        Ok(())
    }
}

/// Which of `words` the attribute is; the first if it is left out. An entity that does not `have` the attribute
/// must leave it out.
fn choice(entity: &Entity, attribute: &'static str, words: &[&str], have: bool) -> Result<usize, SnapshotError> {
    let Some(value) = entity.attributes.get(attribute) else { return Ok(0) };
    if !have {
        return Err(wrong_value(entity, attribute, value, &format!("left out: nothing of type {} has it", entity.ty)));
    }
    let found = match value {
        Value::Text(word) => words.iter().position(|w| word == w),
        _ => None,
    };
    found.ok_or_else(|| wrong_value(entity, attribute, value, &words.join(" or ")))
}

fn wrong_value(entity: &Entity, attribute: &'static str, value: &Value, expected: &str) -> SnapshotError {
    let (found, expected) = (as_json(value), expected.to_owned());
    SnapshotError::Attribute { entity: entity.id.clone(), attribute, found, expected }
}

/// A value as it stands in a file.
pub(crate) fn as_json(value: &Value) -> String {
    serde_json::to_string(value).unwrap_or_else(|_| format!("{value:?}"))
}
