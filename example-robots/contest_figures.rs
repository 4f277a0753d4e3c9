//! A robot's figures in the official mazes, for its unit tests.
//!
//! Included with `#[path]` beside `contest_mazes.rs`, by the robots whose figures
//! are pinned.

use wasmouse_sdk::Robot;
use wasmouse_sdk::testing::{self, PlayOptions};

use crate::contest_mazes::contest_mazes;

/// Plays the official mazes that are here: the number of the maze, the variant, and
/// how the match has to go.
pub fn check<R: Robot>(figures: &[(u8, u32, &str)]) {
    let mazes = contest_mazes();
    for &(number, variant, expected) in figures {
        if let Some((_, maze)) = mazes.iter().find(|it| it.0 == number) {
            testing::check::<R>(maze, &PlayOptions::of_variant(variant), expected);
        }
    }
}
