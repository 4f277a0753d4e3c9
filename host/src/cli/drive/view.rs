//! What the driver sees: readings, steps, and a map of what was seen so far.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use wasmouse_core::game::{Run, Step};
use wasmouse_core::journal::Belief;
use wasmouse_core::maze::{Metric, shortest_path};

use super::super::player::{action_in_words, step_in_words};
use super::super::tui::{Role, Scene, Writer, Zoom, draw_maze, overlay};
use super::driver::{Driver, budget};
use super::outcome::result;
use crate::report::picture::Wall;

/// Columns of the text beside the map, at least.
const TEXT_WIDTH: u16 = 34;

/// Rows of the text above the map, where there is no room beside it.
const TEXT_HEIGHT: u16 = 8;

const HELP: &[&str] = &[
    "up, w      drive straight ahead",
    "left, a    turn left, then drive",
    "right, d   turn right, then drive",
    "down, s    drive backwards",
    "0 to 9     cells that a move drives; 0 only turns",
    "b          drive backwards with all keys, or forwards again",
    "r          reset: ends the exploration run",
    "o          show the best path that may exist",
    "z, Z, x    larger, smaller, as large as it fits",
    "q, esc     give up",
    "",
    "Each of the first four, and a reset, is one step.",
    "any key goes on",
];

/// Draws everything.
pub fn draw(driver: &mut Driver<'_>, buffer: &mut Buffer) {
    let screen = *buffer.area();
    if screen.width < 10 || screen.height < 4 {
        return;
    }
    let look = driver.look;
    let line = |row: u16| Rect {
        y: screen.y + row,
        height: 1,
        ..screen
    };
    Writer::new(buffer, line(0), look).parts([
        ("driving in ".into(), Role::Faint),
        ((&driver.name).into(), Role::Strong),
    ]);
    let body = Rect {
        y: screen.y + 1,
        height: screen.height - 2,
        ..screen
    };
    let (map, text) = areas(driver, body);
    if let Some(map) = map {
        draw_map(driver, map, buffer);
    }
    draw_text(driver, &mut Writer::new(buffer, text, look));
    Writer::new(buffer, line(screen.height - 1), look).line(&[(
        "arrows: turn and drive   0 to 3: cells   r: reset   q: give up   ?: all keys",
        Role::Faint,
    )]);
    if driver.help {
        let lines: Vec<(String, Role)> = HELP
            .iter()
            .map(|line| ((*line).to_owned(), Role::Plain))
            .collect();
        overlay(buffer, look, "keys", &lines);
    }
    if driver.asking {
        let text = "y  give up    any other key  go on".to_owned();
        overlay(
            buffer,
            look,
            "the match is not over",
            &[(text, Role::Plain)],
        );
    }
}

/// Where the map and the text are; without a map the text is everywhere.
fn areas(driver: &Driver<'_>, body: Rect) -> (Option<Rect>, Rect) {
    if !driver.has_map {
        return (None, body);
    }
    let dimension = driver.knowledge.optimistic().dimension();
    let (smallest, _) = Zoom::Small.extent(dimension);
    if body.width >= smallest.min(40) + TEXT_WIDTH + 2 {
        let room = body.width - TEXT_WIDTH - 2;
        let zoom = Zoom::fitting(dimension, room, body.height);
        let width = zoom.extent(dimension).0.min(room);
        let map = Rect { width, ..body };
        let text = Rect {
            x: body.x + width + 2,
            width: body.width - width - 2,
            ..body
        };
        return (Some(map), text);
    }
    let rows = TEXT_HEIGHT.min(body.height / 2);
    let text = Rect {
        height: rows,
        ..body
    };
    let map = Rect {
        y: text.bottom(),
        height: body.height - rows,
        ..body
    };
    (Some(map), text)
}

fn draw_map(driver: &mut Driver<'_>, area: Rect, buffer: &mut Buffer) {
    let possible = driver.knowledge.optimistic();
    let known = &driver.knowledge;
    let mut scene = Scene::new(&possible, |cell, side| match known.wall(cell, side) {
        Belief::Unknown => Wall::Unknown,
        Belief::Open => Wall::Open,
        Belief::Closed => Wall::Closed,
    });
    let (cell, heading) = (driver.simulation.cell(), driver.simulation.heading());
    scene.robot = Some((cell, heading));
    // In the exploration run it crosses itself too often to show anything.
    if driver.simulation.run() == Run::Speed {
        scene.set_path(&driver.stops);
    }
    let longest_move = driver.rules.longest_move;
    let best = || shortest_path(&possible, Metric::Steps { longest_move });
    if let Some(path) = driver.path.then(best).flatten() {
        scene.set_optimum(path.stops());
    }
    let view = driver.camera.viewport(scene.dimension, area, cell);
    driver.zoom = view.zoom;
    draw_maze(&scene, &view, driver.look, buffer);
}

