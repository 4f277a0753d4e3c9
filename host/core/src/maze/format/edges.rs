//! From one value per cell to walls, for the formats that state every inner
//! wall twice, once for each of its cells.

use super::super::{Cell, Heading, Walls};
use super::{Edge, ParseError};

/// The walls of a maze whose cells have these Udacity values (bit set = open),
/// column by column.
///
/// Refuses gaps in the perimeter and cells that disagree, and names all of them
/// at once. `dimension` is in range and `values` has its square as length.
pub(super) fn walls(dimension: u8, values: &[u8]) -> Result<Walls, ParseError> {
    let mut walls = Walls::closed(dimension);
    let mut wrong = Vec::new();
    let cells: Vec<Cell> = walls.cells().collect();
    for &cell in &cells {
        let open = |cell, heading: Heading| values[walls.index(cell)] & heading.bit() != 0;
        for heading in Heading::ALL {
            let here = open(cell, heading);
            match walls.neighbor(cell, heading) {
                None if here => wrong.push(Edge::Perimeter { cell, heading }),
                // The other two sides are the neighbours' up and right.
                Some(neighbor)
                    if matches!(heading, Heading::Up | Heading::Right)
                        && here != open(neighbor, heading.opposite()) =>
                {
                    wrong.push(Edge::Disagreement {
                        cell,
                        heading,
                        neighbor,
                        open: here,
                    });
                }
                _ => {}
            }
        }
    }
    if !wrong.is_empty() {
        return Err(ParseError::Edges(wrong));
    }
    for &cell in &cells {
        for heading in [Heading::Up, Heading::Right] {
            let open = values[walls.index(cell)] & heading.bit() != 0;
            walls.set(cell, heading, open);
        }
    }
    Ok(walls)
}
