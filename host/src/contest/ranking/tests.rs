//! Laws of rankings.

use std::time::{Duration, Instant};

use proptest::prelude::*;
use wasmouse_core::GuestText;

use super::testing::{Sketch, SketchMaze, failed, finished, name, sketches};
use super::{MazeFilter, Ranking, RankingLine, RobotState};
use crate::contest::matrix::{Outcome, ScoreMatrix};
use crate::contest::mean::Mean;
use crate::contest::scoring::{Method, Scoring, TieBreak};

const METHODS: [Method; 3] = [Method::MeanScore, Method::Regret, Method::RankPoints];

fn scoring(method: Method) -> Scoring {
    Scoring {
        method,
        ..Scoring::default()
    }
}

fn rank(matrix: &ScoreMatrix, method: Method) -> Ranking {
    Ranking::new(matrix, &scoring(method), MazeFilter::All, None)
}

/// The lines with the names of their robots instead of their places.
fn by_name(ranking: &Ranking, matrix: &ScoreMatrix) -> Vec<(GuestText, RankingLine)> {
    let lines = ranking.lines.iter();
    let named = |line: &RankingLine| {
        let name = matrix.robots[line.robot].name.clone();
        (
            name,
            RankingLine {
                robot: 0,
                ..line.clone()
            },
        )
    };
    lines.map(named).collect()
}

fn line_of(ranking: &Ranking, robot: usize) -> &RankingLine {
    let mut lines = ranking.lines.iter();
    lines
        .find(|it| it.robot == robot)
        .expect("a line for each robot")
}

