//! What the commands share that fill the terminal: the player, `drive` and `maze edit`.
//!
//! [`Screen`] is the terminal, and the only thing here that touches it. Everything else writes
//! into a buffer of cells, which tests read. A program for the terminal is an [`App`]: it draws
//! itself and handles events, so keys are tested without a terminal.

mod app;
mod camera;
mod glyphs;
mod keyboard;
mod lines;
mod look;
mod maze_view;
mod plain;
mod scene;
mod screen;
#[cfg(test)]
pub mod testing;

pub use app::{App, Flow};
pub use camera::{Camera, Viewport, Zoom};
pub use lines::{Writer, overlay};
pub use look::{Look, Role};
pub use maze_view::draw_maze;
pub use scene::Scene;
pub use screen::run;
