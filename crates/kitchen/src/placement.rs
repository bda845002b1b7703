//! Seeded rooms: the border of the room is full of stations, one of each tool and counters otherwise. Tools and
//! items keep out of the corners, which are out of reach.

use typelift_model::{SplitMix64, Symbol};

use crate::grid::Cell;
use crate::kind::{AGENT, ItemKind, StationKind};
use crate::quirk::Quirks;
use crate::room::{Agent, Item, Room, Station, Which};
use crate::scenario::ScenarioError;

impl Room {
    /// A room with these items, each alone on its counter. Counters are numbered row by row.
    pub(crate) fn with_items(kinds: &[ItemKind], first: usize, seed: u64) -> Result<Self, ScenarioError> {
        let mut random = SplitMix64::new(seed);
        let mut cells: Vec<Cell> = Cell::border().filter(|cell| !cell.is_corner()).collect();
        random.shuffle(&mut cells);
        let (tool_cells, item_cells) = cells.split_at(StationKind::TOOLS.len());
        if kinds.len() > item_cells.len() {
            return Err(ScenarioError::TooManyItems { count: kinds.len(), most: item_cells.len() });
        }
        let items = numbered(kinds, first);
        let counter_cells = Cell::border().filter(|cell| !tool_cells.contains(cell));
        let mut stations: Vec<Station> = (1..)
            .zip(counter_cells)
            .map(|(number, cell)| Station::new(format!("counter_{number}").into(), StationKind::Counter, cell))
            .collect();
        for station in &mut stations {
            let item = item_cells.iter().position(|&cell| cell == station.cell);
            station.content.extend(item.filter(|&item| item < items.len()));
        }
        for (kind, &cell) in StationKind::TOOLS.into_iter().zip(tool_cells) {
            stations.push(Station::new(format!("{}_1", kind.name()).into(), kind, cell));
        }
        let floor: Vec<Cell> = Cell::all().filter(|cell| !cell.is_border()).collect();
        let cell = floor[random.below(floor.len())];
        let agent = Agent { name: format!("{AGENT}_1").into(), cell, facing: None, holding: None };
        let mut order = vec![Which::Agent];
        order.extend((0..stations.len()).map(Which::Station));
        order.extend((0..items.len()).map(Which::Item));
        Ok(Self { agent, stations, items, order, quirks: Quirks::default() })
    }
}

/// Items of these kinds, numbered from `first` within each kind.
fn numbered(kinds: &[ItemKind], first: usize) -> Vec<Item> {
    let name = |index: usize, kind: ItemKind| {
        let number = kinds[..index].iter().filter(|&&k| k == kind).count().saturating_add(first);
        Symbol::from(format!("{}_{number}", kind.name()))
    };
    kinds.iter().enumerate().map(|(index, &kind)| Item::new(name(index, kind), kind)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    fn room(seed: u64) -> Room {
        Room::build(&Scenario::default(), seed).expect("a room")
    }

    #[test]
    fn every_room_is_full_and_reachable() {
        for seed in 0..200 {
            let room = room(seed);
            assert_eq!((room.stations.len(), room.items.len()), (24, 8));
            assert!(!room.agent.cell.is_border());
            for (index, station) in room.stations.iter().enumerate() {
                assert!(station.cell.is_border());
                assert_eq!(room.stations.iter().filter(|s| s.cell == station.cell).count(), 1);
                if station.cell.is_corner() {
                    assert!(station.kind == StationKind::Counter && station.content.is_empty(), "seed {seed}");
                } else {
                    let (cell, facing) = room.way_to(index).expect("a way");
                    assert_eq!(cell.step(facing), Some(station.cell));
                }
            }
            for kind in StationKind::TOOLS {
                assert_eq!(room.stations.iter().filter(|s| s.kind == kind).count(), 1);
            }
            assert!((0..8).all(|item| room.is_free(item) && room.container_holding(item).is_some()));
        }
    }

    #[test]
    fn a_seed_means_one_room() {
        let bytes = |seed| serde_json::to_string(&room(seed).snapshot()).expect("JSON");
        let all: Vec<String> = (0..20).map(bytes).collect();
        assert_eq!(all, (0..20).map(bytes).collect::<Vec<_>>());
        let mut different = all;
        different.sort_unstable();
        different.dedup();
        assert_eq!(different.len(), 20);
    }

    #[test]
    fn the_seed_moves_everything() {
        let places = |of: fn(&Room) -> Cell| {
            let mut cells: Vec<usize> = (0..40).map(|seed| of(&room(seed)).index()).collect();
            cells.sort_unstable();
            cells.dedup();
            cells.len()
        };
        assert!(places(|room| room.agent.cell) > 10);
        assert!(places(|room| room.stations[18].cell) > 10);
        assert!(places(|room| room.cell_of(0)) > 10);
    }
}
