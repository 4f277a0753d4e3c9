//! What every generated maze must be: legal, the same for ever, and of its kind.

use std::ops::Range;

use sha2::{Digest, Sha256};

use super::*;
use crate::maze::format::{self, Format};
use crate::maze::{Cell, Heading, Walls, distances_from, violations};
use crate::maze::{Metric, shortest_path, unreachable_cells};

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
                check(&name, &generate(kind, dimension, seed));
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
fn generated_mazes_are_legal_and_survive_every_format() {
    for_each(every_kind(), 0..6, |name, maze| {
        check_legal(name, maze);
        check_round_trips(name, maze);
    });
}

#[test]
#[ignore = "20,000 mazes take a while: run with --ignored"]
fn a_thousand_mazes_of_each_kind_and_size_are_legal_and_survive_every_format() {
    for_each(Kind::ALL.into_iter(), 0..1_000, |name, maze| {
        check_legal(name, maze);
        check_round_trips(name, maze);
    });
}

/// Published mazes must not move: neither by a change here nor by a dependency.
#[test]
fn the_same_specification_gives_the_same_bytes_for_ever() {
    let found = [
        "gen:division:12:1",
        "gen:tree:16:42",
        "gen:braid:20:18446744073709551615",
        "gen:stretches:14:7",
    ]
    .map(|text| {
        let spec: GenSpec = text.parse().expect("a specification");
        let maze = spec.expand().next().expect("one maze").generate();
        let hash = Sha256::digest(maze.identity_bytes());
        let hex: String = hash
            .iter()
            .take(8)
            .map(|byte| format!("{byte:02x}"))
            .collect();
        format!("{text} {hex}")
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
fn names_of_expanded_mazes_make_them_again() {
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
    let walls_of = |loops| generate(Kind::Tree { loops }, 16, 7).walls().clone();
    let tree = walls_of(0);
    // A tree over the 253 places outside the goal room and the room itself.
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

/// The kinds differ in what a robot meets: loops, dead ends and bare posts.
#[test]
fn each_kind_has_its_character() {
    let totals = |kind| {
        (0..40).fold((0, 0, 0), |(loops, dead_ends, bare), seed| {
            let maze = generate(kind, 16, seed);
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
    assert!(division.2 > 8 * 40, "division leaves places without walls");
    // The post in the middle of the goal room is bare in every maze.
    assert_eq!(braid.2, 40, "braid leaves no post without a wall");
    assert!(
        stretches.0 > division.0 && stretches.1 < division.1 && 4 * stretches.2 < division.2,
        "stretches have more loops than division, fewer dead ends and bare posts"
    );
    let optimum = |kind| -> u32 {
        let optima = (0..40).map(|seed| shortest_path(&generate(kind, 16, seed), Metric::STEPS));
        optima.map(|path| path.expect("solvable").steps()).sum()
    };
    assert!(
        4 * optimum(Kind::Stretches) < 3 * optimum(Kind::Division),
        "stretches have short ways"
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
fn all_cells_can_be_driven_to() {
    for_each(Kind::ALL.into_iter(), 0..3, |name, maze| {
        let distances = distances_from(maze, maze.start(), Metric::STEPS);
        let cells = usize::from(maze.dimension()).pow(2);
        assert_eq!(distances.reached(), cells, "{name}");
    });
}
