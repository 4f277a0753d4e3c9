//! Minnett's robot in generated mazes: it always finishes, whatever the variant, and
//! a reset for a proven path means the optimum of the host's solver.

use robot_minnett::Minnett;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::{Maze, Metric, shortest_path};
use wasmouse_sdk::testing::{self, PlayOptions, Played};

use crate::matches::{KINDS, generated_mazes};

fn for_each_maze(seeds: &str, mut check: impl FnMut(&str, &Maze)) {
    for kind in KINDS {
        for (name, maze) in generated_mazes(&format!("gen:{kind}:12..=20:{seeds}")) {
            check(&name, &maze);
        }
    }
}

fn play(maze: &Maze, variant: u32) -> Played {
    let text = format::print(maze, Format::Udacity).expect("a contest maze");
    let options = PlayOptions {
        variant,
        ..PlayOptions::default()
    };
    testing::play::<Minnett>(&text, &options)
}

/// Thanks to its guard; the report's robot looped for ever in 17 of 500 mazes.
#[test]
fn finishes_every_kind_of_maze() {
    for_each_maze("1..=3", |name, maze| {
        for variant in 0..5 {
            let played = play(maze, variant);
            let summary = played.summary();
            assert!(played.finished, "{variant} in {name}: {summary}");
            assert_eq!((played.bumps, played.resets_before_goal), (0, 0));
        }
    });
}

/// Variants with right path costs race along the optimum, unless the budget ended
/// the exploration.
#[test]
fn a_proven_path_is_the_optimum() {
    let mut proven = 0;
    for_each_maze("101..=104", |name, maze| {
        let optimum = shortest_path(maze, Metric::STEPS).expect("solvable");
        for variant in [0, 3, 4] {
            let played = play(maze, variant);
            let used = played.exploration_steps + played.speed_steps;
            // Otherwise it may have reset because the budget was short.
            if used < 990 {
                assert_eq!(played.speed_steps, optimum.steps(), "{variant} in {name}");
                proven += 1;
            }
        }
    });
    assert!(proven > 150, "only {proven} proofs: a weak test");
}
