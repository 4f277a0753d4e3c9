//! From one value per cell to walls, for the formats that state every inner wall twice: once
//! for each of its cells.

use super::super::{Heading, Walls};
use super::{Edge, ParseError};

/// The walls of a maze whose cells have these Udacity values (bit set = open),
/// column by column.
///
/// `dimension` is in range and `values` has its square as length. The error lists all gaps
/// in the perimeter and all cells that disagree.
pub(super) fn walls(dimension: u8, values: &[u8]) -> Result<Walls, ParseError> {
    let mut walls = Walls::closed(dimension);
    let mut invalid = Vec::new();
    for cell in walls.cells() {
        for heading in Heading::ALL {
            let is_open = |cell, side: Heading| values[walls.index(cell)] & side.bit() != 0;
            let open = is_open(cell, heading);
            match walls.neighbor(cell, heading) {
                None if open => invalid.push(Edge::Perimeter { cell, heading }),
                // The other two sides are the neighbours' up and right.
                Some(neighbor) if matches!(heading, Heading::Up | Heading::Right) => {
                    if open != is_open(neighbor, heading.opposite()) {
                        invalid.push(Edge::Disagreement {
                            cell,
                            heading,
                            neighbor,
                            open,
                        });
                    }
                    walls.set(cell, heading, open);
                }
                _ => {}
            }
        }
    }
    if invalid.is_empty() {
        Ok(walls)
    } else {
        Err(ParseError::Edges(invalid))
    }
}
