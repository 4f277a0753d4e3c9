//! Where everything is on the screen: names, mazes, what happens in words, the timeline, keys.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::journal::Level;

use super::super::tui::{Role, Writer, Zoom, draw_maze, overlay};
use super::control::{MAZES_MAX, Player, Sides};
use super::show::Show;
use super::{account, logs, scenes, timeline};

/// Columns between two mazes.
const GAP: u16 = 2;

/// A maze that is narrower than this shows too little of itself.
const MAZE_WIDTH_MIN: u16 = 30;

/// Lines of text for a match: what happens, how it stands, and the log.
const LINES_MAX: u16 = 7;

/// Columns from which the texts of two matches are beside each other.
const SIDE_BY_SIDE: u16 = 120;

const HELP: &[&str] = &[
    "space              play, pause",
    "left, right        a step back, a step forward; also h, l, wheel",
    "shift+left, right  ten steps",
    "page up, down      fifty steps",
    "home, end          the first, the last step",
    "0 to 9             tenths of the match; or click the line",
    "n, p               next, previous event of the line",
    "up, down           faster, slower; also + and -",
    "m                  maze and what could be known, maze, known",
    "b                  what the robot says it believes, or could know",
    "v, d               visits as shades, steps to the goal",
    "o, c               best path, the robot's colours and labels",
    "z, Z, x            larger, smaller, as large as it fits",
    "ctrl+arrows        another part of a large maze",
    "q, esc             quit",
    "",
    "on the line: G goal, C best path certain, R reset,",
    "! reset ignored, ' bump           any key goes on",
];

/// A maze on the screen.
struct Panel {
    show: usize,
    is_mind: bool,
    area: Rect,
}

/// Draws everything.
pub fn draw(player: &mut Player, buffer: &mut Buffer) {
    let screen = *buffer.area();
    if screen.width < 10 || screen.height < 5 || player.shows.is_empty() {
        return;
    }
    let texts = text_rows(player, screen);
    let body = Rect {
        height: screen.height - texts - 2,
        ..screen
    };
    for (place, panel) in panels(player, body).iter().enumerate() {
        draw_panel(player, place, panel, buffer);
    }
    let text = Rect {
        y: body.bottom(),
        height: texts,
        ..screen
    };
    draw_texts(player, text, buffer);
    let line = Rect {
        y: text.bottom(),
        height: 1,
        ..screen
    };
    draw_timeline(player, line, buffer);
    let keys = Rect {
        y: line.bottom(),
        ..line
    };
    Writer::new(buffer, keys, player.look).line(&[(
        "space: play   left right: step   n p: events   m: mazes   q: quit   ?: keys",
        Role::Faint,
    )]);
    if player.help {
        let lines: Vec<(String, Role)> = HELP
            .iter()
            .map(|line| ((*line).to_owned(), Role::Plain))
            .collect();
        overlay(buffer, player.look, "keys", &lines);
    }
}

/// Rows for the texts of all matches: what the mazes leave, within limits.
fn text_rows(player: &Player, screen: Rect) -> u16 {
    let is_stacked = player.shows.len() == 1 || screen.width < SIDE_BY_SIDE;
    let matches = if is_stacked {
        u16::try_from(player.shows.len()).unwrap_or(1)
    } else {
        1
    };
    // The names above the mazes, the timeline and the keys.
    let room = screen.height - 3;
    let least = (2 * matches).min(room / 2);
    let body = Rect {
        height: room - least + 1,
        ..screen
    };
    let panels = panels(player, body);
    let needed = panels.iter().map(|panel| {
        let dimension = player.shows[panel.show].playback.maze().dimension();
        let zoom = Zoom::fitting(dimension, panel.area.width, panel.area.height);
        zoom.extent(dimension).1
    });
    let needed = needed.max().unwrap_or(0).min(room - least);
    (room - needed).clamp(least, (LINES_MAX * matches).max(least))
}

/// Where the mazes are. Those of what a robot could know are left out where there is no room.
fn panels(player: &Player, body: Rect) -> Vec<Panel> {
    let both = player.overlays.sides == Sides::Both;
    let dimensions = player.shows.iter().map(|it| it.playback.maze().dimension());
    let widest = dimensions.map(|it| Zoom::Small.extent(it).0).max();
    let width_min = widest.unwrap_or(0).min(MAZE_WIDTH_MIN);
    let width_of = |count: usize| {
        let count = u16::try_from(count.max(1)).unwrap_or(u16::MAX);
        body.width.saturating_sub(GAP * (count - 1)) / count
    };
    let shows = player.shows.len().min(MAZES_MAX / 2);
    let both = both && width_of(2 * shows) >= width_min;
    let mut sides = Vec::new();
    for show in 0..shows {
        if both || player.overlays.sides != Sides::Mind {
            sides.push((show, false));
        }
        if both || player.overlays.sides == Sides::Mind {
            sides.push((show, true));
        }
    }
    let width = width_of(sides.len());
    let mut x = body.x;
    let mut panels = Vec::new();
    for (show, is_mind) in sides {
        let area = Rect { x, width, ..body };
        x += width + GAP;
        panels.push(Panel {
            show,
            is_mind,
            area,
        });
    }
    panels
}

