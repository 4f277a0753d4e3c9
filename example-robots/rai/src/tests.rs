//! The report's figures and tables, and the mazes that no report thinks of.

use super::*;
use crate::contest_mazes::contest_mazes;
use wasmouse_sdk::testing::{self, MAZE_01, Note, PlayOptions, Played};
use wasmouse_sdk::{Area, BudgetScope, Cell, journal::Color};

fn play(maze: &str, options: &PlayOptions) -> Played {
    let played = testing::play::<Rai>(maze, options);
    assert_eq!((played.bumps, played.clamps), (0, 0));
    assert_eq!((played.resets_before_goal, played.resets_in_run_2), (0, 0));
    played
}

/// The table of the crate's documentation.
#[test]
fn contest_mazes_in_all_variants() {
    let expected = [
        (1, 0, "finished 139 + 17: 21.633"),
        (2, 0, "finished 220 + 28: 35.333"),
        (3, 0, "finished 260 + 29: 37.667"),
        (1, 1, "finished 144 + 17: 21.800"),
        (2, 1, "finished 255 + 28: 36.500"),
        (3, 1, "finished 297 + 29: 38.900"),
        (1, 2, "finished 180 + 17: 23.000"),
        (2, 2, "finished 280 + 28: 37.333"),
        (3, 2, "finished 362 + 29: 41.067"),
        (1, 3, "finished 304 + 17: 27.133"),
        (2, 3, "finished 681 + 26: 48.700"),
        (3, 3, "finished 837 + 27: 54.900"),
        (1, 4, "finished 382 + 17: 29.733"),
        (2, 4, "finished 657 + 26: 47.900"),
        (3, 4, "finished 776 + 27: 52.867"),
    ];
    contest_figures::check::<Rai>(&expected);
}

/// Figure 5: how often the robot has been in each cell of maze 01 when it resets,
/// column by column; the three dead ends, 1000 there, have been visited once.
#[test]
fn the_traversal_grid_of_maze_01() {
    let figure = [
        [1, 1, 2, 2, 2, 2, 3, 1, 1, 0, 0, 0],
        [1, 1, 2, 2, 3, 2, 4, 1, 1, 1, 1, 0],
        [2, 2, 2, 2, 2, 3, 3, 2, 1, 1, 1, 0],
        [1, 2, 3, 2, 1, 2, 2, 2, 1, 1, 1, 0],
        [1, 1, 1, 1, 2, 1, 1, 1, 0, 0, 1, 0],
        [1, 1, 2, 2, 1, 2, 2, 1, 1, 1, 1, 0],
        [1, 1, 1, 2, 1, 2, 3, 1, 1, 1, 1, 0],
        [1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0],
        [2, 1, 0, 1, 2, 1, 0, 0, 0, 0, 0, 0],
        [1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0],
        [1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0],
        [1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0],
    ];
    let played = play(MAZE_01, &PlayOptions::of_variant(0));
    let mut counts = [[0; 12]; 12];
    for stop in played.stops.iter().filter(|it| it.run == 1) {
        counts[stop.cell.x as usize][stop.cell.y as usize] += 1;
    }
    assert_eq!(counts, figure);
    let marked: CellSet = played
        .journal
        .iter()
        .filter_map(|it| match it.note {
            Note::Paint(cell, Color::Red) => Some(cell),
            _ => None,
        })
        .collect();
    let dead_ends = [(8, 1), (7, 4), (1, 7)].map(|(x, y)| Cell::new(x, y));
    assert!(marked.iter().eq(dead_ends));
}

/// Figures 9 and 10: where the robot stands before each step of the speed run in maze 02.
#[test]
fn the_races_of_maze_02() {
    let figure_9 = "0,0 0,3 0,4 1,4 1,7 1,8 0,8 0,9 1,9 1,10 0,10 0,13 3,13 3,11 4,11 4,12 \
        5,12 5,13 8,13 11,13 11,12 9,12 9,11 10,11 10,10 8,10 8,8 6,8";
    let figure_10 = "0,0 0,3 0,4 1,4 1,7 3,7 3,6 4,6 4,4 5,4 5,3 8,3 8,4 10,4 10,3 9,3 9,2 \
        12,2 12,5 13,5 13,6 11,6 11,7 10,7 10,9 8,9 8,8 6,8";
    let mazes = contest_mazes();
    let Some((_, maze)) = mazes.iter().find(|it| it.0 == 2) else {
        return;
    };
    for (value, figure) in [(0, figure_9), (2, figure_10)] {
        let played = play(maze, &PlayOptions::of_variant(value));
        let race: Vec<String> = played
            .stops
            .iter()
            .filter(|it| it.run == 2)
            .map(|it| format!("{},{}", it.cell.x, it.cell.y))
            .collect();
        assert_eq!(race.join(" "), figure, "variant {value}");
    }
}

#[test]
fn the_first_version_rolls_dice() {
    let seeds = [1, 2].map(|seed| PlayOptions {
        seed,
        ..PlayOptions::of_variant(4)
    });
    let [one, two] = seeds.map(|it| play(MAZE_01, &it));
    assert!(one.finished && two.finished);
    assert_ne!(one.stops, two.stops);
}

#[test]
fn stops_exploring_in_time() {
    for value in 0..5 {
        let mut finished = 0;
        for budget in 60..400 {
            let options = PlayOptions {
                budget,
                ..PlayOptions::of_variant(value)
            };
            let played = play(MAZE_01, &options);
            assert!(
                played.finished || !played.goal_seen,
                "variant {value}, budget {budget}"
            );
            finished += u32::from(played.finished);
        }
        assert!(finished > 300, "variant {value}: {finished} finished");
    }
}

#[test]
fn a_budget_for_each_run() {
    let options = PlayOptions {
        budget: 139,
        budget_scope: BudgetScope::EachRun,
        ..PlayOptions::default()
    };
    assert!(play(MAZE_01, &options).finished);
}

#[test]
fn looks_behind_a_start_in_the_middle() {
    for value in 0..5 {
        let options = PlayOptions {
            start: Cell::new(1, 7),
            goal: Some(Area::new(Cell::new(0, 0), 1, 1)),
            ..PlayOptions::of_variant(value)
        };
        let played = play(MAZE_01, &options);
        assert!(played.finished, "variant {value}: {}", played.summary());
    }
}

#[test]
fn a_goal_that_is_walled_in() {
    let maze = "3\n1,5,4\n0,0,0\n0,0,0";
    for value in 0..5 {
        let played = play(maze, &PlayOptions::of_variant(value));
        assert_eq!(played.summary(), "goal not seen 1000 + 0");
    }
}

#[test]
#[should_panic(expected = "variants 0 to 4")]
fn an_unknown_variant() {
    Rai::start(&Briefing {
        variant: 5,
        ..Briefing::contest(12)
    });
}
