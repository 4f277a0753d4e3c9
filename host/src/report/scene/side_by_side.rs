//! [`side_by_side()`]: several matches at one position.

use super::caption;
use super::overlays::{Overlays, scene};
use super::shot::Shot;
use crate::report::picture::{Caption, Sheet};

/// Matches side by side at one position, with the robot and what it has done below each. The title
/// names the maze; of one match, the line below it does.
pub fn side_by_side(shots: &[Shot<'_>], position: usize, overlays: &Overlays) -> Sheet {
    let title = match shots {
        [first, _, ..] => first.maze,
        _ => "",
    };
    let mut sheet = Sheet::new(title, shots.len());
    for shot in shots {
        let name = match title {
            "" => format!("{} in {}", shot.robot, shot.maze),
            _ => shot.robot.to_owned(),
        };
        let detail = caption::step(shot.playback, position);
        let picture = scene(shot.playback, position, overlays);
        sheet.push(picture, Caption { name, detail });
    }
    sheet
}
