//! Whole matches.

use super::*;
use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};
use wasmouse_sdk::{Area, Cell};

fn check(maze: &str, options: &PlayOptions, expected: &str) {
    let played = testing::play::<Champion>(maze, options);
    assert_eq!(played.summary(), expected);
    assert_eq!(played.bumps, 0);
}

#[test]
fn contest_mazes() {
    let expected = [
        (1, "finished 92 + 17: 20.067"),
        (2, "finished 111 + 22: 25.700"),
        (3, "finished 121 + 27: 31.033"),
    ];
    let mazes = contest_mazes::contest_mazes();
    for (number, expected) in expected {
        if let Some((_, maze)) = mazes.iter().find(|it| it.0 == number) {
            check(maze, &PlayOptions::default(), expected);
        }
    }
}

/// The same in `deep`.
#[test]
fn contest_mazes_deep() {
    let expected = [
        (1, "finished 89 + 17: 19.967"),
        (2, "finished 126 + 23: 27.200"),
        (3, "finished 99 + 27: 30.300"),
    ];
    let options = PlayOptions {
        setting: 1,
        ..PlayOptions::default()
    };
    let mazes = contest_mazes::contest_mazes();
    for (number, expected) in expected {
        if let Some((_, maze)) = mazes.iter().find(|it| it.0 == number) {
            check(maze, &options, expected);
        }
    }
}

/// A budget that is just enough for the first way to the goal and back is enough.
#[test]
fn stops_exploring_in_time() {
    let played = |budget| {
        let options = PlayOptions {
            budget,
            ..PlayOptions::default()
        };
        testing::play::<Champion>(MAZE_01, &options)
    };
    let whole = played(1000);
    let steps = whole.exploration_steps + whole.speed_steps;
    assert!(played(steps).finished);
    let least = (1..=steps).find(|&it| played(it).finished);
    let least = least.expect("the whole budget is enough");
    assert!((least..=steps).all(|it| played(it).finished));
}

#[test]
fn a_goal_elsewhere() {
    let options = PlayOptions {
        start: Cell::new(0, 11),
        goal: Some(Area::new(Cell::new(0, 2), 1, 1)),
        ..PlayOptions::default()
    };
    let played = testing::play::<Champion>(MAZE_01, &options);
    assert_eq!((played.finished, played.speed_steps), (true, 3));
}

#[test]
fn a_goal_that_is_walled_in() {
    let maze = "3\n1,5,4\n0,0,0\n0,0,0";
    check(maze, &PlayOptions::default(), "goal not seen 1000 + 0");
}

#[test]
#[should_panic(expected = "the settings 0 and 1")]
fn an_unknown_setting() {
    Champion::start(&Briefing {
        setting: 2,
        ..Briefing::contest(12)
    });
}
