//! [`App`]: a program that fills the terminal.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::Event;

/// Whether a program goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// It does.
    Go,
    /// It ends.
    End,
}

/// A program that fills the terminal: it knows nothing of the terminal but cells and events.
pub trait App {
    /// Draws everything into an empty buffer of any size.
    fn draw(&mut self, buffer: &mut Buffer);

    /// Handles a key, the mouse, or a new size.
    fn event(&mut self, event: &Event) -> Flow;

    /// The time until the next [`App::tick`]; `None` if nothing moves by itself.
    fn wait(&self) -> Option<Duration> {
        None
    }

    /// Goes on by itself.
    fn tick(&mut self) {}
}
