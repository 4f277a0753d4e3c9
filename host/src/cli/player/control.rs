//! [`Player`]: the position in the matches, and what keys and time do to it.

use std::time::Duration;

use ratatui::crossterm::event::{
    KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};
use ratatui::layout::Rect;

use super::super::tui::{Camera, Flow, Look, Zoom};
use super::show::Show;

/// Which mazes are shown of each match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// The true maze, and beside it what the robot could know.
    Both,
    /// The true maze.
    Maze,
    /// What the robot could know, or says that it believes.
    Mind,
}

/// What is drawn into the mazes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overlays {
    /// The mazes.
    pub sides: Sides,
    /// The robot's own beliefs about walls instead of what its readings show.
    pub beliefs: bool,
    /// How often the robot was in each cell.
    pub heat: bool,
    /// The best path: in the true maze, and if no unknown wall is there.
    pub path: bool,
    /// Steps to the goal.
    pub numbers: bool,
    /// The robot's colours and labels.
    pub paint: bool,
}

/// The shortest time between two pictures.
const FRAME: Duration = Duration::from_millis(33);

/// The limits of the time for a step.
const DELAYS: std::ops::RangeInclusive<Duration> =
    Duration::from_micros(500)..=Duration::from_secs(8);

/// Mazes on the screen, at most.
pub const MAZES_MAX: usize = 8;

/// Steps that a page has.
const PAGE: usize = 50;

/// One match, or several in lockstep, at a position.
///
/// ```no_run
/// # fn shows() -> Vec<wasmouse::cli::player::Show> { Vec::new() }
/// use ratatui::{buffer::Buffer, layout::Rect};
/// let mut player = wasmouse::cli::player::Player::new(shows(), true);
/// player.seek(212);
/// let mut buffer = Buffer::empty(Rect::new(0, 0, 80, 24));
/// player.render(&mut buffer);
/// ```
pub struct Player {
    pub(super) shows: Vec<Show>,
    /// Steps that have been played. A match that is over by then stays at its end.
    pub(super) position: usize,
    pub(super) is_playing: bool,
    pub(super) delay: Duration,
    pub(super) overlays: Overlays,
    pub(super) help: bool,
    pub(super) look: Look,
    /// One for each maze on the screen.
    pub(super) cameras: [Camera; MAZES_MAX],
    /// The size of the cells that were drawn last.
    pub(super) zoom: Zoom,
    /// Where the timeline was drawn last.
    pub(super) timeline: Rect,
}

impl Player {
    /// A player of these matches, in Unicode, with colours or without.
    pub fn new(shows: Vec<Show>, color: bool) -> Self {
        let look = Look {
            charset: crate::report::picture::Charset::Unicode,
            color,
        };
        Self::with_look(shows, look)
    }

    pub(super) fn with_look(shows: Vec<Show>, look: Look) -> Self {
        // There is room for one maze of several robots, more often than not.
        let sides = if shows.len() > 1 {
            Sides::Maze
        } else {
            Sides::Both
        };
        Self {
            shows,
            position: 0,
            is_playing: false,
            delay: Duration::from_millis(120),
            overlays: Overlays {
                sides,
                beliefs: false,
                heat: false,
                path: true,
                numbers: false,
                paint: true,
            },
            help: false,
            look,
            cameras: [Camera::default(); MAZES_MAX],
            zoom: Zoom::Small,
            timeline: Rect::default(),
        }
    }

    /// Goes to a position, or to the end if there are fewer steps.
    pub fn seek(&mut self, position: usize) {
        self.position = position.min(self.last());
        self.cameras.iter_mut().for_each(Camera::follow);
    }

    /// The last position of the longest match.
    pub(super) fn last(&self) -> usize {
        self.shows.iter().map(Show::last).max().unwrap_or(0)
    }

