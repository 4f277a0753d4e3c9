//! [`Editor`]: what keys and the mouse do.

use ratatui::crossterm::event::{
    KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};
use wasmouse_core::maze::{Cell, Heading, Maze};

use super::super::super::tui::{Camera, Flow, Look, Viewport};
use super::board::Board;
use super::facts::Facts;
use super::file::{MazeFile, NotSaved};
use crate::report::text::{Text, text};

/// Which optimal path is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathShown {
    /// None.
    None,
    /// The one with the fewest steps.
    Steps,
    /// The one with the fewest cells.
    Cells,
}

/// A question that has to be answered first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asking {
    /// Whether to quit although the maze was not saved.
    Quit,
    /// Whether to write over what somebody else has written.
    Overwrite,
}

/// A maze in the terminal.
pub struct Editor {
    /// The maze and its history.
    pub board: Board,
    /// Where it is saved.
    pub file: MazeFile,
    /// What follows from the walls as they are.
    pub facts: Facts,
    /// The cell that keys act on.
    pub cursor: Cell,
    /// Which part of the maze is shown.
    pub camera: Camera,
    /// Where the maze was drawn last.
    pub viewport: Option<Viewport>,
    /// Which optimal path is shown.
    pub path: PathShown,
    /// Whether cells have their distance to the goal in them.
    pub numbers: bool,
    /// Whether cells are shaded by their distance to the goal.
    pub heat: bool,
    /// What came of the last key.
    pub message: Option<(Text, bool)>,
    /// The question that has to be answered.
    pub asking: Option<Asking>,
    /// Whether the keys are explained.
    pub help: bool,
    /// Characters and colours.
    pub look: Look,
    /// Whether a drag of the mouse opens or closes walls.
    brush: Option<bool>,
}

impl Editor {
    /// An editor for the maze of a file.
    pub fn new(file: MazeFile, maze: Maze, is_saved: bool, look: Look) -> Self {
        Self {
            facts: Facts::of(&maze),
            cursor: maze.start(),
            board: Board::new(maze, is_saved),
            file,
            camera: Camera::default(),
            viewport: None,
            path: PathShown::Steps,
            numbers: false,
            heat: false,
            message: None,
            asking: None,
            help: false,
            look,
            brush: None,
        }
    }

    /// What a key does.
    pub fn key(&mut self, key: KeyEvent) -> Flow {
        if let Some(asking) = self.asking {
            return self.answer(asking, key);
        }
        if self.help {
            self.help = false;
            return Flow::Go;
        }
        self.message = None;
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        let held = KeyModifiers::CONTROL | KeyModifiers::SHIFT | KeyModifiers::ALT;
        if let Some(side) = arrow(key.code) {
            if key.modifiers.intersects(held) {
                self.toggle(side);
            } else {
                self.go(side);
            }
            return Flow::Go;
        }
        match key.code {
            KeyCode::Char('c' | 'q') if control => return self.quit(),
            KeyCode::Char('s') if control => self.save(false),
            KeyCode::Char('z') if control => self.undo(),
            KeyCode::Char('y' | 'r') if control => self.redo(),
            KeyCode::Char(_) if control => {}
            KeyCode::Char('q') | KeyCode::Esc => return self.quit(),
            KeyCode::F(2) => self.save(false),
            KeyCode::Char('w') => self.toggle(Heading::Up),
            KeyCode::Char('d') => self.toggle(Heading::Right),
            KeyCode::Char('s') => self.toggle(Heading::Down),
            KeyCode::Char('a') => self.toggle(Heading::Left),
            KeyCode::Char('u') => self.undo(),
            KeyCode::Char('r') => self.redo(),
            KeyCode::Char('o') => self.set_all(true),
            KeyCode::Char('c') => self.set_all(false),
            KeyCode::Char('p') => {
                self.path = match self.path {
                    PathShown::None => PathShown::Steps,
                    PathShown::Steps => PathShown::Cells,
                    PathShown::Cells => PathShown::None,
                };
            }
            KeyCode::Char('n') => self.numbers = !self.numbers,
            KeyCode::Char('h') => self.heat = !self.heat,
            KeyCode::Tab | KeyCode::Char('v') => self.next_flagged(),
            KeyCode::Home => self.cursor = self.board.maze().start(),
            KeyCode::End => self.cursor = self.board.maze().goal().origin(),
            KeyCode::Char('+' | '=') => self.zoom(true),
            KeyCode::Char('-') => self.zoom(false),
            KeyCode::Char('0') => self.camera.reset(),
            KeyCode::Char('?') | KeyCode::F(1) => self.help = true,
            _ => {}
        }
        Flow::Go
    }

