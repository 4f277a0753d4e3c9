//! What the editor draws: the maze, and beside or below it what is known about it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use wasmouse_core::maze::{Distances, Heading, Metric, Path, distances_to_goal};

use super::super::super::tui::{Role, Scene, Writer, Zoom, draw_maze, overlay};
use super::editor::{Asking, Editor, PathShown};
use crate::report::number::counted;
use crate::report::text::{Text, text};

/// Columns of the panel beside the maze, at least.
const PANEL_WIDTH: u16 = 36;

/// Rows of the panel below the maze, where there is no room beside it.
const PANEL_HEIGHT: u16 = 8;

const HELP: &[&str] = &[
    "arrows         go to another cell",
    "w a s d        toggle the wall above, left, below, right",
    "shift+arrow    the same, also with ctrl or alt",
    "click, drag    toggle a wall, and do the same to others",
    "o, c           open, close all walls of the cell",
    "u, r           undo, redo; also ctrl-z, ctrl-y",
    "tab            go to the next cell that breaks a rule",
    "home, end      go to the start, to the goal",
    "p              optimal path: in steps, in cells, none",
    "n, h           numbers, shades: steps to the goal",
    "+ - 0          larger, smaller, as large as it fits",
    "ctrl-s, F2     save",
    "q, esc         quit",
    "",
    "any key goes on",
];

/// Draws everything.
pub fn draw(editor: &mut Editor, buffer: &mut Buffer) {
    let screen = *buffer.area();
    let look = editor.look;
    if screen.width < 10 || screen.height < 4 {
        return;
    }
    let (maze_area, panel_area) = areas(screen, editor.board.maze().dimension());
    let footer = Rect {
        y: screen.bottom() - 1,
        height: 1,
        ..screen
    };
    let scene = scene(editor);
    let view = editor
        .camera
        .viewport(scene.dimension, maze_area, editor.cursor);
    editor.viewport = Some(view);
    draw_maze(&scene, &view, look, buffer);
    title(editor, &mut Writer::new(buffer, row(screen, 0), look));
    panel(editor, &mut Writer::new(buffer, panel_area, look));
    foot(editor, &mut Writer::new(buffer, footer, look));
    if editor.help {
        let lines: Vec<(String, Role)> = HELP
            .iter()
            .map(|line| ((*line).to_owned(), Role::Plain))
            .collect();
        overlay(buffer, look, "keys", &lines);
    }
    if let Some(asking) = editor.asking {
        let path = Text::of_path(editor.file.path());
        let (title, lines) = question(asking, &path);
        let lines: Vec<(String, Role)> = lines
            .iter()
            .map(|line| (line.as_str().to_owned(), Role::Plain))
            .collect();
        overlay(buffer, look, title, &lines);
    }
}

fn question(asking: Asking, path: &Text) -> (&'static str, [Text; 2]) {
    match asking {
        Asking::Quit => (
            "unsaved changes",
            [
                text!("{} does not have the last changes.", path),
                text!("s  save and quit    y  quit without them    esc  go on"),
            ],
        ),
        Asking::Overwrite => (
            "the file has changed",
            [
                text!("{} is not what it was when it was read.", path),
                text!("y  overwrite it    esc  keep it"),
            ],
        ),
    }
}

fn row(screen: Rect, row: u16) -> Rect {
    Rect {
        y: screen.y + row,
        height: 1,
        ..screen
    }
}

/// Where the maze and the panel are: side by side if there is room for a small maze and the
/// panel, one above the other if not.
fn areas(screen: Rect, dimension: u8) -> (Rect, Rect) {
    let rows = screen.height - 2;
    let body = Rect {
        y: screen.y + 1,
        height: rows,
        ..screen
    };
    let (smallest, _) = Zoom::Small.extent(dimension);
    if screen.width >= smallest.min(40) + PANEL_WIDTH + 2 {
        let room = screen.width - PANEL_WIDTH - 2;
        let zoom = Zoom::fitting(dimension, room, rows);
        let width = zoom.extent(dimension).0.min(room);
        let maze = Rect { width, ..body };
        let panel = Rect {
            x: body.x + width + 2,
            width: body.width - width - 2,
            ..body
        };
        return (maze, panel);
    }
    let panel_rows = PANEL_HEIGHT.min(rows / 3);
    let maze = Rect {
        height: rows - panel_rows,
        ..body
    };
    let panel = Rect {
        y: maze.bottom(),
        height: panel_rows,
        ..body
    };
    (maze, panel)
}

