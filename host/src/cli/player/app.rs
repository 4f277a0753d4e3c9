//! The player as a program for the terminal.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyEventKind};

use super::super::tui::{App, Camera, Flow};
use super::control::Player;
use super::view;

impl Player {
    /// Draws everything into an empty buffer.
    pub fn render(&mut self, buffer: &mut Buffer) {
        view::draw(self, buffer);
    }
}

impl App for Player {
    fn draw(&mut self, buffer: &mut Buffer) {
        self.render(buffer);
    }

    fn event(&mut self, event: &Event) -> Flow {
        match event {
            Event::Key(key) if key.kind != KeyEventKind::Release => return self.key(*key),
            Event::Mouse(mouse) => self.mouse(*mouse),
            _ => {}
        }
        Flow::Go
    }

    fn wait(&self) -> Option<Duration> {
        let moves = self.is_playing && !self.help;
        moves.then(|| self.delay * self.stride())
    }

    fn tick(&mut self) {
        let stride = self.stride() as usize;
        self.position = (self.position + stride).min(self.last());
        self.cameras.iter_mut().for_each(Camera::follow);
        if self.position == self.last() {
            self.is_playing = false;
        }
    }
}
