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
        variant: 1,
        ..PlayOptions::default()
    };
    let mazes = contest_mazes::contest_mazes();
    for (number, expected) in expected {
        if let Some((_, maze)) = mazes.iter().find(|it| it.0 == number) {
            check(maze, &options, expected);
        }
    }
}

/// A budget that is just enough for the first path to the goal and back is enough.
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
#[should_panic(expected = "the variants 0 and 1")]
fn an_unknown_variant() {
    Champion::start(&Briefing {
        variant: 2,
        ..Briefing::contest(12)
    });
}

/// A maze with a third of its walls, the same every time.
fn any_maze(dimension: u32) -> String {
    let mut random = wasmouse_sdk::Random::new(7);
    let mut passages = wasmouse_sdk::Passages::all_open(dimension);
    let area = Area::new(Cell::new(0, 0), dimension, dimension);
    for cell in area.cells() {
        for side in [Heading::Up, Heading::Right] {
            if random.below(3) == 0 {
                passages.close(cell, side);
            }
        }
    }
    let value = |x, y| {
        let sides = Heading::ALL.into_iter().enumerate();
        let open = sides.filter(|it| passages.is_open(Cell::new(x, y), it.1));
        open.map(|it| 1 << it.0).sum::<u32>().to_string()
    };
    let columns = (0..dimension).map(|x| {
        let values: Vec<String> = (0..dimension).map(|y| value(x, y)).collect();
        values.join(",")
    });
    let lines: Vec<String> = std::iter::once(dimension.to_string())
        .chain(columns)
        .collect();
    lines.join("\n")
}

/// So that the fuel of a match is enough in half-size mazes too.
#[test]
fn thinks_deeply_in_small_mazes_only() {
    let stops = |dimension, variant| {
        let options = PlayOptions::of_variant(variant);
        testing::play::<Champion>(&any_maze(dimension), &options).stops
    };
    assert_ne!(stops(20, 0), stops(20, 1));
    assert_eq!(stops(22, 0), stops(22, 1));
}
