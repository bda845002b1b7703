//! Where the things of a snapshot are.
//!
//! A `location` says it as column and row. Things without one get a free place: items lie where a content list names
//! them, else on an empty counter; stations stand along the border, in the corners last; the agent starts on the
//! first free cell.

use typelift_world::{Entity, Snapshot, Value};

use crate::grid::{Cell, SIZE};
use crate::kind::StationKind;
use crate::restore::as_json;
use crate::room::{Container, Room, Which};
use crate::snapshot_error::SnapshotError;

impl Room {
    /// Gives everything its place.
    pub(crate) fn settle(&mut self, snapshot: &Snapshot) -> Result<(), SnapshotError> {
        let located = snapshot.entities.iter().zip(self.order.clone()).map(|(entity, which)| {
            let cell = located(entity)?;
            Ok((entity, which, cell))
        });
        let located: Vec<_> = located.collect::<Result<_, SnapshotError>>()?;
        self.settle_stations(&located)?;
        self.settle_agent(&located)?;
        self.settle_items(&located)
    }

    fn settle_stations(&mut self, located: &[Located<'_>]) -> Result<(), SnapshotError> {
        let mut taken: Vec<(Cell, usize)> = Vec::new();
        for &(entity, which, cell) in located {
            let (Which::Station(station), Some(cell)) = (which, cell) else { continue };
            if let Some((_, other)) = taken.iter().find(|(other, _)| *other == cell) {
                return Err(misplaced(entity, &format!("taken by {}", self.stations[*other].name)));
            }
            taken.push((cell, station));
            self.stations[station].cell = cell;
        }
        let (corners, sides): (Vec<_>, Vec<_>) = Cell::border().partition(|cell| cell.is_corner());
        for &(entity, which, cell) in located {
            let (Which::Station(station), None) = (which, cell) else { continue };
            let mut places = sides.iter().chain(&corners);
            let free = places.find(|&&cell| taken.iter().all(|(other, _)| *other != cell));
            let cell = *free.ok_or_else(|| SnapshotError::NoPlace { entity: entity.id.clone() })?;
            taken.push((cell, station));
            self.stations[station].cell = cell;
        }
        Ok(())
    }

    fn settle_agent(&mut self, located: &[Located<'_>]) -> Result<(), SnapshotError> {
        for &(entity, which, cell) in located {
            if which == Which::Agent {
                self.agent.cell = match cell {
                    Some(cell) if self.is_floor(cell) => cell,
                    Some(_) => return Err(misplaced(entity, "not on the floor")),
                    None => Cell::all()
                        .find(|&cell| self.is_floor(cell))
                        .ok_or_else(|| SnapshotError::NoPlace { entity: entity.id.clone() })?,
                };
            }
        }
        Ok(())
    }

    /// Puts the items that are not placed yet into stations: first those with a location, bottom first.
    fn settle_items(&mut self, located: &[Located<'_>]) -> Result<(), SnapshotError> {
        for &(entity, which, cell) in located {
            let (Which::Item(item), Some(cell)) = (which, cell) else { continue };
            if self.place_of(item).is_some() {
                continue;
            }
            let station = self.stations.iter().position(|s| s.cell == cell);
            let station = station.ok_or_else(|| misplaced(entity, "neither a station nor does anybody hold it"))?;
            let container = Container::Station(station);
            if self.content(container).len() == self.capacity(container) {
                return Err(misplaced(entity, &format!("{}, which is full", self.stations[station].name)));
            }
            self.content_mut(container).push(item);
        }
        for &(entity, which, _) in located {
            let Which::Item(item) = which else { continue };
            if self.place_of(item).is_some() {
                continue;
            }
            let mut counters = self.stations.iter_mut().filter(|s| s.kind == StationKind::Counter);
            let free = counters.find(|s| s.content.is_empty() && !s.cell.is_corner());
            free.ok_or_else(|| SnapshotError::NoPlace { entity: entity.id.clone() })?.content.push(item);
        }
        Ok(())
    }
}

/// An entity, what it is, and where it says it is.
type Located<'a> = (&'a Entity, Which, Option<Cell>);

/// The cell that the entity's location names, if it has one.
fn located(entity: &Entity) -> Result<Option<Cell>, SnapshotError> {
    let cell = match entity.attributes.get("location") {
        None => return Ok(None),
        Some(Value::Vector(at)) => match at.as_slice() {
            &[x, y] => Cell::all().find(|cell| f64::from(cell.x) == x && f64::from(cell.y) == y),
            _ => None,
        },
        Some(_) => None,
    };
    let problem = format!("not a cell [column, row], each from 0 to {}", SIZE - 1);
    cell.map(Some).ok_or_else(|| misplaced(entity, &problem))
}

fn misplaced(entity: &Entity, problem: &str) -> SnapshotError {
    let location = entity.attributes.get("location").map_or_else(String::new, as_json);
    SnapshotError::Location { entity: entity.id.clone(), location, problem: problem.to_owned() }
}