    fn answer(&mut self, asking: Asking, key: KeyEvent) -> Flow {
        let control = key.modifiers.contains(KeyModifiers::CONTROL);
        match (asking, key.code) {
            (Asking::Quit, KeyCode::Char('s')) => {
                self.asking = None;
                self.save(false);
                if self.asking.is_none() && !self.board.is_modified() {
                    return Flow::End;
                }
            }
            // Whoever presses Ctrl-C twice wants to leave.
            (Asking::Quit, KeyCode::Char('c')) if control => return Flow::End,
            (Asking::Quit, KeyCode::Char('y')) => return Flow::End,
            (Asking::Overwrite, KeyCode::Char('y')) => {
                self.asking = None;
                self.save(true);
            }
            (_, KeyCode::Char('n' | 'q' | 'c') | KeyCode::Esc) => self.asking = None,
            _ => {}
        }
        Flow::Go
    }

    /// What the mouse does.
    pub fn mouse(&mut self, mouse: MouseEvent) {
        if self.asking.is_some() || self.help {
            return;
        }
        let hit = || self.viewport?.hit(mouse.column, mouse.row);
        match mouse.kind {
            MouseEventKind::Down(MouseButton::Left) => {
                self.message = None;
                self.brush = None;
                let Some(hit) = hit() else { return };
                self.cursor = hit.cell;
                if let Some(side) = hit.side {
                    let open = !self.board.maze().walls().is_open(hit.cell, side);
                    self.brush = Some(open);
                    self.set(hit.cell, side, open, false);
                }
            }
            MouseEventKind::Drag(MouseButton::Left) => {
                let Some(hit) = hit() else { return };
                if let (Some(open), Some(side)) = (self.brush, hit.side) {
                    self.set(hit.cell, side, open, true);
                }
            }
            MouseEventKind::Up(_) => self.brush = None,
            MouseEventKind::ScrollUp => self.camera.shift(0, 1),
            MouseEventKind::ScrollDown => self.camera.shift(0, -1),
            MouseEventKind::ScrollLeft => self.camera.shift(-1, 0),
            MouseEventKind::ScrollRight => self.camera.shift(1, 0),
            _ => {}
        }
    }

    fn go(&mut self, side: Heading) {
        self.camera.follow();
        if let Some(next) = self.board.maze().walls().neighbor(self.cursor, side) {
            self.cursor = next;
        }
    }

    fn toggle(&mut self, side: Heading) {
        self.camera.follow();
        let open = !self.board.maze().walls().is_open(self.cursor, side);
        self.set(self.cursor, side, open, false);
    }

    fn set(&mut self, cell: Cell, side: Heading, open: bool, joined: bool) {
        if self.board.set(&[(cell, side)], open, joined) {
            self.update();
        } else if !self.board.is_inner((cell, side)) {
            self.message = Some((text!("the outer wall stays closed"), true));
        }
    }

    fn set_all(&mut self, open: bool) {
        let around = Heading::ALL.map(|side| (self.cursor, side));
        if self.board.set(&around, open, false) {
            self.update();
        }
    }

    fn undo(&mut self) {
        if self.board.undo() {
            self.update();
        } else {
            self.message = Some((text!("nothing to undo"), false));
        }
    }

    fn redo(&mut self) {
        if self.board.redo() {
            self.update();
        } else {
            self.message = Some((text!("nothing to redo"), false));
        }
    }

