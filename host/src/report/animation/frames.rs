//! [`Frames`]: where frames come from.

use super::error::{AnimationError, PIXELS_MAX};
use crate::report::raster::{Image, RasterError};

/// How long frames are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Each but the last, in hundredths of a second. Browsers show less than 2 as 10.
    pub delay: u16,
    /// The last one, in hundredths of a second.
    pub hold: u16,
}

/// Where frames come from, and who wants to know how far they are.
pub struct Frames<'a> {
    /// How many there are.
    pub count: usize,
    /// Draws one of them. All have the same size.
    pub draw: &'a dyn Fn(usize) -> Result<Image, RasterError>,
    /// Called with the number of frames that were written; `false` cancels.
    pub progress: &'a dyn Fn(usize) -> bool,
}

impl Frames<'_> {
    /// The first frame, after which it is known that all of them together are not too large.
    pub(super) fn first(&self) -> Result<Image, AnimationError> {
        if self.count == 0 {
            return Err(AnimationError::Empty);
        }
        let first = (self.draw)(0)?;
        let pixels = first.pixels().len() as u64;
        if pixels.saturating_mul(self.count as u64) > PIXELS_MAX {
            return Err(AnimationError::TooLarge {
                frames: self.count,
                width: first.width(),
                height: first.height(),
            });
        }
        Ok(first)
    }

    /// A frame after the first.
    pub(super) fn next(&self, index: usize) -> Result<Image, AnimationError> {
        if (self.progress)(index) {
            Ok((self.draw)(index)?)
        } else {
            Err(AnimationError::Cancelled)
        }
    }
}

impl Timing {
    /// How long a frame of that many is shown.
    pub(super) const fn of(self, index: usize, count: usize) -> u16 {
        if index + 1 == count {
            self.hold
        } else {
            self.delay
        }
    }
}