/// A maze with its name above it.
fn draw_panel(player: &mut Player, place: usize, panel: &Panel, buffer: &mut Buffer) {
    let show = &player.shows[panel.show];
    let is_alone = player.overlays.sides == Sides::Mind;
    let position = player.position.min(show.last());
    let title = Rect {
        height: 1,
        ..panel.area
    };
    // The title says so where a part of the maze is not shown.
    let scene = if panel.is_mind {
        scenes::of_mind(show, position, player.overlays)
    } else {
        scenes::of_maze(show, position, player.overlays)
    };
    let area = Rect {
        y: panel.area.y + 1,
        height: panel.area.height - 1,
        ..panel.area
    };
    let followed = scene.robot.map_or(scene.start, |(cell, _)| cell);
    let view = player.cameras[place].viewport(scene.dimension, area, followed);
    player.zoom = view.zoom;
    draw_maze(&scene, &view, player.look, buffer);
    let part = if view.is_cut() { " (part)" } else { "" };
    let mut writer = Writer::new(buffer, title, player.look);
    let what = if player.overlays.beliefs && show.has_beliefs {
        "what it believes"
    } else {
        "what it could know"
    };
    if panel.is_mind && !is_alone {
        writer.line(&[(what, Role::Faint), (part, Role::Faint)]);
    } else {
        let what = if panel.is_mind {
            format!(": {what}")
        } else {
            String::new()
        };
        writer.parts([
            (show.robot.as_guest(), Role::Strong),
            (" in ".into(), Role::Faint),
            (show.maze.as_guest(), Role::Plain),
            (GuestStr::from(&what), Role::Faint),
            (part.into(), Role::Faint),
        ]);
    }
}

/// What happens in each match, one above the other or side by side.
fn draw_texts(player: &Player, area: Rect, buffer: &mut Buffer) {
    let count = u16::try_from(player.shows.len()).expect("a few matches");
    let is_stacked = area.width < SIDE_BY_SIDE;
    for (place, show) in player.shows.iter().enumerate() {
        let place = u16::try_from(place).expect("a few matches");
        let part = if count == 1 {
            area
        } else if is_stacked {
            let height = area.height / count;
            Rect {
                y: area.y + place * height,
                height,
                ..area
            }
        } else {
            // As the mazes above.
            let width = (area.width - GAP * (count - 1)) / count;
            Rect {
                x: area.x + place * (width + GAP),
                width,
                ..area
            }
        };
        draw_text(player, show, part, is_stacked && count > 1, buffer);
    }
}

/// What happens in a match, how it stands, and the last lines of the robot's log.
fn draw_text(player: &Player, show: &Show, area: Rect, named: bool, buffer: &mut Buffer) {
    let mut writer = Writer::new(buffer, area, player.look);
    let position = player.position.min(show.last());
    let step = account::step_of(&show.playback, position);
    if named {
        // A long name must not hide what happens.
        let (name, _) = show.robot.as_guest().cut(20);
        writer.parts([
            (name, Role::Strong),
            (": ".into(), Role::Faint),
            (GuestStr::from(&step), Role::Plain),
        ]);
    } else {
        writer.line(&[(&step, Role::Plain)]);
    }
    let standing = account::standing(&show.playback, position);
    let lines = if area.height > 3 { 2 } else { 1 };
    writer.wrapped(&standing, Role::Strong, lines);
    let room = usize::from(writer.rows_left());
    for line in logs::last(show.playback.journal(), position, room) {
        let (mark, role) = match line.level {
            Level::Debug | Level::Info => ("", Role::Plain),
            Level::Warning => ("warning: ", Role::Warning),
            Level::Error => ("error: ", Role::Bad),
        };
        // Quotes, so that nobody takes it for a message of the player.
        let step = format!("step {}: ", line.step);
        writer.parts([
            (GuestStr::from(&step), Role::Faint),
            (mark.into(), role),
            ("\"".into(), Role::Faint),
            (line.text, Role::Plain),
            ("\"".into(), Role::Faint),
        ]);
    }
}

