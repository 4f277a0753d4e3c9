//! [`OpenMatch`]: a match that a page has opened.

use wasmouse_core::playback::Playback;

use crate::about::{About, Origin};
use crate::frame::{frame, number, optional};

/// A match that a page has opened, ready for any question about it.
#[derive(Debug)]
pub struct OpenMatch {
    playback: Playback,
    origin: Option<Origin>,
}

impl OpenMatch {
    /// A match, and what its replay file says about it if it comes from one.
    pub const fn new(playback: Playback, origin: Option<Origin>) -> Self {
        Self { playback, origin }
    }

    /// What does not change while it is watched.
    pub fn about(&self) -> About<'_> {
        About::new(&self.playback, self.origin.as_ref())
    }

    /// For each position, the number of the run, x, y and the heading.
    pub fn poses(&self) -> Vec<u8> {
        // A position costs time in proportion to the steps before it, so steps are read instead.
        let maze = self.playback.maze();
        let start = self.playback.at(0);
        let ends = self.playback.trace().steps().iter().map(|it| it.end(maze));
        std::iter::once((start.run, start.cell, start.heading))
            .chain(ends)
            .flat_map(|(run, cell, heading)| [run.number(), cell.x, cell.y, heading as u8])
            .collect()
    }

    /// For each position, new walls and the optimal speed run in steps, optimistic and pessimistic.
    pub fn audit(&self) -> Vec<i32> {
        let steps = self.playback.audit().steps.iter();
        steps
            .flat_map(|it| {
                [
                    number(it.new_walls as usize),
                    optional(it.outlook.optimistic),
                    optional(it.outlook.pessimistic),
                ]
            })
            .collect()
    }

    /// What there is to see at a position.
    ///
    /// # Errors
    ///
    /// When the match has no such position.
    pub fn frame(&self, position: u32) -> Result<Vec<i32>, String> {
        let last = self.playback.last();
        match usize::try_from(position) {
            Ok(position) if position <= last => Ok(frame(&self.playback, position)),
            _ => Err(format!("the match has {last} steps, not {position}")),
        }
    }
}
