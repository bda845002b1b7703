//! The fixed controller: walks the agent to where it can reach a station. Walking is no action of its own.

use std::collections::VecDeque;

use crate::grid::{Cell, Direction, SIZE};
use crate::room::Room;

impl Room {
    /// The nearest floor cell from which the station is faced, and the direction; `None` if there is no way.
    ///
    /// Breadth first over the free floor; of equally near cells the one met first in the fixed order of directions.
    pub(crate) fn way_to(&self, station: usize) -> Option<(Cell, Direction)> {
        let target = self.stations[station].cell;
        let mut seen = [false; SIZE as usize * SIZE as usize];
        let mut queue = VecDeque::from([self.agent.cell]);
        seen[self.agent.cell.index()] = true;
        while let Some(cell) = queue.pop_front() {
            for direction in Direction::ALL {
                let Some(next) = cell.step(direction) else { continue };
                if next == target {
                    return Some((cell, direction));
                }
                if self.is_floor(next) && !seen[next.index()] {
                    seen[next.index()] = true;
                    queue.push_back(next);
                }
            }
        }
        None
    }
}