fn draw_text(driver: &Driver<'_>, writer: &mut Writer<'_>) {
    writer.line(&[(&budget(driver), Role::Strong)]);
    let simulation = &driver.simulation;
    if simulation.has_ended() {
        writer.skip();
        for (line, role) in result(driver) {
            writer.wrapped(&line, role, 2);
        }
        writer.skip();
        writer.wrapped("enter: watch the match in the true maze", Role::Plain, 2);
        return;
    }
    let sensors = simulation.sense();
    let number = |reading: u8| format!("{reading:<4}");
    writer.line(&[
        ("sensors  left ", Role::Faint),
        (&number(sensors.left), Role::Strong),
        ("front ", Role::Faint),
        (&number(sensors.front), Role::Strong),
        ("right ", Role::Faint),
        (&number(sensors.right), Role::Strong),
    ]);
    if driver.has_map {
        let place = format!("at {}, heading {}", simulation.cell(), simulation.heading());
        writer.line(&[(&place, Role::Plain)]);
    }
    let cells = match driver.cells {
        0 => "stays".to_owned(),
        1 => "drives 1 cell".to_owned(),
        cells => format!("drives {cells} cells"),
    };
    let direction = if driver.backwards { " backwards" } else { "" };
    writer.line(&[
        ("the next move ", Role::Faint),
        (&cells, Role::Plain),
        (direction, Role::Warning),
    ]);
    match (simulation.run(), simulation.goal_reached()) {
        (Run::Exploration, false) => writer.line(&[("the goal is not reached yet", Role::Plain)]),
        (Run::Exploration, true) => writer.wrapped(
            "the goal is reached: a reset starts the speed run",
            Role::Good,
            2,
        ),
        (Run::Speed, _) => writer.line(&[("drive to the goal", Role::Plain)]),
    }
    writer.skip();
    let steps = driver.trace.steps();
    // Without a map, what came of a step is for the driver to find out, as for a robot.
    let words = |step: &Step| match driver.has_map {
        true => step_in_words(step),
        false => action_in_words(step.action),
    };
    for (at, step) in steps.iter().enumerate().rev().take(8) {
        let number = format!("step {}: ", at + 1);
        writer.line(&[(&number, Role::Faint), (&words(step), Role::Plain)]);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use wasmouse_core::game::GameRules;
    use wasmouse_core::maze::{Maze, bundled, format};

    use super::super::super::tui::Look;
    use super::super::super::tui::testing::{any_event, buffer_of, press, screen_of, survive};
    use super::*;
    use crate::report::picture::Charset;

    fn maze() -> Maze {
        format::parse(bundled()[0].text).expect("a maze").maze
    }

    fn look(charset: Charset) -> Look {
        Look {
            charset,
            color: false,
        }
    }

    #[test]
    fn a_drive() {
        let (maze, rules) = (maze(), GameRules::default());
        let name = "test_maze_01\u{1b}[2J".to_owned();
        let mut driver = Driver::new(name, &maze, &rules, look(Charset::Unicode));
        press(&mut driver, "2wdr3<down>o");
        insta::assert_snapshot!("map", screen_of(&mut driver, 80, 24));
        insta::assert_snapshot!("narrow", screen_of(&mut driver, 40, 24));
        driver.has_map = false;
        insta::assert_snapshot!("blind", screen_of(&mut driver, 80, 12));
        press(&mut driver, "q");
        insta::assert_snapshot!("question", screen_of(&mut driver, 80, 24));
    }

    #[test]
    fn an_end_in_ascii() {
        let maze = maze();
        let rules = GameRules {
            budget: 3,
            ..GameRules::default()
        };
        let mut driver = Driver::new("maze", &maze, &rules, look(Charset::Ascii));
        press(&mut driver, "3www");
        let screen = screen_of(&mut driver, 100, 30);
        assert!(screen.is_ascii(), "{screen}");
        insta::assert_snapshot!("end", screen);
        for (width, height) in [(0, 0), (10, 4), (11, 5), (30, 9), (250, 80)] {
            buffer_of(&mut driver, width, height);
            press(&mut driver, "?");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Whatever a person does, and whatever the size.
        #[test]
        fn no_key_breaks_it(
            events in prop::collection::vec(any_event(), 0..70),
            (width, height) in (0..120_u16, 0..40_u16),
            has_map in any::<bool>(),
        ) {
            let maze = maze();
            let rules = GameRules { budget: 20, ..GameRules::default() };
            let name = "maze".to_owned();
            let mut driver = Driver::new(name, &maze, &rules, look(Charset::Unicode));
            driver.has_map = has_map;
            survive(&mut driver, &events, width, height);
            prop_assert!(driver.trace.steps().len() <= 20);
        }
    }
}