fn title(editor: &Editor, writer: &mut Writer<'_>) {
    let path = Text::of_path(editor.file.path());
    let size = editor.board.maze().dimension();
    let about = format!("  {size} x {size}, format {}", editor.file.format());
    let state = match editor.board.is_modified() {
        true => ("  modified", Role::Warning),
        false => ("", Role::Plain),
    };
    let part = match editor.viewport {
        Some(view) if view.is_cut() => "  (part of it)",
        _ => "",
    };
    // The end of a long path says more than its beginning.
    writer.line(&[
        (&file_name(path.as_str()), Role::Strong),
        (&about, Role::Plain),
        (part, Role::Faint),
        state,
    ]);
}

/// The last 40 characters of a path.
fn file_name(path: &str) -> String {
    const SHOWN: usize = 40;
    let count = path.chars().count();
    if count <= SHOWN {
        return path.to_owned();
    }
    let end: String = path.chars().skip(count - SHOWN).collect();
    format!("...{end}")
}

fn scene(editor: &Editor) -> Scene {
    let maze = editor.board.maze();
    let mut scene = Scene::of(maze);
    scene.cursor = Some(editor.cursor);
    let path = match editor.path {
        PathShown::Steps => editor.facts.fewest_steps.as_ref(),
        PathShown::Cells => editor.facts.fewest_cells.as_ref(),
        PathShown::None => None,
    };
    if let Some(path) = path {
        scene.set_optimum(path.stops());
    }
    if editor.heat || editor.numbers {
        let distances: Distances = distances_to_goal(maze, Metric::STEPS);
        let steps = |cell| distances.get(cell);
        if editor.heat {
            let numbers: Vec<u32> = maze
                .walls()
                .cells()
                .map(|cell| steps(cell).unwrap_or(0))
                .collect();
            scene.set_heat(&numbers);
        }
        if editor.numbers {
            for cell in maze.walls().cells() {
                if let Some(mark) = scene.mark_mut(cell) {
                    mark.number = steps(cell);
                }
            }
        }
    }
    for cell in editor.facts.broken.iter().flat_map(|it| it.cells()) {
        if let Some(mark) = scene.mark_mut(cell) {
            mark.flagged = true;
        }
    }
    scene
}

fn panel(editor: &Editor, writer: &mut Writer<'_>) {
    let facts = &editor.facts;
    // What comes after the rules must not be lost where many are broken.
    let after = 11;
    match facts.broken.len() {
        0 => writer.line(&[("legal: it keeps all contest rules", Role::Good)]),
        1 => writer.line(&[("breaks 1 contest rule:", Role::Bad)]),
        count => writer.line(&[(&format!("breaks {count} contest rules:"), Role::Bad)]),
    }
    for (place, violation) in facts.broken.iter().enumerate() {
        let rest = facts.broken.len() - place - 1;
        let room = writer.rows_left().saturating_sub(after);
        let lines = room.saturating_sub(u16::try_from(rest).unwrap_or(room));
        writer.wrapped(&format!("! {violation}"), Role::Plain, lines.clamp(1, 3));
    }
    writer.skip();
    match (&facts.fewest_steps, &facts.fewest_cells) {
        (Some(steps), Some(cells)) => {
            writer.line(&[
                ("fewest steps  ", Role::Faint),
                (&length(steps), Role::Strong),
            ]);
            writer.line(&[
                ("fewest cells  ", Role::Faint),
                (&length(cells), Role::Strong),
            ]);
        }
        _ => writer.line(&[("the goal cannot be reached", Role::Bad)]),
    }
    let oracle = facts
        .oracle
        .map_or_else(|| "none".to_owned(), |it| it.to_string());
    writer.line(&[("oracle score  ", Role::Faint), (&oracle, Role::Strong)]);
    writer.skip();
    for (name, value) in [
        ("turns         ", facts.turns),
        ("dead ends     ", facts.dead_ends),
        ("junctions     ", facts.junctions),
        ("loops         ", facts.loops),
    ] {
        writer.line(&[(name, Role::Faint), (&value.to_string(), Role::Strong)]);
    }
    writer.skip();
    let open: Vec<&str> = Heading::ALL
        .into_iter()
        .filter(|&side| editor.board.maze().walls().is_open(editor.cursor, side))
        .map(Heading::name)
        .collect();
    let open = match open.is_empty() {
        true => "closed".to_owned(),
        false => format!("open {}", open.join(", ")),
    };
    writer.text(&format!("cell {}: {open}", editor.cursor));
    if let (undo @ 1.., redo) | (undo, redo @ 1..) = editor.board.history() {
        writer.line(&[(&format!("{undo} to undo, {redo} to redo"), Role::Faint)]);
    }
}

fn length(path: &Path) -> String {
    format!(
        "{}, {}",
        counted(path.steps(), "step"),
        counted(path.cells(), "cell")
    )
}

