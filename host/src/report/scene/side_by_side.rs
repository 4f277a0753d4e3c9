//! [`side_by_side()`]: several matches at one position.

use wasmouse_core::guest_text;
use wasmouse_core::guest_text::GuestStr;

use super::caption;
use super::overlays::{Overlays, scene};
use super::shot::Shot;
use crate::report::picture::{Caption, Sheet};

/// Matches side by side at one position, with the robot and what it has done below each. The title
/// names the maze; of one match, the line below it does.
pub fn side_by_side(shots: &[Shot<'_>], position: usize, overlays: &Overlays) -> Sheet {
    let title = match shots {
        [first, _, ..] => first.maze,
        _ => GuestStr::default(),
    };
    let mut sheet = Sheet::new(title, shots.len());
    for shot in shots {
        let name = if title.is_empty() {
            guest_text!("{} in {}", shot.robot, shot.maze)
        } else {
            shot.robot.into()
        };
        let detail = caption::step(shot.playback, position);
        let picture = scene(shot.playback, position, overlays);
        sheet.push(picture, Caption { name, detail });
    }
    sheet
}
