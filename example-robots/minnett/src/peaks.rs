//! Where the map is most uncertain: [`nearest_peak`].

use wasmouse_sdk::{Area, Cell};

use crate::knowledge::Knowledge;

/// The corners and middles of the edges of a ring, one cell away from its centre.
const RING: [(i32, i32); 8] = [
    (0, 1),
    (1, 1),
    (1, 0),
    (1, -1),
    (0, -1),
    (-1, -1),
    (-1, 0),
    (-1, 1),
];

/// The cell of greatest uncertainty that is nearest to `here` as the crow flies,
/// the leftmost of equal ones, then the lowest. Cells that cannot be reached do not
/// count; `None` when there are no others.
pub fn nearest_peak(
    knowledge: &Knowledge,
    here: Cell,
    is_scaled: bool,
    is_reached: impl Fn(Cell) -> bool,
) -> Option<Cell> {
    let dimension = knowledge.map().dimension();
    let cells = || {
        Area::new(Cell::new(0, 0), dimension, dimension)
            .cells()
            .filter(|&cell| is_reached(cell))
    };
    let greatest = cells().map(|cell| knowledge.uncertainty(cell)).max()?;
    let value = |cell: Cell| match knowledge.uncertainty(cell) {
        uncertainty if is_scaled && uncertainty == greatest => {
            u32::from(uncertainty) * scale(knowledge, cell)
        }
        uncertainty => u32::from(uncertainty),
    };
    let highest = cells().map(value).max()?;
    cells()
        .filter(|&cell| value(cell) == highest)
        .min_by_key(|cell| cell.x.abs_diff(here.x).pow(2) + cell.y.abs_diff(here.y).pow(2))
}

/// By how much a cell of greatest uncertainty is exaggerated: the radius of the
/// first ring around it with a smaller uncertainty, times that uncertainty. Rings
/// that touch the perimeter are not looked at; 1 when no other has a smaller one.
fn scale(knowledge: &Knowledge, cell: Cell) -> u32 {
    let last = knowledge.map().dimension() - 1;
    let Cell { x, y } = cell;
    let to_perimeter = x.min(y).min(last - x).min(last - y);
    let own = knowledge.uncertainty(cell);
    (1..to_perimeter)
        .find_map(|radius| {
            let smallest = RING
                .iter()
                .map(|&(dx, dy)| {
                    // No ring that is looked at leaves the maze.
                    let ring = |at: u32, by: i32| at.saturating_add_signed(by * radius as i32);
                    knowledge.uncertainty(Cell::new(ring(x, dx), ring(y, dy)))
                })
                .min()?;
            (smallest < own).then(|| radius * u32::from(smallest))
        })
        .unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_sdk::Briefing;

    #[test]
    fn the_peak_of_an_unknown_maze() {
        let knowledge = Knowledge::new(&Briefing::contest(12));
        let start = Cell::new(0, 0);
        let peak = |is_scaled| nearest_peak(&knowledge, start, is_scaled, |_| true);
        assert_eq!(peak(false), Some(Cell::new(1, 1)));
        // Three cells from the goal room with its 3 shapes, four from the perimeter.
        assert_eq!(scale(&knowledge, Cell::new(4, 2)), 1);
        assert_eq!(scale(&knowledge, Cell::new(3, 3)), 2 * 3);
        assert_eq!(scale(&knowledge, Cell::new(2, 2)), 1);
        assert_eq!(peak(true), Some(Cell::new(3, 3)));
    }

    #[test]
    fn only_cells_that_can_be_reached() {
        let knowledge = Knowledge::new(&Briefing::contest(12));
        let peak = |is_reached: fn(Cell) -> bool| {
            nearest_peak(&knowledge, Cell::new(11, 0), false, is_reached)
        };
        assert_eq!(peak(|cell| cell.x < 3), Some(Cell::new(2, 1)));
        assert_eq!(peak(|cell| cell.x == 0), Some(Cell::new(0, 1)));
        assert_eq!(peak(|_| false), None);
    }
}
