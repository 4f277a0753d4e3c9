//! Whole matches: the figures of all variants, and mazes that break the rules.

use super::*;
use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};

/// The figures of the crate's documentation.
#[test]
fn contest_mazes() {
    let expected = [
        (1, 1, "finished 155 + 19: 24.167"),
        (1, 2, "finished 140 + 19: 23.667"),
        (1, 3, "finished 127 + 17: 21.233"),
        (1, 4, "finished 110 + 17: 20.667"),
        (1, 0, "finished 110 + 17: 20.667"),
        (2, 1, "finished 180 + 26: 32.000"),
        (2, 2, "finished 235 + 26: 33.833"),
        (2, 3, "finished 223 + 22: 29.433"),
        (2, 4, "finished 197 + 22: 28.567"),
        (2, 0, "finished 197 + 22: 28.567"),
        (3, 1, "finished 327 + 27: 37.900"),
        (3, 2, "finished 330 + 27: 38.000"),
        (3, 3, "finished 248 + 25: 33.267"),
        (3, 4, "finished 203 + 25: 31.767"),
        (3, 0, "finished 203 + 25: 31.767"),
    ];
    contest_figures::check::<Minnett>(&expected);
}

/// With a budget that is too short for the proof it resets in time.
#[test]
fn stops_exploring_in_time() {
    for variant in 0..5 {
        let play = |budget| {
            let options = PlayOptions {
                variant,
                budget,
                ..PlayOptions::default()
            };
            testing::play::<Minnett>(MAZE_01, &options)
        };
        assert!((100..150).all(|budget| play(budget).finished), "{variant}");
    }
}

/// A goal that is not the room in the centre: nothing is inferred about it.
#[test]
fn a_goal_behind_the_start() {
    let options = PlayOptions {
        start: Cell::new(0, 11),
        goal: Some(Area::new(Cell::new(0, 2), 1, 1)),
        ..PlayOptions::default()
    };
    testing::check::<Minnett>(MAZE_01, &options, "finished 38 + 3: 4.267");
}

#[test]
fn a_goal_that_is_walled_in() {
    let maze = "3\n1,5,4\n0,0,0\n0,0,0";
    testing::check::<Minnett>(maze, &PlayOptions::default(), "goal not seen 1000 + 0");
}

/// Two entrances, against the rules: the inference is wrong, the robot is not.
#[test]
fn two_entrances() {
    let maze = "4\n3,7,7,6\n11,15,15,14\n11,15,15,14\n9,13,13,12";
    let played = testing::play::<Minnett>(maze, &PlayOptions::default());
    assert!(played.finished, "{}", played.summary());
    assert_eq!(played.bumps, 0);
}

#[test]
#[should_panic(expected = "variants 0 to 4")]
fn an_unknown_variant() {
    Minnett::start(&Briefing {
        variant: 5,
        ..Briefing::contest(12)
    });
}

/// A budget whose half is over before the goal is reached: the guard seeks it, and
/// says so once.
#[test]
fn the_guard_seeks_the_goal_when_it_is_late() {
    for (budget, expected) in [(70, 1), (80, 1), (1000, 0)] {
        let options = PlayOptions {
            budget,
            ..PlayOptions::default()
        };
        let played = testing::play::<Minnett>(MAZE_01, &options);
        let is_said = |entry: &&testing::Entry| {
            let note = &entry.note;
            matches!(note, testing::Note::Log(_, text) if text == GUARD_SEEKS_GOAL)
        };
        let said = played.journal.iter().filter(is_said).count();
        assert_eq!(said, expected, "{budget}: {}", played.summary());
    }
}