    fn update(&mut self) {
        self.facts = Facts::of(self.board.maze());
    }

    fn next_flagged(&mut self) {
        let mut cells: Vec<Cell> = self.facts.broken.iter().flat_map(|it| it.cells()).collect();
        cells.sort_unstable();
        let later = cells.iter().find(|&&cell| cell > self.cursor);
        match later.or(cells.first()) {
            Some(&cell) => {
                self.camera.follow();
                self.cursor = cell;
            }
            None => self.message = Some((text!("no cell breaks a rule"), false)),
        }
    }

    fn zoom(&mut self, larger: bool) {
        if let Some(view) = self.viewport {
            self.camera.zoom(view.zoom, larger);
        }
    }

    fn save(&mut self, anyway: bool) {
        match self.file.save(self.board.maze(), anyway) {
            Ok(()) => {
                self.board.set_saved();
                let path = Text::of_path(self.file.path());
                self.message = Some((text!("wrote {}", path), false));
            }
            Err(NotSaved::Changed) => self.asking = Some(Asking::Overwrite),
            Err(NotSaved::Failed(failure)) => {
                self.message = Some((text!("not saved: {}", failure.message()), true));
            }
        }
    }

    fn quit(&mut self) -> Flow {
        if !self.board.is_modified() {
            return Flow::End;
        }
        self.asking = Some(Asking::Quit);
        Flow::Go
    }
}