    pub(super) fn key(&mut self, key: KeyEvent) -> Flow {
        if self.help {
            self.help = false;
            return Flow::Go;
        }
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        let shift = key.modifiers.contains(KeyModifiers::SHIFT);
        match key.code {
            KeyCode::Char('c') if control => return Flow::End,
            KeyCode::Left if control => self.shift(-1, 0),
            KeyCode::Right if control => self.shift(1, 0),
            KeyCode::Up if control => self.shift(0, 1),
            KeyCode::Down if control => self.shift(0, -1),
            KeyCode::Char(_) if control => {}
            KeyCode::Char('q') | KeyCode::Esc => return Flow::End,
            KeyCode::Char(' ') => self.play_or_pause(),
            KeyCode::Right if shift => self.go(10),
            KeyCode::Left if shift => self.go(-10),
            KeyCode::Right | KeyCode::Char('l') => self.go(1),
            KeyCode::Left | KeyCode::Char('h') => self.go(-1),
            KeyCode::PageDown => self.go(PAGE.cast_signed()),
            KeyCode::PageUp => self.go(-PAGE.cast_signed()),
            KeyCode::Home => self.go(isize::MIN),
            KeyCode::End => self.go(isize::MAX),
            KeyCode::Char(digit @ '0'..='9') => {
                let tenths = digit.to_digit(10).unwrap_or(0) as usize;
                self.is_playing = false;
                self.seek(self.last() * tenths / 10);
            }
            KeyCode::Char('n') | KeyCode::Tab => self.jump(true),
            KeyCode::Char('p') | KeyCode::BackTab => self.jump(false),
            KeyCode::Up | KeyCode::Char('+' | '=') => self.set_delay(self.delay / 2),
            KeyCode::Down | KeyCode::Char('-') => self.set_delay(self.delay * 2),
            KeyCode::Char('?') | KeyCode::F(1) => self.help = true,
            KeyCode::Char(key) => self.switch(key),
            _ => {}
        }
        Flow::Go
    }

    /// Switches what is shown.
    fn switch(&mut self, key: char) {
        let overlays = &mut self.overlays;
        match key {
            'm' => {
                overlays.sides = match overlays.sides {
                    Sides::Both => Sides::Maze,
                    Sides::Maze => Sides::Mind,
                    Sides::Mind => Sides::Both,
                };
            }
            'b' => overlays.beliefs = !overlays.beliefs,
            'v' => overlays.heat = !overlays.heat,
            'o' => overlays.path = !overlays.path,
            'd' => overlays.numbers = !overlays.numbers,
            'c' => overlays.paint = !overlays.paint,
            'z' => self.zoom(true),
            'Z' => self.zoom(false),
            'x' => self.cameras.iter_mut().for_each(Camera::reset),
            _ => {}
        }
    }

    fn shift(&mut self, right: i16, up: i16) {
        for camera in &mut self.cameras {
            camera.shift(right, up);
        }
    }

    fn zoom(&mut self, larger: bool) {
        for camera in &mut self.cameras {
            camera.zoom(self.zoom, larger);
        }
    }

    fn play_or_pause(&mut self) {
        if !self.is_playing && self.position == self.last() {
            self.seek(0);
        }
        self.is_playing = !self.is_playing;
    }

    fn go(&mut self, steps: isize) {
        self.is_playing = false;
        self.seek(self.position.saturating_add_signed(steps));
    }

    /// Goes to the next milestone of any match, or to the one before.
    fn jump(&mut self, forwards: bool) {
        self.is_playing = false;
        let marks = self.shows.iter().flat_map(|show| &show.marks);
        let positions = marks.map(|&(position, _)| position);
        let to = if forwards {
            positions.filter(|&it| it > self.position).min()
        } else {
            positions.filter(|&it| it < self.position).max()
        };
        let otherwise = if forwards { self.last() } else { 0 };
        self.seek(to.unwrap_or(otherwise));
    }

    pub(super) fn set_delay(&mut self, delay: Duration) {
        self.delay = delay.clamp(*DELAYS.start(), *DELAYS.end());
    }

    pub(super) fn mouse(&mut self, mouse: MouseEvent) {
        if self.help {
            return;
        }
        let button = MouseButton::Left;
        match mouse.kind {
            MouseEventKind::Down(pressed) | MouseEventKind::Drag(pressed) if pressed == button => {
                let line = self.timeline;
                let row = line.y == mouse.row && line.width > 1;
                if row && (line.x..line.right()).contains(&mouse.column) {
                    self.is_playing = false;
                    let part = usize::from(mouse.column - line.x);
                    let parts = usize::from(line.width - 1);
                    self.seek((self.last() * part + parts / 2) / parts);
                }
            }
            MouseEventKind::ScrollDown => self.go(1),
            MouseEventKind::ScrollUp => self.go(-1),
            _ => {}
        }
    }

