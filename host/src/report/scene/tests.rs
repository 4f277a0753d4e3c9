//! Scenes of a small match.

use wasmouse_core::game::{Action, GameRules};
use wasmouse_core::journal::{Belief, Color, Journal, Note};
use wasmouse_core::maze::{Cell, Heading, Turn, format};
use wasmouse_core::playback::Playback;
use wasmouse_core::record::{Transcript, trace};

use super::*;
use crate::report::picture::{TextStyle, Theme};
use crate::report::raster::draw;

const MAZE: &str = "\
o---o---o---o---o
|           |   |
o   o   o   o   o
|     G   G     |
o   o---o   o   o
|   | G   G |   |
o   o---o---o   o
| S |           |
o---o---o---o---o
";

/// Up, right into the goal, back to the start by a reset, and the same again.
pub(super) fn playback() -> Playback {
    let maze = format::parse(MAZE).expect("a maze").maze;
    let mut transcript = Transcript::default();
    for (turn, advance) in [(Turn::Straight, 2), (Turn::Right, 2)] {
        transcript.push(Action::Move { turn, advance });
    }
    transcript.push(Action::Reset);
    for (turn, advance) in [(Turn::Straight, 2), (Turn::Right, 1)] {
        transcript.push(Action::Move { turn, advance });
    }
    let rules = GameRules::default();
    let (result, trace) = trace(&maze, &rules, &transcript).expect("a whole match");
    let mut journal = Journal::default();
    journal.clear(1000);
    let cell = Cell::new(3, 3);
    let (color, text) = (Color::Red, "<b>\u{202e}".into());
    journal.push(1, Note::Paint { cell, color });
    journal.push(1, Note::Label { cell, text });
    let (side, belief) = (Heading::Left, Belief::Closed);
    journal.push(2, Note::Wall { cell, side, belief });
    Playback::new(maze, rules, trace, result.verdict, journal)
}

#[track_caller]
fn check(position: usize, overlays: &[Overlay], expected: &str) {
    let overlays = overlays.iter().copied().collect();
    let text = scene(&playback(), position, &overlays).to_text(TextStyle::ASCII);
    assert_eq!(text, expected.trim_start_matches('\n'), "\n{text}");
}

#[test]
fn knowledge_grows_and_distances_are_as_if_it_were_all() {
    check(
        0,
        &[Overlay::Knowledge, Overlay::Distances],
        "
o---o---o---o---o
| 2 . 1 . 1 . 2 |
o   . . . . . . o
| 1 .G0 .G0 . 1 |
o   . . . . . . o
| 1 .G0 .G0 . 1 |
o   o . . . . . o
|^2 | 1 . 1 . 2 |
o---o---o---o---o
",
    );
    check(
        1,
        &[Overlay::Knowledge, Overlay::Path, Overlay::Journal],
        "
o------o------o------o------o
|      .  .   .  .   .<b>?:r|
o      . . . .. . . .. . . .o
|  ^      G      G          |
o      . . . .. . . .. . . .o
|  +   .  G   .  G   .  .   |
o      o . . .. . . .. . . .o
|  S   |      .  .   .  .   |
o------o------o------o------o
",
    );
}

#[test]
fn beliefs_are_drawn_when_they_are_written() {
    check(
        1,
        &[Overlay::Beliefs],
        "
o---o---o---o---o
| . . . . . . . |
o . . . . . . . o
| ^ . G . G . . |
o . . . . . . . o
| . . G . G . . |
o . . . . . . . o
| S . . . . . . |
o---o---o---o---o
",
    );
    check(
        2,
        &[Overlay::Beliefs],
        "
o---o---o---o---o
| . . . .   |   |
o . . . . . o . o
| . . G . > . . |
o . . . . . . . o
| . . G . G . . |
o . . . . . . . o
| S . . . . . . |
o---o---o---o---o
",
    );
}

#[test]
fn visits_and_costs_are_heat() {
    check(
        2,
        &[Overlay::Heat],
        "
o---o---o---o---o
|           |   |
o   o   o   o   o
|::: :G: :>:    |
o   o---o   o   o
|:::| G   G |   |
o   o---o---o   o
|:S:|           |
o---o---o---o---o
",
    );
    check(
        5,
        &[Overlay::Costs, Overlay::Path, Overlay::Optimum],
        "
o---o---o---o---o
|::: === ===|%%%|
o   o   o   o   o
|:*: =>= =G= ===|
o   o---o   o   o
|:+:|#G# %G%|%%%|
o   o---o---o   o
| S |### ### %%%|
o---o---o---o---o
",
    );
}

#[test]
fn captions_say_what_happened() {
    let playback = playback();
    let captions = [0, 3, 5, 9].map(|it| caption::step(&playback, it));
    assert_eq!(
        captions,
        [
            "exploration run, step 0 of 5",
            "speed run, step 3 of 5",
            "score 2.100 (3 + 2 steps)",
            "score 2.100 (3 + 2 steps)",
        ]
    );
}

#[test]
fn posters_name_maze_robot_and_result() {
    let playback = playback();
    let shot = Shot {
        robot: "flood".into(),
        maze: "<maze>".into(),
        playback: &playback,
    };
    let sheet = poster("cup", &[shot; 2], &Overlays::default());
    let svg = sheet.to_svg(Theme::Light);
    assert!(svg.contains(">&lt;maze&gt;: flood</text>"), "{svg}");
    assert!(svg.contains(">score 2.100 (3 + 2 steps)</text>"), "{svg}");
}

#[test]
fn films_go_in_lockstep_and_end_with_the_last_picture() {
    let playback = playback();
    let shots = ["a", "b"].map(|robot| Shot {
        robot: robot.into(),
        maze: "m".into(),
        playback: &playback,
    });
    let overlays: Overlays = [Overlay::Path].into_iter().collect();
    let look = (Theme::Light, 200);
    let film = Film::new(shots.to_vec(), overlays.clone(), (0, 5), 2, look);
    assert_eq!(film.len(), 4);
    let still = side_by_side(&shots, 5, &overlays).to_svg(Theme::Light);
    assert_eq!(film.frame(3), draw(&still, 200));
}
