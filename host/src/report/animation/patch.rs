//! [`Patch`]: what differs between two frames.

use crate::report::raster::Image;

/// The smallest rectangle around all pixels that differ, as pixels of the later frame; `None` is
/// one that stays.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Patch {
    pub(super) x: u32,
    pub(super) y: u32,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: Vec<Option<[u8; 3]>>,
}

impl Patch {
    /// What has to be painted over `before` to make `after` of it. One pixel if nothing differs,
    /// because no format has empty frames.
    pub(super) fn between(before: &Image, after: &Image) -> Self {
        let (width, height) = (after.width(), after.height());
        let differs = |y: u32| before.row(0, y, width) != after.row(0, y, width);
        let Some(top) = (0..height).find(|&y| differs(y)) else {
            return Self {
                x: 0,
                y: 0,
                width: 1,
                height: 1,
                pixels: vec![None],
            };
        };
        let bottom = (top..height).rfind(|&y| differs(y)).unwrap_or(top);
        let (mut left, mut right) = (width, 0);
        for y in (top..=bottom).filter(|&y| differs(y)) {
            let (old, new) = (before.row(0, y, width), after.row(0, y, width));
            let pairs = || old.iter().zip(new);
            let first = pairs().position(|(old, new)| old != new);
            let last = pairs().rposition(|(old, new)| old != new);
            if let Some((first, last)) = first.zip(last) {
                left = left.min(first as u32);
                right = right.max(last as u32);
            }
        }
        let (width, height) = (right - left + 1, bottom - top + 1);
        let pixels = (top..=bottom).flat_map(|y| {
            let rows = before
                .row(left, y, width)
                .iter()
                .zip(after.row(left, y, width));
            rows.map(|(old, new)| (old != new).then_some(*new))
        });
        Self {
            x: left,
            y: top,
            width,
            height,
            pixels: pixels.collect(),
        }
    }
}