    /// Steps from one picture to the next while it plays: several where they are shorter than a
    /// picture.
    pub(super) fn stride(&self) -> u32 {
        let strides = FRAME.as_micros().div_ceil(self.delay.as_micros().max(1));
        if self.delay >= FRAME {
            1
        } else {
            u32::try_from(strides).unwrap_or(1)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::tui::App as _;
    use super::super::super::tui::testing::{buffer_of, press};
    use super::super::show::tests::{explorer, lost};
    use super::*;

    fn player() -> Player {
        Player::new(vec![explorer()], false)
    }

    #[test]
    fn keys_seek() {
        let mut player = player();
        let last = player.last();
        assert!(last > 60, "{last}");
        for (keys, position) in [
            ("<right>", 1),
            ("l<right>", 3),
            ("<left>h", 1),
            ("<left><left>", 0),
            ("<shift-right>", 10),
            ("<pagedown>", 60),
            ("<pageup><shift-left>", 0),
            ("<end>", last),
            ("<right>", last),
            ("5", last / 2),
            ("0", 0),
            ("9", last * 9 / 10),
            ("<home>", 0),
        ] {
            assert_eq!(press(&mut player, keys), Flow::Go);
            assert_eq!(player.position, position, "after {keys}");
        }
        for keys in ["q", "<esc>", "<ctrl-c>"] {
            assert_eq!(press(&mut player, keys), Flow::End);
        }
    }

    #[test]
    fn milestones_are_jumped_to() {
        let mut player = player();
        let marks = player.shows[0].marks.clone();
        let mut positions: Vec<usize> = marks.iter().map(|it| it.0).collect();
        positions.dedup();
        let mut seen = Vec::new();
        while player.position < player.last() {
            press(&mut player, "n");
            seen.push(player.position);
        }
        assert_eq!(seen, positions);
        while player.position > positions[0] {
            press(&mut player, "p");
            assert_eq!(Some(player.position), {
                seen.pop();
                seen.last().copied()
            });
        }
    }

    #[test]
    fn it_plays_until_the_end_and_again() {
        let mut player = player();
        assert_eq!(player.wait(), None);
        press(&mut player, " ");
        let delay = player.wait().expect("it plays");
        assert_eq!(delay, Duration::from_millis(120));
        player.tick();
        assert_eq!(player.position, 1);
        press(&mut player, "+");
        assert_eq!(player.wait(), Some(delay / 2));
        press(&mut player, "++++");
        let wait = player.wait().expect("it plays");
        assert!(wait >= FRAME && wait < FRAME * 2, "{wait:?}");
        player.tick();
        assert!(player.position > 4, "several steps for each picture");
        while player.wait().is_some() {
            player.tick();
        }
        assert_eq!(player.position, player.last());
        press(&mut player, " ");
        assert_eq!((player.position, player.is_playing), (0, true));
        press(&mut player, "<right>");
        assert!(!player.is_playing, "a step pauses");
        press(&mut player, "------------------------");
        assert_eq!(player.delay, *DELAYS.end());
        press(&mut player, "++++++++++++++++++++++++");
        assert_eq!(player.delay, *DELAYS.start());
    }

    #[test]
    fn overlays_are_switched() {
        let mut player = player();
        let before = player.overlays;
        press(&mut player, "m");
        assert_eq!(player.overlays.sides, Sides::Maze);
        press(&mut player, "bvodc");
        let now = player.overlays;
        assert!(now.beliefs && now.heat && !now.path && now.numbers && !now.paint);
        press(&mut player, "mmbvodc");
        assert_eq!(player.overlays, before);
        press(&mut player, "?q");
        assert!(!player.help, "any key closes the help");
    }

    #[test]
    fn the_timeline_can_be_clicked() {
        let mut player = player();
        buffer_of(&mut player, 80, 24);
        let line = player.timeline;
        let click = |player: &mut Player, column| {
            player.mouse(MouseEvent {
                kind: MouseEventKind::Down(MouseButton::Left),
                column,
                row: line.y,
                modifiers: KeyModifiers::NONE,
            });
        };
        click(&mut player, line.right() - 1);
        assert_eq!(player.position, player.last());
        click(&mut player, line.x);
        assert_eq!(player.position, 0);
        click(&mut player, line.right());
        assert_eq!(player.position, 0);
    }

    #[test]
    fn matches_of_different_lengths_play_in_lockstep() {
        let (short, long) = (explorer(), lost());
        let (end, last) = (short.last(), long.last());
        let mut player = Player::new(vec![short, long], false);
        assert!(end < last);
        press(&mut player, "<end>");
        assert_eq!(player.position, last);
    }
}
