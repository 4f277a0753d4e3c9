//! In every maze that can be loaded, no example robot panics, bumps or makes a reset that is
//! ignored; in legal mazes, some of them must finish.
//!
//! Played natively in the SDK's arena, which is fast enough for thousands of matches.

use robot_champion::Champion;
use robot_count_expansion::CountExpansion;
use robot_dfs::DepthFirst;
use robot_flood::Flood;
use robot_lobato::Lobato;
use robot_minnett::Minnett;
use robot_rai::Rai;
use robot_random::RandomWalk;
use robot_wall_follower::WallFollower;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::{self, Walls};
use wasmouse_sdk::testing::{self, PlayOptions, Played};
use wasmouse_sdk::{Area, BudgetScope, Cell, Random, Robot};

use crate::matches::{KINDS, bundled_mazes, generated_mazes};

/// Flood, depth-first search, Lobato's robots and Rai's planner finish every legal
/// maze within the budget, in each of their variants.
#[test]
fn finish_legal_mazes() {
    for kind in KINDS {
        for (name, maze) in generated_mazes(&format!("gen:{kind}:12..=20:1..=12")) {
            let text = format::print(&maze, Format::Udacity).expect("a contest maze");
            finishes::<Flood>(2, &name, &text);
            finishes::<DepthFirst>(3, &name, &text);
            finishes::<Lobato>(5, &name, &text);
            finishes::<Rai>(5, &name, &text);
        }
    }
}

/// Requires the robot to finish in each of that many variants.
fn finishes<R: Robot>(variants: u32, maze: &str, text: &str) {
    for variant in 0..variants {
        let options = PlayOptions {
            variant,
            ..PlayOptions::default()
        };
        let played = play::<R>(text, &options);
        let robot = std::any::type_name::<R>();
        let summary = played.summary();
        assert!(played.finished, "{robot} {variant} in {maze}: {summary}");
    }
}

/// The experiment of Lobato's report, section 5.1: in a maze with a long path that the
/// heuristic favours and a short one that it does not, A* alone takes the long one, and the
/// swing finds the short one.
#[test]
fn the_swing_finds_the_path_that_a_star_alone_does_not() {
    let mazes = bundled_mazes();
    let detour = mazes.iter().find(|(name, _)| *name == "lobato-detour");
    let (_, maze) = detour.expect("a bundled maze");
    let text = format::print(maze, Format::Udacity).expect("a contest maze");
    let best = maze::shortest_path(maze, maze::Metric::STEPS).expect("a path");
    let found = [0, 1, 2, 3, 4].map(|variant| {
        let options = PlayOptions {
            variant,
            ..PlayOptions::default()
        };
        let played = play::<Lobato>(&text, &options);
        (played.speed_steps == best.steps(), played.summary())
    });
    let expected = [
        (true, "finished 164 + 17: 22.467"),
        (false, "finished 68 + 28: 30.267"),
        (false, "finished 92 + 18: 21.067"),
        (true, "finished 149 + 17: 21.967"),
        (true, "finished 146 + 17: 21.867"),
    ];
    assert_eq!(
        found,
        expected.map(|(is_best, summary)| (is_best, summary.to_owned()))
    );
}

/// Any walls, any start, any goal, any budget: whatever can be loaded.
#[test]
fn survive_any_maze() {
    let mut random = Random::new(1);
    let mut finished = 0;
    for round in 0..1500 {
        let dimension = match round % 4 {
            0 => 2 + random.below(4),
            1 => 2 + random.below(63),
            _ => 2 + random.below(19),
        };
        let share = random.below(75);
        let text = any_walls(dimension, share, &mut random);
        let mut options = any_options(dimension, &mut random);
        finished += u32::from(play::<Flood>(&text, &options).finished);
        play::<WallFollower>(&text, &options);
        options.variant = round % 3;
        play::<DepthFirst>(&text, &options);
        options.variant = round % 5;
        finished += u32::from(play::<Lobato>(&text, &options).finished);
        play::<Rai>(&text, &options);
        options.variant = 0;
        play::<RandomWalk>(&text, &options);
        play::<CountExpansion>(&text, &options);
        if round % 7 == 0 {
            // Thorough and slow.
            options.variant = random.below(5);
            play::<Minnett>(&text, &options);
        }
    }
    assert!(finished > 600, "only {finished} finished: a weak test");
}

/// The champion too, in fewer and smaller ones: it thinks longer.
#[test]
fn the_champion_survives_any_maze() {
    let mut random = Random::new(2);
    let mut finished = 0;
    for round in 0..60 {
        let dimension = 2 + random.below(13);
        let share = random.below(60);
        let text = any_walls(dimension, share, &mut random);
        let options = PlayOptions {
            variant: u32::from(round % 4 == 3),
            ..any_options(dimension, &mut random)
        };
        finished += u32::from(play::<Champion>(&text, &options).finished);
    }
    assert!(finished > 10, "only {finished} finished: a weak test");
}

/// Plays, and checks what holds in every match.
fn play<R: Robot>(text: &str, options: &PlayOptions) -> Played {
    let played = testing::play::<R>(text, options);
    let name = std::any::type_name::<R>();
    assert_eq!(played.bumps, 0, "{name} with {options:?} in\n{text}");
    assert_eq!(played.clamps, 0, "{name} with {options:?} in\n{text}");
    let ignored = (played.resets_before_goal, played.resets_in_run_2);
    assert_eq!(ignored, (0, 0), "{name} with {options:?} in\n{text}");
    played
}

fn any_walls(dimension: u32, share: u32, random: &mut Random) -> String {
    let mut walls = Walls::open(dimension as u8);
    let cells: Vec<maze::Cell> = walls.cells().collect();
    for &cell in &cells {
        for heading in [maze::Heading::Up, maze::Heading::Right] {
            if random.below(100) < share {
                walls.set(cell, heading, false);
            }
        }
    }
    // By hand, because the host prints only mazes with a start and a goal.
    let mut text = dimension.to_string();
    for (index, &cell) in cells.iter().enumerate() {
        let first = (index as u32).is_multiple_of(dimension);
        text.push(if first { '\n' } else { ',' });
        text.push_str(&walls.value(cell).to_string());
    }
    text
}

fn any_options(dimension: u32, random: &mut Random) -> PlayOptions {
    let mut any_cell = || Cell::new(random.below(dimension), random.below(dimension));
    let (start, origin) = (any_cell(), any_cell());
    let width = 1 + random.below((dimension - origin.x).min(3));
    let height = 1 + random.below((dimension - origin.y).min(3));
    let mut goal = Area::new(origin, width, height);
    if goal.contains(start) {
        // No maze has its start in the goal.
        let elsewhere = (start.x + 1) % dimension;
        goal = Area::new(Cell::new(elsewhere, start.y), 1, 1);
    }
    let scopes = [BudgetScope::BothRuns, BudgetScope::EachRun];
    PlayOptions {
        seed: random.next_u64(),
        variant: random.below(2),
        budget: [1, 2, 10, 100, 400][random.below(5) as usize],
        budget_scope: scopes[random.below(2) as usize],
        longest_move: [1, 2, 3, 3, 7, 127][random.below(6) as usize],
        start,
        goal: Some(goal),
        ..PlayOptions::default()
    }
}