fn ranks(ranking: &Ranking) -> Vec<(usize, Option<u32>)> {
    let lines = ranking.lines.iter();
    lines.map(|it| (it.robot, it.rank)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn the_order_of_robots_and_mazes_changes_nothing(
        (sketch, order) in sketches().prop_flat_map(|sketch| {
            let order: Vec<usize> = (0..sketch.robots).collect();
            (Just(sketch), Just(order).prop_shuffle())
        }),
    ) {
        let mut permuted = sketch.clone();
        permuted.mazes.reverse();
        let (matrix, permuted) = (sketch.matrix(), permuted.matrix_with_order(&order));
        for method in METHODS {
            let (ranking, other) = (rank(&matrix, method), rank(&permuted, method));
            prop_assert_eq!(by_name(&ranking, &matrix), by_name(&other, &permuted));
        }
    }

    /// What the average over finished matches violates.
    #[test]
    fn finishing_more_never_ranks_lower(
        (sketch, failures) in sketches().prop_flat_map(|sketch| {
            let cells = sketch.mazes.len() * sketch.seeds as usize;
            (Just(sketch), proptest::collection::vec(proptest::bool::ANY, cells))
        }),
    ) {
        // The last robot does what the first does, except that it fails now and then.
        let mut sketch = sketch;
        let robots = sketch.robots + 1;
        let mut failures = failures.into_iter();
        for maze in &mut sketch.mazes {
            let rows = maze.cells.chunks(robots - 1);
            maze.cells = rows.flat_map(|row| {
                let is_finished = row[0].is_some_and(|it| it.outcome == Outcome::Finished);
                let has_failed = is_finished && failures.next().unwrap_or(false);
                let last = if has_failed { failed() } else { row[0] };
                row.iter().copied().chain([last]).collect::<Vec<_>>()
            }).collect();
        }
        sketch.robots = robots;
        let matrix = sketch.matrix();
        for method in METHODS {
            let ranking = rank(&matrix, method);
            let (first, last) = (line_of(&ranking, 0).rank, line_of(&ranking, robots - 1).rank);
            prop_assert!(first <= last, "{:?} > {:?} by {:?}", first, last, method);
        }
    }

    #[test]
    fn rank_points_are_those_of_a_naive_count(sketch in sketches()) {
        let matrix = sketch.matrix();
        let ranking = rank(&matrix, Method::RankPoints);
        for line in &ranking.lines {
            let mut half_points = 0;
            for (maze, _) in matrix.mazes.iter().enumerate().filter(|it| it.1.oracle.is_some()) {
                for seed in 0..sketch.seeds {
                    let score = |robot: usize| {
                        let played = matrix.get(robot, maze, seed).expect("all are played");
                        let score = played.score(&matrix.rules);
                        (score.is_none(), score)
                    };
                    for other in (0..sketch.robots).filter(|it| *it != line.robot) {
                        let points = match score(line.robot).cmp(&score(other)) {
                            std::cmp::Ordering::Less => 2,
                            std::cmp::Ordering::Equal => 1,
                            std::cmp::Ordering::Greater => 0,
                        };
                        half_points += points * i128::from(matrix.weight(maze));
                    }
                }
            }
            let is_ranked = line.rank.is_some();
            let expected = is_ranked.then(|| Mean::fraction(half_points, 2));
            prop_assert_eq!(line.rank_points, expected);
        }
    }

    #[test]
    fn a_weight_is_a_repetition(sketch in sketches()) {
        let mut repeated = sketch.clone();
        repeated.weights.fill(1);
        repeated.mazes = sketch.mazes.iter().flat_map(|maze| {
            vec![maze.clone(); sketch.weights[maze.set] as usize]
        }).collect();
        let (matrix, repeated) = (sketch.matrix(), repeated.matrix());
        // Counts are of matches that were really played.
        let without_counts = |ranking: &Ranking, matrix: &ScoreMatrix| {
            let mut lines = by_name(ranking, matrix);
            for (_, line) in &mut lines {
                let counts = [
                    &mut line.matches, &mut line.finished, &mut line.budget_used_up,
                    &mut line.goal_reached, &mut line.faults, &mut line.optimal_speed_runs,
                ];
                counts.into_iter().for_each(|it| *it = 0);
            }
            lines
        };
        for method in METHODS {
            let (ranking, other) = (rank(&matrix, method), rank(&repeated, method));
            prop_assert_eq!(without_counts(&ranking, &matrix), without_counts(&other, &repeated));
        }
    }

    #[test]
    fn regret_ranks_as_the_mean_score_does(sketch in sketches()) {
        let matrix = sketch.matrix();
        let (by_score, by_regret) = (rank(&matrix, Method::MeanScore), rank(&matrix, Method::Regret));
        prop_assert_eq!(ranks(&by_score), ranks(&by_regret));
    }

    /// A robot with a missing match does not move the others.
    #[test]
    fn an_incomplete_robot_changes_nothing_for_others(sketch in sketches(), at in 0..8_usize) {
        let reachable: Vec<usize> = (0..sketch.mazes.len())
            .filter(|&it| sketch.mazes[it].is_reachable)
            .collect();
        prop_assume!(sketch.robots > 1 && !reachable.is_empty());
        let mut incomplete = sketch.clone();
        incomplete.mazes[reachable[at % reachable.len()]].cells[0] = None;
        let mut matrix = incomplete.matrix();
        matrix.robots[0].unplayed.insert("no process".into(), 1);
        let others: Vec<usize> = (1..sketch.robots).collect();
        let without = incomplete.matrix_with_order(&others);
        for method in METHODS {
            let (ranking, other) = (rank(&matrix, method), rank(&without, method));
            let lines = by_name(&ranking, &matrix);
            let is_other = |it: &(GuestText, RankingLine)| it.0 != *name(0);
            let rest: Vec<_> = lines.iter().filter(|it| is_other(it)).cloned().collect();
            prop_assert_eq!(rest, by_name(&other, &without));
            prop_assert_eq!(ranking.mazes, other.mazes);
            let (_, line) = lines.iter().find(|it| !is_other(it)).expect("it has a line");
            prop_assert_eq!((line.rank, line.state), (None, RobotState::Incomplete));
            prop_assert_eq!(line.unplayed, 1);
        }
    }
}

/// Three robots: one that fails the hard maze, one that finishes everything, one in between.
fn example() -> Sketch {
    Sketch::of_rows(&[
        vec![finished(90, 17), finished(110, 17), finished(120, 18)],
        vec![failed(), finished(600, 60), failed()],
    ])
}

#[test]
fn failing_in_the_hard_maze_does_not_pay() {
    let matrix = example().matrix();
    for method in METHODS {
        let ranking = rank(&matrix, method);
        assert_eq!(ranks(&ranking), [(1, Some(1)), (0, Some(2)), (2, Some(3))]);
    }
    let ranking = rank(&matrix, Method::MeanScore);
    let [best, next, _] = &ranking.lines[..] else {
        panic!("{ranking:?}");
    };
    // (17 + 110/30 + 60 + 600/30) / 2, and (17 + 90/30 + 1000) / 2.
    assert_eq!(best.value, Some(Mean::fraction(3020, 60)));
    assert_eq!(next.value, Some(Mean::fraction(1020, 2)));
    assert_eq!(next.mean_finished_score, Some(Mean::fraction(20, 1)));
    assert_eq!(next.finish_rate, Some(Mean::fraction(1, 2)));
    let regret = next.finished_regret.expect("a finished match");
    assert_eq!(regret.exploration, Mean::fraction(87, 30));
    assert_eq!(
        (regret.speed, next.rank_points),
        (Mean::fraction(15, 1), Some(Mean::fraction(5, 2)))
    );
    assert_eq!((next.matches, next.finished, next.faults), (2, 1, 1));
    // 107 steps and 6 calls in the match that failed.
    assert_eq!(
        next.step_fuel_mean,
        Some(Mean::fraction(107 * 100 + 500, 113))
    );
}

#[test]
fn percentiles_are_scores_that_were_reached() {
    let rows: Vec<_> = (1..=10).map(|it| vec![finished(0, it)]).collect();
    let ranking = rank(&Sketch::of_rows(&rows).matrix(), Method::MeanScore);
    let percentiles = ranking.lines[0].percentiles.expect("ten matches");
    let steps = [
        percentiles.p10,
        percentiles.p25,
        percentiles.p50,
        percentiles.p75,
        percentiles.p90,
    ];
    assert_eq!(
        steps.map(|it| it.to_string()),
        ["1.000", "3.000", "5.000", "8.000", "9.000"]
    );
}

#[test]
fn tie_breaks_decide_in_their_order() {
    // As many finished with the same average; the first has the lower median.
    let matrix = Sketch::of_rows(&[
        vec![finished(30, 10), finished(30, 11)],
        vec![finished(30, 10), finished(30, 11)],
        vec![finished(30, 13), finished(30, 11)],
    ])
    .matrix();
    let with = |tie_breaks: &[TieBreak]| {
        let scoring = Scoring {
            tie_breaks: tie_breaks.to_vec(),
            ..Scoring::default()
        };
        ranks(&Ranking::new(&matrix, &scoring, MazeFilter::All, None))
    };
    assert_eq!(with(&[]), [(0, Some(1)), (1, Some(2))]);
    assert_eq!(with(&[TieBreak::Memory]), [(0, Some(1)), (1, Some(1))]);
    let (memory, median) = (TieBreak::Memory, TieBreak::MedianScore);
    assert_eq!(with(&[memory, median]), [(0, Some(1)), (1, Some(2))]);
}

#[test]
fn sets_classes_and_unreachable_mazes_are_left_out() {
    let mut sketch = example();
    sketch.weights = vec![1, 5];
    sketch.mazes[1].set = 1;
    sketch.mazes.push(SketchMaze {
        set: 1,
        is_reachable: false,
        cells: vec![failed(); 3],
    });
    let mut matrix = sketch.matrix();
    matrix.robots[0].class = Some("small".into());
    matrix.robots[2].class = Some("small".into());
    let scoring = Scoring::default();
    let all = Ranking::new(&matrix, &scoring, MazeFilter::All, None);
    assert_eq!(
        (all.mazes, all.mazes_unreachable, all.mazes_total),
        (2, 1, 3)
    );
    assert!(!all.partial);
    let easy = Ranking::new(&matrix, &scoring, MazeFilter::Set(0), None);
    assert_eq!(ranks(&easy), [(0, Some(1)), (1, Some(2)), (2, Some(3))]);
    let small = Ranking::new(&matrix, &scoring, MazeFilter::All, Some("small".into()));
    assert_eq!(ranks(&small), [(0, Some(1)), (2, Some(2))]);
    // One point in the easy maze, and half a point five times in the hard one.
    assert_eq!(small.lines[0].rank_points, Some(Mean::fraction(7, 2)));
}

#[test]
fn a_contest_in_progress_ranks_what_all_have_played() {
    let mut sketch = example();
    sketch.mazes[1].cells = vec![failed(), None, None];
    let ranking = rank(&sketch.matrix(), Method::MeanScore);
    assert_eq!(ranks(&ranking), [(0, Some(1)), (1, Some(2)), (2, Some(3))]);
    assert!(ranking.partial && ranking.mazes == 1);
    // A robot that was added later does not take all ranks away.
    sketch.mazes[0].cells[1] = None;
    let ranking = rank(&sketch.matrix(), Method::MeanScore);
    assert_eq!(ranks(&ranking), [(0, Some(1)), (2, Some(2)), (1, None)]);
    assert_eq!(line_of(&ranking, 1).state, RobotState::NotStarted);
}

#[test]
fn nothing_has_no_ranks() {
    for rows in [&[][..], &[vec![None, None]][..]] {
        let ranking = rank(&Sketch::of_rows(rows).matrix(), Method::RankPoints);
        assert!(
            ranking
                .lines
                .iter()
                .all(|it| it.rank.is_none() && it.value.is_none())
        );
    }
}

/// Takes a small part of a second when it is optimised; the deadline is for this build on a busy
/// machine, and fails for anything that does more than a few passes.
#[test]
fn a_million_matches_are_ranked_at_once() {
    let row = |maze: u32| {
        let robots = (0..5).map(|robot| match (maze * 7 + robot) % 11 {
            0 => failed(),
            rest => finished(60 + maze % 90, 20 + rest),
        });
        robots.collect()
    };
    let mut sketch = Sketch::of_rows(&(0..200).map(row).collect::<Vec<_>>());
    sketch.seeds = 1000;
    for maze in &mut sketch.mazes {
        maze.cells = maze.cells.repeat(1000);
    }
    let matrix = sketch.matrix();
    for method in METHODS {
        let start = Instant::now();
        let ranking = rank(&matrix, method);
        let elapsed = start.elapsed();
        assert_eq!((ranking.mazes, ranking.lines[0].matches), (200, 200_000));
        assert!(elapsed < Duration::from_secs(30), "{method:?}: {elapsed:?}");
    }
}