/// The direction of an arrow key, also of those that some prefer.
const fn arrow(code: KeyCode) -> Option<Heading> {
    match code {
        KeyCode::Up => Some(Heading::Up),
        KeyCode::Right => Some(Heading::Right),
        KeyCode::Down => Some(Heading::Down),
        KeyCode::Left => Some(Heading::Left),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use wasmouse_core::maze::format::{self, Format};
    use wasmouse_core::maze::{Walls, bundled};

    use super::super::super::super::tui::testing::{press, screen_of};
    use super::*;
    use crate::report::picture::Charset;

    const PLAIN: Look = Look {
        charset: Charset::Unicode,
        color: false,
    };

    /// An editor of the first official maze, in a folder of its own.
    fn editor() -> (tempfile::TempDir, Editor) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("maze.txt");
        fs::write(&path, bundled()[0].text).expect("a file");
        let (file, maze) = MazeFile::open(&path).expect("a maze");
        (folder, Editor::new(file, maze, true, PLAIN))
    }

    fn walls(editor: &Editor) -> &Walls {
        editor.board.maze().walls()
    }

    #[test]
    fn keys_move_and_toggle_walls() {
        let (_folder, mut editor) = editor();
        assert_eq!(press(&mut editor, "<right><up><up><left>"), Flow::Go);
        assert_eq!(editor.cursor, Cell::new(0, 2));
        let before = walls(&editor).value(editor.cursor);
        press(&mut editor, "w<shift-right>");
        assert_eq!(walls(&editor).value(editor.cursor), before ^ 0b0011);
        press(&mut editor, "a");
        assert!(editor.message.take().expect("a message").1, "the perimeter");
        press(&mut editor, "u<ctrl-z>");
        assert_eq!(walls(&editor).value(editor.cursor), before);
        press(&mut editor, "r");
        assert_eq!(walls(&editor).value(editor.cursor), before ^ 1);
        press(&mut editor, "o");
        assert_eq!(walls(&editor).value(editor.cursor), 0b0111);
        press(&mut editor, "c");
        assert_eq!(walls(&editor).value(editor.cursor), 0);
    }

    #[test]
    fn the_mouse_toggles_the_wall_that_it_points_at() {
        let (_folder, mut editor) = editor();
        screen_of(&mut editor, 80, 24);
        let view = editor.viewport.expect("it was drawn");
        let mouse = |editor: &mut Editor, kind, column, row| {
            editor.mouse(MouseEvent {
                kind,
                column,
                row,
                modifiers: KeyModifiers::NONE,
            });
        };
        let places: Vec<(u16, u16)> = (0..24).flat_map(|y| (0..80).map(move |x| (x, y))).collect();
        let place = |cell, side| {
            let wanted = |&&(x, y): &&(u16, u16)| {
                view.hit(x, y)
                    .is_some_and(|hit| hit.cell == cell && hit.side == Some(side))
            };
            *places.iter().find(wanted).expect("a place of the wall")
        };
        let before = editor.board.maze().clone();
        let (cell, above) = (Cell::new(3, 3), Cell::new(3, 4));
        let open = walls(&editor).is_open(cell, Heading::Right);
        let (x, y) = place(cell, Heading::Right);
        let button = MouseButton::Left;
        mouse(&mut editor, MouseEventKind::Down(button), x, y);
        assert_eq!(walls(&editor).is_open(cell, Heading::Right), !open);
        let (x, y) = place(above, Heading::Right);
        mouse(&mut editor, MouseEventKind::Drag(button), x, y);
        assert_eq!(walls(&editor).is_open(above, Heading::Right), !open);
        mouse(&mut editor, MouseEventKind::Up(button), x, y);
        let (x, y) = place(cell, Heading::Right);
        mouse(&mut editor, MouseEventKind::Drag(button), x, y);
        press(&mut editor, "u");
        assert_eq!(*editor.board.maze(), before, "the drag is one change");
        mouse(&mut editor, MouseEventKind::Down(button), 79, 23);
        assert_eq!(*editor.board.maze(), before, "nothing is there");
    }

    #[test]
    fn saving_writes_the_file_and_quitting_asks() {
        let (folder, mut editor) = editor();
        let path = folder.path().join("maze.txt");
        assert_eq!(press(&mut editor, "q"), Flow::End, "nothing to lose");
        press(&mut editor, "d");
        assert_eq!(press(&mut editor, "q"), Flow::Go);
        assert_eq!(editor.asking, Some(Asking::Quit));
        assert_eq!(press(&mut editor, "n"), Flow::Go);
        assert_eq!(editor.asking, None);
        assert_eq!(press(&mut editor, "<ctrl-c>y"), Flow::End);
        assert_eq!(
            fs::read_to_string(&path).expect("a file"),
            bundled()[0].text
        );
        editor.asking = None;
        assert_eq!(press(&mut editor, "<ctrl-c>s"), Flow::End);
        let saved = format::parse(&fs::read_to_string(&path).expect("a file")).expect("a maze");
        assert_eq!(&saved.maze, editor.board.maze());
        assert_eq!(saved.format, Format::Udacity);
        assert_eq!(press(&mut editor, "<esc>"), Flow::End);
    }

    #[test]
    fn a_failed_save_keeps_editor_and_file() {
        let (folder, mut editor) = editor();
        let path = folder.path().join("maze.txt");
        fs::write(&path, "changed").expect("a file");
        press(&mut editor, "d<ctrl-s>");
        assert_eq!(editor.asking, Some(Asking::Overwrite));
        press(&mut editor, "n");
        assert_eq!(fs::read(&path).expect("a file"), b"changed");
        assert!(editor.board.is_modified());
        fs::remove_file(&path).expect("a file");
        fs::create_dir(&path).expect("a folder in its place");
        press(&mut editor, "<ctrl-s>y");
        let (message, is_bad) = editor.message.clone().expect("a message");
        assert!(is_bad && message.as_str().starts_with("not saved: failed to write"));
        assert!(editor.board.is_modified());
        assert_eq!(press(&mut editor, "qs"), Flow::Go, "it must not be lost");
    }

    #[test]
    fn tab_goes_to_the_cells_that_break_rules() {
        let (_folder, mut editor) = editor();
        press(&mut editor, "<tab>");
        assert_eq!(editor.message.as_ref().map(|it| it.1), Some(false));
        press(&mut editor, "<end>");
        let goal = editor.cursor;
        press(&mut editor, "d<home><tab>");
        assert_eq!(editor.cursor, goal);
    }
}
