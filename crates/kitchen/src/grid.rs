//! The room's cells: 7 × 7, x to the right, y down.

/// The number of cells along each side.
pub(crate) const SIZE: u8 = 7;

/// A cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cell {
    pub(crate) x: u8,
    pub(crate) y: u8,
}

/// Where the agent looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Left,
    Right,
    Down,
    Up,
}

impl Direction {
    pub(crate) const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Down, Self::Up];
}

impl Cell {
    /// Every cell, row by row.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| Self { x, y }))
    }

    /// The cells at the edge of the room, row by row.
    pub(crate) fn border() -> impl Iterator<Item = Self> {
        Self::all().filter(|cell| cell.is_border())
    }

    pub(crate) fn is_border(self) -> bool {
        Self::is_end(self.x) || Self::is_end(self.y)
    }

    /// Whether it is one of the four corners, which are out of reach from the floor.
    pub(crate) fn is_corner(self) -> bool {
        Self::is_end(self.x) && Self::is_end(self.y)
    }

    fn is_end(coordinate: u8) -> bool {
        coordinate == 0 || coordinate == SIZE - 1
    }

    /// Its number, row by row.
    pub(crate) fn index(self) -> usize {
        usize::from(self.y) * usize::from(SIZE) + usize::from(self.x)
    }

    /// The cell one step away, if it is in the room.
    pub(crate) fn step(self, direction: Direction) -> Option<Self> {
        let (x, y) = match direction {
            Direction::Left => (self.x.checked_sub(1)?, self.y),
            Direction::Right => (self.x + 1, self.y),
            Direction::Down => (self.x, self.y + 1),
            Direction::Up => (self.x, self.y.checked_sub(1)?),
        };
        (x < SIZE && y < SIZE).then_some(Self { x, y })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn border_and_corners() {
        assert_eq!(Cell::all().count(), 49);
        assert_eq!(Cell::border().count(), 24);
        assert_eq!(Cell::border().filter(|c| c.is_corner()).count(), 4);
        assert!(Cell::all().enumerate().all(|(i, cell)| cell.index() == i));
    }

    #[test]
    fn steps_end_at_the_edge() {
        let corner = Cell { x: 6, y: 0 };
        let reached: Vec<_> = Direction::ALL.into_iter().filter_map(|d| corner.step(d)).collect();
        assert_eq!(reached, [Cell { x: 5, y: 0 }, Cell { x: 6, y: 1 }]);
    }
}
