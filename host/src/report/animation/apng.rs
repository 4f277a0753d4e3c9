//! [`apng()`]: frames as an animated PNG file.

use std::io::Write;

use png::{BitDepth, BlendOp, ColorType, DisposeOp, Encoder};

use super::error::AnimationError;
use super::frames::{Frames, Timing};
use super::patch::Patch;

/// What delays are fractions of.
const HUNDREDTHS: u16 = 100;

/// Writes the frames as an animated PNG file that repeats forever, with exact colours. Programs
/// that do not know animated ones show the first frame.
///
/// # Errors
///
/// When a frame cannot be drawn, the file would be too large or cannot be written, or it was
/// cancelled.
pub fn apng(frames: &Frames<'_>, timing: Timing, out: impl Write) -> Result<(), AnimationError> {
    let mut before = frames.first()?;
    let mut encoder = Encoder::new(out, before.width(), before.height());
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_animated(u32::try_from(frames.count).unwrap_or(u32::MAX), 0)?;
    encoder.set_dispose_op(DisposeOp::None)?;
    encoder.set_blend_op(BlendOp::Over)?;
    encoder.set_frame_delay(timing.of(0, frames.count), HUNDREDTHS)?;
    let mut writer = encoder.write_header()?;
    let first: Vec<Option<[u8; 3]>> = before.pixels().iter().copied().map(Some).collect();
    writer.write_image_data(&rgba(&first))?;
    for index in 1..frames.count {
        let after = frames.next(index)?;
        let patch = Patch::between(&before, &after);
        // Position 0 first: until both are set, the rectangle has to fit.
        writer.reset_frame_position()?;
        writer.set_frame_dimension(patch.width, patch.height)?;
        writer.set_frame_position(patch.x, patch.y)?;
        writer.set_frame_delay(timing.of(index, frames.count), HUNDREDTHS)?;
        writer.write_image_data(&rgba(&patch.pixels))?;
        before = after;
    }
    (frames.progress)(frames.count);
    writer.finish()?;
    Ok(())
}

/// Opaque pixels, and transparent ones where there is no colour.
fn rgba(pixels: &[Option<[u8; 3]>]) -> Vec<u8> {
    let pixels = pixels.iter();
    let bytes =
        pixels.flat_map(|it| it.map_or([0; 4], |[red, green, blue]| [red, green, blue, 255]));
    bytes.collect()
}
