//! Every maze file of the shared collection: it parses, it survives every format that can hold
//! it, and the survey of it agrees with a count on the characters of the file.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use wasmouse_core::maze::format::{Format, parse, print};
use wasmouse_core::maze::{Area, Cell, Maze, Survey, goal_entrances, unreachable_cells};

use crate::shared::shared;

/// The maze files, sorted.
fn files() -> Vec<PathBuf> {
    let shared = shared();
    let mut files = Vec::new();
    for folder in ["competition", "halfsize", "training", "udacity"] {
        let entries = fs::read_dir(shared.join("mazes").join(folder)).expect("a folder");
        files.extend(entries.map(|entry| entry.expect("an entry").path()));
    }
    files.sort();
    assert!(files.len() >= 300, "only {} maze files", files.len());
    files
}

fn read(file: &Path) -> String {
    fs::read_to_string(file).expect("maze files are UTF-8 text")
}

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn every_file_parses() {
    let failed = files().into_iter().filter_map(|file| {
        let error = parse(&read(&file)).err()?;
        Some(format!("{}: {error}", file.display()))
    });
    assert_eq!(failed.collect::<Vec<_>>(), [""; 0]);
}

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn every_file_survives_every_format_that_can_hold_it() {
    let mut printed = BTreeMap::new();
    for file in files() {
        let maze = parse(&read(&file)).expect("a maze").maze;
        let is_usual =
            maze.start() == Cell::new(0, 0) && maze.goal() == Area::center(maze.dimension());
        for format in Format::ALL {
            let text = print(&maze, format);
            assert_eq!(
                text.is_ok(),
                is_usual || format == Format::Competition,
                "{}: {text:?}",
                file.display()
            );
            if let Ok(text) = text {
                let again = parse(&text).expect("what was printed is a maze");
                assert_eq!(again.format, format, "{}", file.display());
                assert_eq!(again.maze, maze, "{} as {format}", file.display());
                *printed.entry(format.name()).or_insert(0) += 1;
            }
        }
    }
    println!("round trips by format: {printed:?}");
}

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn printing_in_the_same_format_gives_the_same_characters() {
    for file in files() {
        let text = read(&file);
        let parsed = parse(&text).expect("a maze");
        let mut printed = print(&parsed.maze, parsed.format).expect("its own format");
        if parsed.format == Format::Competition && !text.contains('S') {
            printed = printed.replace(['S', 'G'], " ");
        }
        let text = text.replace("\r\n", "\n");
        assert_eq!(printed.trim_end(), text.trim_end(), "{}", file.display());
    }
}

/// What is counted about a maze.
#[derive(Debug, PartialEq, Eq)]
struct Facts {
    solvable: bool,
    unreachable: usize,
    entrances: usize,
}

impl Facts {
    fn by_wasmouse(maze: &Maze) -> Self {
        let unreachable = unreachable_cells(maze);
        Self {
            solvable: maze.goal().cells().any(|cell| !unreachable.contains(&cell)),
            unreachable: unreachable.len(),
            entrances: goal_entrances(maze).len(),
        }
    }

    /// From a grid of characters with the start and the goal cells marked:
    /// paint runs over everything that is no wall, character by character.
    fn by_painting(mut picture: Vec<Vec<char>>) -> Self {
        let centers: Vec<(usize, usize)> = (1..picture.len())
            .step_by(2)
            .flat_map(|row| (2..picture[0].len()).step_by(4).map(move |at| (row, at)))
            .collect();
        let marked = |picture: &[Vec<char>], mark| -> Vec<(usize, usize)> {
            let is_marked = |&(row, at): &(usize, usize)| picture[row][at] == mark;
            centers.iter().copied().filter(is_marked).collect()
        };
        let goal = marked(&picture, 'G');
        let sides = |(row, at): (usize, usize)| {
            [
                ((row - 1, at), (row.wrapping_sub(2), at)),
                ((row + 1, at), (row + 2, at)),
                ((row, at - 2), (row, at.wrapping_sub(4))),
                ((row, at + 2), (row, at + 4)),
            ]
        };
        let entrances = goal
            .iter()
            .flat_map(|&cell| sides(cell))
            .filter(|&((row, at), beyond)| picture[row][at] == ' ' && !goal.contains(&beyond))
            .count();
        let mut wet = marked(&picture, 'S');
        while let Some((row, at)) = wet.pop() {
            if matches!(picture[row][at], ' ' | 'S' | 'G') {
                picture[row][at] = '~';
                wet.extend([(row - 1, at), (row + 1, at), (row, at - 1), (row, at + 1)]);
            }
        }
        let is_dry = |&&(row, at): &&(usize, usize)| picture[row][at] != '~';
        Self {
            solvable: goal.iter().any(|cell| !is_dry(&cell)),
            unreachable: centers.iter().filter(is_dry).count(),
            entrances,
        }
    }
}

/// The file as a grid of characters; Udacity values are drawn as a picture.
fn picture(text: &str) -> Vec<Vec<char>> {
    let mut picture: Vec<Vec<char>> = if text.starts_with('o') {
        text.trim_end()
            .lines()
            .map(|line| line.chars().collect())
            .collect()
    } else {
        drawn(text)
    };
    let rows = picture.len();
    if !text.contains('S') {
        picture[rows - 2][2] = 'S';
        let middle = rows / 2;
        for row in [middle - 1, middle + 1] {
            for at in [2 * middle - 2, 2 * middle + 2] {
                picture[row][at] = 'G';
            }
        }
    }
    picture
}

fn drawn(text: &str) -> Vec<Vec<char>> {
    let columns: Vec<Vec<u8>> = text
        .lines()
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|value| value.parse::<u8>().expect("a number"))
        })
        .map(Iterator::collect)
        .collect();
    let n = columns.len();
    let mut picture = vec![vec!['#'; 4 * n + 1]; 2 * n + 1];
    for (x, column) in columns.iter().enumerate() {
        for (y, &value) in column.iter().enumerate() {
            let (row, at) = (2 * (n - 1 - y) + 1, 4 * x + 2);
            picture[row][at - 1..=at + 1].fill(' ');
            for (bit, (row, at)) in [(1, (row - 1, at)), (2, (row, at + 2))] {
                if value & bit != 0 {
                    picture[row][at] = ' ';
                }
            }
        }
    }
    picture
}

#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn the_survey_agrees_with_paint_on_the_characters() {
    let mut survey = Survey::default();
    let mut painted = Survey::default();
    for file in files() {
        let text = read(&file);
        let maze = parse(&text).expect("a maze").maze;
        let facts = Facts::by_painting(picture(&text));
        assert_eq!(Facts::by_wasmouse(&maze), facts, "{}", file.display());
        survey.add(&maze);
        painted.files += 1;
        painted.parsed += 1;
        painted.solvable += usize::from(facts.solvable);
        painted.with_unreachable += usize::from(facts.unreachable > 0);
        *painted.by_entrances.entry(facts.entrances).or_default() += 1;
    }
    // Legality is more than these counts.
    painted.contest_legal = survey.contest_legal;
    println!("{painted:?}");
    assert_eq!(survey, painted);
}
