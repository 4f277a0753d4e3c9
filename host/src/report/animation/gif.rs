//! [`gif()`]: frames as a GIF file.

use std::io::Write;

use gif::{DisposalMethod, Encoder, Frame, Repeat};

use super::error::AnimationError;
use super::frames::{Frames, Timing};
use super::palette::Palette;
use super::patch::Patch;

/// Frames whose colours make the palette of all.
const SAMPLES: usize = 12;

/// Writes the frames as a GIF file that repeats forever. If they have more than 255 colours, rare
/// ones become similar ones.
///
/// # Errors
///
/// When a frame cannot be drawn, the file would be too large or cannot be written, or it was
/// cancelled.
pub fn gif(frames: &Frames<'_>, timing: Timing, out: impl Write) -> Result<(), AnimationError> {
    let first = frames.first()?;
    let side = AnimationError::Side {
        width: first.width(),
        height: first.height(),
    };
    let (Ok(width), Ok(height)) = (u16::try_from(first.width()), u16::try_from(first.height()))
    else {
        return Err(side);
    };
    let mut samples = vec![first];
    let last = frames.count - 1;
    let mut places: Vec<usize> = (1..SAMPLES).map(|it| last * it / (SAMPLES - 1)).collect();
    places.dedup();
    for index in places.into_iter().filter(|&index| index > 0) {
        samples.push((frames.draw)(index)?);
    }
    let mut palette = Palette::of(&samples);
    let mut before = palette.shown(&samples[0]);
    drop(samples);

    let mut encoder = Encoder::new(out, width, height, &palette.table())?;
    encoder.set_repeat(Repeat::Infinite)?;
    let pixels: Vec<Option<[u8; 3]>> = before.pixels().iter().copied().map(Some).collect();
    encoder.write_frame(&Frame {
        delay: timing.of(0, frames.count),
        width,
        height,
        buffer: palette.numbers(&pixels).into(),
        ..Frame::default()
    })?;
    for index in 1..frames.count {
        let after = palette.shown(&frames.next(index)?);
        let patch = Patch::between(&before, &after);
        // All fit, because the whole frame does.
        let [left, top, width, height] =
            [patch.x, patch.y, patch.width, patch.height].map(|it| it as u16);
        encoder.write_frame(&Frame {
            delay: timing.of(index, frames.count),
            dispose: DisposalMethod::Keep,
            transparent: Some(palette.transparent()),
            left,
            top,
            width,
            height,
            buffer: palette.numbers(&patch.pixels).into(),
            ..Frame::default()
        })?;
        before = after;
    }
    (frames.progress)(frames.count);
    encoder.into_inner()?.flush()?;
    Ok(())
}