fn foot(editor: &Editor, writer: &mut Writer<'_>) {
    match &editor.message {
        Some((message, true)) => writer.line(&[(message.as_str(), Role::Bad)]),
        Some((message, false)) => writer.line(&[(message.as_str(), Role::Good)]),
        None => writer.line(&[(
            "arrows: go   w a s d: walls   u: undo   ctrl-s: save   q: quit   ?: all keys",
            Role::Faint,
        )]),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::PathBuf;

    use proptest::prelude::*;
    use wasmouse_core::maze::format::Format;
    use wasmouse_core::maze::{Maze, Walls, bundled};

    use super::super::super::super::tui::testing::{any_event, press, screen_of, survive};
    use super::super::super::super::tui::{App as _, Look};
    use super::super::file::MazeFile;
    use super::*;
    use crate::report::picture::Charset;

    fn editor(maze: Maze, path: &str, look: Look) -> Editor {
        let file = MazeFile::new(PathBuf::from(path), Format::Udacity);
        Editor::new(file, maze, true, look)
    }

    fn official() -> Maze {
        let text = bundled()[0].text;
        wasmouse_core::maze::format::parse(text)
            .expect("a maze")
            .maze
    }

    const PLAIN: Look = Look {
        charset: Charset::Unicode,
        color: false,
    };
    const ASCII: Look = Look {
        charset: Charset::Ascii,
        color: false,
    };

    #[test]
    fn a_legal_maze() {
        let mut editor = editor(official(), "maze.txt", PLAIN);
        insta::assert_snapshot!("legal", screen_of(&mut editor, 80, 24));
        press(&mut editor, "?");
        insta::assert_snapshot!("help", screen_of(&mut editor, 80, 24));
    }

    #[test]
    fn a_maze_that_breaks_rules() {
        let mut editor = editor(official(), "maze.txt", ASCII);
        press(&mut editor, "d<end>sd<home>nh");
        insta::assert_snapshot!("broken", screen_of(&mut editor, 80, 24));
        insta::assert_snapshot!("broken_wide", screen_of(&mut editor, 130, 40));
        insta::assert_snapshot!("broken_narrow", screen_of(&mut editor, 40, 24));
    }

    #[test]
    fn colours_say_nothing_that_characters_do_not() {
        let mut editor = editor(official(), "maze.txt", Look::RICH);
        press(&mut editor, "d<right><right>h");
        insta::assert_snapshot!("color", screen_of(&mut editor, 90, 30));
    }

    #[test]
    fn questions_show_hostile_paths_as_text() {
        let path = format!("{}\u{1b}[2J\u{202e}txt", "x".repeat(300));
        let mut editor = editor(official(), &path, PLAIN);
        press(&mut editor, "dq");
        let screen = screen_of(&mut editor, 80, 24);
        assert!(!screen.contains('\u{1b}') && !screen.contains('\u{202e}'));
        insta::assert_snapshot!("question", screen);
    }

    #[test]
    fn a_message_says_what_was_saved() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("maze.txt");
        fs::write(&path, bundled()[0].text).expect("a file");
        let (file, maze) = MazeFile::open(&path).expect("a maze");
        let mut editor = Editor::new(file, maze, true, PLAIN);
        press(&mut editor, "d<ctrl-s>");
        let screen = screen_of(&mut editor, 200, 24);
        let last = screen.lines().last().expect("a line");
        assert!(
            last.starts_with("wrote ") && last.ends_with("maze.txt"),
            "{last}"
        );
    }

    /// Whatever the size of terminal and maze.
    #[test]
    fn any_terminal_will_do() {
        for dimension in [3, 16, 64] {
            let maze = Maze::contest(Walls::open(dimension)).expect("it fits");
            let mut editor = editor(maze, "maze.txt", Look::RICH);
            press(&mut editor, "nh");
            for (width, height) in [
                (0, 0),
                (1, 1),
                (10, 4),
                (11, 5),
                (30, 9),
                (80, 24),
                (250, 80),
            ] {
                let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
                editor.draw(&mut buffer);
                press(&mut editor, "+");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Whatever a person does, and whatever the size. Undoing all of it gives the first maze.
        #[test]
        fn no_key_breaks_it(
            events in prop::collection::vec(any_event(), 0..70),
            (width, height) in (0..120_u16, 0..40_u16),
        ) {
            // Where nothing can be written.
            let mut editor = editor(official(), "missing folder/maze.txt", PLAIN);
            survive(&mut editor, &events, width, height);
            let maze = editor.board.maze();
            prop_assert_eq!((maze.start(), maze.goal()), (official().start(), official().goal()));
            while editor.board.undo() {}
            prop_assert_eq!(editor.board.maze(), &official());
        }
    }
}
