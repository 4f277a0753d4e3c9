//! [`Shot`]: a match that is drawn.

use wasmouse_core::guest_text;
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::playback::Playback;

use super::caption;
use super::overlays::{Overlays, scene};
use crate::report::picture::Picture;

/// A match that is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Shot<'a> {
    /// The robot, with its variant.
    pub robot: GuestStr<'a>,
    /// The maze.
    pub maze: GuestStr<'a>,
    /// What happened.
    pub playback: &'a Playback,
}

impl Shot<'_> {
    /// The match at a position, without a caption; its title names robot, maze and step.
    pub fn picture(&self, position: usize, overlays: &Overlays) -> Picture {
        let mut picture = scene(self.playback, position, overlays);
        let step = caption::step(self.playback, position);
        picture.set_title(&guest_text!("{} in {}: {}", self.robot, self.maze, step));
        picture
    }
}