fn draw_timeline(player: &mut Player, row: Rect, buffer: &mut Buffer) {
    let last = player.last();
    let state = if player.is_playing {
        "playing"
    } else if player.position == last {
        "the end"
    } else {
        "paused "
    };
    let position = player.position;
    let left = format!("{state} {position:>4} of {last}  ");
    let right = format!("  {}", speed(player.delay));
    let columns = |text: &str| u16::try_from(text.len()).expect("a short text");
    let around = columns(&left) + columns(&right);
    let line = Rect {
        x: row.x + columns(&left),
        width: row.width.saturating_sub(around),
        ..row
    };
    let mut writer = Writer::new(buffer, row, player.look);
    writer.line(&[(&left, Role::Strong)]);
    let marks = player.shows.iter().flat_map(|show| &show.marks);
    timeline::draw(buffer, line, player.look, (position, last), marks);
    if line.width > 0 {
        let place = Rect {
            x: line.right(),
            width: columns(&right),
            ..row
        };
        Writer::new(buffer, place, player.look).line(&[(&right, Role::Faint)]);
    }
    player.timeline = line;
}

/// Steps in a second.
fn speed(delay: Duration) -> String {
    let tenths = 10_000_000 / delay.as_micros().max(1);
    if tenths >= 100 {
        format!("{:>4} steps/s", tenths / 10)
    } else {
        format!("{:>2}.{} steps/s", tenths / 10, tenths % 10)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::super::tui::Look;
    use super::super::super::tui::testing::{any_event, buffer_of, press, screen_of, survive};
    use super::super::show::tests::{explorer, hostile, lost};
    use super::*;
    use crate::report::picture::Charset;

    const ASCII: Look = Look {
        charset: Charset::Ascii,
        color: false,
    };

    fn at(shows: Vec<Show>, position: usize) -> Player {
        let mut player = Player::new(shows, false);
        player.seek(position);
        player
    }

    #[test]
    fn one_match() {
        let mut player = at(vec![explorer()], 45);
        insta::assert_snapshot!("explored", screen_of(&mut player, 80, 24));
        insta::assert_snapshot!("explored_wide", screen_of(&mut player, 160, 45));
        press(&mut player, "<end>bvd");
        insta::assert_snapshot!("believed", screen_of(&mut player, 80, 24));
        press(&mut player, "?");
        insta::assert_snapshot!("help", screen_of(&mut player, 80, 24));
    }

    #[test]
    fn ascii() {
        let mut player = Player::with_look(vec![explorer()], ASCII);
        player.seek(70);
        let screen = screen_of(&mut player, 80, 24);
        assert!(screen.is_ascii(), "{screen}");
        insta::assert_snapshot!("ascii", screen);
    }

    #[test]
    fn color() {
        let mut player = Player::new(vec![explorer()], true);
        player.seek(45);
        press(&mut player, "mv");
        insta::assert_snapshot!("color", screen_of(&mut player, 80, 30));
    }

    #[test]
    fn two_matches() {
        let mut player = at(vec![explorer(), lost()], 50);
        insta::assert_snapshot!("two", screen_of(&mut player, 80, 24));
        press(&mut player, "<end>m");
        insta::assert_snapshot!("two_ends", screen_of(&mut player, 80, 24));
        press(&mut player, "m");
        insta::assert_snapshot!("two_wide", screen_of(&mut player, 200, 50));
    }

    #[test]
    fn hostile_text_is_only_text() {
        let mut player = at(vec![hostile()], usize::MAX);
        for (width, height) in [(80, 24), (200, 50)] {
            for keys in ["", "m", "m", "zz"] {
                press(&mut player, keys);
                let buffer = buffer_of(&mut player, width, height);
                for cell in buffer.content() {
                    let symbol = cell.symbol();
                    let harmless = symbol.chars().count() == 1
                        && !symbol.contains(|it: char| it.is_control() || it == '\u{202e}');
                    assert!(harmless, "{symbol:?}");
                }
            }
        }
        insta::assert_snapshot!("hostile", screen_of(&mut player, 80, 24));
        let mut player = Player::with_look(vec![hostile(), hostile()], ASCII);
        player.seek(9);
        assert!(screen_of(&mut player, 200, 50).is_ascii());
    }

    /// Whatever the size of the terminal.
    #[test]
    fn any_terminal_will_do() {
        let mut player = at(vec![explorer(), hostile()], 9);
        press(&mut player, "vd");
        for (width, height) in [
            (0, 0),
            (1, 1),
            (9, 4),
            (10, 5),
            (11, 6),
            (30, 9),
            (80, 24),
            (250, 80),
        ] {
            for keys in ["", "m", "m", "m", "?", "z", "Z"] {
                press(&mut player, keys);
                buffer_of(&mut player, width, height);
            }
        }
        let mut nothing = Player::new(Vec::new(), false);
        press(&mut nothing, " <end>n<right>5");
        buffer_of(&mut nothing, 80, 24);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Whatever a person does, and whatever the size.
        #[test]
        fn no_key_breaks_it(
            events in prop::collection::vec(any_event(), 0..70),
            (width, height) in (0..120_u16, 0..40_u16),
        ) {
            let mut player = Player::new(vec![explorer(), hostile()], true);
            survive(&mut player, &events, width, height);
            prop_assert!(player.position <= player.last());
        }
    }
}
