//! [`sequence`]: moments of one match in a grid, as in the report of Lobato.

use wasmouse_core::guest_text;

use super::caption;
use super::overlays::{Overlays, scene};
use super::shot::Shot;
use crate::report::picture::{Caption, Sheet};

/// Moments of a sequence, at most.
pub const SEQUENCE_MAX: usize = 100;

/// Moments of a match between two positions, both included and the others as evenly between them as
/// can be. Fewer than `count` if there are not so many. In rows of up to five.
pub fn sequence(
    shot: &Shot<'_>,
    count: usize,
    (first, last): (usize, usize),
    overlays: &Overlays,
) -> Sheet {
    let positions = positions(count.min(SEQUENCE_MAX), first, last);
    let columns = columns(positions.len());
    let mut sheet = Sheet::new(&guest_text!("{} in {}", shot.robot, shot.maze), columns);
    for position in positions {
        let caption = Caption {
            name: caption::step(shot.playback, position).into(),
            detail: String::new(),
        };
        sheet.push(scene(shot.playback, position, overlays), caption);
    }
    sheet
}

fn positions(count: usize, first: usize, last: usize) -> Vec<usize> {
    let gaps = count.saturating_sub(1).max(1);
    let length = last.saturating_sub(first);
    let mut positions: Vec<usize> = (0..count.max(1))
        .map(|it| first + length * it / gaps)
        .collect();
    positions.dedup();
    positions
}

/// The columns of a grid that is a little wider than high.
pub(super) fn columns(count: usize) -> usize {
    match count {
        0..=3 => count.max(1),
        4 => 2,
        5..=9 => 3,
        10..=16 => 4,
        _ => 5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_even_and_include_both_ends() {
        assert_eq!(positions(5, 0, 100), [0, 25, 50, 75, 100]);
        assert_eq!(positions(4, 10, 12), [10, 11, 12]);
        assert_eq!(positions(1, 3, 9), [3]);
        assert_eq!(positions(6, 7, 7), [7]);
    }
}
