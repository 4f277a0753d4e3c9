//! Generated mazes are legal, never change, and have the properties of their kind.

use std::ops::Range;

use super::*;
use crate::maze::format::{self, Format};
use crate::maze::{Cell, Heading, Maze, Metric, Walls};
use crate::maze::{distances_from, shortest_path, unreachable_cells, violations};

fn every_kind() -> impl Iterator<Item = Kind> {
    let trees = [0, 100].map(|loops| Kind::Tree { loops });
    Kind::ALL.into_iter().chain(trees)
}

/// Calls `check` with the name and the maze of every kind, dimension and seed.
fn for_each(kinds: impl Iterator<Item = Kind>, seeds: Range<u64>, check: impl Fn(&str, &Maze)) {
    for kind in kinds {
        for dimension in GENERATED_DIMENSIONS.step_by(2) {
            for seed in seeds.clone() {
                let name = format!("gen:{kind}:{dimension}:{seed}");
                check(&name, &kind.generate(dimension, seed));
            }
        }
    }
}

fn check_legal(name: &str, maze: &Maze) {
    assert_eq!(violations(maze), [], "{name}");
    assert_eq!(unreachable_cells(maze), [], "{name}");
}

fn check_round_trips(name: &str, maze: &Maze) {
    for format in Format::ALL {
        let text = format::print(maze, format).unwrap_or_else(|e| panic!("{name}: {e}"));
        let parsed = format::parse(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(parsed.maze, *maze, "{name} as {format:?}");
    }
}

#[test]
fn mazes_are_legal_and_round_trip_in_every_format() {
    for_each(every_kind(), 0..6, |name, maze| {
        check_legal(name, maze);
        check_round_trips(name, maze);
    });
}

#[test]
#[ignore = "20,000 mazes take long; run with --ignored"]
fn many_mazes_are_legal_and_round_trip_in_every_format() {
    for_each(Kind::ALL.into_iter(), 0..1_000, |name, maze| {
        check_legal(name, maze);
        check_round_trips(name, maze);
    });
}

/// Neither a change here nor a dependency may change published mazes.
#[test]
fn the_mazes_of_a_specification_never_change() {
    let found = [
        "gen:division:12:1",
        "gen:tree:16:42",
        "gen:braid:20:18446744073709551615",
        "gen:stretches:14:7",
    ]
    .map(|text| {
        let spec: GenSpec = text.parse().expect("a specification");
        let maze = spec.expand().next().expect("one maze").generate();
        format!("{text} {:.16}", maze.digest().to_string())
    });
    assert_eq!(
        found,
        [
            "gen:division:12:1 b1640fed633d5308",
            "gen:tree:16:42 aca3412247ffbd8b",
            "gen:braid:20:18446744073709551615 6f446a69cb83a2e8",
            "gen:stretches:14:7 b40b72e65ee915bb",
        ]
    );
}

#[test]
fn the_name_of_a_maze_is_its_specification() {
    let many: GenSpec = "gen:tree,loops=30:12..=15:3..=4".parse().expect("valid");
    let mazes: Vec<_> = many.expand().collect();
    assert_eq!(mazes.len() as u64, many.count());
    for maze in mazes {
        let name = maze.to_string();
        let alone: GenSpec = name.parse().unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(alone.expand().collect::<Vec<_>>(), [maze]);
    }
}

#[test]
fn more_loops_open_more_walls_of_the_same_tree() {
    let walls_of = |loops| Kind::Tree { loops }.generate(16, 7).walls().clone();
    let tree = walls_of(0);
    // A tree of the 252 cells outside the goal room and the room as one, with its 4 edges.
    assert_eq!(open_edges(&tree), 16 * 16 - 1 + 1);
    let mut before = tree;
    for loops in [1, 12, 50, 100] {
        let now = walls_of(loops);
        for cell in now.cells() {
            assert_eq!(
                before.value(cell) & !now.value(cell),
                0,
                "{loops} at {cell}"
            );
        }
        assert!(open_edges(&now) > open_edges(&before));
        before = now;
    }
}

/// The kinds differ in loops, dead ends and posts without walls.
#[test]
fn each_kind_has_its_properties() {
    let totals = |kind: Kind| {
        (0..40).fold((0, 0, 0), |(loops, dead_ends, bare), seed| {
            let maze = kind.generate(16, seed);
            let walls = maze.walls();
            (
                loops + open_edges(walls) - (16 * 16 - 1),
                dead_ends + dead_ends_of(walls),
                bare + bare_posts(walls),
            )
        })
    };
    let [division, tree, braid, stretches] = Kind::ALL.map(totals);
    assert!(
        braid.0 > tree.0 && tree.0 > division.0,
        "braid has the most loops"
    );
    assert!(tree.1 > 2 * braid.1, "tree has the most dead ends");
    assert!(division.2 > 8 * 40, "division has open areas");
    // The post in the middle of the goal room has no walls in any maze.
    assert_eq!(braid.2, 40, "braid has a wall at every other post");
    assert!(
        stretches.0 > division.0 && stretches.1 < division.1 && 4 * stretches.2 < division.2,
        "stretches has more loops than division, fewer dead ends and fewer bare posts"
    );
    let optimum = |kind: Kind| -> u32 {
        let optima = (0..40).map(|seed| shortest_path(&kind.generate(16, seed), Metric::STEPS));
        optima.map(|path| path.expect("solvable").steps()).sum()
    };
    assert!(
        4 * optimum(Kind::Stretches) < 3 * optimum(Kind::Division),
        "stretches has short paths"
    );
}

fn open_edges(walls: &Walls) -> usize {
    let ones = walls
        .cells()
        .map(|cell| walls.value(cell).count_ones() as usize);
    ones.sum::<usize>() / 2
}

fn dead_ends_of(walls: &Walls) -> usize {
    let cells = walls.cells();
    cells
        .filter(|&cell| walls.value(cell).count_ones() == 1)
        .count()
}

fn bare_posts(walls: &Walls) -> usize {
    let inner = |cell: &Cell| cell.x > 0 && cell.y > 0;
    let bare = |cell: Cell| {
        let below_left = Cell::new(cell.x - 1, cell.y - 1);
        walls.is_open(cell, Heading::Left)
            && walls.is_open(cell, Heading::Down)
            && walls.is_open(below_left, Heading::Up)
            && walls.is_open(below_left, Heading::Right)
    };
    walls
        .cells()
        .filter(inner)
        .filter(|&cell| bare(cell))
        .count()
}

#[test]
fn all_cells_are_reachable() {
    for_each(Kind::ALL.into_iter(), 0..3, |name, maze| {
        let distances = distances_from(maze, maze.start(), Metric::STEPS);
        let cells = usize::from(maze.dimension()).pow(2);
        assert_eq!(distances.reached(), cells, "{name}");
    });
}
