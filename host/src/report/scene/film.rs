//! [`Film`]: the frames of an animated picture of matches.

use super::overlays::Overlays;
use super::shot::Shot;
use super::side_by_side::side_by_side;
use crate::report::picture::Theme;
use crate::report::raster::{Image, RasterError, draw};

/// Matches side by side in lockstep, frame by frame. One that has ended waits for the others.
#[derive(Clone, Debug)]
pub struct Film<'a> {
    shots: Vec<Shot<'a>>,
    overlays: Overlays,
    theme: Theme,
    width: u32,
    positions: Vec<usize>,
}

impl<'a> Film<'a> {
    /// A film from one position to another, both included. `every` is how many steps a frame
    /// takes, at least 1; `width` is that of all matches together, in pixels.
    pub fn new(
        shots: Vec<Shot<'a>>,
        overlays: Overlays,
        (first, last): (usize, usize),
        every: usize,
        (theme, width): (Theme, u32),
    ) -> Self {
        let mut positions: Vec<usize> = (first..=last).step_by(every.max(1)).collect();
        if positions.last().is_some_and(|&it| it < last) {
            positions.push(last);
        }
        Self {
            shots,
            overlays,
            theme,
            width,
            positions,
        }
    }

    /// How many frames there are.
    pub const fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there is no frame.
    pub const fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Draws a frame.
    ///
    /// # Errors
    ///
    /// When it would be too large.
    ///
    /// # Panics
    ///
    /// When there is no such frame.
    pub fn frame(&self, index: usize) -> Result<Image, RasterError> {
        let sheet = side_by_side(&self.shots, self.positions[index], &self.overlays);
        draw(&sheet.to_svg(self.theme), self.width)
    }
}
