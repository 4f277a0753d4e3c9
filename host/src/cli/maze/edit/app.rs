//! The editor as a program for the terminal.

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyEventKind};

use super::super::super::tui::{App, Flow};
use super::editor::Editor;
use super::view;

impl App for Editor {
    fn draw(&mut self, buffer: &mut Buffer) {
        view::draw(self, buffer);
    }

    fn event(&mut self, event: &Event) -> Flow {
        match event {
            Event::Key(key) if key.kind != KeyEventKind::Release => return self.key(*key),
            Event::Mouse(mouse) => self.mouse(*mouse),
            _ => {}
        }
        Flow::Go
    }
}
