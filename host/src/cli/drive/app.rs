//! The driver as a program for the terminal.

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyEventKind};

use super::super::tui::{App, Flow};
use super::driver::Driver;
use super::view;

impl App for Driver<'_> {
    fn draw(&mut self, buffer: &mut Buffer) {
        view::draw(self, buffer);
    }

    fn event(&mut self, event: &Event) -> Flow {
        match event {
            Event::Key(key) if key.kind != KeyEventKind::Release => self.key(*key),
            _ => Flow::Go,
        }
    }
}
